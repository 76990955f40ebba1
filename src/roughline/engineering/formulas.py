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

Value = TypeVar("Value", float, NDArray[np.float64])

_FULL = 1e-6  # of the saturated stiffness, which may be missing in full contact

ELASTIC_UP_TO = 0.4
"""Mean contact pressure over hardness at which yield begins under a smooth asperity."""


def interface_stiffness(stiffness: ArrayLike, saturated: float) -> Real:
    """Stiffness of the interface alone, 1 / k_interface = 1 / k - 1 / k_s.

    A free surface in full contact is as stiff as its flat punch, k_s. That compliance belongs to
    the bodies, and the rest to the roughness. This is exact under a uniform mean pressure, which a
    punch does not have: see :mod:`roughline.assessment.larger_surface` for a piece of a larger
    surface.

    Parameters
    ----------
    stiffness : float or ndarray
        Of the contact, below `saturated`. [force / length]
    saturated : float
        Of the flat punch of the same outline, on the same grid. [force / length]

    Returns
    -------
    ndarray
        Infinite in full contact, where k is k_s to one part in a million. [force / length]
    """
    k = np.asarray(stiffness, dtype=np.float64)
    left = saturated - k
    with np.errstate(divide="ignore", invalid="ignore"):
        of_interface = np.where(left > _FULL * saturated, k * saturated / left, np.inf)
    return np.where(np.isnan(left), np.nan, of_interface)


def electrical_resistance(
    stiffness: Value, E_star: float, resistivities: tuple[float, float]
) -> Value:
    """Constriction resistance by Barber's identity, 1 / R = 2 k / (E* (rho1 + rho2)).

    Exact for clean metallic contact of any shape: current and stress follow from the same
    potential. Films and the mean free path of electrons add to the resistance.

    Parameters
    ----------
    stiffness : float or ndarray
        Normal contact stiffness k. [N / m]
    E_star : float
        Contact modulus. [Pa]
    resistivities : tuple of float
        Of both bodies. [ohm m]

    References
    ----------
    J. R. Barber, "Bounds on the electrical resistance between contacting elastic rough bodies",
    Proc. R. Soc. A 459, 53-66 (2003), eq. 10.
    """
    return E_star * sum(resistivities) / (2 * stiffness)


def thermal_conductance(
    stiffness: Value, E_star: float, conductivities: tuple[float, float]
) -> Value:
    """Thermal conductance of the solid contact by Barber's identity, G = kappa_s k / E*.

    With ``kappa_s = 2 kappa1 kappa2 / (kappa1 + kappa2)``. Gas in the gaps and radiation add to it.

    Parameters
    ----------
    stiffness : float or ndarray
        Normal contact stiffness k [N / m], or k over the nominal area [N / m³].
    E_star : float
        Contact modulus. [Pa]
    conductivities : tuple of float
        Of both bodies. [W / (m K)]

    Returns
    -------
    float or ndarray
        Conductance [W / K], or per nominal area [W / (m² K)].
    """
    return harmonic_conductivity(conductivities) * stiffness / E_star


def harmonic_conductivity(conductivities: tuple[float, float]) -> float:
    """kappa_s = 2 kappa1 kappa2 / (kappa1 + kappa2). [W / (m K)]"""
    first, second = conductivities
    return 2 * first * second / (first + second)


def holm_resistance(force: Value, hardness: float, resistivities: tuple[float, float]) -> Value:
    """Holm's resistance of one round spot at the hardness of the softer body.

    R = (rho1 + rho2) / (4 a) with pi a² = F / H: all the load on a single plastic spot. Many
    spots far apart have less.

    Parameters
    ----------
    force : float or ndarray
        Normal force. [N]
    hardness : float
        Of the softer body. [Pa]
    resistivities : tuple of float
        Of both bodies. [ohm m]

    References
    ----------
    R. Holm, "Electric Contacts", 4th ed. (1967), section 1.
    """
    radius = np.sqrt(force / (math.pi * hardness))
    return sum(resistivities) / (4 * radius)


