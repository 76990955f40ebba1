"""Surface displacement of bonded layers under waves of pressure, in plane strain.

In each layer, Airy's stress function of a wave has two terms that decay from its top and two that
decay from its bottom. So all exponentials are below one, and thick layers do no harm. What lies
below has a compliance, two by two for shear and pressure. It ties the terms to each other at the
bottom, and they give the compliance at the top.

References
----------
.. [1] S. P. Timoshenko and J. N. Goodier, *Theory of Elasticity*, McGraw-Hill (1970), §24 (one wave
   of Airy's function).
"""

from __future__ import annotations

import math

import numpy as np

from roughline.computing.arrays import Floats, Real
from roughline.computing.compiled import compiled


def compliance(q: Real, layers: Real, base_young: float, base_poisson: float) -> Real:
    """Displacement over pressure of waves, real or complex ones. [length / pressure]

    Rows of the layers are Young's moduli, Poisson's ratios and thicknesses, from the top on.
    """
    young, poisson, thickness = layers
    soft = (1 + poisson) / young  # 1 / (2 G)
    found = np.array(q, dtype=np.result_type(q, np.float64))
    waves = found.reshape(-1)
    base_soft, unwanted = (1 + base_poisson) / base_young, np.empty((2, 0), found.dtype)
    _climb(waves, unwanted, soft, poisson, thickness, base_soft, base_poisson)
    if math.isinf(base_young):  # even pressure compresses layers that cannot widen
        even = soft * (1 - 2 * poisson) / (1 - poisson) * thickness
        waves[waves == 0] = even.sum()
    else:
        waves[waves == 0] = math.inf
    return found


def shear_compliance(
    q: Real, layers: Real, base_young: float, base_poisson: float
) -> tuple[Real, Real, Real]:
    """Displacements along the surface: by shear along and across waves, and by pressure.

    Waves may be complex. The last is what draws the surface together. At q = 0 shear displaces
    evenly, without bound on an elastic base, and pressure does not. [length / pressure]
    """
    young, poisson, thickness = layers
    base_soft, soft = (1 + base_poisson) / base_young, (1 + poisson) / young
    waves = np.array(q, dtype=np.result_type(q, np.float64)).reshape(-1)
    others, across = np.zeros((2, waves.size), waves.dtype), np.zeros_like(waves)
    _climb_twisted(waves, soft, thickness, base_soft, across)
    some = waves == 0
    _climb(waves, others, soft, poisson, thickness, base_soft, base_poisson)
    even = math.inf if base_soft else float((2 * soft * thickness).sum())
    others[0, some], across[some] = even, even
    return others[0].reshape(q.shape), across.reshape(q.shape), others[1].reshape(q.shape)


@compiled
def _climb_twisted(
    waves: Floats, soft: Real, thickness: Real, base_soft: float, across: Floats
) -> None:
    """Carry the compliance to shear across a wave, in antiplane strain, up through the layers.

    In each layer the displacement is a cosh(q z) + b sinh(q z), and the shear G q times as much as
    a sinh(q z) + b cosh(q z).
    """
    for i in range(waves.size):
        q = waves[i]
        if q == 0:
            continue
        c = 2 * base_soft / q
        for above in range(thickness.size):
            j = thickness.size - 1 - above
            stiff, t = q / (2 * soft[j]), np.tanh(thickness[j] * q)
            c = (c * stiff + t) / (1 + c * stiff * t) / stiff
        across[i] = c


@compiled
def _climb(
    waves: Floats,
    others: Floats,  # displacements along the surface by shear and by pressure, if there is room
    soft: Real,
    poisson: Real,
    thickness: Real,
    base_soft: float,
    base_poisson: float,
) -> None:
    """Carry the compliance of the base up through the layers, and write it over each wavenumber.

    The wave has the displacements u sin(q x) along x and w cos(q x) into the body, the shear stress
    T sin(q x) and the stress N cos(q x), both over q. Terms a and b of what decays downwards give,
    at the distance z from where it begins and with k = q z,

        2 G u = (a + b (k - 2 (1 - nu))) exp(-k),   T = (b - a - b k) exp(-k),
        2 G w = (a + b (k + 1 - 2 nu)) exp(-k),     N = -(a + b k) exp(-k).

    Of what decays upwards, w and T have the other sign.
    """
    for i in range(waves.size):
        q = waves[i]
        if q == 0:
            continue
        # compliance of what lies below: u = xx T + xz N, w = xz T + zz N
        xx = 0 * q - 2 * (1 - base_poisson) * base_soft
        xz, zz = 0 * q + (1 - 2 * base_poisson) * base_soft, xx
        for j in range(thickness.size - 1, -1, -1):
            k, g = q * thickness[j], soft[j]
            e, c, d = np.exp(-k), 2 * (1 - poisson[j]), 1 - 2 * poisson[j]
            # displacements less those by what lies below, at the bottom: of the terms from the top
            a00 = e * (g + xx + xz)
            a01 = e * (g * (k - c) - xx * (1 - k) + xz * k)
            a10 = e * (g + xz + zz)
            a11 = e * (g * (k + d) - xz * (1 - k) + zz * k)
            # and of those from the bottom
            b00, b01 = g - xx + xz, -c * g + xx
            b10, b11 = -g - xz + zz, -d * g + xz
            # so much of these goes with those: r = -b^-1 a
            det = b00 * b11 - b01 * b10
            r00, r01 = (b01 * a10 - b11 * a00) / det, (b01 * a11 - b11 * a01) / det
            r10, r11 = (b10 * a00 - b00 * a10) / det, (b10 * a01 - b00 * a11) / det
            # displacements and stresses at the top, of both together
            u0 = g * (1 + e * (r00 + (k - c) * r10))
            u1 = g * (-c + e * (r01 + (k - c) * r11))
            w0 = g * (1 - e * (r00 + (k + d) * r10))
            w1 = g * (d - e * (r01 + (k + d) * r11))
            t0 = -1 + e * (r00 - (1 - k) * r10)
            t1 = 1 + e * (r01 - (1 - k) * r11)
            n0 = -1 - e * (r00 + k * r10)
            n1 = -e * (r01 + k * r11)
            det = t0 * n1 - t1 * n0
            xx, xz, zz = (
                (u0 * n1 - u1 * n0) / det,
                (u1 * t0 - u0 * t1) / det,
                (w1 * t0 - w0 * t1) / det,
            )
        waves[i] = -zz / q
        if others.shape[1]:
            others[0, i], others[1, i] = -xx / q, xz / q
