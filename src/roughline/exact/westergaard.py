"""Periodic waves: partial contact of one wave, full contact of one and of two crossed waves.

References
----------
.. [1] H. M. Westergaard, "Bearing pressures and cracks", J. Appl. Mech. 6, 49-53 (1939).
.. [2] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §13.2, eqs. 13.7 and 13.8.
.. [3] K. L. Johnson, J. A. Greenwood and J. G. Higginson, "The contact of elastic regular wavy
   surfaces", Int. J. Mech. Sci. 27, 383-396 (1985).
"""

from __future__ import annotations

import numpy as np

from roughline.exact._checks import Real, positive


def full_contact_pressure(amplitude: float, wavelength: float, E_star: float) -> float:
    """Mean pressure p* = pi E* Delta / lambda that closes Delta cos(2 pi x / lambda). [pressure]

    Parameters
    ----------
    amplitude, wavelength : float
        Delta and lambda. [length]
    E_star : float
        Contact modulus. [pressure]
    """
    positive(amplitude=amplitude, wavelength=wavelength, E_star=E_star)
    return np.pi * E_star * amplitude / wavelength


def crossed_full_contact_pressure(amplitude: float, wavelength: float, E_star: float) -> float:
    """Mean pressure sqrt(2) p* that closes Delta cos(2 pi x / lambda) cos(2 pi y / lambda)."""
    return float(np.sqrt(2) * full_contact_pressure(amplitude, wavelength, E_star))


def mean_pressure(half_width: Real, amplitude: float, wavelength: float, E_star: float) -> Real:
    """Mean pressure p* sin²(pi a / lambda) at contact half-width a. [pressure]

    Parameters
    ----------
    half_width : ndarray
        a, up to lambda / 2. [length]
    amplitude, wavelength, E_star
        As for :func:`full_contact_pressure`.
    """
    full = full_contact_pressure(amplitude, wavelength, E_star)
    return full * np.sin(np.pi * half_width / wavelength) ** 2


def pressure(
    x: Real, half_width: float, amplitude: float, wavelength: float, E_star: float
) -> Real:
    """Pressure over the crest at x = 0 in partial contact, zero outside. [pressure]

    ``2 p* cos(pi x / lambda) sqrt(sin²(pi a / lambda) - sin²(pi x / lambda))``

    Parameters
    ----------
    x : ndarray
        Distance from a crest, within half a wavelength. [length]
    half_width : float
        Contact half-width a. [length]
    amplitude, wavelength, E_star
        As for :func:`full_contact_pressure`.
    """
    full = full_contact_pressure(amplitude, wavelength, E_star)
    edge = np.sin(np.pi * half_width / wavelength) ** 2
    inside = np.maximum(0.0, edge - np.sin(np.pi * x / wavelength) ** 2)
    return 2 * full * np.cos(np.pi * x / wavelength) * np.sqrt(inside)
