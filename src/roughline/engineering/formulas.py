"""What follows from a curve for two materials: conductance, interface and tangential stiffness.

Every function takes arrays over loads, or numbers, in SI or any coherent units.
"""

from __future__ import annotations

import math
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from roughline.computing.arrays import Real
from roughline.errors import InputError

_Value = TypeVar("_Value", float, NDArray[np.float64])

_FULL_CONTACT = 1e-6  # of the saturated stiffness, which may be missing in full contact

ELASTIC_UP_TO = 0.4
"""Mean contact pressure over hardness at which yield begins under a smooth asperity."""


def interface_stiffness(stiffness: ArrayLike, saturated: float) -> Real:
    """Stiffness of the interface alone, 1 / k_interface = 1 / k - 1 / k_s. [force / length]

    A free surface in full contact is as stiff as the flat punch of its outline on the same grid,
    k_s, the saturated stiffness. That compliance belongs to the bodies, and the rest to the
    roughness. This is exact under a uniform mean pressure, which a punch does not have: see
    :mod:`roughline.margins.larger_surface` for a piece of a larger surface. It is infinite in
    full contact, where k is k_s to one part in a million.
    """
    k = np.asarray(stiffness, dtype=np.float64)
    left = saturated - k
    with np.errstate(divide="ignore", invalid="ignore"):
        of_interface = np.where(left > _FULL_CONTACT * saturated, k * saturated / left, np.inf)
    return np.where(np.isnan(left), np.nan, of_interface)


def electrical_resistance(
    stiffness: _Value, E_star: float, resistivities: tuple[float, float]
) -> _Value:
    """Constriction resistance by Barber's identity, 1 / R = 2 k / (E* (rho1 + rho2)). [ohm]

    k is the normal contact stiffness [N / m], E* the contact modulus [Pa], and the resistivities
    are those of both bodies [ohm m]. It is exact for clean metallic contact of any shape: current
    and stress follow from the same potential. Films and the mean free path of electrons add to the
    resistance.

    References
    ----------
    J. R. Barber, "Bounds on the electrical resistance between contacting elastic rough bodies",
    Proc. R. Soc. A 459, 53-66 (2003), eq. 10.
    """
    return E_star * sum(resistivities) / (2 * stiffness)


def thermal_conductance(
    stiffness: _Value, E_star: float, conductivities: tuple[float, float]
) -> _Value:
    """Thermal conductance of the solid contact by Barber's identity, G = kappa_s k / E*. [W / K]

    With ``kappa_s = 2 kappa1 kappa2 / (kappa1 + kappa2)`` of the conductivities of both bodies
    [W / (m K)], and the contact modulus E* [Pa]. Of a normal contact stiffness per nominal area
    [N / m³] instead of k [N / m] it is the conductance per area [W / (m² K)]. Gas in the gaps and
    radiation add to it.
    """
    return harmonic_conductivity(conductivities) * stiffness / E_star


def harmonic_conductivity(conductivities: tuple[float, float]) -> float:
    """kappa_s = 2 kappa1 kappa2 / (kappa1 + kappa2). [W / (m K)]"""
    first, second = conductivities
    return 2 * first * second / (first + second)


def holm_resistance(force: _Value, hardness: float, resistivities: tuple[float, float]) -> _Value:
    """Holm's resistance of one round spot at the hardness of the softer body. [ohm]

    R = (rho1 + rho2) / (4 a) with pi a² = F / H: all the load F [N] on a single plastic spot of
    the hardness H [Pa], between bodies of these resistivities [ohm m]. Many spots far apart have
    less.

    References
    ----------
    R. Holm, "Electric Contacts", 4th ed. (1967), section 1.
    """
    radius = np.sqrt(force / (math.pi * hardness))
    return sum(resistivities) / (4 * radius)


def mikic_conductance(
    pressure: _Value,
    E_star: float,
    rms_height: float,
    rms_slope: float,
    conductivities: tuple[float, float],
) -> _Value:
    """Mikic's elastic conductance, 1.55 kappa_s m / sigma (sqrt(2) p / (E* m))^0.94. [W / (m² K)]

    p is the mean pressure over the nominal area [Pa], E* the contact modulus [Pa], kappa_s that of
    the conductivities of both bodies [W / (m K)]. Of the sum of both surfaces, sigma is the rms
    height [m], and m the mean absolute slope of a cut, for Gaussian heights rms grad h / sqrt(pi)
    with the rms slope of the surface.

    References
    ----------
    B. B. Mikic, "Thermal contact conductance; theoretical considerations", Int. J. Heat Mass
    Transfer 17, 205-214 (1974).
    """
    slope = _mean_slope(rms_slope)
    scale = 1.55 * harmonic_conductivity(conductivities) * slope / rms_height
    return scale * (math.sqrt(2) * pressure / (E_star * slope)) ** 0.94


def yovanovich_conductance(
    pressure: _Value,
    hardness: float,
    rms_height: float,
    rms_slope: float,
    conductivities: tuple[float, float],
) -> _Value:
    """Yovanovich's plastic conductance, 1.25 kappa_s m / sigma (p / H)^0.95. [W / (m² K)]

    H is the hardness of the softer body [Pa], and the rest as for :func:`mikic_conductance`.

    References
    ----------
    M. M. Yovanovich, "Four decades of research on thermal contact, gap, and joint resistance in
    microelectronics", IEEE Trans. Compon. Packag. Technol. 28, 182-206 (2005), eq. 14.
    """
    slope = _mean_slope(rms_slope)
    scale = 1.25 * harmonic_conductivity(conductivities) * slope / rms_height
    return scale * (pressure / hardness) ** 0.95


