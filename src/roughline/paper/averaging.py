"""The exponent of mean stiffness over mean force, for means at fixed force, depth or level."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from roughline.computing.arrays import Real
from roughline.paper.exponents import converged_stiffness, exponent_estimate
from roughline.paper.windows import Window
from roughline.statistics import bootstrap
from roughline.statistics.averages import Averaging
from roughline.statistics.bootstrap import NO_ESTIMATE, IntervalEstimate
from roughline.statistics.planes import at_depths, at_levels
from roughline.statistics.power_law import fit_power_law
from roughline.statistics.window import inside_window

if TYPE_CHECKING:
    import xarray

Fixed = Literal["force", "depth", "level"]
"""What all realisations have in common where they are averaged."""

_PLACES = 2000
_LEAST_SHARE = 0.95  # of resamples that must have an exponent, for an interval
_COVERED = 1.1  # how near to the ends of the window mean forces must come, as a factor


def exponent_of_means(
    data: xarray.Dataset, window: Window, fixed: Fixed, averaging: Averaging
) -> IntervalEstimate:
    """Return the exponent of mean stiffness over mean force in a window of the mean force.

    Parameters
    ----------
    data : Dataset
        An ensemble at one fractal dimension.
    window : tuple of float
        Smallest and largest mean force.
    fixed : {"force", "depth", "level"}
        Whether realisations are averaged under the same force, at the same depth since their first
        touch, or at the same height of the rigid plane above their mean.
    averaging : {"arithmetic", "geometric"}
        Which mean, of both force and stiffness. At fixed level a geometric mean is that of the
        levels at which all realisations touch.

    Returns
    -------
    IntervalEstimate
        By least squares of the logarithms; no estimate where the means do not cover the window.
    """
    if fixed == "force":
        stiffness, _ = converged_stiffness(data, window)
        return exponent_estimate(
            fit_power_law(data.force_bar.values, stiffness, window, averaging=averaging)
        )
    force, stiffness = _at_fixed(data, fixed)
    geometric = averaging == "geometric"
    if geometric:
        touches = (force > 0).all(axis=0)
        force, stiffness = np.log(force[:, touches]), np.log(stiffness[:, touches])
    if not force.size:
        return NO_ESTIMATE
    mean = np.exp(force.mean(axis=0)) if geometric else force.mean(axis=0)
    inside = inside_window(mean, window)
    if np.count_nonzero(inside) < 3 or not _covers(mean[inside], window):
        return NO_ESTIMATE
    both = np.concatenate([force[:, inside], stiffness[:, inside]], axis=1)
    exponent = bootstrap.function_of_means(both, _slope if geometric else _slope_of_logarithms)
    if np.isfinite(exponent.values).mean() < _LEAST_SHARE:
        return IntervalEstimate(float(exponent.value), np.nan, np.nan)
    return exponent.interval_estimate()


def _at_fixed(data: xarray.Dataset, fixed: Fixed) -> tuple[Real, Real]:
    """Force and stiffness of the realisations that converged, at common depths or levels."""
    converged = np.isfinite(data.stiffness.values).all(axis=1)
    force_bar, depth = data.force_bar.values, data.depth.values[converged].astype(np.float64)
    stiffness = data.stiffness.values[converged]
    if fixed == "depth":
        return at_depths(force_bar, depth, stiffness, _PLACES)
    return at_levels(force_bar, depth, stiffness, data.highest.values[converged], _PLACES)


def _covers(mean_force: Real, window: Window) -> bool:
    """Whether mean forces reach both ends of a window."""
    low, high = window
    return bool(mean_force.min() <= low * _COVERED and mean_force.max() >= high / _COVERED)


def _slope_of_logarithms(means: Real) -> tuple[Real, Real]:
    """Exponent of mean stiffness over mean force, and its gradient by both.

    The last axis holds the mean forces at all levels, and then the stiffnesses. A resample that
    carries no force at a level is fitted without that level; its exponent is NaN if fewer than
    three levels are left.
    """
    carries = (means > 0).reshape(*means.shape[:-1], 2, -1).all(axis=-2)
    both = np.concatenate([carries, carries], axis=-1)
    safe = np.where(both, means, 1.0)
    slope, gradient = _slope(np.where(both, np.log(safe), np.nan))
    return slope, gradient / safe


def _slope(means: Real) -> tuple[Real, Real]:
    """Slope by least squares of the second half of the last axis over the first, and its gradient.

    Points that are NaN are left out; the slope is NaN if fewer than three are left.
    """
    known = np.isfinite(means[..., : means.shape[-1] // 2])
    count = known.sum(axis=-1, keepdims=True)
    x, y = (np.where(known, each - _mean(each, known), 0.0) for each in np.split(means, 2, axis=-1))
    spread = np.where(count >= 3, (x**2).sum(axis=-1, keepdims=True), np.nan)
    slope = (x * y).sum(axis=-1, keepdims=True) / spread
    gradient = np.concatenate([(y - 2 * slope * x) / spread, x / spread], axis=-1)
    return slope[..., 0], gradient


def _mean(values: Real, known: Real) -> Real:
    """Mean over the last axis of the values that are known, kept as an axis."""
    count = np.maximum(known.sum(axis=-1, keepdims=True), 1)
    return np.where(known, values, 0.0).sum(axis=-1, keepdims=True) / count
