"""A quantity measured at some places of a part: its mean over all places, from a few."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.statistics.student import student

_SCATTER_ROUNDING = 1e-9  # relative scatter below which values are the same
_AGREEMENT_CHANCE = 0.99  # of places that are alike


@dataclass(frozen=True, eq=False)
class _PlaceAverage:
    """Mean of a positive quantity over the places of a part, at each load."""

    mean: Real
    """Geometric mean; NaN without a place, and where some values alone are zero or infinite."""

    scatter: Real
    """Geometric standard deviation, a factor of at least 1; NaN for fewer than two places.

    Two of three places lie between mean / scatter and mean * scatter.
    """

    low: Real
    high: Real
    """Ends of the interval of the mean over all places.

    NaN for fewer than two places, and where all values are the same and nothing else is open.
    """

    count: Indices  # places that have a value, neither zero nor infinite


def average_of_places(
    values: Real,
    low: Real,
    high: Real,
    at_bounds: tuple[Real, Real] | None = None,
    confidence: float = 0.95,
) -> _PlaceAverage:
    """Average a positive quantity over a few places, chosen at random, of many.

    Such quantities scatter by factors, so logarithms are averaged. A resistance and its conductance
    therefore give the same result. The half width of the interval combines two parts as if they
    were independent: Student's t times the standard error of the logarithms; and, at either end,
    the median distance of the values' own ends, which may be a bias that all places share and does
    not average out. A whole of which the places are parts may differ from their mean, by an amount
    whose bounds are known alone; they are added.

    Values, shape (places, loads), are not negative, and NaN where there is none. Their own ends
    count as no width where they are NaN. `at_bounds` holds what they would become at both, if
    the whole differed from the mean as much; NaN counts as no difference.
    """
    at_bounds = at_bounds or (values, values)
    known = np.isfinite(values) & (values > 0)
    count = np.count_nonzero(known, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = np.where(known, np.log(np.where(known, values, 1.0)), 0.0)
        extreme = ((values == 0) | np.isinf(values)).any(axis=0)
        centre = np.where((count > 0) & ~extreme, logs.sum(axis=0) / count, np.nan)
        squares = np.where(known, (logs - centre) ** 2, 0.0).sum(axis=0)
        deviation = np.where(count > 1, np.sqrt(squares / (count - 1)), np.nan)
        deviation = np.where(deviation < _SCATTER_ROUNDING, 0.0, deviation)
        t = student(np.maximum(count - 1, 1), (1 + confidence) / 2)
        mean_error = t * deviation / np.sqrt(count)
        halves = [
            np.hypot(mean_error, _median_distance(np.abs(np.log(values / ends)), known))
            + _median_distance(np.abs(np.log(values / bounds)), known)
            for ends, bounds in zip((low, high), at_bounds, strict=True)
        ]
        is_open = np.fmax(*halves) > 0
        ends = [
            np.where(is_open, np.exp(centre + sign * half), np.nan)
            for sign, half in zip((-1, 1), halves, strict=True)
        ]
    all_equal = (values == values[:1]).all(axis=0) & extreme
    mean = np.where(all_equal, values[0], np.exp(centre))
    return _PlaceAverage(mean, np.exp(deviation), ends[0], ends[1], count)


def _median_distance(distances: Real, known: Mask) -> Real:
    """Median over the places that have a value; a place without ends counts as distance zero."""
    distances = np.where(np.isnan(distances), 0.0, distances)
    none = ~known.any(axis=0)
    return np.nanmedian(np.where(known | none, distances, np.nan), axis=0)


@dataclass(frozen=True)
class Agreement:
    """Whether places differ by more than parts of one place do."""

    between: float  # standard deviation of the means of places
    within: float  # that which independent parts of a place explain
    ratio: float  # variance between places over that which their parts explain
    chance: float  # ratio that it does not exceed in 99 of 100 cases if all places are alike

    @property
    def place_share(self) -> float:
        """Share of the variance between places that is not explained by their parts."""
        return max(0.0, 1 - 1 / self.ratio) if self.ratio > 0 else 0.0

    @property
    def holds(self) -> bool:
        """Whether chance explains what differs between places."""
        return self.ratio <= self.chance


def agreement(values: Real) -> Agreement | None:
    """Compare the scatter between places with that of the parts of each: an analysis of variance.

    Parts that are independent of each other scatter about the mean of their place as the means of
    places do about that of all, times the root of their number. What differs between places beyond
    that belongs to the places. Values, shape (places, parts), are on a scale on which they scatter
    evenly, such as logarithms. None for fewer than two places or parts, and where parts do not
    differ.
    """
    from scipy.special import fdtri  # here because it loads slowly

    places, parts = values.shape
    if min(places, parts) < 2:
        return None
    between = float(values.mean(axis=1).var(ddof=1))
    within = float(values.var(axis=1, ddof=1).mean()) / parts
    if not within > 0:
        return None
    chance = float(fdtri(places - 1, places * (parts - 1), _AGREEMENT_CHANCE))
    return Agreement(between**0.5, within**0.5, between / within, chance)
