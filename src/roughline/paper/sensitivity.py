"""How much the exponent depends on the window of loads and on the averaging."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughline.computing.arrays import Real
from roughline.paper.exponents import Window, usable
from roughline.statistics import bootstrap
from roughline.statistics.averages import at_levels
from roughline.statistics.bootstrap import NOTHING, Estimate
from roughline.statistics.power_law import PowerLaw, find_window, fit_power_law, inside_window

if TYPE_CHECKING:
    import xarray


WINDOWS_REDUCED: tuple[Window, ...] = ((1e-4, 1e-2), (1e-3, 1e-1), (1e-2, 0.3))
WINDOWS_FULL: tuple[Window, ...] = ((1e-3, 1e-2), (1e-2, 1e-1), (1e-2, 0.3))

_LEVELS = 400
_SURE = 0.95  # share of resamples that must bear something in the window, for an interval


@dataclass(frozen=True)
class Sensitivity:
    """The exponent of one ensemble and fractal dimension, fitted in several ways.

    Attributes
    ----------
    fractal_dimension : float
        D_f.
    arithmetic, geometric : tuple of PowerLaw
        Mean stiffness at fixed force, for each window.
    at_level : tuple of Estimate
        Exponent of mean stiffness over mean force, both at fixed level, for each window.
    automatic : PowerLaw or None
        Arithmetic mean, in the longest window in which a power law is not rejected.
    unresolved : int
        Loads that the automatic window may not use, because in some realisation fewer than ten
        springs or cells touch, or because it did not converge.
    """

    fractal_dimension: float
    arithmetic: tuple[PowerLaw, ...]
    geometric: tuple[PowerLaw, ...]
    at_level: tuple[Estimate, ...]
    automatic: PowerLaw | None
    unresolved: int


def sensitivity(data: xarray.Dataset, windows: tuple[Window, ...]) -> Sensitivity:
    """Fit one fractal dimension of an ensemble in several ways."""
    force = data.force_bar.values
    fits = [(window, usable(data, window)[0]) for window in windows]
    good = (np.isfinite(data.stiffness.values) & (data.resolved.values == 1)).all(axis=0)
    stiffness = data.stiffness.values[:, good]
    automatic = find_window(force[good], stiffness) if np.count_nonzero(good) >= 5 else None
    return Sensitivity(
        fractal_dimension=float(data.fractal_dimension),
        arithmetic=tuple(fit_power_law(force, values, window) for window, values in fits),
        geometric=tuple(
            fit_power_law(force, values, window, averaging="geometric") for window, values in fits
        ),
        at_level=tuple(_at_level(data, window) for window in windows),
        automatic=fit_power_law(force[good], stiffness, automatic) if automatic else None,
        unresolved=int(np.count_nonzero(~good)),
    )


def _at_level(data: xarray.Dataset, window: Window) -> Estimate:
    """Exponent of the means at fixed level, where the mean force lies in the window."""
    converged = np.isfinite(data.stiffness.values).all(axis=1)
    force, stiffness = at_levels(
        data.force_bar.values,
        data.depth.values[converged],
        data.stiffness.values[converged],
        data.highest.values[converged],
        _LEVELS,
    )
    means = force.mean(axis=0), stiffness.mean(axis=0)
    inside = inside_window(means[0], window)
    if np.count_nonzero(inside) < 3:
        return NOTHING
    both = np.concatenate([force[:, inside], stiffness[:, inside]], axis=1)
    found = bootstrap.of_means(both, _slope)
    if np.isfinite(found.values).mean() < _SURE:
        return Estimate(float(found.value), np.nan, np.nan)
    return found.estimate()


def _slope(means: Real) -> tuple[Real, Real]:
    """Exponent by least squares of mean force and mean stiffness, side by side, and its gradient.

    Levels at which a resample bears nothing are left out of its line; NaN if fewer than three are
    left.
    """
    bears = (means > 0).reshape(*means.shape[:-1], 2, -1).all(axis=-2)
    count = bears.sum(axis=-1, keepdims=True)
    safe = np.where(np.concatenate([bears, bears], axis=-1), means, 1.0)
    x, y = np.split(np.log(safe), 2, axis=-1)
    x, y = (
        np.where(bears, each - each.sum(axis=-1, keepdims=True) / np.maximum(count, 1), 0.0)
        for each in (x, y)
    )
    spread = np.where(count >= 3, (x**2).sum(axis=-1, keepdims=True), np.nan)
    slope = (x * y).sum(axis=-1, keepdims=True) / spread
    gradient = np.concatenate([(y - 2 * slope * x) / spread, x / spread], axis=-1) / safe
    return slope[..., 0], gradient
