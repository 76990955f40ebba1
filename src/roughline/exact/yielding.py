"""Bodies that bear a hardness H at most: first yield of a ball, and the flat disc that yields.

The model is 0 <= p <= H: the half-space is elastic, and where the pressure is H it yields.

References
----------
.. [1] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), eqs. 4.22 to 4.24.
.. [2] V. L. Popov and M. Heß, *Method of Dimensionality Reduction in Contact Mechanics and
   Friction*, Springer (2015), ch. 3.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from roughline.exact._checks import Real, positive


def ball_yield_radius(radius_of_curvature: float, E_star: float, hardness: float) -> float:
    """Contact radius a_y = pi H R / (2 E*) at which Hertz's largest pressure is H. [length]

    Parameters
    ----------
    radius_of_curvature : float
        R. [length]
    E_star, hardness : float
        Contact modulus and H. [pressure]
    """
    positive(radius_of_curvature=radius_of_curvature, E_star=E_star, hardness=hardness)
    return pi * hardness * radius_of_curvature / (2 * E_star)


def ball_yield_force(radius_of_curvature: float, E_star: float, hardness: float) -> float:
    """Force F_y = pi³ R² H³ / (6 E*²) at which Hertz's largest pressure is H. [force]

    Parameters
    ----------
    radius_of_curvature : float
        R. [length]
    E_star, hardness : float
        Contact modulus and H. [pressure]
    """
    positive(radius_of_curvature=radius_of_curvature, E_star=E_star, hardness=hardness)
    return pi**3 * radius_of_curvature**2 * hardness**3 / (6 * E_star**2)


@dataclass(frozen=True)
class YieldingDisc:
    """Rigid disc of radius a on a half-space that bears H at most.

    The elastic pressure is infinite at the rim, so a ring c < r < a bears H from first touch on;
    inside, the half-space stays in contact and the pressure rises to H at r = c. In the reduction
    method [2]_, the line of the disc carries E* d per length for x < c and, from the pressure of
    the ring, 2 H sqrt(a² - x²) beyond. Both are equal at c, as the pressure is finite there.

    Attributes
    ----------
    radius : float
        a. [length]
    E_star, hardness : float
        Contact modulus and H. [pressure]

    Raises
    ------
    ValueError
        If any of them is not positive.
    """

    radius: float
    E_star: float
    hardness: float

    def __post_init__(self) -> None:
        positive(radius=self.radius, E_star=self.E_star, hardness=self.hardness)

    def depth(self, elastic_radius: ArrayLike) -> Real:
        """Depth d = (2 H / E*) sqrt(a² - c²) at which the ring begins at c; 0 < c < a. [length]"""
        positive(elastic_radius=elastic_radius)
        c = np.asarray(elastic_radius)
        return 2 * self.hardness / self.E_star * np.sqrt(self.radius**2 - c**2)

    def force(self, elastic_radius: ArrayLike) -> Real:
        """Force F = 2 H (a² arccos(c / a) + c sqrt(a² - c²)), at most pi a² H. [force]"""
        positive(elastic_radius=elastic_radius)
        c, a = np.asarray(elastic_radius), self.radius
        return 2 * self.hardness * (a**2 * np.arccos(c / a) + c * np.sqrt(a**2 - c**2))

    def stiffness(self, elastic_radius: ArrayLike) -> Real:
        """Stiffness k = dF/dd = 2 E* c: the ring carries no additional load. [force / length]"""
        positive(elastic_radius=elastic_radius)
        return 2 * self.E_star * np.asarray(elastic_radius)

    @property
    def unloading_stiffness(self) -> float:
        """Stiffness 2 E* a at first unloading: all of the disc springs back. [force / length]"""
        return 2 * self.E_star * self.radius

    def work(self, elastic_radius: ArrayLike) -> Real:
        """Work of the force from first touch on, the integral of F dd. [force length]

        With c = a sin(t): (4 H² a³ / E*) ((pi / 2 - t) cos t + sin t - sin³ t / 3 - 2 / 3).
        """
        positive(elastic_radius=elastic_radius)
        t = np.arcsin(np.asarray(elastic_radius) / self.radius)
        shape = (pi / 2 - t) * np.cos(t) + np.sin(t) - np.sin(t) ** 3 / 3 - 2 / 3
        return 4 * self.hardness**2 * self.radius**3 / self.E_star * shape

    def pressure(self, elastic_radius: float, r: ArrayLike) -> Real:
        """Pressure (H / pi) arccos((2 c² - a² - r²) / (a² - r²)) for r < c, H to a. [pressure]

        Parameters
        ----------
        elastic_radius : float
            c. [length]
        r : array_like
            Distances from the axis. [length]
        """
        positive(elastic_radius=elastic_radius)
        r, a, c = np.abs(r), self.radius, elastic_radius
        inner = np.minimum(r, c)  # at c this is H
        inside = np.arccos((2 * c**2 - a**2 - inner**2) / (a**2 - inner**2)) / pi
        return np.where(r < a, self.hardness * inside, 0.0)
