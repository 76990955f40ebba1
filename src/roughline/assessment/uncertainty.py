"""Intervals of stiffness and area: what the grid and filled points leave open."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.curve import Curve
from roughline.engineering.answer import Ends


@dataclass(frozen=True, eq=False)
class Solution:
    """A curve and its intervals.

    Attributes
    ----------
    curve : Curve
        Loads that failed are marked.
    interrupted : bool
        Whether Ctrl-C came.
    stiffness_interval, area_interval : tuple of ndarray, shape (loads,), or None
        Both ends, of stiffness [N / m] and of the corrected area fraction [1].
    note : str
        What another way to fill missing points changes, if that was tried.
    """

    curve: Curve
    interrupted: bool = False
    stiffness_interval: Ends | None = None
    area_interval: Ends | None = None
    note: str = ""

    @classmethod
    def of(
        cls,
        curve: Curve,
        interrupted: bool,
        stiffness_change: Real | float = 0.0,
        area_change: Real | float = 0.0,
        note: str = "",
    ) -> Solution:
        """A curve with the intervals of its grid's errors and of further changes.

        Without the grid's errors there are no intervals: further changes alone are narrower than
        what is unknown.
        """
        value, error = curve.area_fraction_corrected, curve.area_fraction_error
        most = curve.area_fraction_most
        if curve.stiffness_error is None or value is None or error is None or most is None:
            return cls(curve, interrupted, note=note)
        stiffness = interval(curve.stiffness, np.hypot(curve.stiffness_error, stiffness_change))
        low, high = interval(value, np.hypot(error, area_change))
        # whole cells overstate an area under summits, and finer waves take away from it
        area = low, np.minimum(high, most + area_change)
        return cls(curve, interrupted, stiffness, area, note)


def interval(value: Real, error: Real) -> Ends:
    """Both ends of an interval, v / (1 + e / v) and v + e: nothing positive gets below zero."""
    with np.errstate(invalid="ignore"):
        return value / (1 + error / value), value + error


def change(before: Real | None, after: Real | None) -> tuple[Real, float]:
    """By how much each load changes, and by how many per cent at most."""
    assert before is not None
    assert after is not None
    moved = np.abs(after - before)
    with np.errstate(invalid="ignore", divide="ignore"):
        return moved, 100 * float(np.nanmax(moved / before, initial=0.0))
