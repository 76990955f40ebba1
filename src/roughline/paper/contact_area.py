"""The real contact area of an ensemble: its law over the force, and where stiffness saturates."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughline.contact import scaling
from roughline.paper.windows import WINDOW_AREA, covers
from roughline.statistics import bootstrap
from roughline.statistics.bootstrap import NO_ESTIMATE, IntervalEstimate
from roughline.statistics.power_law import exponent_weights
from roughline.statistics.window import inside_window

if TYPE_CHECKING:
    import xarray

    from roughline.computing.arrays import Mask, Real

SATURATED = 0.9
"""Share of the exact punch's stiffness at which the real area is read."""


@dataclass(frozen=True)
class AreaLaw:
    """The real area over the force, eq. 4, for one way to measure the area."""

    # A E* rms_slope / F, geometric mean over the window: every load has the same weight [1]
    kappa: IntervalEstimate
    kappa_ends: tuple[float, float]  # κ at the first and at the last load of the window [1]
    # exponent of the area over the force, by least squares of the logarithms
    exponent: IntervalEstimate


def mean_area(one: xarray.Dataset) -> tuple[Real, Mask]:
    """Return the mean real area fraction at each load, corrected for its outline.

    Beside it stands whether ten cells or more touch in every realisation.
    """
    area = np.nanmean(one.area_fraction_corrected.values, axis=0)
    return area, (one.resolved.values == 1).all(axis=0)


def area_law(full: xarray.Dataset, name: str) -> AreaLaw:
    """Return the area law of one fractal dimension, with the area of that name."""
    inside = inside_window(full.force_bar.values, WINDOW_AREA)
    force = full.force_bar.values[inside]
    area = full[name].values[:, inside]
    finite = np.isfinite(area).all(axis=1)
    if not covers(full.force_bar.values, WINDOW_AREA) or not finite.any():
        return AreaLaw(NO_ESTIMATE, (np.nan, np.nan), NO_ESTIMATE)
    area, slope = area[finite], full.rms_slope.values[finite]
    scaled = area * slope[:, np.newaxis] / force
    same_weights = np.full(force.size, 1 / force.size)
    ends = scaled.mean(axis=0)[[0, -1]]
    exponent = bootstrap.sum_of_log_means(area, exponent_weights(force, WINDOW_AREA))
    return AreaLaw(
        kappa=bootstrap.sum_of_log_means(scaled, same_weights).interval_estimate().exp(),
        kappa_ends=(float(ends[0]), float(ends[1])),
        exponent=exponent.interval_estimate(),
    )


def saturation(full: xarray.Dataset) -> IntervalEstimate:
    """Return the real area fraction at which the mean stiffness is 90 % of the exact punch's.

    The area is counted in cells, and interpolated linearly between loads; it is NaN if the
    largest load does not reach that stiffness.
    """
    converged = np.isfinite(full.stiffness.values).all(axis=1)
    stiffness = full.stiffness.values[converged] / scaling.EXACT_PUNCH
    area = full.area_fraction.values[converged]
    if not converged.any():
        return NO_ESTIMATE
    mean = stiffness.mean(axis=0)
    above = int(np.searchsorted(mean, SATURATED))
    if above in (0, mean.size):
        return NO_ESTIMATE

    def area_at_saturation(means: Real) -> tuple[Real, Real]:
        """Area between two loads, and its gradient by the two stiffnesses and areas."""
        (k_0, k_1), (a_0, a_1) = means[..., :2].T, means[..., 2:].T
        part, slope = (SATURATED - k_0) / (k_1 - k_0), (a_1 - a_0) / (k_1 - k_0)
        gradient = [-(1 - part) * slope, -part * slope, 1 - part, part]
        return a_0 + part * (a_1 - a_0), np.stack(gradient, axis=-1)

    ends = slice(above - 1, above + 1)
    both = np.hstack([stiffness[:, ends], area[:, ends]])
    return bootstrap.function_of_means(both, area_at_saturation).interval_estimate()
