"""Departures of a topography from what predictions rest on, each with what chance would allow."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Literal, get_args
from weakref import WeakKeyDictionary

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.errors import InputError
from roughline.errors.words import called
from roughline.facts.fact import Fact
from roughline.measurement.chance import Finding
from roughline.measurement.coarser_selves import coarser_selves
from roughline.measurement.fit import SelfAffineFit, fitted
from roughline.measurement.gaussian_heights import shapes_on_every_scale
from roughline.measurement.homogeneity import (
    drift_along_sides,
    scatter_between_places,
    slopes_by_direction,
)
from roughline.measurement.longer_waves import LongShape, known_tilt, long_shapes
from roughline.topography.body import Body, Line, Surface
from roughline.topography.preparation import outliers
from roughline.topography.scan_lines import OVER_MEDIAN
from roughline.units import in_words

Assumption = Literal[
    "gaussian",
    "isotropic",
    "stationary",
    "steady",
    "roll-off",
    "longer waves",
    "resolution",
    "measured",
]
"""What predictions from a topography rest on."""

FIT_RESTS_ON: frozenset[Assumption] = frozenset(
    {"isotropic", "stationary", "resolution", "measured"}
)
"""Assumptions behind one self-affine law for all directions and places."""

_DEPARTURE_CHANCE = 0.002  # where a topography fulfils an assumption, over all its tests
_DRIFT_CHANCE = 0.02  # of a drift over a map, which goes on beyond it
_LONG_WAVES_CHANCE = 0.02  # of tilt and bow: what few coefficients show is easily missed
_LONG_WAVES_SHARE = 0.02  # mean square of longer waves, over that of the rest, that matters
_STEPPED_SHARE = 0.1  # of heights in steps, that matters
_LEVEL_SHARE = 0.003  # of heights on one level, beyond the lowest, that matters
_FILLED_SHARE = 0.1  # of points: beyond, intervals of light loads hold too few surfaces
_LARGEST_JUMP = 0.02  # of the rms height, by which rows jump that matters
_NO_ROLL_OFF_GRAVITY = 2.0  # of a map without a roll-off, which has no number of its own
_LEVELLED_GRAVITY = 1.01  # of a tilt that is not known, which has no number of its own

_FEWEST_POINTS = 8  # along the shortest side, that tell of faults
_MOST_SEARCHED = 1024  # points along a side, for equal heights
HEIGHT_ROUNDING = 1e-9  # of the largest height, within which heights are equal
_LEVELS_BESIDE = 3  # on either side of one, that show how many heights are equal by their steps
_LEVEL_EXCESS = 3.0  # times as many as on any of them that are not equal by steps alone
_JUMP_SCATTERS = 8.0  # of rows from the line through those beside them that are not by chance
_STEP_STEEPNESS = 3.0  # than the slopes beside it is a step


@dataclass(frozen=True)
class Departure:
    """A departure from what predictions rest on."""

    assumption: Assumption  # what does not hold
    fact: Fact  # with the number measured, what chance would allow, and what to do
    gravity: float  # the number measured over that which would not matter; above 1

    @property
    def text(self) -> str:
        """The fact in words."""
        return str(self.fact)


def departures(
    body: Body, on: Collection[Assumption] = get_args(Assumption)
) -> tuple[Departure, ...]:
    """Return how a topography departs from some of what predictions rest on, gravest first.

    What it departs from otherwise is not computed.
    """
    if isinstance(body, Line) and body.kind == "reduced":
        return ()
    known = _KNOWN.setdefault(body, {})
    found: list[Departure] = []
    for assumptions, test in _TESTS.items():
        if not assumptions.isdisjoint(on):
            if assumptions not in known:
                known[assumptions] = tuple(filter(None, test(body)))
            found += [each for each in known[assumptions] if each.assumption in on]
    return tuple(sorted(found, key=lambda each: -each.gravity))


_Tested = frozenset[Assumption]

_KNOWN: WeakKeyDictionary[Body, dict[_Tested, tuple[Departure, ...]]] = WeakKeyDictionary()


def _find_chance(body: Body) -> Iterator[Departure | None]:
    """Say whether heights, or their scatter between places, are not by chance."""
    selves = list(coarser_selves(body))
    yield _first("gaussian", shapes_on_every_scale(body, selves), body)
    yield _first("stationary", scatter_between_places(selves), body)


def _find_lay(body: Body) -> Iterator[Departure | None]:
    """Say whether slopes differ by direction."""
    if isinstance(body, Surface):
        yield _first("isotropic", slopes_by_direction(body), body)


def _find_drift(body: Body) -> Iterator[Departure | None]:
    """Say whether the roughness drifts over a piece."""
    if isinstance(body, Surface) and body.is_cut_out:
        yield _first("steady", drift_along_sides(body), body, _DRIFT_CHANCE)


def _find_steps(body: Body) -> Iterator[Departure]:
    """Say whether heights stand in steps, as an instrument rounds them or ends its range."""
    share = _share_on_lines(body.heights)
    if share <= _STEPPED_SHARE:
        return
    yield Departure("resolution", Fact("heights_in_steps", share=share), share / _STEPPED_SHARE)


def _find_faults(body: Body) -> Iterator[Departure]:
    """Say where heights are not the surface's, so that no answer holds."""
    if (share := body.provenance.missing_share) > _FILLED_SHARE:
        yield Departure("measured", Fact("many_filled", share=share), share / _FILLED_SHARE)
    if not body.is_cut_out or not body.rms_height:
        return
    if (share := _share_on_a_level(body.heights)) > _LEVEL_SHARE:
        yield Departure("measured", Fact("heights_on_a_level", share=share), share / _LEVEL_SHARE)
    rows = _jump(body) if isinstance(body, Surface) else None
    if isinstance(body, Surface) and rows and abs(rows.height) > _LARGEST_JUMP * body.rms_height:
        gravity = abs(rows.height) / _LARGEST_JUMP / body.rms_height
        yield Departure("measured", _describe_jump(rows, body), gravity)


