"""Flat punches: stiffness of the square, the disc and the ellipse.

The stiffness of a flat punch is pi E* times the electrostatic capacity of its shape (in units in
which a sphere of radius a has capacity a).
"""

from __future__ import annotations

import numpy as np

from roughline.exact._checks import Real, positive

_SQUARE_CAPACITY = 0.366788
"""Capacity of the unit square, to the last digit given."""


def square_stiffness(E_star: float, side: float) -> float:
    """Stiffness of the rigid square punch, k = 1.15230 E* L. [force / length]

    Parameters
    ----------
    E_star : float
        Contact modulus. [pressure]
    side : float
        Side L. [length]
    """
    positive(E_star=E_star, side=side)
    return float(np.pi * _SQUARE_CAPACITY * E_star * side)


def disc_stiffness(E_star: float, radius: float) -> float:
    """Stiffness of the rigid disc, k = 2 E* a. [force / length]

    Parameters
    ----------
    E_star : float
        Contact modulus. [pressure]
    radius : float
        Radius a. [length]

    References
    ----------
    .. [1] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), eq. 3.36.
    """
    positive(E_star=E_star, radius=radius)
    return 2 * E_star * radius


def disc_pressure(force: float, radius: float, r: Real) -> Real:
    """Pressure under the rigid disc, F / (2 pi a sqrt(a² - r²)), zero outside. [pressure]

    Parameters
    ----------
    force : float
        Total force. [force]
    radius : float
        Radius a. [length]
    r : ndarray
        Distances from the axis; the pressure is infinite at the rim. [length]

    References
    ----------
    .. [1] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), eq. 3.34.
    """
    positive(force=force, radius=radius)
    inside = np.abs(r) < radius
    depth_of_root = np.sqrt(radius**2 - np.where(inside, r, 0.0) ** 2)
    return np.where(inside, force / (2 * np.pi * radius * depth_of_root), 0.0)


def ellipse_stiffness(E_star: float, a: float, b: float) -> float:
    """Stiffness of the rigid elliptic punch, k = pi E* a / K(e), e² = 1 - (b / a)².

    Parameters
    ----------
    E_star : float
        Contact modulus. [pressure]
    a, b : float
        Semi-axes in any order. [length]

    Returns
    -------
    float
        Stiffness. [force / length]

    References
    ----------
    .. [1] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §3.5 and eq. 4.28.
    """
    from scipy.special import ellipkm1

    positive(E_star=E_star, a=a, b=b)
    long, short = max(a, b), min(a, b)
    return float(np.pi * E_star * long / ellipkm1((short / long) ** 2))