def mikic_conductance(
    pressure: Value,
    E_star: float,
    rms_height: float,
    rms_slope: float,
    conductivities: tuple[float, float],
) -> Value:
    """Mikic's elastic conductance per area, 1.55 kappa_s m / sigma (sqrt(2) p / (E* m))^0.94.

    With m the mean absolute slope of a cut, for Gaussian heights rms grad h / sqrt(pi).

    Parameters
    ----------
    pressure : float or ndarray
        Mean pressure over the nominal area. [Pa]
    E_star : float
        Contact modulus. [Pa]
    rms_height : float
        Of the sum of both surfaces. [m]
    rms_slope : float
        Rms gradient of the sum of both surfaces. [1]
    conductivities : tuple of float
        Of both bodies. [W / (m K)]

    Returns
    -------
    float or ndarray
        [W / (m² K)]

    References
    ----------
    B. B. Mikic, "Thermal contact conductance; theoretical considerations", Int. J. Heat Mass
    Transfer 17, 205-214 (1974).
    """
    slope = _mean_slope(rms_slope)
    scale = 1.55 * harmonic_conductivity(conductivities) * slope / rms_height
    return scale * (math.sqrt(2) * pressure / (E_star * slope)) ** 0.94


def yovanovich_conductance(
    pressure: Value,
    hardness: float,
    rms_height: float,
    rms_slope: float,
    conductivities: tuple[float, float],
) -> Value:
    """Plastic conductance per area, 1.25 kappa_s m / sigma (p / H)^0.95 (Yovanovich).

    Parameters
    ----------
    pressure, rms_height, rms_slope, conductivities
        As for :func:`mikic_conductance`.
    hardness : float
        Of the softer body. [Pa]

    Returns
    -------
    float or ndarray
        [W / (m² K)]

    References
    ----------
    M. M. Yovanovich, "Four decades of research on thermal contact, gap, and joint resistance in
    microelectronics", IEEE Trans. Compon. Packag. Technol. 28, 182-206 (2005), eq. 14.
    """
    slope = _mean_slope(rms_slope)
    scale = 1.25 * harmonic_conductivity(conductivities) * slope / rms_height
    return scale * (pressure / hardness) ** 0.95


def plasticity_index(E_star: float, hardness: float, summits: tuple[float, float]) -> float:
    """Greenwood and Williamson's index, E* / H sqrt(sigma_s / R); < 0.6 elastic, > 1 plastic.

    Parameters
    ----------
    E_star : float
        Contact modulus. [Pa]
    hardness : float
        Of the softer body. [Pa]
    summits : tuple of float
        Standard deviation of summit heights, and mean radius of summits. [m]

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
    """Tangential force over tangential displacement at constant normal load, up to full sliding.

    Q = mu (F(d) - F(d_c)), u_x = mu E* / G* (d - d_c) for a stick area as large as the contact at
    d_c, whatever its shape (Ciavarella 1998, Jäger 1998). The last load is the normal load.

    Parameters
    ----------
    depth, force : ndarray, shape (loads,)
        A curve, rising, up to the normal load. [length], [force]
    E_star, G_star : float
        Contact moduli. [pressure]
    friction : float
        Coefficient of friction. [1]

    Returns
    -------
    displacement, tangential_force : ndarray, shape (loads + 1,)
        From no load to full sliding.

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
    """Modulus of the reflection coefficient of a longitudinal plane wave at normal incidence.

    ``|r| = |z1 - z2 + i w z1 z2 / K| / |z1 + z2 + i w z1 z2 / K|``, for waves much longer than
    the distances between contact spots; w = 2 pi frequency.

    Parameters
    ----------
    stiffness_per_area : float or ndarray
        Of the interface alone, K; where it is zero, the whole wave is reflected. [N / m³]
    frequency : float
        [Hz]
    impedances : tuple of float
        Of both bodies, z. [kg / (m² s)]

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


def constriction_of_disc(area: float, E_star: float) -> float:
    """Stiffness of a flat round punch of some area, 2 E* a with pi a² the area. [N / m]

    Bodies that are much wider than a joint have this stiffness even without any roughness.
    """
    return 2 * E_star * math.sqrt(area / math.pi)


def _mean_slope(rms_slope: float) -> float:
    """Mean absolute slope of a cut through Gaussian heights with an rms gradient."""
    return rms_slope / math.sqrt(math.pi)
