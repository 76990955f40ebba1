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
    pressure, gap, displacement = (
        fields.pressure / state.E_star,
        fields.gap / height,
        fields.displacement / height,
    )
    maps = {
        "area": Map(fields.contact.astype(np.uint8), "marks", 0, 2, marks=("ink",)),
        "pressure": _scaled(
            pressure, "Viridis256", "pressure over E*; blank where nothing touches", _PRESSED
        ),
        "gap": _scaled(gap, "Cividis256", "gap in rms heights; blank where they touch"),
        "displacement": _scaled(
            displacement, "Cividis256", "deflection of the half-space in rms heights"
        ),
    }
    for each in state.added:
        maps |= each.maps_of(fields, state)
    return maps


def _scaled(values: NDArray[Any], palette: str, caption: str, low: float = 0.0) -> Map:
    """A map from a share of its largest number, or zero, to that."""
    high = float(values.max(initial=0.0))
    return Map(values, palette, low * high, high or 1.0, caption)