def _describe_jump(rows: _Jump, surface: Surface) -> Fact:
    """Say where rows of a map jump."""
    at = {"axis": "xy"[rows.axis], "at": rows.index * surface.spacing[rows.axis]}
    jump = {"jump": abs(rows.height), "is_above": rows.height > 0, "scatter": rows.scatter}
    return Fact("map_jumps", **at, **jump, unit=surface.unit, is_row=rows.is_single)


def _share_on_lines(heights: Real) -> float:
    """Return the share of heights in line with their neighbours along every side."""
    heights = _searched_corner(heights)
    inner = in_line(heights)[(slice(1, -1),) * heights.ndim]
    return 0.0 if inner.all() else float(inner.mean())


def _share_on_a_level(heights: Real) -> float:
    """Return the share of heights that stand on one level above the lowest, which may be tilted.

    Heights that are rounded stand on levels, but on none of them are many more than on those beside
    it.
    """
    heights = _searched_corner(heights)
    flat = in_line(heights)
    if not flat.any():
        return 0.0
    level = levelled(heights, flat)
    steps = np.round((level - level.max()) / (HEIGHT_ROUNDING * np.abs(heights).max()))
    _, counts = np.unique(steps, return_counts=True)
    ends = np.pad(counts, _LEVELS_BESIDE, constant_values=1)
    beside = np.lib.stride_tricks.sliding_window_view(ends, 2 * _LEVELS_BESIDE + 1).copy()
    beside[:, _LEVELS_BESIDE] = 0
    many = counts > _LEVEL_EXCESS * beside.max(axis=1)
    return float(counts[1:][many[1:]].max(initial=0) / heights.size)


