"""Axisymmetric indenters f(r) = c r^n; Hertz's paraboloid and the cone are two of them.

References
----------
.. [1] I. N. Sneddon, "The relation between load and penetration in the axisymmetric Boussinesq
   problem for a punch of arbitrary profile", Int. J. Eng. Sci. 3, 47-57 (1965).
.. [2] V. L. Popov and M. Heß, *Method of Dimensionality Reduction in Contact Mechanics and
   Friction*, Springer (2015), ch. 3.
.. [3] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §4.2 and eq. 5.10.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import gamma, pi, sqrt, tan

import numpy as np
from numpy.typing import ArrayLike

from roughline.exact._checks import Real, positive


@dataclass(frozen=True)
class PowerLawIndenter:
    """Rigid indenter f(r) = c r^n on an elastic half-space; depths and radii may be arrays.

    Attributes
    ----------
    exponent : float
        n.
    coefficient : float
        c. [length^(1 - n)]
    E_star : float
        Contact modulus. [pressure]

    Raises
    ------
    ValueError
        If any of them is not positive.
    """

    exponent: float
    coefficient: float
    E_star: float

    def __post_init__(self) -> None:
        positive(exponent=self.exponent, coefficient=self.coefficient, E_star=self.E_star)

    @property
    def stretch(self) -> float:
        """kappa_n = (sqrt(pi) / 2) n Gamma(n / 2) / Gamma((n + 1) / 2): g = kappa_n f. [1]"""
        n = self.exponent
        return sqrt(pi) / 2 * n * gamma(n / 2) / gamma((n + 1) / 2)

    def radius(self, depth: ArrayLike) -> Real:
        """Contact radius a, from d = kappa_n c a^n; of one depth or an array of them. [length]"""
        positive(depth=depth)
        return (np.asarray(depth) / (self.stretch * self.coefficient)) ** (1 / self.exponent)

    def depth(self, radius: ArrayLike) -> Real:
        """Depth d = g(a). [length]"""
        positive(radius=radius)
        return self.stretch * self.coefficient * np.asarray(radius) ** self.exponent

    def force(self, depth: ArrayLike) -> Real:
        """Force F = 2 n / (n + 1) E* a d. [force]"""
        n = self.exponent
        return 2 * n / (n + 1) * self.E_star * self.radius(depth) * np.asarray(depth)

    def stiffness(self, depth: ArrayLike) -> Real:
        """Stiffness k = dF/dd = 2 E* a. [force / length]"""
        return 2 * self.E_star * self.radius(depth)


def paraboloid(radius_of_curvature: float, E_star: float) -> PowerLawIndenter:
    """Hertz's indenter f = r² / (2 R): F = (4/3) E* sqrt(R) d^(3/2), a² = R d."""
    positive(radius_of_curvature=radius_of_curvature)
    return PowerLawIndenter(2.0, 1 / (2 * radius_of_curvature), E_star)


def cone(slope_angle: float, E_star: float) -> PowerLawIndenter:
    """Cone f = r tan(theta), theta from the surface: F = (pi / 2) E* a² tan(theta)."""
    positive(slope_angle=slope_angle)
    return PowerLawIndenter(1.0, tan(slope_angle), E_star)


def hertz_pressure(
    depth: ArrayLike, radius_of_curvature: float, E_star: float, r: ArrayLike
) -> Real:
    """Hertz's pressure p0 sqrt(1 - r² / a²), p0 = (2 / pi) E* sqrt(d / R), zero outside.

    Parameters
    ----------
    depth : float or ndarray
        d; an array is broadcast with `r`. [length]
    radius_of_curvature : float
        R. [length]
    E_star : float
        Contact modulus. [pressure]
    r : float or ndarray
        Distances from the axis. [length]

    Returns
    -------
    ndarray
        Pressure. [pressure]
    """
    a = paraboloid(radius_of_curvature, E_star).radius(depth)
    p0 = 2 / pi * E_star * np.sqrt(np.asarray(depth) / radius_of_curvature)
    return p0 * np.sqrt(np.maximum(0.0, 1 - (np.asarray(r) / a) ** 2))
