"""Averages of an ensemble at fixed force or fixed level, with intervals over realisations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Indices, Real
from roughline.computing.summary import summary
from roughline.errors import InputError
from roughline.errors.checks import allowed_choice, refuse, refuse_other_seeds
from roughline.errors.public import public
from roughline.statistics import bootstrap

Averaging = Literal["arithmetic", "geometric"]


@dataclass(frozen=True, eq=False)
class Average:
    """Mean of a quantity over realisations, at each load.

    Attributes
    ----------
    mean : ndarray, shape (loads,)
        Arithmetic or geometric mean.
    low, high : ndarray, shape (loads,)
        Ends of its studentised interval, from resampled realisations.
    scatter : ndarray, shape (loads,)
        Standard deviation of the realisations; of the logarithm if the mean is geometric.
    standard_error : ndarray, shape (loads,)
        Scatter over the square root of the count.
    count : ndarray of int, shape (loads,)
        Number of realisations averaged; values that are not finite are left out.
    averaging : {"arithmetic", "geometric"}
        Which mean.
    confidence : float
        Level of the interval.
    """

    mean: Real
    low: Real
    high: Real
    scatter: Real
    standard_error: Real
    count: Indices
    averaging: Averaging
    confidence: float

    __repr__ = summary


@public
def average(
    values: ArrayLike,
    averaging: Averaging = "arithmetic",
    confidence: float = 0.95,
    rng: int = 0,
) -> Average:
    """Average a quantity over realisations, at each load.

    Parameters
    ----------
    values : array_like, shape (realisations, loads)
        Stiffness, area or any other quantity at fixed loads; NaN where a load did not converge.
    averaging : {"arithmetic", "geometric"}, optional
        Which mean.
    confidence : float, optional
        Level of the interval.
    rng : int, optional
        Seed of the resampling.

    Raises
    ------
    InputError
        If the shape is another, or the mean is geometric and a value is not positive.

    Examples
    --------
    >>> import roughline as rl
    >>> stiffness = [[1.0, 2.0], [1.2, 2.3], [0.9, 2.1], [1.1, 1.9]]  # four bodies, two loads
    >>> mean = rl.average(stiffness)
    >>> print(mean.mean.round(3), mean.low.round(2), mean.high.round(2))
    [1.05  2.075] [0.84 1.8 ] [1.26 2.35]
    """
    table = _checked_table(values, averaging, confidence, rng)
    averaged = np.log(table) if averaging == "geometric" else table
    count = np.count_nonzero(np.isfinite(table), axis=0)
    resampled = bootstrap.means(averaged, rng)
    ends = np.array([resampled.value, *resampled.interval(confidence)])
    mean, low, high = np.exp(ends) if averaging == "geometric" else ends
    scatter = resampled.error * np.sqrt(count)
    return Average(mean, low, high, scatter, resampled.error, count, averaging, confidence)


@public
def relative_difference(
    values: ArrayLike,
    reference: ArrayLike,
    *,
    paired: bool,
    confidence: float = 0.95,
    rng: int = 0,
) -> tuple[Real, Real, Real]:
    """Relative difference of two ensemble means, ``mean(values) / mean(reference) - 1``.

    Parameters
    ----------
    values, reference : array_like, shape (realisations, loads)
        The two ensembles at the same loads; positive, or NaN where a load did not converge.
    paired : bool
        Whether realisation i of one belongs to realisation i of the other (same seed, same
        phases). Pairs are resampled together, and a pair is left out where one value is not
        finite.
    confidence : float, optional
        Level of the interval.
    rng : int, optional
        Seed of the resampling.

    Returns
    -------
    difference, low, high : ndarray, shape (loads,)
        The difference and the ends of its interval; NaN where no pair is left. [1]

    Raises
    ------
    InputError
        If the shapes do not fit, or a value is not positive.
    """
    first = _checked_table(values, "arithmetic", confidence, rng)
    second = _checked_table(reference, "arithmetic", confidence, rng)
    if first.shape[1] != second.shape[1] or (paired and first.shape != second.shape):
        raise InputError(
            f"values have shape {first.shape}, the reference {second.shape}; the same loads are "
            "needed, and for pairs the same realisations"
        )
    if (first <= 0).any() or (second <= 0).any():
        raise InputError("a relative difference needs positive values; some are zero or negative")
    if paired:
        pairs = zip(first.T, second.T, strict=True)
        ends = [_log_ratio_of_pairs(*pair, confidence, rng) for pair in pairs]
        difference, low, high = np.expm1(np.reshape(ends, (-1, 3)).T)
    else:
        # two seeds, because the two ensembles are independent
        log_ratio = bootstrap.means(first, rng).log() - bootstrap.means(second, rng + 1).log()
        difference = np.expm1(log_ratio.value)
        low, high = np.expm1(log_ratio.interval(confidence))
    return difference, low, high


def _log_ratio_of_pairs(
    values: Real, reference: Real, confidence: float, rng: int
) -> tuple[float, float, float]:
    """Logarithm of the ratio of two means over the realisations where both are finite, and ends."""
    both = np.isfinite(values) & np.isfinite(reference)
    if not both.any():
        return np.nan, np.nan, np.nan
    pairs = np.column_stack([values[both], reference[both]])
    ratio = bootstrap.sum_of_log_means(pairs, np.array([1.0, -1.0]), rng=rng)
    low, high = ratio.interval(confidence)
    return float(ratio.value), float(low), float(high)


def refuse_other_settings(averaging: str, confidence: float, rng: int = 0) -> None:
    """Refuse an average, a level of confidence or a seed that there is not.

    Raises
    ------
    InputError
        With what is allowed.
    """
    allowed_choice("averaging", averaging, get_args(Averaging))
    if not 0 < confidence < 1:
        refuse("confidence", confidence, "a level between 0 and 1 is needed")
    refuse_other_seeds(rng)


def _checked_table(values: ArrayLike, averaging: str, confidence: float, rng: int) -> Real:
    table = np.asarray(values, dtype=np.float64)
    if table.ndim != 2 or not table.size:
        raise InputError(f"values have shape {table.shape}; (realisations, loads) is needed")
    refuse_other_settings(averaging, confidence, rng)
    if averaging == "geometric" and (table <= 0).any():
        raise InputError("a geometric mean needs positive values; some are zero or negative")
    return table
