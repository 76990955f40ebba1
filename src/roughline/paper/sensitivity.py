"""How much the exponent depends on the window of loads and on the averaging."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughline.computing.arrays import Real
from roughline.paper.exponents import converged_stiffness
from roughline.paper.windows import Window
from roughline.statistics import bootstrap
from roughline.statistics.averages import at_levels
from roughline.statistics.bootstrap import NO_ESTIMATE, IntervalEstimate
from roughline.statistics.power_law import PowerLaw, fit_power_law
from roughline.statistics.window import find_window, inside_window

if TYPE_CHECKING:
    import xarray

_LEVELS = 400
_LEAST_SHARE = 0.95  # of resamples that must have an exponent, for an interval


@dataclass(frozen=True)
class Sensitivity:
    """The exponent of one ensemble and fractal dimension, fitted in several ways.

    Attributes
    ----------
    fractal_dimension : float
        D_f.
    arithmetic, geometric : tuple of PowerLaw
        Law of the mean stiffness at fixed force, for each window.
    at_level : tuple of IntervalEstimate
        Exponent of mean stiffness over mean force, both at fixed level, for each window.
    automatic : PowerLaw or None
        Law of the arithmetic mean in the longest window in which a power law is not rejected.
    unresolved : int
        Loads that the automatic window leaves out, because a realisation did not converge or
        has fewer than ten springs or cells in contact.
    """

    fractal_dimension: float
    arithmetic: tuple[PowerLaw, ...]
    geometric: tuple[PowerLaw, ...]
    at_level: tuple[IntervalEstimate, ...]
    automatic: PowerLaw | None
    unresolved: int


def sensitivity(data: xarray.Dataset, windows: tuple[Window, ...]) -> Sensitivity:
    """Fit one fractal dimension of an ensemble in several ways."""
    force = data.force_bar.values
    converged = [(window, converged_stiffness(data, window)[0]) for window in windows]
    usable = (np.isfinite(data.stiffness.values) & (data.resolved.values == 1)).all(axis=0)
    stiffness = data.stiffness.values[:, usable]
    automatic = find_window(force[usable], stiffness) if np.count_nonzero(usable) >= 5 else None
    return Sensitivity(
        fractal_dimension=float(data.fractal_dimension),
        arithmetic=tuple(fit_power_law(force, values, window) for window, values in converged),
        geometric=tuple(
            fit_power_law(force, values, window, averaging="geometric")
            for window, values in converged
        ),
        at_level=tuple(_exponent_at_level(data, window) for window in windows),
        automatic=fit_power_law(force[usable], stiffness, automatic) if automatic else None,
        unresolved=int(np.count_nonzero(~usable)),
    )


def sensitivities(
    data: xarray.Dataset, dimensions: Real, windows: tuple[Window, ...]
) -> list[Sensitivity]:
    """Fit each of several fractal dimensions of an ensemble in several ways."""
    return [sensitivity(data.sel(fractal_dimension=each), windows) for each in dimensions]


def _exponent_at_level(data: xarray.Dataset, window: Window) -> IntervalEstimate:
    """Exponent of the means at fixed level, at the levels whose mean force is in the window."""
    converged = np.isfinite(data.stiffness.values).all(axis=1)
    force, stiffness = at_levels(
        data.force_bar.values,
        data.depth.values[converged],
        data.stiffness.values[converged],
        data.highest.values[converged],
        _LEVELS,
    )
    inside = inside_window(force.mean(axis=0), window)
    if np.count_nonzero(inside) < 3:
        return NO_ESTIMATE
    both = np.concatenate([force[:, inside], stiffness[:, inside]], axis=1)
    exponent = bootstrap.function_of_means(both, _slope)
    if np.isfinite(exponent.values).mean() < _LEAST_SHARE:
        return IntervalEstimate(float(exponent.value), np.nan, np.nan)
    return exponent.interval_estimate()


def _slope(means: Real) -> tuple[Real, Real]:
    """Exponent by least squares of mean stiffness over mean force, and its gradient.

    The last axis holds the forces at all levels, and then the stiffnesses. A resample that
    carries no force at a level is fitted without that level; its exponent is NaN if fewer than
    three levels are left.
    """
    carries = (means > 0).reshape(*means.shape[:-1], 2, -1).all(axis=-2)
    count = carries.sum(axis=-1, keepdims=True)
    safe = np.where(np.concatenate([carries, carries], axis=-1), means, 1.0)
    x, y = np.split(np.log(safe), 2, axis=-1)
    x, y = (
        np.where(carries, each - each.sum(axis=-1, keepdims=True) / np.maximum(count, 1), 0.0)
        for each in (x, y)
    )
    spread = np.where(count >= 3, (x**2).sum(axis=-1, keepdims=True), np.nan)
    slope = (x * y).sum(axis=-1, keepdims=True) / spread
    gradient = np.concatenate([(y - 2 * slope * x) / spread, x / spread], axis=-1) / safe
    return slope[..., 0], gradient