def levelled(heights: Real, flat: Mask) -> Real:
    """Heights below the highest, without the tilt that flat ones have."""
    level: Real = heights - heights.max()
    for axis, n in enumerate(heights.shape):
        slope = np.median(np.gradient(heights, axis=axis)[flat])
        level = np.moveaxis(np.moveaxis(level, axis, -1) - slope * np.arange(n), -1, axis)
    return level


def in_line(heights: Real) -> Mask:
    """Mark heights in line with their neighbours along every side; those at the rim are not."""
    found = np.zeros(heights.shape, dtype=bool)
    if min(heights.shape) < _FEWEST_POINTS:
        return found
    inner = (slice(1, -1),) * heights.ndim
    scale = float(np.abs(heights).max())
    found[inner] = True
    for axis in range(heights.ndim):
        along = np.moveaxis(np.diff(heights, n=2, axis=axis), axis, 0)
        others = np.moveaxis(along[(slice(None), *inner[1:])], 0, axis)
        found[inner] &= np.abs(others) <= HEIGHT_ROUNDING * scale
    return found


def _searched_corner(heights: Real) -> Real:
    """A corner of heights that is quickly searched."""
    return heights[(slice(_MOST_SEARCHED),) * heights.ndim]


@dataclass(frozen=True)
class _Jump:
    """Rows that stand off those beside them, all along."""

    axis: int  # across which side
    index: int  # of the first of these rows
    height: float  # by how much they stand above the rows before [length]
    # by how much rows stand off the line through those beside them otherwise [length]
    scatter: float
    is_single: bool  # whether it is one row alone, between others that continue each other


def _jump(surface: Surface) -> _Jump | None:
    """Return the highest jump between rows of a map that is not by chance, nor one of spikes."""
    found = _highest_jump(surface.heights)
    if found is None:
        return None
    spikes = outliers(surface)  # which takes longer than rows do
    return _highest_jump(np.ma.MaskedArray(surface.heights, spikes)) if spikes.any() else found


def _highest_jump(heights: Real) -> _Jump | None:
    """Return the highest jump between rows.

    Grooves, ridges and edges between tool marks are none: slopes on one side of them go on.
    """
    found = [
        each
        for axis in range(2)
        if heights.shape[axis] >= _FEWEST_POINTS
        for each in _jumps(np.asarray(heights.mean(axis=1 - axis)), axis)
        if abs(each.height) > _JUMP_SCATTERS * each.scatter
    ]
    return max(found, key=lambda each: abs(each.height), default=None)


def _jumps(means: Real, axis: int) -> Iterator[_Jump]:
    """The single row, and the step, that are highest above what the slopes beside them say."""
    slopes = np.diff(means)
    scatter = float(OVER_MEDIAN * np.median(np.abs(np.diff(slopes))))
    up, down = slopes[1:-2], -slopes[2:-1]  # to a row, and from it
    single = _least(up, down, up - slopes[:-3], down + slopes[3:])
    before, step, after = slopes[:-2], slopes[1:-1], slopes[2:]
    steep = np.abs(step) > _STEP_STEEPNESS * np.maximum(np.abs(before), np.abs(after))
    steps = np.where(steep, _least(step, step - before, step - after), 0.0)
    for heights, is_single in ((single, True), (steps, False)):
        worst = int(np.argmax(np.abs(heights)))
        yield _Jump(axis, worst + 2, float(heights[worst]), scatter, is_single)


def _least(*values: Real) -> Real:
    """The smallest of values where all have one sign, else none."""
    signs = np.sign(values)
    same_sign = (signs == signs[0]).all(axis=0)
    return np.where(same_sign, signs[0] * np.abs(values).min(axis=0), 0.0)


def _first(
    assumption: Assumption,
    findings: Iterable[Finding],
    body: Body,
    chance: float = _DEPARTURE_CHANCE,
) -> Departure | None:
    """The gravest of findings that chance does not explain; None if there is none."""
    from scipy import special  # here because it loads slowly

    findings = list(findings)
    if not findings:
        return None
    limit = -float(special.ndtri(chance / len(findings) / 2))
    grave = [each for each in findings if abs(each.score) > limit and each.gravity > 1]
    if not grave:
        return None
    worst = max(grave, key=lambda each: each.gravity)
    fact = Fact("beyond_chance", fact=worst.fact(limit), what=_what(body))
    return Departure(assumption, fact, worst.gravity)


