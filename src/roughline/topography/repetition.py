"""Steps at the borders of a surface that is repeated periodically."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughline.facts.fact import Fact
from roughline.topography.body import Surface

_OUTWEIGHS = 0.5  # share of a repeated map's mean-square slope that is warned of


@dataclass(frozen=True)
class _BorderJump:
    """Steps of a repeated surface across its borders, compared with those within."""

    jump: float  # Root-mean-square difference of heights across opposite borders. [length]
    step: float  # the same of neighbouring points within the surface [length]
    # share of the repeated surface's mean-square slope that lies at its borders [1]
    share_of_slope: float

    @property
    def outweighs(self) -> bool:
        """Whether the borders have more of the mean-square slope than all other steps."""
        return self.share_of_slope > _OUTWEIGHS

    def fact(self, unit: str | None) -> Fact:
        """How far a map jumps where it is repeated; a grave warning if that outweighs."""
        times = self.jump / self.step if self.step else None
        numbers = {"unit": unit, "outweighs": self.outweighs}
        found = Fact("map_jumps_at_borders", **vars(self), times=times, **numbers)
        return found.grave(self.outweighs)


def border_jump(surface: Surface, repeats: tuple[bool, bool] = (True, True)) -> _BorderJump:
    """Measure the jump across the borders of a surface that is repeated, along x and y or one."""
    across, within = [], []
    slopes_across = slopes_within = 0.0
    for axis, (spacing, repeated) in enumerate(zip(surface.spacing, repeats, strict=True)):
        if not repeated:
            continue
        heights = np.moveaxis(surface.heights, axis, 0)
        across.append(heights[0] - heights[-1])
        within.append(np.diff(heights, axis=0).ravel())
        slopes_across += float(np.sum((across[-1] / spacing) ** 2))
        slopes_within += float(np.sum((within[-1] / spacing) ** 2))
    jump, step = (math.sqrt(float(np.mean(np.concatenate(each) ** 2))) for each in (across, within))
    slopes = slopes_across + slopes_within
    return _BorderJump(jump, step, slopes_across / slopes if slopes else 0.0)
