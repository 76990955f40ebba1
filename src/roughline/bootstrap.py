"""Intervals from resampling the realisations of an ensemble."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]

ROUNDS = 1000


def resampled_means(values: Real, rng: int = 0) -> Real:
    """Means of an ensemble resampled with replacement; what is not finite is left out.

    Ensembles of equally many realisations, resampled with the same seed, take the same ones.

    Parameters
    ----------
    values : ndarray, shape (realisations, ...)
        One entry for each realisation.
    rng : int, optional
        Seed of the resampling.

    Returns
    -------
    ndarray, shape (1000, ...)
        NaN where a resample holds no finite value.
    """
    count = values.shape[0]
    draws = np.random.default_rng(rng).integers(count, size=(ROUNDS, count))
    rows = np.repeat(np.arange(ROUNDS), count)
    weights = np.zeros((ROUNDS, count))
    np.add.at(weights, (rows, draws.ravel()), 1.0)
    flat = values.reshape(count, -1)
    finite = np.isfinite(flat)
    sums, counts = weights @ np.where(finite, flat, 0.0), weights @ finite
    means = np.divide(sums, counts, out=np.full(sums.shape, np.nan), where=counts > 0)
    return means.reshape(ROUNDS, *values.shape[1:])


def percentile_interval(resamples: Real, confidence: float = 0.95) -> Real:
    """Lower and upper end of the interval that holds the middle of the resamples.

    Parameters
    ----------
    resamples : ndarray, shape (rounds, ...)
        Statistics of the resamples.
    confidence : float, optional
        Level of the interval.

    Returns
    -------
    ndarray, shape (2, ...)
        Lower and upper ends.
    """
    return np.nanquantile(resamples, [(1 - confidence) / 2, (1 + confidence) / 2], axis=0)


def interval(
    values: Real, statistic: Callable[[Real], float | Real], confidence: float = 0.95, rng: int = 0
) -> Real:
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
    results = np.array([statistic(mean) for mean in resampled_means(values, rng)])
    return percentile_interval(results, confidence)
