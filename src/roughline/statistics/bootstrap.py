"""Studentised intervals from resampling the realisations of an ensemble.

Every resample has its own standard error. The interval follows from the distances of the resamples
from the ensemble, in units of these errors. Percentiles of the resamples would be too narrow: an
interval that contains 95 % of the resamples contains the true value in 87 to 92 of 100 ensembles of
10 or 20 realisations.

References
----------
Efron and Tibshirani, An Introduction to the Bootstrap, 1993, ch. 12 (the bootstrap-t interval).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from roughline.computing.arrays import Real
from roughline.statistics.student import student

_Statistic = Callable[[Real], tuple[Real, Real]]
"""Takes means, shape (..., loads); returns values, shape (...), and gradients, (..., loads)."""

ROUNDS = 1999  # number of resamples
_FEWEST_FREEDOM = 5.0  # with fewer degrees of freedom too many resamples are alike
_ERROR_ROUNDING = 1e-12  # relative: the realisations are all the same


@dataclass(frozen=True)
class IntervalEstimate:
    """A number with its interval, of 95 % unless said otherwise; NaN where there is none."""

    value: float
    low: float
    high: float

    def exp(self) -> IntervalEstimate:
        """Return the exponential of the number and of the ends of its interval."""
        return IntervalEstimate(*np.exp([self.value, self.low, self.high]).tolist())

    def __sub__(self, exact: float) -> IntervalEstimate:
        """Return the difference from a number that is known exactly."""
        return IntervalEstimate(self.value - exact, self.low - exact, self.high - exact)

    def over(self, exact: float) -> IntervalEstimate:
        """Return the ratio to a positive number that is known exactly."""
        return IntervalEstimate(self.value / exact, self.low / exact, self.high / exact)


NO_ESTIMATE = IntervalEstimate(math.nan, math.nan, math.nan)
"""The estimate of an ensemble that does not determine the number."""


@dataclass(frozen=True, eq=False)
class Resampled:
    """A statistic of an ensemble and of its resamples, each with its standard error."""

    value: Real  # of the ensemble, shape (...)
    error: Real
    values: Real  # of the resamples, shape (rounds, ...); NaN where one has none
    errors: Real
    freedom: Real
    """Degrees of freedom of the error: realisations less 1, or Welch's number for a difference."""

    def log(self) -> Resampled:
        """Return the logarithm of the statistic; differences of logarithms are ratios."""
        return Resampled(
            np.log(self.value),
            self.error / self.value,
            np.log(self.values),
            self.errors / self.values,
            self.freedom,
        )

    def exp(self) -> Resampled:
        """Return the exponential of the statistic."""
        value, values = np.exp(self.value), np.exp(self.values)
        return Resampled(value, self.error * value, values, self.errors * values, self.freedom)

    def __sub__(self, other: Resampled) -> Resampled:
        """Return the difference of two independent ensembles."""
        first, second = self.error**2, other.error**2
        share = first / np.where(first + second > 0, first + second, 1)
        return Resampled(
            self.value - other.value,
            np.sqrt(first + second),
            self.values - other.values,
            np.hypot(self.errors, other.errors),
            1 / (share**2 / self.freedom + (1 - share) ** 2 / other.freedom),
        )

    def interval_estimate(self, confidence: float = 0.95) -> IntervalEstimate:
        """Return a statistic that is a single number, with its interval."""
        return IntervalEstimate(float(self.value), *map(float, self.interval(confidence)))

    def interval(self, confidence: float = 0.95) -> Real:
        """Return the lower and upper ends of the interval, shape (2, ...).

        Student's t assumes a normal distribution. The resamples show how skew the distribution
        is, but resamples of few realisations show too little of the skewness. On each side, the
        farther of the two ends is taken. For fewer than six realisations Student's t alone is
        used.
        """
        known = np.isfinite(self.value) & np.isfinite(self.error)
        varied = known & (self.error > _ERROR_ROUNDING * np.abs(self.value))
        with np.errstate(divide="ignore", invalid="ignore"):
            steps = np.where(varied, (self.values - self.value) / self.errors, 0.0)
        tails = np.array([(1 + confidence) / 2, (1 - confidence) / 2])
        # each end is one of the resamples: between two of them, one may be infinite
        resampled = np.nanquantile(steps, tails, axis=0, method="nearest")
        t = np.array([student(self.freedom, tail) for tail in tails])
        farther = np.maximum(resampled[0], t[0]), np.minimum(resampled[1], t[1])
        quantiles = np.where(self.freedom < _FEWEST_FREEDOM, t, np.array(farther))
        width = np.where(varied, quantiles, 0.0) * self.error
        return np.where(known, self.value - width, np.nan)


