"""What the second picture can show of a contact: its maps, with how each is drawn."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.lab.explore.state import ExploreState

_PRESSED = 1e-6  # of the largest pressure: where less presses, the paper shows


@dataclass(frozen=True, eq=False)
class Map:
    """Numbers over the surface, and all that the page needs to draw them."""

    values: NDArray[Any]
    palette: str  # the page knows it by this name
    low: float
    high: float
    caption: str = ""
    marks: tuple[str, ...] = ()  # the colours that mean something, by their names
    ring: tuple[float, float] | None = None  # a place that is marked, in sides of the surface

    @property
    def look(self) -> dict[str, Any]:
        """How it is drawn, without its numbers."""
        return {name: value for name, value in vars(self).items() if name != "values"}


def contact_maps(state: ExploreState, surface: rl.Surface, fields: rl.Fields) -> dict[str, Map]:
    """The maps of a contact, by the words that choose them."""
    height = surface.rms_height
    marks = ("ink",) if state.hardness_bar is None else ("ink", "plastic")
    pressure, gap, displacement = (
        fields.pressure / state.E_star,
        fields.gap / height,
        fields.displacement / height,
    )
    area = fields.contact.astype(np.uint8) + fields.plastic
    return {
        "area": Map(area, "marks", 0, 2, marks=marks),
        "pressure": _scaled(
            pressure, "Viridis256", "pressure over E*; blank where nothing touches", _PRESSED
        ),
        "gap": _scaled(gap, "Cividis256", "gap in rms heights; blank where they touch"),
        "displacement": _scaled(
            displacement, "Cividis256", "deflection of the half-space in rms heights"
        ),
    }


def _scaled(values: NDArray[Any], palette: str, caption: str, low: float = 0.0) -> Map:
    """A map from a share of its largest number, or zero, to that."""
    high = float(values.max(initial=0.0))
    return Map(values, palette, low * high, high or 1.0, caption)
