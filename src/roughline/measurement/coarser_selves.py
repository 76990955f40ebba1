"""Coarser selves of a topography: its heights on ever larger cells, and what is fine on them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from roughline.computing.arrays import Real
from roughline.measurement.chance import MOST_CELLS, Chance
from roughline.topography.body import Body

_FEWEST_CELLS = 8  # along the shortest side of a coarser self
_DETAIL_REACH = 32  # cells over which detail is correlated at most


@dataclass(frozen=True, eq=False)
class CoarserSelf:
    """Heights on cells of some points, and their second differences. [length]"""

    cell: int  # points along a cell
    heights: Real  # means over the cells, less their mean

    @cached_property
    def detail(self) -> Real:
        """Second differences of the inner cells, summed over both sides."""
        h = self.heights
        inner = (slice(1, -1),) * h.ndim
        total = -2.0 * h.ndim * h[inner]
        for axis in range(h.ndim):
            for step in (slice(0, -2), slice(2, None)):
                total += h[(*inner[:axis], step, *inner[axis + 1 :])]
        return total

    @cached_property
    def detail_chance(self) -> Chance:
        """Chance of its detail."""
        return Chance.of(self.detail, _DETAIL_REACH)

    @cached_property
    def heights_chance(self) -> Chance:
        """Chance of its heights, those of large maps on coarser cells, as long waves decide."""
        heights = self.heights
        while heights.ndim == 2 and max(heights.shape) > MOST_CELLS and min(heights.shape) > 1:
            heights = _halved(heights)
        return Chance.of(heights, max(heights.shape))


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
    while min(heights.shape) >= _FEWEST_CELLS:
        yield CoarserSelf(cell, heights)
        cell *= 2
        heights = _halved(heights)


def _halved(heights: Real) -> Real:
    """Means over pairs of neighbours along every side."""
    for axis, n in enumerate(heights.shape):
        even = np.moveaxis(heights, axis, 0)[: n - n % 2]
        heights = np.moveaxis((even[::2] + even[1::2]) / 2, 0, axis)
    return heights
