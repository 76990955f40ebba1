"""Topographies of SurfaceTopography as surfaces."""

from __future__ import annotations

from typing import Any

from roughline.errors import InputError
from roughline.topography.settings import PERIODIC, PIECE, Settings
from roughline.units import metres_per


def fields_of_topography(
    topography: Any, has_sizes: bool, unit: str | None, settings: Settings
) -> dict[str, Any]:
    """Return heights, sizes, unit and settings of a topography, as fields of a Surface.

    A map that states its unit is converted to metres.
    """
    if topography.dim != 2:
        raise InputError("the topography is a line scan; a Surface needs a map: make a Line of it")
    if has_sizes:
        raise InputError("the topography has its own sizes; leave sizes out")
    if topography.unit and unit:
        raise InputError(f"the topography states its unit, {topography.unit}; leave unit out")
    factor = metres_per(topography.unit) if topography.unit else 1.0
    heights = topography.heights()
    return {
        "heights": heights if factor == 1 else heights * factor,
        "sizes": tuple(factor * float(size) for size in topography.physical_sizes),
        "unit": "m" if topography.unit else unit,
        "settings": {
            "origin": PERIODIC if topography.is_periodic else PIECE,
            **({"file_unit": topography.unit} if topography.unit else {}),
            **settings,
        },
    }
