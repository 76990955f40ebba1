"""The larger surface that a map was cut out of, and whether the map tells of it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from roughline.errors import InputError
from roughline.measurement.fit import SelfAffineFit, fitted
from roughline.topography.body import Surface

MOST_DOUBLINGS = 4
"""From a map without a roll-off to the larger surface: maps a sixteenth as long were tried."""

_USUAL_DOUBLINGS = 2.0  # doublings where the larger surface has no size


Assembly = Literal["joint", "seal"]
"""What a map is a piece of."""


@dataclass(frozen=True)
class Extrapolation:
    """The larger surface that a map was cut out of."""

    roll_offs: float | None  # wavelengths along a side of the map; None if it shows none
    doublings: float = (
        _USUAL_DOUBLINGS  # of the map's side until it is as long as the larger surface
    )
    assembly: Assembly | None = None  # what it is, if its area is known

    @classmethod
    def of(
        cls, roll_offs: float | None, area: float, joint: float | None, assembly: Assembly = "joint"
    ) -> Extrapolation:
        """The larger surface behind a map of a nominal area [m²], a joint's whose area is known."""
        if joint is None:
            return cls(roll_offs)
        return cls(roll_offs, max(0.0, math.log2(joint / area) / 2), assembly)

    @property
    def is_supported(self) -> bool:
        """Whether a map's tiles tell of a surface as large as that."""
        return self.roll_offs is not None or self.doublings <= MOST_DOUBLINGS


def roll_offs_along_a_side(surface: Surface) -> float | None:
    """Roll-off wavelengths along a side of a surface.

    None if the fitted interval of the roll-off reaches the longest waves, so that there may be
    none, or if there are too few points for a fit.
    """
    try:
        _, fit = fitted(surface)
    except InputError:
        return None
    return fitted_roll_offs(fit)


def fitted_roll_offs(fit: SelfAffineFit) -> float | None:
    """Roll-off wavelengths along a side of the surface that a law was fitted to."""
    return fit.q_roll / fit.q_low if fit.q_roll and fit.shows_roll_off else None
