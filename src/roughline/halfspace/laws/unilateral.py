"""Elastic bodies that neither stick to each other nor overlap."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.errors import InputError
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

    def refuse(
        self, control: str, values: Real, heights: Real, area: float, mean_is_free: bool
    ) -> None:
        """Refuse pulls, and depths beyond full contact where that is rigid."""
        super().refuse(control, values, heights, area, mean_is_free)
        refuse_beyond_full_contact(control, values, heights, mean_is_free)


def refuse_beyond_full_contact(
    control: str, values: Real, heights: Real, mean_is_free: bool
) -> None:
    """Refuse depths at which all nodes touch, where that is rigid."""
    if control == "depths" and mean_is_free:
        full_contact, depth = float(np.mean(heights.max() - heights)), values.max()
        if not depth < full_contact:
            raise InputError(
                f"depth {depth:g} is beyond reach: the periodic half-space is in full contact "
                f"at {full_contact:g}, whatever the force; give smaller depths, or forces"
            )
