"""Intervals of stiffness and area: the uncertainty due to the grid and to filled points."""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.engineering.intervals import Ends, Intervals

_UNSURE_RATIO = 5.0  # of both ends; above, a stiffness near full contact may be infinite


def estimate_intervals(
    curve: SurfaceCurve, other: SurfaceCurve | None = None, unsure: Real | float = 0.0
) -> Intervals | None:
    """Intervals of a curve, of its grid's errors and of how far another one is from it.

    The other is that of another choice, such as another way to fill missing points; `unsure` is a
    further error, relative to the values. Without the grid's errors there are none: those of that
    choice alone would be too narrow.
    """
    value, error = curve.area_fraction_corrected, curve.area_fraction_error
    stiffness_error = curve.stiffness_error
    unloading, unloading_error = curve.unloading_stiffness, curve.unloading_stiffness_error
    if error is None or stiffness_error is None or unloading_error is None:
        return None
    other = other or curve
    area_change = change(value, other.area_fraction_corrected, unsure)
    loading_change = change(curve.stiffness, other.stiffness, unsure)
    unloading_change = change(unloading, other.unloading_stiffness, unsure)
    low, high = interval(value, np.hypot(error, area_change))
    loading = interval(curve.stiffness, np.hypot(stiffness_error, loading_change))
    springing = interval(unloading, np.hypot(unloading_error, unloading_change))
    if curve.half_space.mean_is_free:  # a full contact is infinitely stiff
        may_be_full = high >= 1
        loading, springing = (_open(ends, may_be_full) for ends in (loading, springing))
    if curve.hardness is not None:  # no area bears more than the hardness
        low = np.maximum(low, curve.force / (curve.hardness * curve.length**2))
        loading = loading_under_unloading(loading, springing)
    # whole cells overstate an area under summits, and finer waves take away from it
    return Intervals(
        loading, springing, (low, np.minimum(high, curve.area_fraction_most + area_change))
    )


def unloading_stiffness(curve: Curve) -> Real:
    """Stiffness on unloading; of a line, which has no yield, that on loading. [N / m]"""
    return curve.unloading_stiffness if isinstance(curve, SurfaceCurve) else curve.stiffness


def area_fraction(curve: Curve) -> Real:
    """Corrected contact area fraction; NaN of a line, whose model does not predict it. [1]"""
    if isinstance(curve, SurfaceCurve):
        return curve.area_fraction_corrected
    return np.full_like(curve.force, np.nan)


def interval(value: Real, error: Real) -> Ends:
    """Both ends of an interval, v / (1 + e / v) and v + e: nothing positive gets below zero."""
    with np.errstate(invalid="ignore"):
        return np.where(value == 0, 0.0, value / (1 + error / value)), value + error


def _open(ends: Ends, may_be_full: Mask) -> Ends:
    """Ends of a stiffness, without an upper one where contact may be full and little is known."""
    unsure = ends[1] > _UNSURE_RATIO * ends[0]
    return ends[0], np.where(may_be_full & unsure, np.inf, ends[1])


def loading_under_unloading(loading: Ends, unloading: Ends) -> Ends:
    """Ends of the stiffness on loading, which lies between none and that on unloading.

    These bounds are all that is known where a coarser grid has no point below the hardness.
    """
    known = np.isfinite(unloading[1])
    low = np.where(np.isnan(loading[0]) & known, 0.0, loading[0])
    return low, np.where(known, np.fmin(loading[1], unloading[1]), loading[1])


def widened(values: Real, ends: Ends | None, further: Ends) -> Ends:
    """Ends of values whose logarithms differ further, combined with their own as independent."""
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = np.log(values)
        if ends is not None:
            further = combined(further, (np.log(ends[0]) - logs, np.log(ends[1]) - logs))
        low, high = (values * np.exp(each) for each in further)
    low = np.where(np.isneginf(further[0]) & ~np.isnan(values), 0.0, low)
    return np.where(values == 0, 0.0, low), np.where(values == 0, 0.0, high)


def combined(first: Ends, second: Ends) -> Ends:
    """Both ends of a sum of independent differences."""
    return -np.hypot(first[0], second[0]), np.hypot(first[1], second[1])


def change(before: Real, after: Real, unsure: Real | float = 0.0) -> Real:
    """By how much each load changes.

    A further error `unsure`, relative to the values, is added to it as independent.
    """
    with np.errstate(invalid="ignore"):  # infinite in full contact
        moved = np.where(after == before, 0.0, np.abs(after - before))
        return np.hypot(moved, np.where(unsure == 0, 0.0, unsure * before))