def means(values: Real, rng: int = 0) -> Resampled:
    """Resample the mean over the first axis, realisations; what is not finite is left out.

    Two ensembles with the same number of realisations, resampled with the same seed, draw the
    same realisations.
    """
    count = values.shape[0]
    flat = values.reshape(count, -1)
    finite = np.isfinite(flat)
    weights = _weights(count, rng)
    counts = weights @ finite
    some = np.where(counts > 0, counts, np.nan)
    # deviations from the mean of the ensemble keep the squares from cancelling
    centre = np.where(finite, flat, 0.0).sum(axis=0) / some[0]
    deviations = np.where(finite, flat - centre, 0.0)
    shift = weights @ deviations / some
    variance = np.maximum(weights @ deviations**2 / some - shift**2, 0.0)
    freedom = np.where(counts[0] > 1, counts[0] - 1, np.nan)
    errors = np.sqrt(variance / freedom)
    shape = values.shape[1:]
    return Resampled(
        (centre + shift[0]).reshape(shape),
        errors[0].reshape(shape),
        (centre + shift[1:]).reshape(ROUNDS, *shape),
        errors[1:].reshape(ROUNDS, *shape),
        freedom.reshape(shape),
    )


def function_of_means(values: Real, statistic: _Statistic, rng: int = 0) -> Resampled:
    """Resample a smooth function of the means, with its linearised standard error.

    Values, shape (realisations, loads), are all finite. One realisation has no error.
    """
    count = values.shape[0]
    weights = _weights(count, rng)
    centre = values.mean(axis=0)
    deviations = values - centre
    shift = weights @ deviations / count
    results, gradient = statistic(centre + shift)
    # how far each realisation moves the statistic of each resample
    moves = gradient @ deviations.T
    moves -= (gradient * shift).sum(axis=1)[:, np.newaxis]
    np.square(moves, out=moves)  # in place, as these arrays are large
    freedom = count - 1 if count > 1 else np.nan
    errors = np.sqrt(np.einsum("ij,ij->i", weights, moves) / count / freedom)
    return Resampled(results[0], errors[0], results[1:], errors[1:], np.asarray(float(freedom)))


def sum_of_log_means(
    values: Real, weights: Real, geometric: bool = False, rng: int = 0
) -> Resampled:
    """Resample a weighted sum over loads of the logarithm of the mean, such as an exponent.

    Values, shape (realisations, loads), are positive; those at loads of weight zero are not used.
    """
    used = weights != 0
    factors = weights[used]
    if geometric:
        return function_of_means(
            np.log(values[:, used]),
            lambda means: (means @ factors, np.broadcast_to(factors, means.shape)),
            rng,
        )
    return function_of_means(
        values[:, used], lambda means: (np.log(means) @ factors, factors / means), rng
    )


@lru_cache(maxsize=4)
def _weights(count: int, rng: int) -> Real:
    """How often each realisation counts: in the ensemble (row 0) and in each resample."""
    draws = np.random.default_rng(rng).integers(count, size=(ROUNDS, count))
    weights = np.zeros((1 + ROUNDS, count))
    weights[0] = 1.0
    np.add.at(weights, (np.repeat(np.arange(1, 1 + ROUNDS), count), draws.ravel()), 1.0)
    weights.flags.writeable = False
    return weights
