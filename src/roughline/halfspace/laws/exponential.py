"""Elastic bodies whose pull falls exponentially with the gap."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors.public import public_making
from roughline.halfspace.laws.adhesive import Adhesive


@public_making
@dataclass(frozen=True)
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

    def share_at(self, gap: Real) -> Real:
        """Return exp(-g / rho)."""
        return np.exp(-gap / self.range)

    def gap_at(self, share: Real) -> Real:
        """Return -rho ln(share)."""
        return -self.range * np.log(share)

    def work_beyond(self, gap: Real) -> Real:
        """Return rho exp(-g / rho)."""
        return self.range * np.exp(-gap / self.range)
