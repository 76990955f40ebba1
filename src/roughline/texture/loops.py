"""Compiled loop over the points of a surface, from the highest down; it takes arrays only."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Real
from roughline.computing.compiled import compiled

_Whole = NDArray[np.int64]


@compiled
def _root(parent: _Whole, offset: NDArray[np.int32], point: int) -> int:
    """Return the root of a point; the path to it is halved, offsets are those to the parents."""
    while parent[point] != point:
        above = parent[point]
        if parent[above] != above:
            offset[point, 0] += offset[above, 0]
            offset[point, 1] += offset[above, 1]
            parent[point] = parent[above]
        point = parent[point]
    return point


@compiled
def _to_root(parent: _Whole, offset: NDArray[np.int32], point: int) -> tuple[int, int]:
    """Return the way from the root of a point to it, in steps along both sides."""
    x, y = 0, 0
    while parent[point] != point:
        x += offset[point, 0]
        y += offset[point, 1]
        point = parent[point]
    return x, y


@compiled
def peaks_of_hills(heights: Real, order: _Whole, is_periodic: bool, least: float) -> _Whole:
    """Return the flat indices of the peaks that Wolf pruning leaves.

    Points are added from the highest down, and a hill grows around each peak. Where two meet, the
    lower one ends, and counts if it is at least so high. The top of a hill is what lies less than
    that below its peak: if it meets the border of a piece, or runs around a periodic surface, it
    is a ridge or no known peak, and does not count.
    """
    nx, ny = heights.shape
    flat = heights.ravel()
    parent = np.full(flat.size, -1, np.int64)
    peak = np.zeros(flat.size, np.int64)  # of the hill of a root
    is_open = np.zeros(flat.size, np.bool_)  # whether the top of that hill ends in nothing
    offset = np.zeros((flat.size, 2), np.int32)
    found = np.zeros(flat.size, np.int64)
    count = 0
    for point in order:
        x, y, height = point // ny, point % ny, flat[point]
        parent[point] = peak[point] = point
        is_open[point] = not is_periodic and (x in (0, nx - 1) or y in (0, ny - 1))
        for dx in range(-1, 2):
            for dy in range(-1, 2):
                i, j = x + dx, y + dy
                if not is_periodic and not (0 <= i < nx and 0 <= j < ny):
                    continue
                other = (i % nx) * ny + j % ny
                if (dx == 0 and dy == 0) or parent[other] < 0:
                    continue
                one, two = _root(parent, offset, point), _root(parent, offset, other)
                here, there = _to_root(parent, offset, point), _to_root(parent, offset, other)
                # from the root of the other point to that of this one
                wx, wy = there[0] - here[0] - dx, there[1] - here[1] - dy
                if one == two:
                    if (wx != 0 or wy != 0) and flat[peak[one]] - height < least:
                        is_open[one] = True  # around the surface
                    continue
                low, high = one, two
                if flat[peak[one]] > flat[peak[two]]:
                    low, high, wx, wy = two, one, -wx, -wy
                if flat[peak[low]] - height >= least:
                    if not is_open[low]:
                        found[count] = peak[low]
                        count += 1
                elif is_open[low] and flat[peak[high]] - height < least:
                    is_open[high] = True
                parent[low] = high
                offset[low, 0], offset[low, 1] = wx, wy
    for point in range(flat.size):
        if parent[point] == point and not is_open[point]:
            found[count] = peak[point]
            count += 1
    return found[:count]
