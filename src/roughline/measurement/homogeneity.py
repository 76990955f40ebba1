"""Whether a topography is alike everywhere, from side to side, and in all directions."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from roughline.computing.arrays import Real
from roughline.facts.fact import Fact
from roughline.measurement.chance import Finding, score_of_square
from roughline.measurement.coarser_selves import CoarserSelf
from roughline.statistics.student import student
from roughline.topography.body import Surface

ISOTROPIC_FROM = 0.7  # least over largest slope, from which on a surface counts as isotropic

_LARGEST_SCATTER = 0.05  # of rms slopes between places, relative; more matters
_TILES_ALONG = (2, 4, 8)  # along a side, whose slopes are compared
_SLOPE_FLOOR = 1e-6  # of the largest mean square slope: none
_FEWEST_IN_TILE = 10  # independent squares of slopes in a tile
_STRIP_COUNT = 24  # from side to side, of which the mean squares of slopes are compared
_LARGEST_CORRELATION = 0.9  # of neighbouring strips
_LARGEST_DRIFT = 0.1  # logarithm of the ratio of rms slopes at both sides; more matters
_FEWEST_POINTS = 16  # along a side, for slopes by direction
_CORRELATED_MODES = 3.78  # modes that vary together under a Hann window: (35 / 18)²


def scatter_between_places(selves: Sequence[CoarserSelf]) -> Iterable[Finding]:
    """Yield the scatter of rms slopes between parts of the body, on every scale."""
    for own in selves:
        squares = own.detail**2
        independent = own.detail_chance.independent(2)
        for tiles in _TILES_ALONG:
            cells = min(squares.shape) // tiles
            if not cells:
                continue
            means = _means(squares, cells)
            shape = independent * cells**squares.ndim / squares.size / 2
            if shape >= _FEWEST_IN_TILE / 2 and means.max() > 0:
                yield _scatter(np.log(np.maximum(means, _SLOPE_FLOOR * means.max())), shape)


def _scatter(logs: Real, shape: float) -> Finding:
    """Compare the scatter of logarithms of mean squares with that of gamma variates."""
    from scipy import special  # here because it loads slowly

    expected = float(special.polygamma(1, shape))
    variance, freedom = float(logs.var(ddof=1)), logs.size - 1
    score = score_of_square(freedom, variance / expected)
    varies = math.sqrt(max(0.0, variance - expected)) / 2
    spread = math.exp(float(np.ptp(logs)) / 2)

    def fact(_limit: float) -> Fact:
        factor, chance = (math.exp(math.sqrt(each) / 2) for each in (variance, expected))
        numbers = {"factor": factor, "spread": spread, "chance": chance}
        return Fact("differs_between_places", parts=logs.size, **numbers)

    return Finding(score, varies / _LARGEST_SCATTER, fact)


def drift_along_sides(surface: Surface) -> Iterable[Finding]:
    """Yield the drift of rms slopes along both sides of a map, if it has points enough for it.

    Strips across a side each have a mean square of slopes. Neighbours may correlate, and count for
    fewer then. The strips need not be Gaussian, nor the map isotropic: their own scatter is the
    measure.
    """
    if min(surface.shape) <= _STRIP_COUNT:
        return
    heights, (dx, dy) = surface.detrended().heights, surface.spacing
    across = (np.diff(heights, axis=0) / dx)[:, :-1]
    along = (np.diff(heights, axis=1) / dy)[:-1]
    squares = across**2 + along**2
    for axis, name in enumerate("xy"):
        means = np.array([each.mean() for each in np.array_split(squares, _STRIP_COUNT, axis=axis)])
        if means.min() > 0:
            yield _drift(name, np.log(means) / 2)


def _drift(along: str, logs: Real) -> Finding:
    """Fit a line to the logarithms of rms slopes of strips, whose scatter may be correlated."""
    from scipy import special  # here because it loads slowly

    n = logs.size
    place = np.linspace(-0.5, 0.5, n) * (1 - 1 / n)
    spread = float((place**2).sum())
    change = float((place * logs).sum()) / spread
    rest = logs - logs.mean() - change * place
    square = float((rest**2).sum())
    # a line takes away from the correlation of what is left, about 2 / n
    correlation = float((rest[1:] * rest[:-1]).sum()) / square + 2 / n if square else 0.0
    correlation = min(max(correlation, 0.0), _LARGEST_CORRELATION)
    longer = (1 + correlation) / (1 - correlation)
    error, freedom = math.sqrt(square / (n - 2) * longer / spread), max(n / longer - 2, 1.0)
    ratio = abs(change) / error if error else math.inf
    score = -float(special.ndtri(special.stdtr(freedom, -ratio))) if change else 0.0

    def fact(limit: float) -> Fact:
        allowed = error * float(student(freedom, special.ndtr(limit)))
        return Fact("drifts", along=along, factor=math.exp(abs(change)), chance=math.exp(allowed))

    return Finding(score, abs(change) / _LARGEST_DRIFT, fact)


def slopes_by_direction(surface: Surface) -> Iterable[Finding]:
    """Yield slopes by direction, of all waves and of those longer than some."""
    if min(surface.shape) < _FEWEST_POINTS:
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
    lowest, end = 1 / min(surface.sizes), 0.5 / max(surface.spacing)
    together = _CORRELATED_MODES if surface.is_cut_out else 1.0
    while end >= 4 * lowest:
        longer = (q2 >= lowest**2) & (q2 < end**2)
        weights = power[longer]
        turned = ((qx + 1j * qy) ** 2)[longer] / q2[longer]
        total = float(weights.sum())
        if total > 0:
            lay = abs(complex((weights * turned).sum())) / total
            variance = together * float((weights**2).sum()) / 4 / total**2
            yield _lay(lay, variance, 1 / end, surface.unit)
        end /= 2


def _lay(lay: float, variance: float, wave: float, unit: str | None) -> Finding:
    """Judge how far slopes of waves longer than one prefer a direction."""
    from scipy import special  # here because it loads slowly

    chance = math.exp(-min(lay**2 / 2 / variance, 600.0))
    score = -float(special.ndtri(chance / 2))

    def fact(limit: float) -> Fact:
        allowed = math.sqrt(-2 * variance * math.log(2 * special.ndtr(-limit)))
        numbers = {"ratio": _ratio(lay), "chance": _ratio(min(allowed, 1.0))}
        return Fact("slopes_differ_by_direction", wave=wave, unit=unit, **numbers)

    return Finding(score, lay / _lay_at(ISOTROPIC_FROM), fact)


def _lay_at(ratio: float) -> float:
    return (1 - ratio**2) / (1 + ratio**2)


def _ratio(lay: float) -> float:
    """Least over largest slope."""
    return math.sqrt(max(1 - lay, 0.0) / (1 + lay))  # lay may round above one


def _means(values: Real, cells: int) -> Real:
    """Means over groups of so many cells along each side."""
    for axis, n in enumerate(values.shape):
        complete = np.moveaxis(values, axis, 0)[: n - n % cells]
        groups = complete.reshape(n // cells, cells, *complete.shape[1:]).mean(axis=1)
        values = np.moveaxis(groups, 0, axis)
    return values
