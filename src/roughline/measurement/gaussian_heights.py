"""Whether heights are Gaussian on every scale, and slopes of the highest places those of all."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from roughline.computing.arrays import Real
from roughline.facts.fact import Fact
from roughline.measurement.chance import Chance, Finding, score_of_square
from roughline.measurement.coarser_selves import CoarserSelf
from roughline.topography.body import Body, point_spacings
from roughline.units import in_words

_FEWEST_VALUES = 8  # independent values, from which a skewness or a kurtosis says something
_LARGEST_SKEWNESS = 0.45  # of heights or curvatures; more matters
_LARGEST_EXCESS = (1.0, 2.5)  # of the kurtosis over 3, of heights and of curvatures
_LARGEST_LACK = 0.6  # of the kurtosis under 3
_HIGHEST_SHARES = (0.02, 0.05, 0.1, 0.2)  # shares of the highest places whose slopes are judged
_LARGEST_SLOPE_RATIO = 0.3  # logarithm of the ratio of their rms slope to that of all that matters
_SCORE_SHARE = 0.88  # of a score: squares that correlate have heavier tails than those that do not
_FEWEST_CELLS = 16  # along a side, for their slopes
_FEWEST_SLOPES = 24  # independent slopes of the highest places
_SLOPE_REACH = 32  # cells over which slopes are correlated at most


def shapes_on_every_scale(body: Body, selves: Sequence[CoarserSelf]) -> Iterable[Finding]:
    """Yield shapes of the distributions of heights and of detail on every scale."""
    for own in selves:
        yield from _shape(
            own.heights, own.heights_chance, _named(body, own, "heights"), _LARGEST_EXCESS[0]
        )
        yield from _shape(
            own.detail, own.detail_chance, _named(body, own, "curvatures"), _LARGEST_EXCESS[1]
        )
        yield from _slopes_of_the_highest(body, own)


def _named(body: Body, own: CoarserSelf, what: str) -> str:
    """Name heights or curvatures by the size of their cells."""
    return f"the {what}" if own.cell == 1 else f"the {what} of{_cells(body, own)}"


def _cells(body: Body, own: CoarserSelf) -> str:
    """Name cells by their size."""
    size = own.cell * max(point_spacings(body))
    return " points" if own.cell == 1 else f" cells of {in_words(size, body.unit, 2)}"


def _shape(values: Real, chance: Chance, name: str, excess: float) -> Iterable[Finding]:
    """Skewness and kurtosis of values."""
    third, fourth = chance.independent(3), chance.independent(4)
    if min(third, fourth) < _FEWEST_VALUES or not values.any():
        return
    skewness, kurtosis = skewness_and_kurtosis(values)

    def skew(limit: float) -> Fact:
        chance = limit * math.sqrt(6 / third)
        return Fact("skewed", of=name, skewness=skewness, chance=chance)

    def tails(limit: float) -> Fact:
        chance = limit * math.sqrt(24 / fourth)
        return Fact("long_tailed", of=name, kurtosis=kurtosis, chance=chance)

    yield Finding(_skewness_score(skewness, third), abs(skewness) / _LARGEST_SKEWNESS, skew)
    gravity = (kurtosis - 3) / (excess if kurtosis > 3 else -_LARGEST_LACK)
    yield Finding(_kurtosis_score(kurtosis, fourth), gravity, tails)


def skewness_and_kurtosis(values: Real) -> tuple[float, float]:
    """Skewness and kurtosis; their rounding does not depend on the scale of the values."""
    deviation = values - values.mean()
    largest = float(np.abs(deviation).max())
    if largest == 0 or float(np.ptp(values)) == 0:
        return math.nan, math.nan
    deviation /= largest
    variance = float((deviation**2).mean())
    return (
        float((deviation**3).mean()) / variance**1.5,
        float((deviation**4).mean()) / variance**2,
    )


def _skewness_score(skewness: float, n: float) -> float:
    """Standard score of a skewness of n Gaussian values (D'Agostino 1970)."""
    y = skewness * math.sqrt((n + 1) * (n + 3) / (6 * (n - 2)))
    beta = 3 * (n**2 + 27 * n - 70) * (n + 1) * (n + 3) / ((n - 2) * (n + 5) * (n + 7) * (n + 9))
    w2 = -1 + math.sqrt(2 * (beta - 1))
    delta, alpha = 1 / math.sqrt(0.5 * math.log(w2)), math.sqrt(2 / (w2 - 1))
    return delta * math.asinh(y / alpha)


def _kurtosis_score(kurtosis: float, n: float) -> float:
    """Standard score of a kurtosis of n Gaussian values (Anscombe, Glynn 1983)."""
    mean = 3 * (n - 1) / (n + 1)
    variance = 24 * n * (n - 2) * (n - 3) / ((n + 1) ** 2 * (n + 3) * (n + 5))
    x = (kurtosis - mean) / math.sqrt(variance)
    beta = 6 * (n**2 - 5 * n + 2) / ((n + 7) * (n + 9))
    beta *= math.sqrt(6 * (n + 3) * (n + 5) / (n * (n - 2) * (n - 3)))
    a = 6 + 8 / beta * (2 / beta + math.sqrt(1 + 4 / beta**2))
    root = (1 - 2 / a) / abs(1 + x * math.sqrt(2 / (a - 4)))
    third = math.copysign(root ** (1 / 3), 1 + x * math.sqrt(2 / (a - 4)))
    return (1 - 2 / (9 * a) - third) / math.sqrt(2 / (9 * a))


def _slopes_of_the_highest(body: Body, own: CoarserSelf) -> Iterable[Finding]:
    """Whether slopes of the highest places are those of all, as on a Gaussian surface.

    The mean of the corners of a square of cells and the slopes across it do not correlate.
    """
    means, slopes = _mean_and_slopes(own.heights)
    squares = np.sum([each**2 for each in slopes], axis=0)
    mean = float(squares.mean())
    if min(squares.shape) < _FEWEST_CELLS or not mean:
        return
    chances = [Chance.of(each, _SLOPE_REACH) for each in slopes]
    for share in _HIGHEST_SHARES:
        highest = means > np.quantile(means, 1 - share)
        count = int(highest.sum())
        if not count:
            continue
        variance = sum(
            (float((each**2).mean()) / mean) ** 2 * chance.scatter_within(highest)
            for each, chance in zip(slopes, chances, strict=True)
        )
        if variance > 2 / _FEWEST_SLOPES:
            continue
        ratio = float(squares[highest].mean()) / mean
        yield _as_of_all(f"the highest {share:.0%} of{_cells(body, own)}", ratio, variance)


def _mean_and_slopes(heights: Real) -> tuple[Real, list[Real]]:
    """Means over neighbours along all sides, and differences along each."""
    if heights.ndim == 1:
        return (heights[1:] + heights[:-1]) / 2, [heights[1:] - heights[:-1]]
    along, across = heights[1:] + heights[:-1], heights[1:] - heights[:-1]
    slopes = [(across[:, 1:] + across[:, :-1]) / 2, (along[:, 1:] - along[:, :-1]) / 2]
    return (along[:, 1:] + along[:, :-1]) / 4, slopes


def _as_of_all(places: str, ratio: float, variance: float) -> Finding:
    """Judge the mean square slope of the highest places over that of all."""
    from scipy import special  # here because it loads slowly

    shape = 2 / variance  # of a chi-squared variable with as many degrees of freedom
    score = _SCORE_SHARE * score_of_square(shape, ratio)

    def fact(limit: float) -> Fact:
        chance = special.ndtr(-limit / _SCORE_SHARE)
        least, most = (
            math.sqrt(special.chdtri(shape, each) / shape) for each in (1 - chance, chance)
        )
        ends = {"least": least, "most": most}
        return Fact("slopes_differ_by_height", places=places, ratio=math.sqrt(ratio), **ends)

    return Finding(score, abs(math.log(max(ratio, 1e-9))) / 2 / _LARGEST_SLOPE_RATIO, fact)
