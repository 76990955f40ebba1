"""How nodes follow unit slides and a unit approach, and the tangents of a state that these give."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from roughline.computing.arrays import InGrid, Mask, Real, Single
from roughline.halfspace.friction.rates import Going
from roughline.halfspace.friction.vectors import on_nodes


@dataclass(frozen=True, eq=False)
class UnitSlides:
    """Shear of nodes by unit slides along x and along y, each of shape (nodes, 2)."""

    shear: tuple[Real, Real]
    displacement: tuple[Real, Real] | None = None  # by the shear, exactly

    @staticmethod
    def along(way: Real, unit: tuple[Real, Real]) -> Real:
        """Return what a slide along a way brings, from that of unit slides."""
        return np.asarray(way[0] * unit[0] + way[1] * unit[1], np.float64)


@dataclass(frozen=True, eq=False)
class UnitWays:
    """Pressures and shear of nodes by unit slides along x and y, and by a unit approach.

    They are kept to start from, in single precision.
    """

    nodes: InGrid
    tractions: Single  # shape (nodes, 3, 3): shear along x and y and pressure, by each of the ways
    totals: Real  # of these, shape (3, 3) [force / length]

    def moved(self, others: UnitWays, to: UnitWays) -> UnitWays:
        """Return these where others, of the same nodes, have gone elsewhere."""
        change = to.tractions - on_nodes(to.nodes, others.nodes, others.tractions)
        tractions = on_nodes(to.nodes, self.nodes, self.tractions) + change
        return replace(to, tractions=tractions.astype(np.float32))

    def led(self, going: Going) -> tuple[Real, Real]:
        """Return the ways after which loads have gone so, and what nodes bear more after them."""
        ways = ways_under(self.totals, going)
        return ways, self.tractions.astype(np.float64) @ ways


@dataclass(frozen=True, eq=False)
class ShearTangents:
    """Stiffness dQ/d(slide) at a state, each 2 by 2, and where it sticks. [force / length]"""

    sticks: Mask  # if loads go on as they did last
    on: Real
    back: Real
    convolutions: int = 0
    led: tuple[UnitSlides, UnitSlides] | None = None  # how shear follows, on and back
    coupled: tuple[UnitWays, UnitWays] | None = None  # the same of bodies that are coupled


def ways_under(totals: Real, going: Going) -> Real:
    """Return the slides and the approach with which loads go so."""
    asked, given = totals.copy(), np.array([*going.along, going.normal])
    if not going.by_shear:
        asked[:2] = np.eye(3)[:2]
    if not going.by_force:
        asked[2] = np.eye(3)[2]
    return np.asarray(np.linalg.lstsq(asked, given, rcond=None)[0], np.float64)
