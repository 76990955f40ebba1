"""Departures of a topography from what predictions rest on, each with what chance would allow."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Literal
from weakref import WeakKeyDictionary

import numpy as np
from scipy import special

from roughline.computing.arrays import Mask, Real
from roughline.errors import InputError
from roughline.spectra.coarser_selves import (
    Chance,
    CoarserSelf,
    coarser_selves,
    correlated,
    fine_part,
    kurtosis_score,
    skewness_score,
)
from roughline.spectra.fit import SelfAffineFit, fit_self_affine
from roughline.spectra.isotropic import isotropic_spectrum
from roughline.spectra.longer_waves import LongShape, long_shapes, tilt_of
from roughline.spectra.profile import profile_spectrum
from roughline.topography.body import Body, Line, Surface
from roughline.topography.settings import MOUNTING, TILT
from roughline.units import decimal, engineering

Assumption = Literal[
    "gaussian", "isotropic", "stationary", "roll-off", "longer waves", "resolution"
]
"""What predictions from a topography rest on."""

_CHANCE = 0.002  # of a departure from an assumption that a topography fulfils, over all its tests
_CHANCE_OF_WAVES = 0.01  # of tilt and bow: what few coefficients show is easily missed
_LEAST_VALUES = 8  # independent values, from which a skewness or a kurtosis says something
_SKEW = 0.45  # skewness that matters
_EXCESS = (1.0, 2.5)  # kurtosis over 3 that matters, of heights and of curvatures
_LACK = 0.6  # kurtosis under 3 that matters
_HIGHEST = (0.02, 0.05, 0.1, 0.2)  # shares of the highest places whose slopes are judged
_AS_OF_ALL = 0.3  # logarithm of the ratio of their rms slope to that of all that matters
_HEAVY = 0.88  # of a score: squares that correlate have heavier tails than those that do not
_LEAST_CELLS = 16  # along a side, for their slopes
_LEAST_SLOPES = 24  # independent slopes of the highest places
_SLOPE_REACH = 32  # cells over which slopes are correlated at most
_ALIKE = 0.7  # least over largest slope, from which on a surface counts as isotropic
_VARIES = 0.1  # relative scatter of rms slopes between places that matters
_TILES = (2, 4, 8)  # along a side, whose slopes are compared
_LEAST_OF_TILE = 10  # independent squares of slopes in a tile
_LONGER = 0.02  # mean square of longer waves, over that of the rest, that matters
_NO_ROLL_OFF = 2.0  # gravity of a roll-off that is not seen
_LEVELLED = 1.01  # gravity of a tilt that is not known
_CORRELATED = 3.78  # modes that vary together under a Hann window


@dataclass(frozen=True)
class Departure:
    """A departure from what predictions rest on.

    Attributes
    ----------
    assumption : str
        What does not hold.
    text : str
        A sentence that says so with the number measured, what chance would allow, and what to do.
    gravity : float
        The number measured over that which would not matter; above 1.
    """

    assumption: Assumption
    text: str
    gravity: float


@dataclass(frozen=True)
class _Finding:
    """Result of one test."""

    score: float  # of a standard normal distribution
    gravity: float
    text: Callable[[float], str]  # of the score that chance allows


def departures(body: Body) -> tuple[Departure, ...]:
    """Return how a topography departs from what predictions rest on, gravest first.

    Parameters
    ----------
    body : Surface or Line
        Prepared. [length] A reduced line is no topography, and departs from nothing.
    """
    if body not in _KNOWN:
        _KNOWN[body] = _departures(body)
    return _KNOWN[body]


_KNOWN: WeakKeyDictionary[Body, tuple[Departure, ...]] = WeakKeyDictionary()


def _departures(body: Body) -> tuple[Departure, ...]:
    if isinstance(body, Line) and body.kind == "reduced":
        return ()
    selves = list(coarser_selves(body))
    found = [
        _first("gaussian", _of_heights(body, selves)),
        _first("stationary", _of_places(selves)),
    ]
    if isinstance(body, Surface):
        found.append(_first("isotropic", _of_directions(body)))
    if body.is_cut_out and selves:
        found += _of_long_waves(body)
    return tuple(sorted(filter(None, found), key=lambda each: -each.gravity))


def _first(assumption: Assumption, findings: Iterable[_Finding]) -> Departure | None:
    """The gravest of findings that chance does not explain; None if there is none."""
    findings = list(findings)
    if not findings:
        return None
    limit = -float(special.ndtri(_CHANCE / len(findings) / 2))
    grave = [each for each in findings if abs(each.score) > limit and each.gravity > 1]
    if not grave:
        return None
    worst = max(grave, key=lambda each: each.gravity)
    return Departure(assumption, worst.text(limit), worst.gravity)


# Gaussian heights


def _of_heights(body: Body, selves: Sequence[CoarserSelf]) -> Iterable[_Finding]:
    """Shapes of the distributions of heights and of detail on every scale."""
    for own in selves:
        yield from _shape(own.heights, own.of_heights, _named(body, own, "heights"), _EXCESS[0])
        yield from _shape(own.detail, own.of_detail, _named(body, own, "curvatures"), _EXCESS[1])
        yield from _slopes_of_the_highest(body, own)


def _named(body: Body, own: CoarserSelf, what: str) -> str:
    """Name heights or curvatures by the size of their cells."""
    if own.cell == 1:
        return f"the {what}"
    return f"the {what} of{_cells(body, own)}"


def _cells(body: Body, own: CoarserSelf) -> str:
    """Name cells by their size."""
    if own.cell == 1:
        return " points"
    return f" cells of {engineering(own.cell * _spacing(body), body.unit or '', 2).strip()}"


def _spacing(body: Body) -> float:
    return max(body.spacing) if isinstance(body, Surface) else body.spacing


def _shape(values: Real, chance: Chance, name: str, excess: float) -> Iterable[_Finding]:
    """Skewness and kurtosis of values."""
    third, fourth = chance.independent(3), chance.independent(4)
    if min(third, fourth) < _LEAST_VALUES or not values.any():
        return
    values = values - values.mean()
    values /= values.std()
    skewness, kurtosis = float((values**3).mean()), float((values**4).mean())

    def skewed(limit: float) -> str:
        return (
            f"heights are not Gaussian: the skewness of {name} is {decimal(skewness, 2)}, and "
            f"chance allows {decimal(limit * math.sqrt(6 / third), 2)}"
        )

    def tailed(limit: float) -> str:
        return (
            f"heights are not Gaussian: the kurtosis of {name} is {decimal(kurtosis, 2)}, and "
            f"chance allows 3 with {decimal(limit * math.sqrt(24 / fourth), 2)} more or less"
        )

    yield _Finding(skewness_score(skewness, third), abs(skewness) / _SKEW, skewed)
    gravity = (kurtosis - 3) / (excess if kurtosis > 3 else -_LACK)
    yield _Finding(kurtosis_score(kurtosis, fourth), gravity, tailed)


def _slopes_of_the_highest(body: Body, own: CoarserSelf) -> Iterable[_Finding]:
    """Whether slopes of the highest places are those of all, as on a Gaussian surface.

    The mean of the corners of a square of cells and the slopes across it do not correlate.
    """
    means, slopes = _mean_and_slopes(own.heights)
    squares = np.sum([each**2 for each in slopes], axis=0)
    mean = float(squares.mean())
    if min(squares.shape) < _LEAST_CELLS or not mean:
        return
    chances = [Chance.of(each, _SLOPE_REACH) for each in slopes]
    for share in _HIGHEST:
        highest = means > np.quantile(means, 1 - share)
        count = int(highest.sum())
        if not count:
            continue
        variance = sum(
            (float((each**2).mean()) / mean) ** 2 * _scatter_within(highest, chance)
            for each, chance in zip(slopes, chances, strict=True)
        )
        if variance > 2 / _LEAST_SLOPES:
            continue
        ratio = float(squares[highest].mean()) / mean
        yield _as_of_all(body, own, share, ratio, variance)


def _mean_and_slopes(heights: Real) -> tuple[Real, list[Real]]:
    """Means over neighbours along all sides, and differences along each."""
    if heights.ndim == 1:
        return (heights[1:] + heights[:-1]) / 2, [heights[1:] - heights[:-1]]
    along, across = heights[1:] + heights[:-1], heights[1:] - heights[:-1]
    slopes = [(across[:, 1:] + across[:, :-1]) / 2, (along[:, 1:] - along[:, :-1]) / 2]
    return (along[:, 1:] + along[:, :-1]) / 4, slopes


def _scatter_within(places: Mask, chance: Chance) -> float:
    """Relative variance of the mean square of a Gaussian field over some places."""
    part = fine_part(places.astype(np.float64))
    if not part.any():
        return math.inf
    total = float((correlated(part, chance.reach) * chance.correlation**2).sum())
    total /= 1 + chance.correlation.size / chance.count  # the correlation's own scatter adds up
    return 2 * max(total / float(part.sum()), 1.0) / float(places.sum())


def _as_of_all(
    body: Body, own: CoarserSelf, share: float, ratio: float, variance: float
) -> _Finding:
    """Judge the mean square slope of the highest places over that of all."""
    shape = 2 / variance  # of a chi-squared variable with as many degrees of freedom
    score = _HEAVY * _score_of_square(shape, ratio)

    def text(limit: float) -> str:
        chance = special.ndtr(-limit / _HEAVY)
        least, most = (
            math.sqrt(special.chdtri(shape, each) / shape) for each in (1 - chance, chance)
        )
        return (
            f"heights are not Gaussian: the rms slope of the highest {share:.0%} of"
            f"{_cells(body, own)} is {decimal(math.sqrt(ratio), 2)} of that of all, and chance "
            f"allows {decimal(least, 2)} to {decimal(most, 2)}"
        )

    return _Finding(score, abs(math.log(max(ratio, 1e-9))) / 2 / _AS_OF_ALL, text)


def _score_of_square(freedom: float, ratio: float) -> float:
    """Standard score of a chi-squared variable over its mean."""
    over = float(special.chdtrc(freedom, freedom * ratio))
    if over < 0.5:
        return -float(special.ndtri(max(over, 1e-300)))
    return float(special.ndtri(max(float(special.chdtr(freedom, freedom * ratio)), 1e-300)))


def _means(values: Real, cells: int) -> Real:
    """Means over groups of so many cells along each side."""
    for axis, n in enumerate(values.shape):
        whole = np.moveaxis(values, axis, 0)[: n - n % cells]
        groups = whole.reshape(n // cells, cells, *whole.shape[1:]).mean(axis=1)
        values = np.moveaxis(groups, 0, axis)
    return values


# Alike everywhere


def _of_places(selves: Sequence[CoarserSelf]) -> Iterable[_Finding]:
    """Scatter of rms slopes between parts of the body, on every scale."""
    for own in selves:
        squares = own.detail**2
        independent = own.of_detail.independent(2)
        for tiles in _TILES:
            cells = min(squares.shape) // tiles
            if not cells:
                continue
            means = _means(squares, cells)
            shape = independent * cells**squares.ndim / squares.size / 2
            if shape < _LEAST_OF_TILE / 2 or means.min() <= 0:
                continue
            yield _scatter(np.log(means), shape, tiles)


def _scatter(logs: Real, shape: float, tiles: int) -> _Finding:
    """Compare the scatter of logarithms of mean squares with that of gamma variates."""
    expected = float(special.polygamma(1, shape))
    variance, freedom = float(logs.var(ddof=1)), logs.size - 1
    score = _score_of_square(freedom, variance / expected)
    varies = math.sqrt(max(0.0, variance - expected)) / 2
    spread = math.exp(float(np.ptp(logs)) / 2)

    def text(limit: float) -> str:
        return (
            f"roughness is not alike everywhere: between {logs.size} parts the rms slope scatters "
            f"by {math.sqrt(variance) / 2:.0%}, up to a factor of {decimal(spread, 2)}, and chance "
            f"explains {math.sqrt(expected) / 2:.0%}"
        )

    return _Finding(score, varies / _VARIES, text)


# Alike in all directions


def _of_directions(surface: Surface) -> Iterable[_Finding]:
    """Slopes by direction, in every octave of waves."""
    if min(surface.shape) < 16:
        return
    level = surface.detrended() if surface.is_cut_out else surface
    heights = level.heights - level.heights.mean()
    if not heights.any():
        return
    heights /= np.abs(heights).max()
    if surface.is_cut_out:
        heights *= np.outer(*(np.hanning(n + 1)[:-1] for n in surface.shape))
    power = np.abs(np.fft.rfft2(heights)) ** 2
    (nx, ny), (dx, dy) = surface.shape, surface.spacing
    qx, qy = np.fft.fftfreq(nx, dx)[:, np.newaxis], np.fft.rfftfreq(ny, dy)
    q2 = qx**2 + qy**2
    power *= q2
    power[:, 0] /= 2  # both halves of the plane are alike
    lowest, end = 2 / min(surface.sizes), 0.5 / max(surface.spacing)
    together = _CORRELATED if surface.is_cut_out else 1.0
    while end >= 2 * lowest:
        octave = (q2 >= (end / 2) ** 2) & (q2 < end**2)
        weights = power[octave]
        turned = ((qx + 1j * qy) ** 2 / np.maximum(q2, lowest**2 / 4))[octave]
        total = float(weights.sum())
        if total > 0:
            lay = abs(complex((weights * turned).sum())) / total
            variance = together * float((weights**2).sum()) / 4 / total**2
            yield _lay(lay, variance, 1 / end, surface.unit)
        end /= 2


def _lay(lay: float, variance: float, wave: float, unit: str | None) -> _Finding:
    """Judge how far slopes of an octave of waves prefer a direction."""
    chance = math.exp(-min(lay**2 / 2 / variance, 600.0))
    score = -float(special.ndtri(chance / 2))

    def text(limit: float) -> str:
        allowed = math.sqrt(-2 * variance * math.log(2 * special.ndtr(-limit)))
        length = engineering(2 * wave, unit or "", 2).strip()
        return (
            f"slopes differ by direction: of waves up to {length}, the least is "
            f"{_ratio(lay):.2f} of the largest, and chance allows {_ratio(min(allowed, 1.0)):.2f}"
        )

    return _Finding(score, lay / _lay_of(_ALIKE), text)


def _lay_of(ratio: float) -> float:
    return (1 - ratio**2) / (1 + ratio**2)


def _ratio(lay: float) -> float:
    """Least over largest slope."""
    return math.sqrt((1 - lay) / (1 + lay))


# Roll-off and longer waves


def _of_long_waves(body: Body) -> list[Departure | None]:
    """Say whether a piece shows a roll-off, and whether it lies on waves longer than itself."""
    what = "map" if isinstance(body, Surface) else "scan"
    try:
        spectrum = isotropic_spectrum(body) if isinstance(body, Surface) else profile_spectrum(body)
        fit = fit_self_affine(spectrum)
    except InputError:
        return []
    found = [_of_shapes(body, fit, what)]
    if fit.q_roll is None or fit.q_roll_interval[0] <= fit.q_low * (1 + 1e-9):
        text = (
            f"the {what} shows no roll-off: its spectrum still rises at its longest waves, so "
            f"longer ones are missing: a longer {what} would hold more of them"
        )
        found.append(Departure("roll-off", text, _NO_ROLL_OFF))
    return found


def _of_shapes(body: Body, fit: SelfAffineFit, what: str) -> Departure | None:
    """Say whether tilt and bow are more than waves of the body's own spectrum explain."""
    shapes = list(long_shapes(body, fit))
    grave = [
        each
        for each in shapes
        if each.chance < _CHANCE_OF_WAVES / len(shapes) and each.share > _LONGER
    ]
    if grave:
        worst = max(grave, key=lambda each: each.share)
        return Departure("longer waves", _in_words(worst, body, what), worst.share / _LONGER)
    if tilt_of(body) is None and body.settings.get(TILT) != MOUNTING:
        text = (
            f"the {what} was levelled before it was given, so its heights do not tell whether it "
            f"lies on waves longer than itself: give it as it was measured, or {_SAY_SO}"
        )
        return Departure("longer waves", text, _LEVELLED)
    return None


def _in_words(shape: LongShape, body: Body, what: str) -> str:
    """Say what waves longer than a body leave in it."""
    rms, explained = (
        engineering(each, body.unit or "", 2).strip() for each in (shape.rms, shape.explained)
    )
    remedy = "map a larger area, or several places" if what == "map" else "scan a longer line"
    if shape.degree == 1:
        return (
            f"the {what} is tilted: the tilt has an rms height of {rms}, of which its own waves "
            f"explain {explained}, and the rest is the mounting's or of waves longer than the "
            f"{what}: {remedy}, or {_SAY_SO}"
        )
    name = "bow" if shape.degree == 2 else "longest shape"
    return (
        f"the {what} lies on waves longer than itself: its {name} has an rms height of {rms}, and "
        f"its own waves explain {explained}: {remedy}"
    )


_SAY_SO = 'say that the tilt is the mounting\'s (tilt="mounting")'