def _what(body: Body) -> str:
    return "map" if isinstance(body, Surface) else "scan"


def _find_long_waves(body: Body) -> list[Departure | None]:
    """Say whether a piece shows a roll-off, and whether it lies on waves longer than itself."""
    if not body.is_cut_out or next(coarser_selves(body), None) is None:
        return []
    what = _what(body)
    try:
        _, fit = fitted(body)
    except InputError:
        return []
    if not fit.is_judged:
        return []
    found = [_find_tilt_and_bow(body, fit, what)]
    if not fit.shows_roll_off:
        found.append(Departure("roll-off", Fact("no_roll_off", what=what), _NO_ROLL_OFF_GRAVITY))
    return found


def _find_tilt_and_bow(body: Body, fit: SelfAffineFit, what: str) -> Departure | None:
    """Say whether tilt and bow are more than waves of the body's own spectrum explain."""
    if body.provenance.is_levelled_by_lines:
        return Departure("longer waves", Fact("levelled_by_lines", what=what), _LEVELLED_GRAVITY)
    if grave := _grave_shapes(body, fit):
        worst = max(grave, key=lambda each: each.share)
        gravity = math.sqrt(worst.share / _LONG_WAVES_SHARE)
        return Departure("longer waves", _describe_shape(worst, body, what), gravity)
    if known_tilt(body) is None and not body.provenance.tilt.is_of_mounting:
        return Departure("longer waves", Fact("levelled_before", what=what), _LEVELLED_GRAVITY)
    return None


def _grave_shapes(body: Body, fit: SelfAffineFit) -> list[LongShape]:
    """Tilt and bow that a body's own waves do not explain."""
    shapes = list(long_shapes([body], fit))
    return [
        each
        for each in shapes
        if each.chance < _LONG_WAVES_CHANCE / len(shapes) and each.share > _LONG_WAVES_SHARE
    ]


def checked_fit(body: Body, fit: SelfAffineFit) -> SelfAffineFit:
    """Take the intervals down of a refused law, and where a body departs from what one rests on.

    So does a bow, which stands in the place of the longest waves.
    """
    if not fit.is_judged:
        return fit
    if fit.objections:
        return fit.without_intervals()
    if departures(body, FIT_RESTS_ON):
        return fit.without_intervals()
    for shape in _grave_shapes(body, fit) if body.is_cut_out else []:
        if shape.degree > 1:
            rms, explained = (in_words(each, body.unit, 2) for each in (shape.rms, shape.explained))
            return fit.without_intervals(
                f"a bow of rms height {rms} hides the longest waves, which explain {explained}: "
                f"remove it first ({called('trend', 'curvature')})"
            )
    return fit


def _describe_shape(shape: LongShape, body: Body, what: str) -> Fact:
    """Say what waves longer than a body leave in it."""
    sizes = {"rms": shape.rms, "explained": shape.explained, "unit": body.unit}
    if shape.degree == 1:
        return Fact("tilted", what=what, **sizes)
    name = "bow" if shape.degree == 2 else "longest shape"
    return Fact("bowed", what=what, shape=name, **sizes)


_TESTS: Mapping[_Tested, Callable[[Body], Iterable[Departure | None]]] = {
    frozenset({"gaussian", "stationary"}): _find_chance,
    frozenset({"resolution"}): _find_steps,
    frozenset({"isotropic"}): _find_lay,
    frozenset({"steady"}): _find_drift,
    frozenset({"roll-off", "longer waves"}): _find_long_waves,
    frozenset({"measured"}): _find_faults,
}
"""What is tested, by the assumptions that are judged together."""
