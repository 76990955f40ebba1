"""What chance allows: how moments of Gaussian fields scatter, and scores of what is found."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Mask, Real
from roughline.facts.fact import Fact

MOST_CELLS = 512  # cells along a side of a map, from which correlations are taken


@dataclass(frozen=True)
class Finding:
    """Result of one test of an assumption."""

    score: float  # of a standard normal distribution, if the assumption holds
    gravity: float  # what was measured over what would not matter
    fact: Callable[[float], Fact]  # with what chance allows, for the score that it allows


@dataclass(frozen=True, eq=False)
class Chance:
    """How far a Gaussian field with the correlation of given values scatters."""

    correlation: Real  # over lags, from minus to plus their reach along each side
    pairs: Real  # number of pairs of values at each lag, over that of values
    count: int  # of values
    own_scatter: float  # of the sum of its squares, as it is taken from so many values
    reach: int  # largest lag

    @classmethod
    def of(cls, field: Real, reach: int) -> Chance:
        """Take the correlation of a field up to some lag along each side."""
        count, part = field.size, _fine_part(field)
        field = part - part.mean()
        pairs = np.ones(())
        for n in field.shape:
            lags = np.abs(np.arange(-min(reach, n // 2), min(reach, n // 2) + 1))
            pairs = np.multiply.outer(pairs, (n - lags) / n)
        correlation = _correlated(field, reach) / pairs
        middle = tuple(n // 2 for n in correlation.shape)
        scale = correlation[middle]
        correlation = correlation / scale if scale else correlation
        return cls(correlation, pairs, count, 1 + correlation.size / field.size, reach)

    def independent(self, power: int) -> float:
        """Number of independent values with the same scatter of sums of that power."""
        # where the mean and the tilt are removed, distant values have a correlation below zero,
        # which says nothing of how many are independent
        total = float((self.pairs * np.abs(self.correlation) ** power).sum())
        if power == 2:  # squares of a correlation's own scatter add up
            total /= self.own_scatter
        return self.count / max(total, 1.0)

    def scatter_within(self, places: Mask) -> float:
        """Relative variance of the mean square of such a field over some places."""
        part = _fine_part(places.astype(np.float64))
        if not part.any():
            return math.inf
        total = float((_correlated(part, self.reach) * self.correlation**2).sum())
        total /= self.own_scatter
        return 2 * max(total / float(part.sum()), 1.0) / float(places.sum())


def score_of_square(freedom: float, ratio: float) -> float:
    """Return the standard score of a chi-squared variable over its mean.

    It is infinite where the chance is smaller than the smallest number.
    """
    from scipy import special  # here because it loads slowly

    over = float(special.chdtrc(freedom, freedom * ratio))
    if over < 0.5:
        return -float(special.ndtri(over))
    return float(special.ndtri(special.chdtr(freedom, freedom * ratio)))


def _fine_part(field: Real) -> Real:
    """Return the part of a field from which correlations are taken: all but of large maps."""
    if field.ndim == 1:
        return field
    return field[tuple(slice(0, MOST_CELLS) for _ in field.shape)]


def _correlated(values: Real, reach: int) -> Real:
    """Return sums of products of values over lags up to a reach, or to half a side."""
    lags = [min(reach, n // 2) for n in values.shape]
    padded = [fft.good_size(n + lag) for n, lag in zip(values.shape, lags, strict=True)]
    wide = np.zeros(padded)
    wide[tuple(slice(0, n) for n in values.shape)] = values
    axes = range(values.ndim)
    sums = np.fft.irfftn(np.abs(np.fft.rfftn(wide)) ** 2, padded, axes)
    return np.asarray(sums[np.ix_(*(np.r_[-lag : lag + 1] for lag in lags))])
