"""The exponent of mean stiffness over mean force, for means at fixed force, depth or level."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Literal

import numpy as np

from roughline.paper.laws import converged_stiffness, exponent_estimate
from roughline.statistics import bootstrap
from roughline.statistics.bootstrap import NO_ESTIMATE, IntervalEstimate
from roughline.statistics.planes import at_depths, at_levels
from roughline.statistics.power_law import fit_power_law, line_weights
from roughline.statistics.window import inside_window

if TYPE_CHECKING:
    import xarray

    from roughline.computing.arrays import Indices, Real
    from roughline.paper.windows import ForceWindow
    from roughline.statistics.averages import Averaging

Fixed = Literal["force", "depth", "level"]
"""What all realisations have in common where they are averaged."""

_DEPTHS = 2000  # depths or levels of an ensemble
_FACTOR_AROUND_WINDOW = 5.0  # of the mean force, up to which they are used
_FEWEST_PLACES, _MOST_PLACES = 8, 120  # of those
_FITTED_FORCES = 12  # means in the window at which the line is fitted, evenly spaced logarithms
_NO_FORCE = 1e-200  # mean force up to which no body of a resample touches
_LEAST_SHARE_OF_RESAMPLES = 0.95  # that must have an exponent, for an interval


def exponent_of_means(
    data: xarray.Dataset, window: ForceWindow, fixed: Fixed, averaging: Averaging
) -> IntervalEstimate:
    """Return the exponent of mean stiffness over mean force in a window of the mean force.

    It is that of an ensemble at one fractal dimension, by least squares of the logarithms; there is
    no estimate where the means do not cover the window. Realisations are averaged under the same
    force, at the same depth since their first touch, or at the same height of the rigid plane above
    their mean (level). At fixed level a geometric mean is that of the levels at which all
    realisations touch.
    """
    if fixed == "force":
        stiffness = converged_stiffness(data, window)
        return exponent_estimate(
            fit_power_law(data.force_bar.values, stiffness, window, averaging=averaging)
        )
    force, stiffness = _at_fixed(data, fixed)
    geometric = averaging == "geometric"
    if geometric:
        touches = (force > 0).all(axis=0)
        force, stiffness = np.log(force[:, touches]), np.log(stiffness[:, touches])
    used = _places_around(force.mean(axis=0), window, geometric)
    if used is None:
        return NO_ESTIMATE
    both = np.concatenate([force[:, used], stiffness[:, used]], axis=1)
    exponent = bootstrap.function_of_means(both, partial(_exponent, window, geometric))
    if np.isfinite(exponent.values).mean() < _LEAST_SHARE_OF_RESAMPLES:
        return IntervalEstimate(float(exponent.value), np.nan, np.nan)
    return exponent.interval_estimate()


def _at_fixed(data: xarray.Dataset, fixed: Fixed) -> tuple[Real, Real]:
    """Force and stiffness of the realisations that converged, at common depths or levels."""
    converged = np.isfinite(data.stiffness.values).all(axis=1)
    force_bar, depth = data.force_bar.values, data.depth.values[converged].astype(np.float64)
    stiffness = data.stiffness.values[converged]
    if fixed == "depth":
        return at_depths(force_bar, depth, stiffness, _DEPTHS)
    return at_levels(force_bar, depth, stiffness, data.highest.values[converged], _DEPTHS)


def _places_around(force: Real, window: ForceWindow, geometric: bool) -> Indices | None:
    """Return places whose mean force lies around a window; None where they do not reach its ends.

    They reach beyond it, as resamples have the forces of the window at other places.
    """
    mean = np.exp(force) if geometric else force
    low, high = window
    if not mean.size or mean.min() > low or mean.max() < high:
        return None
    around = np.flatnonzero(
        inside_window(mean, (low / _FACTOR_AROUND_WINDOW, high * _FACTOR_AROUND_WINDOW))
    )
    if around.size < _FEWEST_PLACES:
        return None
    return around[np.linspace(0, around.size - 1, min(_MOST_PLACES, around.size)).astype(int)]


def _exponent(window: ForceWindow, geometric: bool, means: Real) -> tuple[Real, Real]:
    """Exponent of mean stiffness over mean force in a window, and its gradient by both means.

    The last axis of `means` holds the mean forces at all places, rising, and then the stiffnesses,
    or the means of their logarithms. The exponent of a resample that does not cover the window is
    NaN.
    """
    at = np.linspace(math.log(window[0]), math.log(window[1]), _FITTED_FORCES)
    weights, _ = line_weights(at)
    table = means.reshape(-1, means.shape[-1])
    logs = table if geometric else np.log(np.maximum(table, _NO_FORCE))
    x, y = np.split(logs, 2, axis=1)
    right = np.stack([(x < each).sum(axis=1) for each in at], axis=1)
    covers = (right[:, 0] > 0) & (right[:, -1] < x.shape[1])
    right = np.clip(right, 1, x.shape[1] - 1)
    (x_left, y_left), (x_right, y_right) = (
        (np.take_along_axis(x, place, axis=1), np.take_along_axis(y, place, axis=1))
        for place in (right - 1, right)
    )
    covers &= x_left[:, 0] > math.log(_NO_FORCE)
    step = np.where(x_right > x_left, x_right - x_left, 1.0)
    slope, part = (y_right - y_left) / step, (at - x_left) / step
    exponents = np.where(covers, (y_left + slope * (at - x_left)) @ weights, np.nan)
    gradient = np.zeros_like(logs)
    rows = np.arange(len(logs))[:, np.newaxis]
    for place, share in ((right - 1, 1 - part), (right, part)):
        np.add.at(gradient, (rows, place), -weights * slope * share)
        np.add.at(gradient, (rows, place + x.shape[1]), weights * share)
    gradient[~covers] = 0.0
    if not geometric:
        gradient /= np.where(table > _NO_FORCE, table, 1.0)
    shape = means.shape[:-1]
    return exponents.reshape(shape), gradient.reshape(means.shape)
