"""What the second picture can show of a contact."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.lab.explore.state import ExploreState
from roughline.lab.maps import Map

_PRESSED = 1e-6  # of the largest pressure: where less presses, the paper shows


def contact_maps(state: ExploreState, surface: rl.Surface, fields: rl.Fields) -> dict[str, Map]:
    """The maps of a contact, by the words that choose them."""
    height = surface.rms_height
    heights = (surface.heights - surface.heights.mean()) / height
    gap = np.where(fields.contact, np.nan, fields.gap / height)
    maps = {
        "height": Map(
            *(heights, "Cividis256", float(heights.min()), float(heights.max())), "height", "/ h"
        ),
        "area": Map(fields.contact.astype(np.uint8), "marks", 0, 2, marks=("ink",)),
        "pressure": _scaled(
            *(fields.pressure / state.E_star, "Viridis256", "pressure", "/ E*", _PRESSED),
            caption="blank where nothing touches",
        ),
        "gap": _scaled(
            *(gap, "Cividis256", "gap", "/ h"),
            nothing="in contact",
            caption="blank where they touch",
        ),
        "displacement": _scaled(
            *(fields.displacement / height, "Cividis256", "deflection", "/ h"),
            caption="of the half-space",
        ),
    }
    for each in state.added:
        maps |= each.maps_of(fields, state)
    return maps


def _scaled(
    values: NDArray[Any], palette: str, title: str, unit: str, low: float = 0.0, **said: str
) -> Map:
    """A map from a share of its largest number, or zero, to that."""
    high = float(np.nanmax(values, initial=0.0))
    return Map(values, palette, low * high, high or 1.0, title, unit, **said)  # type: ignore[arg-type]
