"""Departures of a topography from what predictions rest on, each with what chance would allow."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Literal
from weakref import WeakKeyDictionary

import numpy as np
from scipy import special

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.spectra.coarser_selves import (
    Chance,
    CoarserSelf,
    coarser_selves,
    kurtosis_score,
    skewness_score,
)
from roughline.spectra.fit import fit_self_affine
from roughline.spectra.isotropic import isotropic_spectrum
from roughline.spectra.profile import profile_spectrum
from roughline.topography.body import Body, Line, Surface
from roughline.units import decimal, engineering

Assumption = Literal[
    "gaussian", "isotropic", "stationary", "roll-off", "longer waves", "resolution"
]
"""What predictions from a topography rest on."""

_CHANCE = 0.002  # of a departure from an assumption that a topography fulfils, over all its tests
_LEAST_VALUES = 8  # independent values, from which a skewness or a kurtosis says something
_SKEW = 0.3  # skewness that matters
_EXCESS = 0.8  # kurtosis over 3 that matters
_FOLLOWS = 0.15  # relative rise of the variance of slopes with an rms height that matters
_GROUPED = 4  # cells along a group whose slopes are compared with its height
_ALIKE = 0.7  # least over largest slope, from which on a surface counts as isotropic
_VARIES = 0.1  # relative scatter of rms slopes between places that matters
_TILES = (2, 4, 8)  # along a side, whose slopes are compared
_LEAST_OF_TILE = 10  # independent squares of slopes in a tile
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
        found.append(_without_roll_off(body))
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
        yield from _shape(own.heights, own.of_heights, _named(body, own, "heights"))
        yield from _shape(own.detail, own.of_detail, _named(body, own, "curvatures"))
        yield from _detail_by_height(body, own)


def _named(body: Body, own: CoarserSelf, what: str) -> str:
    """Name heights or detail by the size of their cells."""
    if own.cell == 1:
        return f"the {what}"
    side = engineering(own.cell * _spacing(body), body.unit or "", 2).strip()
    return f"the {what} on cells of {side}"


def _spacing(body: Body) -> float:
    return max(body.spacing) if isinstance(body, Surface) else body.spacing


def _shape(values: Real, chance: Chance, name: str) -> Iterable[_Finding]:
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
    yield _Finding(kurtosis_score(kurtosis, fourth), abs(kurtosis - 3) / _EXCESS, tailed)


def _detail_by_height(body: Body, own: CoarserSelf) -> Iterable[_Finding]:
    """Whether detail is rougher where the surface is higher."""
    detail = own.detail
    inner = own.heights[(slice(1, -1),) * detail.ndim]
    if min(inner.shape) < 4 * _GROUPED:
        return
    heights, squares = (_means(values, _GROUPED) for values in (inner, detail**2))
    heights, squares = heights - heights.mean(), squares / squares.mean() - 1
    scatter = heights.std() * squares.std()
    if not scatter:
        return
    together = float((heights * squares).mean() / scatter)
    reach = max(heights.shape)
    of_heights, of_squares = Chance.of(heights, reach), Chance.of(squares, reach)
    pairs = of_heights.pairs * of_heights.correlation * of_squares.correlation
    count = heights.size / max(float(pairs.sum()), 1.0)
    if count < _LEAST_VALUES:
        return
    rise = float(together * squares.std())
    root = math.sqrt(count - 3)
    score = math.atanh(max(-0.999, min(together, 0.999))) * root

    def text(limit: float) -> str:
        allowed = math.tanh(limit / root) * float(squares.std())
        return (
            f"heights are not Gaussian: the mean square of {_named(body, own, 'curvatures')} "
            f"{'rises' if rise > 0 else 'falls'} by {abs(rise):.0%} with an rms height, and "
            f"chance allows {allowed:.0%}"
        )

    yield _Finding(score, abs(rise) / _FOLLOWS, text)


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
    score = -float(
        special.ndtri(max(special.chdtrc(freedom, freedom * variance / expected), 1e-300))
    )
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


# Roll-off


def _without_roll_off(body: Body) -> Departure | None:
    """Say that a piece shows no roll-off."""
    what = "map" if isinstance(body, Surface) else "scan"
    try:
        spectrum = isotropic_spectrum(body) if isinstance(body, Surface) else profile_spectrum(body)
        fit = fit_self_affine(spectrum)
    except InputError:
        return None
    if fit.q_roll is not None and fit.q_roll_interval[0] > fit.q_low * (1 + 1e-9):
        return None
    return Departure(
        "roll-off",
        f"the {what} shows no roll-off: its spectrum still rises at its longest waves, so longer "
        f"ones are missing: a longer {what} would hold more of them",
        2.0,
    )
