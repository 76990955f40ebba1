"""The mean stiffness of an ensemble over force, as the figures draw it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray

    from roughline.computing.arrays import Mask, Real
    from roughline.statistics.averages import Averaging


@dataclass(frozen=True, eq=False)
class MeanCurve:
    """Mean stiffness of one fractal dimension over force, all of shape (loads,)."""

    force_bar: Real  # dimensionless force F / (E* h L) [1]
    mean: Real  # of k / (punch E* L) over the realisations that converged [1]
    low: Real  # one standard error below the mean, and one above it [1]
    high: Real
    resolved: Mask  # whether ten springs or cells or more touch in every realisation


def mean_curve(
    one: xarray.Dataset, punch: float = 1.0, averaging: Averaging = "arithmetic"
) -> MeanCurve:
    """Average the stiffness of one fractal dimension, over that of a punch, at fixed force."""
    stiffness = one.stiffness.values / punch
    averaged = np.log(stiffness) if averaging == "geometric" else stiffness
    mean = np.nanmean(averaged, axis=0)
    freedom = max(stiffness.shape[0] - 1, 1)  # of a single realisation no error is known
    error = np.nanstd(averaged, axis=0) / np.sqrt(freedom)
    low, high = mean - error, mean + error
    if averaging == "geometric":
        mean, low, high = np.exp([mean, low, high])
    return MeanCurve(
        force_bar=one.force_bar.values,
        mean=mean,
        low=low,
        high=high,
        resolved=(one.resolved.values == 1).all(axis=0),
    )
