"""A sphere that an elastic half-space pulls before it touches, with Dugdale's even pull.

The pull sigma_0 = w / h_0 acts where the gap is below the range h_0, within the reach c. It lifts
the half-space by 2 sigma_0 c / E* on the axis and by 4 sigma_0 c / (pi E*) at r = c, where the gap
is h_0. Maugis' states with contact begin where the gap on the axis closes.

References
----------
.. [1] D. Maugis, "Adhesion of spheres: the JKR-DMT transition using a Dugdale model", J. Colloid
   Interface Sci. 150, 243-269 (1992).
.. [2] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), eqs. 3.29a and 3.29b.
.. [3] R. S. Bradley, "The cohesive force between solid surfaces and the surface energy of solids",
   Phil. Mag. 13, 853-862 (1932).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np
from numpy.typing import ArrayLike

from roughline.exact._checks import Real, positive


@dataclass(frozen=True)
class PulledSphere:
    """Sphere of radius R that is pulled across a gap; depths are negative, as is its force.

    A sphere that comes nearer is pulled from the depth -h_0 on, where its reach jumps from zero to
    twice `smallest_reach`, or past `largest_reach` into contact. One that goes away is let go at
    `smallest_reach`.

    Attributes
    ----------
    radius_of_curvature : float
        R. [length]
    work_of_adhesion : float
        w. [energy / length²]
    range : float
        h_0. [length]
    E_star : float
        Contact modulus. [pressure]

    Raises
    ------
    ValueError
        If any of them is not positive.
    """

    radius_of_curvature: float
    work_of_adhesion: float
    range: float
    E_star: float

    def __post_init__(self) -> None:
        positive(
            radius_of_curvature=self.radius_of_curvature,
            work_of_adhesion=self.work_of_adhesion,
            range=self.range,
            E_star=self.E_star,
        )

    @property
    def pull(self) -> float:
        """sigma_0 = w / h_0. [pressure]"""
        return self.work_of_adhesion / self.range

    def force(self, reach: ArrayLike) -> Real:
        """Force -pi c² sigma_0. [force]"""
        positive(reach=reach)
        return -pi * np.asarray(reach) ** 2 * self.pull

    def depth(self, reach: ArrayLike) -> Real:
        """Depth c² / (2 R) - 4 sigma_0 c / (pi E*) - h_0, at which the gap at c is h_0. [length]"""
        positive(reach=reach)
        c = np.asarray(reach)
        lifted = 4 * self.pull * c / (pi * self.E_star)
        return c**2 / (2 * self.radius_of_curvature) - lifted - self.range

    def gap(self, reach: ArrayLike) -> Real:
        """Gap on the axis, -d - 2 sigma_0 c / E*; below zero the sphere touches. [length]"""
        return -self.depth(reach) - 2 * self.pull * np.asarray(reach) / self.E_star

    @property
    def smallest_reach(self) -> float:
        """Reach 4 sigma_0 R / (pi E*) at which dd/dc = 0. [length]"""
        return 4 * self.pull * self.radius_of_curvature / (pi * self.E_star)

    @property
    def largest_reach(self) -> float:
        """Reach at which the gap on the axis is zero. [length]"""
        half = self.pull * self.radius_of_curvature * (1 - 2 / pi) * 2 / self.E_star
        # (sqrt(half² + x) - half), without the difference of two like numbers
        x = 2 * self.radius_of_curvature * self.range
        return x / (half + sqrt(half**2 + x))

    def reach(self, depth: float) -> float:
        """Reach at a depth, of a sphere that is pulled already. [length]

        Raises
        ------
        ValueError
            If the sphere is not pulled at this depth, or touches.
        """
        edge = self.smallest_reach
        square = edge**2 + 2 * self.radius_of_curvature * (depth + self.range)
        found = edge + sqrt(max(square, 0.0))
        if square < 0 or found > self.largest_reach:
            state = "no pull reaches the sphere" if square < 0 else "the sphere touches"
            raise ValueError(f"depth is {depth:g}; {state} there")
        return found
