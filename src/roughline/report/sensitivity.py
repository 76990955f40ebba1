"""How much the exponent depends on the window of loads and on the averaging."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from roughline import bootstrap
from roughline.averages import at_levels
from roughline.power_law import PowerLaw, find_window, fit_power_law
from roughline.report.summary import Estimate, Window, inside_window, usable

if TYPE_CHECKING:
    import xarray

Real = NDArray[np.float64]

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
        return Estimate(np.nan, np.nan, np.nan)
    pairs = zip(
        bootstrap.resampled_means(force[:, inside]),
        bootstrap.resampled_means(stiffness[:, inside]),
        strict=True,
    )
    slopes = np.array([_slope(*pair) for pair in pairs])
    value = _slope(*(mean[inside] for mean in means))
    if np.isfinite(slopes).mean() < _SURE:
        return Estimate(value, np.nan, np.nan)
    low, high = bootstrap.percentile_interval(slopes)
    return Estimate(value, float(low), float(high))


def _slope(force: Real, stiffness: Real) -> float:
    """Exponent by least squares; levels at which a resample bears nothing are left out."""
    bears = (force > 0) & (stiffness > 0)
    if np.count_nonzero(bears) < 3:
        return float("nan")
    x, y = np.log(force[bears]), np.log(stiffness[bears])
    centred = x - x.mean()
    return float((centred * y).sum() / (centred**2).sum())
