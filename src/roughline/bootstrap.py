"""Intervals from resampling the realisations of an ensemble."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

ROUNDS = 1000


def interval(
    values: NDArray[np.float64],
    statistic: Callable[[NDArray[np.float64]], float | NDArray[np.float64]],
    confidence: float = 0.95,
    rng: int = 0,
) -> NDArray[np.float64]:
    """Percentile interval of a statistic of the ensemble mean.

    Parameters
    ----------
    values : ndarray, shape (realisations, ...)
        One entry for each realisation.
    statistic : callable
        Takes the mean over realisations and returns one or more numbers.
    confidence : float, optional
        Level of the interval.
    rng : int, optional
        Seed of the resampling.

    Returns
    -------
    ndarray, shape (2, ...)
        Lower and upper ends.
    """
    count = values.shape[0]
    draws = np.random.default_rng(rng).integers(count, size=(ROUNDS, count))
    results = np.array([statistic(values[draw].mean(axis=0)) for draw in draws])
    return np.quantile(results, [(1 - confidence) / 2, (1 + confidence) / 2], axis=0)
