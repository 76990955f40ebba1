"""Coarser selves of a topography: its heights on ever larger cells, and what is fine on them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Real
from roughline.topography.body import Body

_LEAST = 8  # cells along the shortest side of a coarser self
_MOST = 512  # cells along a side, from which correlations are taken
_FINE_REACH = 32  # cells over which detail is correlated at most


@dataclass(frozen=True, eq=False)
class Chance:
    """How far a Gaussian field with the correlation of given values scatters.

    Attributes
    ----------
    correlation : ndarray
        Over lags, from minus to plus their reach along each side. [1]
    pairs : ndarray
        Number of pairs of values at each lag, over that of values. [1]
    count : int
        Number of values.
    reach : int
        Largest lag. [1]
    """

    correlation: Real
    pairs: Real
    count: int
    reach: int

    @classmethod
    def of(cls, field: Real, reach: int) -> Chance:
        """Take the correlation of a field up to some lag along each side."""
        field = fine_part(field)
        field = field - field.mean()
        pairs = np.ones(())
        for n in field.shape:
            lags = np.abs(np.arange(-min(reach, n // 2), min(reach, n // 2) + 1))
            pairs = np.multiply.outer(pairs, (n - lags) / n)
        correlation = correlated(field, reach) / pairs
        middle = tuple(n // 2 for n in correlation.shape)
        scale = correlation[middle]
        return cls(correlation / scale if scale else correlation, pairs, field.size, reach)

    def independent(self, power: int) -> float:
        """Number of independent values with the same scatter of sums of that power."""
        # where the mean and the tilt are removed, distant values have a correlation below zero,
        # which says nothing of how many are independent
        total = float((self.pairs * np.abs(self.correlation) ** power).sum())
        if power == 2:  # squares of a correlation's own scatter add up
            total /= 1 + self.correlation.size / self.count
        return self.count / max(total, 1.0)


@dataclass(frozen=True, eq=False)
class CoarserSelf:
    """Heights on cells of some points, and their second differences.

    Attributes
    ----------
    cell : int
        Points along a cell.
    heights : ndarray, shape (nx, ny) or (n,)
        Means over the cells, less their mean. [length]
    """

    cell: int
    heights: Real

    @cached_property
    def detail(self) -> Real:
        """Second differences of the inner cells, summed over both sides. [length]"""
        h = self.heights
        inner = (slice(1, -1),) * h.ndim
        total = -2.0 * h.ndim * h[inner]
        for axis in range(h.ndim):
            for step in (slice(0, -2), slice(2, None)):
                total += h[(*inner[:axis], step, *inner[axis + 1 :])]
        return total

    @cached_property
    def of_detail(self) -> Chance:
        """Chance of its detail."""
        return Chance.of(self.detail, _FINE_REACH)

    @cached_property
    def of_heights(self) -> Chance:
        """Chance of its heights."""
        return Chance.of(self.heights, max(self.heights.shape))


def coarser_selves(body: Body) -> Iterator[CoarserSelf]:
    """Yield a body on its own points, then on cells of 2, 4, ... points along a side.

    A piece of a larger body is taken without its mean plane.
    """
    heights = (body.detrended() if body.is_cut_out else body).heights
    heights = heights - heights.mean()
    largest = float(np.abs(heights).max())
    if largest == 0:
        return
    heights /= largest
    cell = 1
    while min(heights.shape) >= _LEAST:
        yield CoarserSelf(cell, heights)
        cell *= 2
        for axis, n in enumerate(heights.shape):
            even = np.moveaxis(heights, axis, 0)[: n - n % 2]
            heights = np.moveaxis((even[::2] + even[1::2]) / 2, 0, axis)


def fine_part(field: Real) -> Real:
    """Return the part of a field from which correlations are taken: all but of large ones."""
    return field[tuple(slice(0, _MOST) for _ in field.shape)]


def correlated(values: Real, reach: int) -> Real:
    """Sums of products of values over lags up to a reach, or to half a side."""
    lags = [min(reach, n // 2) for n in values.shape]
    padded = [fft.good_size(n + lag) for n, lag in zip(values.shape, lags, strict=True)]
    wide = np.zeros(padded)
    wide[tuple(slice(0, n) for n in values.shape)] = values
    axes = range(values.ndim)
    sums = np.fft.irfftn(np.abs(np.fft.rfftn(wide)) ** 2, padded, axes)
    return np.asarray(sums[np.ix_(*(np.r_[-lag : lag + 1] for lag in lags))])


def skewness_score(skewness: float, n: float) -> float:
    """Standard score of a skewness of n independent Gaussian values (D'Agostino 1970)."""
    y = skewness * math.sqrt((n + 1) * (n + 3) / (6 * (n - 2)))
    beta = 3 * (n**2 + 27 * n - 70) * (n + 1) * (n + 3) / ((n - 2) * (n + 5) * (n + 7) * (n + 9))
    w2 = -1 + math.sqrt(2 * (beta - 1))
    delta, alpha = 1 / math.sqrt(0.5 * math.log(w2)), math.sqrt(2 / (w2 - 1))
    return delta * math.asinh(y / alpha)


def kurtosis_score(kurtosis: float, n: float) -> float:
    """Standard score of a kurtosis of n independent Gaussian values (Anscombe, Glynn 1983)."""
    mean = 3 * (n - 1) / (n + 1)
    variance = 24 * n * (n - 2) * (n - 3) / ((n + 1) ** 2 * (n + 3) * (n + 5))
    x = (kurtosis - mean) / math.sqrt(variance)
    beta = 6 * (n**2 - 5 * n + 2) / ((n + 7) * (n + 9))
    beta *= math.sqrt(6 * (n + 3) * (n + 5) / (n * (n - 2) * (n - 3)))
    a = 6 + 8 / beta * (2 / beta + math.sqrt(1 + 4 / beta**2))
    root = (1 - 2 / a) / abs(1 + x * math.sqrt(2 / (a - 4)))
    third = math.copysign(root ** (1 / 3), 1 + x * math.sqrt(2 / (a - 4)))
    return (1 - 2 / (9 * a) - third) / math.sqrt(2 / (9 * a))
