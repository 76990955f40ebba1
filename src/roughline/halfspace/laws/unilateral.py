"""Elastic bodies that neither stick to each other nor overlap."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from roughline.computing.arrays import Indices, Real
from roughline.halfspace.laws.law import ContactLaw


@dataclass(frozen=True)
class Unilateral(ContactLaw):
    """Bodies that neither stick to each other nor overlap: p >= 0, gap >= 0 and p gap = 0."""

    assumption: ClassVar[str] = "linear elastic, without adhesion"

    @property
    def settings(self) -> dict[str, str | float]:
        """Nothing, as such bodies go without saying."""
        return {}

    def bounds(self, nodes: Indices | None) -> tuple[Real | float, Real | float]:
        """Return that pressures only push, and may be of any size."""
        return 0.0, math.inf

    def scaled(self, pressure: float, length: float) -> Unilateral:
        """Return the law itself, which has no units."""
        return self
