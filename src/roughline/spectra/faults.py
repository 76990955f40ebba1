"""Faults of a measurement that heights show: many equal ones, and rows that jump."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Mask, Real

_LEAST = 8  # points along the shortest side that tell of faults
_MOST = 1024  # points along a side that are searched for equal heights
_ROUNDING = 1e-9  # of the largest height, within which heights are equal
_BESIDE = 3  # levels on either side of one that show how many heights are equal by their steps
_MORE = 3.0  # times as many as on any of them that are not equal by steps alone
_SCATTERS = 8.0  # of rows from the line through those beside them that are not by chance
_STEEPER = 3.0  # than the slopes beside it is a step
_SIGMA = 1.4826  # standard deviation of normal values over the median of their moduli


def share_on_lines(heights: Real) -> float:
    """Return the share of heights in line with their neighbours along every side."""
    heights = _some_of(heights)
    inner = _in_line(heights)[(slice(1, -1),) * heights.ndim]
    return 0.0 if inner.all() else float(inner.mean())


def share_on_a_level(heights: Real) -> float:
    """Return the share of heights that stand on one level above the lowest, which may be tilted.

    Heights that are rounded stand on levels, but on none of them are many more than on those beside
    it.
    """
    heights = _some_of(heights)
    flat = _in_line(heights)
    if not flat.any():
        return 0.0
    level = heights - heights.max()
    for axis, n in enumerate(heights.shape):
        slope = np.median(np.gradient(heights, axis=axis)[flat])
        level = np.moveaxis(np.moveaxis(level, axis, -1) - slope * np.arange(n), -1, axis)
    steps = np.round((level - level.max()) / (_ROUNDING * np.abs(heights).max()))
    _, counts = np.unique(steps, return_counts=True)
    ends = np.pad(counts, _BESIDE, constant_values=1)
    beside = np.lib.stride_tricks.sliding_window_view(ends, 2 * _BESIDE + 1).copy()
    beside[:, _BESIDE] = 0
    many = counts > _MORE * beside.max(axis=1)
    return float(counts[1:][many[1:]].max(initial=0) / heights.size)


def _in_line(heights: Real) -> Mask:
    """Mark heights in line with their neighbours along every side; those at the rim are not."""
    found = np.zeros(heights.shape, dtype=bool)
    if min(heights.shape) < _LEAST:
        return found
    inner = (slice(1, -1),) * heights.ndim
    scale = float(np.abs(heights).max())
    found[inner] = True
    for axis in range(heights.ndim):
        along = np.moveaxis(np.diff(heights, n=2, axis=axis), axis, 0)
        others = np.moveaxis(along[(slice(None), *inner[1:])], 0, axis)
        found[inner] &= np.abs(others) <= _ROUNDING * scale
    return found


def _some_of(heights: Real) -> Real:
    """A corner of heights that is quickly searched."""
    return heights[(slice(_MOST),) * heights.ndim]


@dataclass(frozen=True)
class Jump:
    """Rows that stand off those beside them, all along."""

    axis: int  # across which side
    index: int  # of the first of these rows
    height: float  # by how much they stand above the rows before [length]
    # by how much rows stand off the line through those beside them otherwise [length]
    scatter: float
    is_single: bool  # whether it is one row alone, between others that continue each other


def jump(heights: Real) -> Jump | None:
    """Return the highest jump between rows of a map that is not by chance.

    Grooves, ridges and edges between tool marks are none: slopes on one side of them go on.
    """
    found = [
        each
        for axis in range(2)
        if heights.shape[axis] >= _LEAST
        for each in _jumps(heights.mean(axis=1 - axis), axis)
        if abs(each.height) > _SCATTERS * each.scatter
    ]
    return max(found, key=lambda each: abs(each.height), default=None)


def _jumps(means: Real, axis: int) -> Iterator[Jump]:
    """The single row, and the step, that are highest above what the slopes beside them say."""
    slopes = np.diff(means)
    scatter = float(_SIGMA * np.median(np.abs(np.diff(slopes))))
    up, down = slopes[1:-2], -slopes[2:-1]  # to a row, and from it
    single = _least(up, down, up - slopes[:-3], down + slopes[3:])
    before, step, after = slopes[:-2], slopes[1:-1], slopes[2:]
    steep = np.abs(step) > _STEEPER * np.maximum(np.abs(before), np.abs(after))
    steps = np.where(steep, _least(step, step - before, step - after), 0.0)
    for heights, is_single in ((single, True), (steps, False)):
        worst = int(np.argmax(np.abs(heights)))
        yield Jump(axis, worst + 2, float(heights[worst]), scatter, is_single)


def _least(*values: Real) -> Real:
    """The smallest of values where all have one sign, else none."""
    signs = np.sign(values)
    alike = (signs == signs[0]).all(axis=0)
    return np.where(alike, signs[0] * np.abs(values).min(axis=0), 0.0)
