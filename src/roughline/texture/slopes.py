"""Parameters of slopes, by forward differences between neighbouring points.

A wave of 8 points loses 2.5 % of its slope in forward differences, and 10 % in central ones, so
the scheme belongs to the number. Differences run around a periodic body and end at the borders of
a piece.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from roughline.computing.arrays import Real
from roughline.texture.found import Found
from roughline.topography.heights import rms


def forward_differences(heights: Real, axis: int, *, is_periodic: bool) -> Real:
    """Return the next height along an axis less each height."""
    if is_periodic:
        return np.roll(heights, -1, axis) - heights
    return np.diff(heights, axis=axis)


def slope_parameters(heights: Real, spacings: tuple[float, ...], *, is_periodic: bool) -> Found:
    """Return Sdq and Sdr of a surface.

    Four points span two triangles, in two ways; the developed area is the mean of both.
    """
    slopes = [
        forward_differences(heights, axis, is_periodic=is_periodic) / spacings[axis]
        for axis in range(2)
    ]
    gradient = math.hypot(*map(rms, slopes))
    if min(heights.shape) < 2:
        needed = "the surface is one point wide: a gradient and an area need two points a side"
        return {"Sdq": needed, "Sdr": needed}
    on_sides = [
        _on_both_sides(each, 1 - axis, is_periodic=is_periodic) for axis, each in enumerate(slopes)
    ]
    share = np.mean([_lengthened(x**2 + y**2) for x in on_sides[0] for y in on_sides[1]])
    return {"Sdq": gradient, "Sdr": 100 * float(share)}


def gradient_and_length(heights: Real, spacing: float, *, is_periodic: bool) -> tuple[float, float]:
    """Return Rdq and Rdr of a profile."""
    slopes = forward_differences(heights, 0, is_periodic=is_periodic) / spacing
    return rms(slopes), 100 * _lengthened(slopes**2)


def _on_both_sides(slopes: Real, axis: int, *, is_periodic: bool) -> tuple[Any, Any]:
    """Return the slopes along the first and along the second side of each cell."""
    if is_periodic:
        return slopes, np.roll(slopes, -1, axis)
    between = np.moveaxis(slopes, axis, 0)
    return np.moveaxis(between[:-1], 0, axis), np.moveaxis(between[1:], 0, axis)


def _lengthened(squares: Real) -> float:
    """Mean of sqrt(1 + s²) - 1 over squares of slopes, which does not cancel for small ones."""
    return float((squares / (1 + np.sqrt(1 + squares))).mean())
