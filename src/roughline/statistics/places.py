"""A quantity measured at some places of a part: its mean over all places, from a few."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real

_ROUNDING = 1e-9  # relative scatter below which values are the same


@dataclass(frozen=True, eq=False)
class PlaceAverage:
    """Mean of a positive quantity over the places of a part, at each load.

    Attributes
    ----------
    mean : ndarray, shape (loads,)
        Geometric mean; NaN without a place, and where some values are zero or infinite and others
        are not.
    scatter : ndarray, shape (loads,)
        Geometric standard deviation, a factor of at least 1: two of three places lie between mean /
        scatter and mean * scatter. NaN for fewer than two places.
    low, high : ndarray, shape (loads,)
        Ends of the interval of the mean over all places. NaN for fewer than two places, and where
        all values are the same and nothing else is open.
    count : ndarray of int, shape (loads,)
        Places that have a value, neither zero nor infinite.
    """

    mean: Real
    scatter: Real
    low: Real
    high: Real
    count: Indices


def average_of_places(
    values: Real, low: Real, high: Real, confidence: float = 0.95
) -> PlaceAverage:
    """Average a positive quantity over a few places, chosen at random, of many.

    Such quantities scatter by factors, so logarithms are averaged. A resistance and its conductance
    therefore give the same result. The half width of the interval combines two parts as if they
    were independent: Student's t times the standard error of the logarithms; and, at either end,
    the median distance of the values' own ends, which may be a bias that all places share and does
    not average out.

    Parameters
    ----------
    values : ndarray, shape (places, loads)
        Not negative; NaN where there is no value.
    low, high : ndarray, shape (places, loads)
        Ends of each value's own interval; NaN where there is none, which counts as no width.
    confidence : float, optional
        Level of the interval.
    """
    from scipy.special import stdtrit  # here because it loads slowly

    known = np.isfinite(values) & (values > 0)
    count = np.count_nonzero(known, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = np.where(known, np.log(np.where(known, values, 1.0)), 0.0)
        extreme = ((values == 0) | np.isinf(values)).any(axis=0)
        centre = np.where((count > 0) & ~extreme, logs.sum(axis=0) / count, np.nan)
        squares = np.where(known, (logs - centre) ** 2, 0.0).sum(axis=0)
        deviation = np.where(count > 1, np.sqrt(squares / (count - 1)), np.nan)
        deviation = np.where(deviation < _ROUNDING, 0.0, deviation)
        student = stdtrit(np.maximum(count - 1, 1), (1 + confidence) / 2)
        of_places = student * deviation / np.sqrt(count)
        halves = [
            np.hypot(of_places, _median_distance(np.abs(np.log(values / ends)), known))
            for ends in (low, high)
        ]
        is_open = np.fmax(*halves) > 0
        ends = [
            np.where(is_open, np.exp(centre + sign * half), np.nan)
            for sign, half in zip((-1, 1), halves, strict=True)
        ]
    alike = (values == values[:1]).all(axis=0) & extreme
    mean = np.where(alike, values[0], np.exp(centre))
    return PlaceAverage(mean, np.exp(deviation), ends[0], ends[1], count)


def _median_distance(distances: Real, known: Mask) -> Real:
    """Median over the places that have a value; a place without ends counts as distance zero."""
    distances = np.where(np.isnan(distances), 0.0, distances)
    none = ~known.any(axis=0)
    return np.nanmedian(np.where(known | none, distances, np.nan), axis=0)
