"""Intervals of stiffness and area: the uncertainty due to the grid and to filled points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.contact.curve import Curve
from roughline.engineering.intervals import Ends, Intervals

_UNSURE = 5.0  # upper over lower end above which a stiffness near full contact may be infinite


@dataclass(frozen=True, eq=False)
class Changes:
    """Effect of another choice, such as another way to fill missing points.

    Attributes
    ----------
    stiffness, unloading, area : ndarray, shape (loads,), or float
        Change of the stiffness on loading and on unloading [N / m] and of the corrected area
        fraction [1].
    """

    stiffness: Real | float = 0.0
    unloading: Real | float = 0.0
    area: Real | float = 0.0


@dataclass(frozen=True, eq=False)
class Solution:
    """A curve and its intervals.

    Attributes
    ----------
    curve : Curve
        Loads that failed are marked.
    interrupted : bool
        Whether Ctrl-C came.
    intervals : Intervals or None
        Of the curve; None where the grid's errors are not known.
    note : str
        What another way to fill missing points changes, if that was tried.
    """

    curve: Curve
    interrupted: bool = False
    intervals: Intervals | None = None
    note: str = ""

    @classmethod
    def of(
        cls, curve: Curve, interrupted: bool, changes: Changes | None = None, note: str = ""
    ) -> Solution:
        """A curve with the intervals of its grid's errors and of further changes.

        Without the grid's errors there are no intervals: those of further changes alone would be
        too narrow.
        """
        changes = changes or Changes()
        value, error = curve.area_fraction_corrected, curve.area_fraction_error
        most, unloading = curve.area_fraction_most, curve.unloading_stiffness
        unloading_error = curve.unloading_stiffness_error
        if curve.stiffness_error is None or value is None or error is None or most is None:
            return cls(curve, interrupted, note=note)
        assert unloading is not None
        assert unloading_error is not None
        low, high = interval(value, np.hypot(error, changes.area))
        loading = interval(curve.stiffness, np.hypot(curve.stiffness_error, changes.stiffness))
        springing = interval(unloading, np.hypot(unloading_error, changes.unloading))
        if curve.settings.get("boundary") == "periodic":  # a full contact is infinitely stiff
            may_be_full = high >= 1
            loading, springing = (_open(ends, may_be_full) for ends in (loading, springing))
        if curve.hardness is not None:  # no area bears more than the hardness
            low = np.maximum(low, curve.force / (curve.hardness * curve.length**2))
            loading = loading_under_unloading(loading, springing)
        # whole cells overstate an area under summits, and finer waves take away from it
        area_ends = low, np.minimum(high, most + changes.area)
        return cls(curve, interrupted, Intervals(loading, springing, area_ends), note)


def interval(value: Real, error: Real) -> Ends:
    """Both ends of an interval, v / (1 + e / v) and v + e: nothing positive gets below zero."""
    with np.errstate(invalid="ignore"):
        return np.where(value == 0, 0.0, value / (1 + error / value)), value + error


def _open(ends: Ends, may_be_full: Mask) -> Ends:
    """Ends of a stiffness, without an upper one where contact may be full and little is known."""
    unsure = ends[1] > _UNSURE * ends[0]
    return ends[0], np.where(may_be_full & unsure, np.inf, ends[1])


def loading_under_unloading(loading: Ends, unloading: Ends) -> Ends:
    """Ends of the stiffness on loading, which lies between none and that on unloading.

    These bounds are all that is known where a coarser grid has no point below the hardness.
    """
    known = np.isfinite(unloading[1])
    low = np.where(np.isnan(loading[0]) & known, 0.0, loading[0])
    return low, np.where(known, np.fmin(loading[1], unloading[1]), loading[1])


def change(before: Real | None, after: Real | None, asked: Indices) -> tuple[Real, float]:
    """By how much each load changes, and by how many per cent at most of those asked for."""
    assert before is not None
    assert after is not None
    with np.errstate(invalid="ignore", divide="ignore"):
        moved = np.where(after == before, 0.0, np.abs(after - before))  # infinite in full contact
        return moved, 100 * float(np.nanmax((moved / before)[asked], initial=0.0))
