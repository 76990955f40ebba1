"""Surface displacement of the elastic half-space under a uniformly loaded rectangle.

References
----------
.. [1] A. E. H. Love, "The stress produced in a semi-infinite solid by pressure on part of the
   boundary", Phil. Trans. R. Soc. A 228, 377-420 (1929).
.. [2] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), eq. 3.25.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Floats, Real
from roughline.computing.compiled import compiled

# Love's closed form loses digits with the distance: its four terms grow like r, their sum decays
# like 1/r. So it is used up to this distance from the cell, in its shorter sides. Beyond, the
# integral along the longer side is exact and eight Gauss points across it are enough.
_CLOSED_FORM_UP_TO = 2.5
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)
# From this distance on, in longer sides, the multipoles up to 1/r^11 are all that counts.
_MULTIPOLES_FROM = 16.0
_MULTIPOLES = 5  # beside the first


def love(
    x: ArrayLike, y: ArrayLike, dx: float, dy: float, factor: float = 1.0, out: Real | None = None
) -> Real:
    """Displacement per unit pressure on one cell, for E* = 1, shape (x.size, y.size). [length]

    It is ``(1 / pi) * integral of 1/r over the cell``, accurate to about 1e-15, times a factor.
    Offsets from the centre of the loaded cell are in cells; they are not negative, and those along
    y ascend. The sides of the cell are lengths.
    """
    x, y, unit = np.asarray(x, np.float64), np.asarray(y, np.float64), max(dx, dy)
    out = np.empty((x.size, y.size)) if out is None else out
    sides = dx / unit, dy / unit
    _fill(x * sides[0], y * sides[1], *sides, _multipoles(*sides), factor * unit / np.pi, out)
    return out


@lru_cache
def _multipoles(dx: float, dy: float) -> Real:
    """Return the mean over a cell, whose longer side is one, of the terms of 1/r.

    1/r seen from (u, v) in the cell is the sum over even l of ``rho^l P_l(cos g) / r^(l+1)``, where
    ``rho cos g = u cos t + v sin t`` in the direction t; odd terms have no mean. Row k holds the
    factor of ``1/r^(2k+1)`` as a polynomial in cos² t.
    """
    half_sides = dx / 2, dy / 2
    moments = [
        [half ** (2 * i) / (2 * i + 1) for i in range(_MULTIPOLES + 1)] for half in half_sides
    ]
    result = np.zeros((_MULTIPOLES + 1, _MULTIPOLES + 1))
    for k in range(_MULTIPOLES + 1):
        for m in range(k + 1):  # P_2k has the term (rho cos g)^(2k - 2m) rho^(2m)
            legendre = (-1) ** m * math.comb(2 * k, m) * math.comb(4 * k - 2 * m, 2 * k) / 4**k
            for i in range(k - m + 1):  # of the first factor (u cos t)^(2i) (v sin t)^(2k-2m-2i)
                for j in range(m + 1):  # and of the second u^(2j) v^(2m-2j)
                    term = legendre * math.comb(2 * (k - m), 2 * i) * math.comb(m, j)
                    term *= moments[0][i + j] * moments[1][k - i - j]
                    for n in range(k - m - i + 1):  # sin² = 1 - cos²
                        result[k, i + n] += term * (-1) ** n * math.comb(k - m - i, n)
    return result


@compiled
def _fill(
    x: Floats, y: Floats, dx: float, dy: float, multipoles: Floats, factor: float, rows: Floats
) -> None:
    for i in range(x.size):
        row = rows[i]
        near = np.searchsorted(y, math.sqrt(max(_MULTIPOLES_FROM**2 - x[i] ** 2, 0.0)))
        for j in range(near):
            row[j] = factor * _near(x[i], y[j], dx, dy)
        powers, share = _in_powers(x[i], multipoles), factor * dx * dy
        outer, far = y[near:], row[near:]
        for j in range(far.size):
            far[j] = share * _series(powers, x[i], outer[j])


@compiled
def _in_powers(x: float, multipoles: Floats) -> Floats:
    """Return the multipoles at the offset x as a polynomial in 1/r², to be multiplied by 1/r."""
    powers = np.zeros(2 * _MULTIPOLES + 1)
    for k in range(_MULTIPOLES + 1):
        power = 1.0
        for i in range(k + 1):
            powers[k + i] += multipoles[k, i] * power
            power *= x * x
    return powers


@compiled
def _series(powers: Floats, x: float, y: float) -> float:
    """Return the mean of 1/r over a cell that is far."""
    s = np.divide(1.0, x * x + y * y)
    total = powers[2 * _MULTIPOLES]
    for n in range(2 * _MULTIPOLES - 1, -1, -1):
        total = total * s + powers[n]
    return total * math.sqrt(s)


@compiled
def _near(x: float, y: float, dx: float, dy: float) -> float:
    """Return the integral of 1/r over a cell that is near."""
    if dx < dy:
        x, y, dx, dy = y, x, dy, dx
    left, right = x - dx / 2, x + dx / 2
    if max(left, 0.0) ** 2 + y**2 < (_CLOSED_FORM_UP_TO * dy) ** 2:
        low, high = y - dy / 2, y + dy / 2
        return _corner(right, high) - _corner(left, high) - _corner(right, low) + _corner(left, low)
    total = 0.0
    for i in range(_NODES.size):
        total += _WEIGHTS[i] * _line(left, right, y + _NODES[i] * dy / 2)
    return total * dy / 2


@compiled
def _corner(x: float, y: float) -> float:
    """Integral of 1/r over the rectangle between the origin and (x, y), with the sign of x y."""
    if x == 0 or y == 0:
        return 0.0
    a, b = abs(x), abs(y)
    return math.copysign(1.0, x * y) * (a * math.asinh(b / a) + b * math.asinh(a / b))


@compiled
def _line(left: float, right: float, t: float) -> float:
    """Integral of 1/r from left to right at the distance t: asinh(right / t) - asinh(left / t)."""
    both = right * math.sqrt(t**2 + left**2) + abs(left) * math.sqrt(t**2 + right**2)
    if left < 0:
        return math.asinh(both / t**2)
    return math.asinh((right - left) * (right + left) / both)
