"""Any history of normal and shear force along one line: the springs of the reduction method.

Each spring bears E* (d - g(x)) and, while it sticks, G* times the slide since it came into contact;
what it bears sideways is at most mu times what it bears. Springs are followed one by one, so errors
are of second order in their distance. The method is exact for pressure and shear that do not move
each other, and n = nu / (1 - nu) of 0.

References
----------
.. [1] R. D. Mindlin and H. Deresiewicz, "Elastic spheres in contact under varying oblique forces",
   J. Appl. Mech. 20, 327-344 (1953).
.. [2] V. L. Popov and M. Heß, *Method of Dimensionality Reduction in Contact Mechanics and
   Friction*, Springer (2015), §5.3 to 5.5.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from roughline.exact._checks import Real, positive
from roughline.exact.indenters import PowerLawIndenter


class SlidSprings(NamedTuple):
    """Where a load of the history leaves the body."""

    depth: float  # [length]
    shear_force: float  # [force]
    slide: float  # [length]
    stick_radius: float  # [length]


@dataclass(frozen=True)
class CoulombSprings:
    """A body c r^n on springs with Coulomb friction.

    Attributes
    ----------
    body : PowerLawIndenter
        The body.
    largest_depth : float
        Depth to which springs reach. [length]
    G_star : float
        Tangential contact modulus. [pressure]
    friction : float
        Coefficient mu. [1]
    count : int
        Springs between the axis and the edge at the largest depth.

    Raises
    ------
    ValueError
        If a number is not positive.
    """

    body: PowerLawIndenter
    largest_depth: float
    G_star: float
    friction: float
    count: int = 2**14

    def __post_init__(self) -> None:
        positive(
            largest_depth=self.largest_depth,
            G_star=self.G_star,
            friction=self.friction,
            count=self.count,
        )

    def under(self, depths: Real, shear_forces: Real) -> Iterator[SlidSprings]:
        """Follow depths and shear forces, between which depth and slide are straight in time.

        Parameters
        ----------
        depths : ndarray, shape (loads,)
            Of each load; from rest at none. [length]
        shear_forces : ndarray, shape (loads,)
            Of each load, less than mu F. [force]
        """
        from scipy.optimize import brentq  # here because it loads slowly

        spacing = float(self.body.radius(self.largest_depth)) / self.count
        x = spacing * (np.arange(self.count) + 0.5)
        line = self.body.depth(x)
        shear, before, slide = np.zeros(self.count), 0.0, 0.0
        for depth, shear_force in zip(depths.tolist(), shear_forces.tolist(), strict=True):
            share = np.ones(self.count)  # of the step in which a spring is in contact
            if depth > before:
                share = np.clip((depth - line) / (depth - before), 0.0, 1.0)
            bears = self.friction * self.body.E_star * np.maximum(depth - line, 0.0)
            stuck = self.G_star * share

            def left_by(
                moved: float, shear: Real = shear, stuck: Real = stuck, bears: Real = bears
            ) -> Real:
                return np.clip(shear + stuck * moved, -bears, bears)

            most = (np.abs(shear).max() + bears.max()) / self.G_star
            while 2 * spacing * left_by(most).sum() < abs(shear_force):
                most *= 2  # springs that have just come into contact
            moved = brentq(
                lambda moved, force=shear_force: 2 * spacing * left_by(moved).sum() - force,
                -most,
                most,
                xtol=1e-15 * most,
            )
            is_stuck = np.abs(shear + stuck * moved) < bears
            shear, slide, before = left_by(moved), slide + moved, depth
            yield SlidSprings(depth, shear_force, slide, float(spacing * is_stuck.sum()))
