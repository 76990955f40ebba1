"""Elastic bodies that pull each other across gaps, up to a work of adhesion."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Self

from roughline.computing.arrays import Indices, Real
from roughline.errors import InputError
from roughline.halfspace.laws.law import ContactLaw


@dataclass(frozen=True)
class Adhesive(ContactLaw):
    """Elastic bodies that pull each other across gaps.

    Where the bodies touch, the pressure is above the largest pull -w / h_0; across a gap it is the
    share of that pull which the gap leaves. The order of loads matters: bodies that come nearer
    jump together, and bodies that go apart hold each other where they did not pull before.

    Attributes
    ----------
    work_of_adhesion : float
        Work to separate a unit of area, w. [pressure * length]
    range : float
        h_0, so that the largest pull is w / h_0. [length]
    """

    work_of_adhesion: float
    range: float

    def __post_init__(self) -> None:
        for name, what in (("work_of_adhesion", "work of an area"), ("range", "length")):
            if not 0 < getattr(self, name) < math.inf:
                raise InputError(
                    f"is {getattr(self, name)!r}; a positive, finite {what} is needed: bodies that "
                    "do not stick are rl.Unilateral()",
                    name,
                )

    @property
    def largest_pull(self) -> float:
        """Tension of nodes that all but touch, w / h_0. [pressure]"""
        return self.work_of_adhesion / self.range

    def bounds(self, nodes: Indices | None) -> tuple[Real | float, Real | float]:
        """Return the largest pull, and that nodes bear any pressure."""
        return -self.largest_pull, math.inf

    def scaled(self, pressure: float, length: float) -> Self:
        """Return the law in other units."""
        work, reach = self.work_of_adhesion / (pressure * length), self.range / length
        return replace(self, work_of_adhesion=work, range=reach)