def plasticity_index(E_star: float, hardness: float, summits: tuple[float, float]) -> float:
    """Greenwood and Williamson's index, E* / H sqrt(sigma_s / R); < 0.6 elastic, > 1 plastic. [1]

    E* is the contact modulus and H the hardness of the softer body [Pa]; of the summits, sigma_s is
    the standard deviation of their heights, and R their mean radius [m].

    References
    ----------
    J. A. Greenwood and J. B. P. Williamson, "Contact of nominally flat surfaces", Proc. R. Soc. A
    295, 300-319 (1966), eq. 17.
    """
    deviation, radius = summits
    return E_star / hardness * math.sqrt(deviation / radius)


def partial_slip(
    depth: Real, force: Real, E_star: float, G_star: float, friction: float
) -> tuple[Real, Real]:
    """Tangential displacement and force at constant normal load, from none to full sliding.

    Q = mu (F(d) - F(d_c)), u_x = mu E* / G* (d - d_c) for a stick area as large as the contact at
    d_c, whatever its shape (Ciavarella 1998, Jäger 1998). Depths [length] and forces [force] are
    those of a rising curve up to the normal load; what is returned has one value more. E* and G*
    are contact moduli [pressure].

    Raises
    ------
    InputError
        If the coefficient of friction is not positive, or loads are missing.

    References
    ----------
    M. Ciavarella, "Tangential loading of general three-dimensional contacts", J. Appl. Mech. 65,
    998-1003 (1998); J. Jäger, "A new principle in contact mechanics", J. Tribol. 120, 677 (1998).
    """
    if not 0 < friction < math.inf:
        raise InputError(f"the coefficient of friction is {friction}; a positive one is needed")
    if not (np.isfinite(depth).all() and np.isfinite(force).all()):
        raise InputError("some loads of the curve were not solved; partial slip needs all of them")
    stick_depth = np.append(depth[::-1], 0.0)
    stick_force = np.append(force[::-1], 0.0)
    ratio = friction * E_star / G_star
    return ratio * (depth[-1] - stick_depth), friction * (force[-1] - stick_force)


def reflection(
    stiffness_per_area: ArrayLike, frequency: float, impedances: tuple[float, float]
) -> Real:
    """Modulus of the reflection coefficient of a longitudinal plane wave at normal incidence. [1]

    ``|r| = |z1 - z2 + i w z1 z2 / K| / |z1 + z2 + i w z1 z2 / K|``, for waves much longer than the
    distances between contact spots; w = 2 pi frequency [Hz], and z are the impedances of both
    bodies [kg / (m² s)]. K is the stiffness per area of the interface alone [N / m³]; where it is
    zero, the whole wave is reflected.

    References
    ----------
    H. G. Tattersall, "The ultrasonic pulse-echo technique as applied to adhesion testing",
    J. Phys. D 6, 819-832 (1973), eq. 15.
    """
    if not 0 < frequency < math.inf:
        raise InputError(f"frequency is {frequency}; a positive one is needed")
    first, second = impedances
    with np.errstate(divide="ignore", invalid="ignore"):
        spring = 2 * math.pi * frequency * first * second / np.asarray(stiffness_per_area)
        reflected = np.hypot(first - second, spring) / np.hypot(first + second, spring)
    return np.where(np.isinf(spring), 1.0, reflected)


def _mean_slope(rms_slope: float) -> float:
    """Mean absolute slope of a cut through Gaussian heights with an rms gradient."""
    return rms_slope / math.sqrt(math.pi)


def largest_pressure_under_ball(
    contact_radius: ArrayLike,
    radius: float,
    E_star: float,
    work_of_adhesion: float = 0.0,
    *,
    is_sphere: bool = False,
) -> Real:
    """Pressure in the middle of the contact of a ball, where it is largest. [Pa]

    That of Hertz's parabola is 2 E* a / (pi R), 3/2 of the mean [1]_. Of a sphere it is
    (E* / pi) (chi_2(a / R) + artanh(a / R)) with Legendre's chi function, the integral of g'(x) / x
    of the reduced profile g(x) = x artanh(x / R) [2]_. Where bodies stick as JKR have it, the pull
    at the edge takes sqrt(2 w E* / (pi a)) from either [1]_. NaN where nothing touches.

    References
    ----------
    .. [1] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), eq. 4.24 and §5.5.
    .. [2] V. L. Popov and M. Heß, *Method of Dimensionality Reduction in Contact Mechanics and
       Friction*, Springer (2015), ch. 3 and eq. 3.38.
    """
    from scipy.special import spence  # here because it loads slowly

    a = np.where(np.asarray(contact_radius) > 0, contact_radius, np.nan)
    share = a / radius
    if is_sphere:
        chi = (spence(1 - share) - spence(1 + share)) / 2
        pressure = E_star / np.pi * (chi + np.arctanh(share))
    else:
        pressure = 2 / np.pi * E_star * share
    return pressure - np.sqrt(2 * work_of_adhesion * E_star / (np.pi * a))
