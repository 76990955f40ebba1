"""Lines of a scan: levels that jump from one to the next, and scars within one.

A line is `heights[:, j]`, a row of the picture. A probe follows it in a second and needs minutes
for all of them, so what drifts or slips meanwhile stands between lines.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.errors import InputError
from roughline.facts.fact import Fact
from roughline.topography.body import Body, BodyType, Surface, after_step
from roughline.topography.effects import with_effect
from roughline.topography.line_levels import Levelling, line_levels
from roughline.topography.missing import Filler

_FEWEST_POINTS = 8  # points of a line, and lines, that tell of either
_BLOCKS = 8  # parts of a line that show how far its median is by chance
_OVER_CHANCE = 2.0  # times as far are jumps
_SMALLEST_JUMP = 0.02  # of the rms height
# correlation of a jump with the next: -0.5 if lines know nothing of each other, and zero or more of
# grooves, which are as wide as some lines
_TURNING = -0.1
_SCAR, _SCAR_GOES_ON = 5.0, 2.5  # times the scatter of neighbouring lines
_SHORTEST_SCAR = 3  # points of a scar
_WITHIN_LINES = np.array([[False, True, False]] * 3)  # which points are neighbours
OVER_MEDIAN = 1.4826  # standard deviation of normal values over the median of their moduli


def levelled(body: BodyType, how: Levelling) -> BodyType:
    """Return a map without the levels of its lines; its settings record what that did."""
    _refuse_others(body, "lines")
    heights = body.heights - line_levels(body.heights, how)
    before = body.provenance
    filled = before.filled.points if before.filled else before.filled_before_crop
    late = {"filled_between_levels": filled} if filled and not before.filled_over_lines else {}
    level = after_step(body, heights, lines_levelled=how, **late)
    return with_effect(body, level, "levelled")


def without_scars(body: BodyType) -> BodyType:
    """Return a map whose scars are filled like missing points."""
    _refuse_others(body, "remove_scars")
    marks = scars(body.heights)
    count = int(np.count_nonzero(marks))
    if not count:
        return after_step(body, body.heights, scars_removed=0)
    known = np.ma.MaskedArray(body.heights, marks)
    filled = Filler().filled(known, "the topography, without its scars,")
    return with_effect(body, after_step(body, filled, scars_removed=count), "scars")


def scars(heights: Real) -> Mask:
    """Mark runs of points of a line that jump to one side of both lines beside it.

    Their least distance from both is more than five times the scatter of neighbouring lines
    somewhere, and half as much all along three points or more. A line that is off from end to end
    is a matter of levels.
    """
    from scipy import ndimage  # here because it loads slowly

    steps = np.diff(heights, axis=1)
    scatter = OVER_MEDIAN * float(np.median(np.abs(steps - np.median(steps))))
    marks = np.zeros(heights.shape, dtype=bool)
    up, down = steps[:, :-1], -steps[:, 1:]  # of a line above the one before, and the one after
    for sign in (1, -1):
        least = np.minimum(sign * up, sign * down)
        runs, count = ndimage.label(least > _SCAR_GOES_ON * scatter, _WITHIN_LINES)
        if not count or not scatter:
            continue
        numbers = np.arange(1, count + 1)
        highest = ndimage.maximum(least, runs, numbers)
        points = np.bincount(runs.ravel(), minlength=count + 1)[1:]
        is_scar = (highest > _SCAR * scatter) & (points >= _SHORTEST_SCAR) & (points < len(heights))
        marks[:, 1:-1] |= np.isin(runs, numbers[is_scar])
    return marks


@dataclass(frozen=True)
class LineJumps:
    """How far medians of neighbouring lines differ."""

    rms: float  # [length]
    by_chance: float  # as their points explain: the medians of parts of lines tell [length]
    turning: float  # correlation of a difference with the next [1]


def line_jumps(heights: Real) -> LineJumps | None:
    """Return how lines of a map jump; None if there are too few of them, or of their points."""
    if min(heights.shape) < 2 * _BLOCKS:
        return None
    steps = np.diff(heights, axis=1)
    jumps = np.median(steps, axis=0)
    jumps -= jumps.mean()
    parts = np.array([np.median(each, axis=0) for each in np.array_split(steps, _BLOCKS)])
    by_chance = np.sqrt((parts.var(axis=0, ddof=1) / _BLOCKS).mean())
    square = float(jumps @ jumps)
    turning = float(jumps[1:] @ jumps[:-1]) / square if square else 0.0
    return LineJumps(float(np.sqrt(square / jumps.size)), float(by_chance), turning)


def line_jump_warning(body: Body) -> Fact | None:
    """Say that lines of a measured map jump; None where they do not."""
    if not isinstance(body, Surface) or not body.is_cut_out:
        return None
    found = line_jumps(body.heights)
    if (
        found is None
        or found.rms <= _OVER_CHANCE * found.by_chance
        or found.rms <= _SMALLEST_JUMP * body.rms_height
        or found.turning >= _TURNING
    ):
        return None
    return Fact("rows_jump", rms=found.rms, by_chance=found.by_chance, unit=body.unit)


def _refuse_others(body: Body, argument: str) -> None:
    """Refuse what has no lines beside each other."""
    if not isinstance(body, Surface):
        raise InputError("is for maps; a line scan has one line", argument)
    if min(body.shape) < _FEWEST_POINTS:
        raise InputError(
            f"needs {_FEWEST_POINTS} lines of {_FEWEST_POINTS} points or more; the map has "
            f"{body.shape[1]} of {body.shape[0]}",
            argument,
        )
