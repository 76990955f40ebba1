"""Surfaces in Gwyddion's simple field format (GSF)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from roughline.errors import InputError
from roughline.topography.body import Surface
from roughline.topography.files.in_metres import heights_in_metres, sides_in_metres
from roughline.topography.heights import rms_deviation

_MOST_ROUNDED = 1e-3  # of the rms height, that rounding may change heights by, against each other


def write_gsf(surface: Surface, path: Path) -> None:
    """Write the heights in single precision, the only one of the format, and the sides, in metres.

    The head is text and ends in 1 to 4 zero bytes, at a multiple of 4 bytes. Heights follow row by
    row, x fastest.
    """
    (nx, ny), (lx, ly) = surface.shape, sides_in_metres(surface)
    heights = heights_in_metres(surface)
    with np.errstate(all="ignore"):  # what single precision cannot hold is refused here
        single = heights.astype("<f4")
        is_rounded = not np.ptp(single - heights) <= _MOST_ROUNDED * rms_deviation(heights)
    if is_rounded:
        raise InputError(
            f"{path} would hold the heights with 7 digits, too few for their roughness: take the "
            'mean off, or write them as ".x3p" or ".nc"'
        )
    head = (
        "Gwyddion Simple Field 1.0\n"
        f"XRes = {nx}\nYRes = {ny}\nXReal = {lx!r}\nYReal = {ly!r}\n"
        "XYUnits = m\nZUnits = m\nTitle = Height\n"
    ).encode()
    path.write_bytes(head + bytes(4 - len(head) % 4) + single.T.tobytes())
