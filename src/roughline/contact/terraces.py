"""Plateaus of a terraced surface, whose rims are lost where pixels are means across an edge."""

from __future__ import annotations

import numpy as np

from roughline.measurement.departures import HEIGHT_ROUNDING, in_line, levelled
from roughline.topography.body import Surface, with_heights

_SMALLEST_SHARE = 0.01  # share of heights on plateaus that matters


def with_whole_plateaus(surface: Surface) -> Surface | None:
    """Raise the pixels across edges to the upper plateau; None where heights stand on none.

    Levels are those of pixels in the midst of plateaus. A mean between two of them has points on
    the upper one, and the plateaus beside it reach into it.
    """
    from scipy import ndimage  # here because it loads slowly

    heights = surface.heights
    flat = in_line(heights)
    if not flat.any() or surface.rms_height == 0:
        return None
    level = levelled(heights, flat)
    step = HEIGHT_ROUNDING * float(np.ptp(level))
    counts = np.round(level / step)
    levels = np.unique(counts[flat])
    plateau = np.isin(counts, levels)
    if plateau.mean() < _SMALLEST_SHARE or plateau.all():
        return None
    beside = ndimage.maximum_filter(np.where(plateau, level, -np.inf), size=3)
    next_level = step * np.append(levels, -np.inf)[np.searchsorted(levels, counts)]
    rise = np.maximum(np.maximum(beside, next_level) - level, 0.0)
    return with_heights(surface, heights + np.where(plateau, 0.0, rise))
