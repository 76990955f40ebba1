"""Force that stands on points that were missing: nobody measured them, and they were filled."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.contact.fields import Fields
from roughline.contact.measures import Measure
from roughline.question.source import Topography, pressed_body
from roughline.topography.body import Surface
from roughline.topography.preparation import resampled

ON_FILLED = "force_on_filled"
"""Name of the measure, among those of the curve as asked."""

_SHARE_IN_INTERVALS = 0.1  # of the force, from which on intervals hold that it stands elsewhere


def filled_points(topographies: Sequence[Topography]) -> Mask | None:
    """Mark points of the pressed surface that were filled; None where that is not known."""
    marks: list[Surface] = []
    for each in topographies:
        region = each.filled_region
        if region is None and not each.is_filled and isinstance(each.body, Surface):
            region = replace(each.body, heights=np.zeros_like(each.body.heights))
        if region is None:
            return None
        points = None if each.preparation is None else each.preparation.points
        marks.append(region if points is None else resampled(region, points))
    return np.asarray(pressed_body(marks).heights > 0)


def force_on(points: Mask) -> Measure:
    """The share of the force that stands on some points, as a measure."""

    def share(fields: Fields) -> float:
        pushed = np.maximum(fields.pressure, 0.0)
        if pushed.shape != points.shape:  # coarser, to judge the grid
            return math.nan
        return float(pushed[points].sum() / pushed.sum()) if pushed.any() else 0.0

    return Measure(ON_FILLED, "s_f", "1", "share of the force that stands on filled points", share)


def relative_error(share: Real) -> Real:
    """By how much answers may differ if a share of the force stands elsewhere, relative to them.

    What was measured carries the rest, so that values are known to a factor 1 / (1 - s).
    """
    with np.errstate(divide="ignore"):
        return np.where(share > _SHARE_IN_INTERVALS, share / (1 - share), 0.0)
