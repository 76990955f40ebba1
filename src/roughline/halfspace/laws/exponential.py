"""Elastic bodies whose pull falls exponentially with the gap."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors.public import public_making
from roughline.halfspace.laws.adhesive import Adhesive

_LEAST = 1e-7  # share of the largest pull, from which on pulls are told apart


@public_making
@dataclass(frozen=True, eq=False)
class Exponential(Adhesive):
    """Elastic bodies that pull each other with a pressure (w / rho) exp(-g / rho) [1]_.

    Where the bodies touch, the pressure is above -w / rho. This is the law of the Contact-Mechanics
    Challenge [2]_. The order of loads matters: bodies that come nearer jump together, and bodies
    that go apart hold each other where they did not pull before.

    Attributes
    ----------
    work_of_adhesion : float
        Work to separate a unit of area, w. [pressure * length]
    range : float
        Gap across which the pull falls by a factor e, rho. [length]
    share : ndarray, shape (nx, ny), or float
        Share of the largest pull that each node bears at least.

    Raises
    ------
    InputError
        If work or range are not positive and finite.

    References
    ----------
    .. [1] M. H. Müser, "Single-asperity contact mechanics with positive and negative work of
       adhesion", Beilstein J. Nanotechnol. 5, 419-437 (2014).
    .. [2] M. H. Müser et al., "Meeting the Contact-Mechanics Challenge", Tribol. Lett. 65, 118
       (2017).
    """

    assumption: ClassVar[str] = (
        "linear elastic, and pull each other across gaps, e times less with each range"
    )

    @property
    def reach(self) -> float:
        """Gap with the least share that is told from none. [length]"""
        return -math.log(_LEAST) * self.range

    def share_at(self, gap: Real) -> Real:
        """Return exp(-g / rho)."""
        return np.exp(-np.maximum(gap, 0.0) / self.range)

    def gap_between(self, share: Real, other: Real | float) -> Real:
        """Return rho times the difference of their logarithms; the least ones count as alike."""
        logs = [np.log(np.maximum(each, _LEAST)) for each in (share, other)]
        return self.range * np.abs(logs[0] - logs[1])

    def work_beyond(self, gap: Real) -> Real:
        """Return exp(-g / rho)."""
        return self.share_at(gap)
