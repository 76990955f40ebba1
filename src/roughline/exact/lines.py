"""Line contacts in plane strain: a cylinder, and a flat strip.

A line load has no bounded displacement: that of a force P' per length at the distance y across is
2 P' / (pi E*) ln(D / |y|), with the distance D from which displacements count.

References
----------
.. [1] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), §4.2(c) and eq. 2.64 (strips).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import log, pi, sqrt

import numpy as np

from roughline.exact._checks import Real, positive


@dataclass(frozen=True)
class Cylinder:
    """Rigid cylinder that touches an elastic half-space along its length, by Hertz [1]_.

    Attributes
    ----------
    radius : float
        Radius R. [length]
    force : float
        Force per length P'. [force / length]
    E_star : float
        Contact modulus. [pressure]
    datum : float
        Distance D from which displacements count. [length]

    Raises
    ------
    ValueError
        If any of them is not positive.

    References
    ----------
    .. [1] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), eqs. 4.43 to 4.45.
    """

    radius: float
    force: float
    E_star: float
    datum: float

    def __post_init__(self) -> None:
        positive(radius=self.radius, force=self.force, E_star=self.E_star, datum=self.datum)

    @property
    def half_width(self) -> float:
        """Half of the width of the contact, a = 2 sqrt(P' R / (pi E*)). [length]"""
        return 2 * sqrt(self.force * self.radius / (pi * self.E_star))

    def pressure(self, y: Real) -> Real:
        """Pressure at distances from the middle, 2 P' / (pi a) sqrt(1 - y² / a²). [pressure]"""
        a = self.half_width
        return 2 * self.force / (pi * a) * np.sqrt(np.maximum(1 - (np.asarray(y) / a) ** 2, 0.0))

    @property
    def depth(self) -> float:
        """Depth P' / (pi E*) (2 ln(2 D / a) + 1). [length]"""
        of_datum = 2 * log(2 * self.datum / self.half_width)
        return self.force / (pi * self.E_star) * (of_datum + 1)

    @property
    def stiffness(self) -> float:
        """Slope of the force per length over depth, that of a strip as wide. [pressure]"""
        return strip_stiffness(self.E_star, self.half_width, self.datum)


def strip_stiffness(E_star: float, half_width: float, datum: float) -> float:
    """Force per length of a flat strip over its depth, pi E* / (2 ln(2 D / a)). [pressure]

    Parameters
    ----------
    E_star : float
        Contact modulus. [pressure]
    half_width, datum : float
        Half of the width, a, and the distance D from which displacements count. [length]
    """
    positive(E_star=E_star, half_width=half_width, datum=datum)
    return pi * E_star / (2 * log(2 * datum / half_width))


def strip_pressure(force: float, half_width: float, y: Real) -> Real:
    """Pressure under a flat strip, P' / (pi sqrt(a² - y²)), zero outside. [pressure]

    Parameters
    ----------
    force : float
        Force per length P'. [force / length]
    half_width : float
        Half of the width, a. [length]
    y : ndarray
        Distances from the middle; the pressure is infinite at the edges. [length]
    """
    positive(force=force, half_width=half_width)
    inside = np.abs(y) < half_width
    root = np.sqrt(half_width**2 - np.where(inside, y, 0.0) ** 2)
    return np.where(inside, force / (pi * root), 0.0)
