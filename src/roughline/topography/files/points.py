"""Lists of points in text: x z along a line, or x y z on a regular grid with or without gaps."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Mask, Real
from roughline.errors import InputError
from roughline.topography.files.text import is_even

_Indices = NDArray[np.intp]

_NEAR = 0.15  # of a step: positions nearer to each other are one, and nearer to a node are on it
_SPARSE = 20  # nodes of the grid for each point of a list, at most


def line_of(x: Real, z: Real, name: str) -> tuple[Real, Real | None, float]:
    """Return the heights of a line in order, the positions if they are uneven, and the length."""
    if x.size < 2:
        raise InputError(f"{name} lists {x.size} point: at least 2 are needed; it was cut short")
    if x[0] > x[-1]:
        x, z = x[::-1], z[::-1]
    steps = np.diff(x)
    if not (steps > 0).all():
        i = int((steps <= 0).argmax())
        raise InputError(
            f"{name} lists positions that do not rise from point to point: {x[i]:g} stands before "
            f"{x[i + 1]:g}; a line scan has each position once, in order"
        )
    if is_even(x):
        return z, None, float((x[-1] - x[0]) / (x.size - 1) * x.size)
    return z, x, float(x[-1] - x[0])


def map_of(x: Real, y: Real, z: Real, name: str) -> tuple[Real, tuple[float, float]]:
    """Return the heights of a list of points on their grid, and the sides of the map.

    Nodes of the grid that the list leaves out are NaN.

    Refused are points on no regular grid, two heights at one place, and a last row that alone lacks
    its end, as in a file that was cut short.
    """
    (i, dx), (j, dy) = (_nodes(positions, name, axis) for positions, axis in ((x, "x"), (y, "y")))
    if dx == 0 or dy == 0:
        raise _irregular(name, "they have one position along a side")
    shape = (int(i.max()) + 1, int(j.max()) + 1)
    if shape[0] * shape[1] > _SPARSE * z.size:
        raise _irregular(name, f"{z.size} points would lie on a grid of {shape[0]} x {shape[1]}")
    heights = np.full(shape, np.nan)
    heights[i, j] = z
    twice = ~((heights[i, j] == z) | np.isnan(z))
    if twice.any():
        k = int(twice.argmax())
        raise InputError(
            f"{name} lists two heights at x = {x[k]:g}, y = {y[k]:g}: delete one of them"
        )
    listed = np.zeros(shape, dtype=bool)
    listed[i, j] = True
    if not listed.all():
        _refuse_cut_list(i, j, listed, name)
    return heights, (dx * shape[0], dy * shape[1])


def is_grid(x: Real, y: Real) -> bool:
    """Whether points lie on a regular grid, one at nearly each node."""
    try:
        (i, _), (j, _) = _nodes(x, "", "x"), _nodes(y, "", "y")
    except InputError:
        return False
    columns, rows = int(i.max()) + 1, int(j.max()) + 1
    return min(columns, rows) > 1 and x.size <= columns * rows < 1.2 * x.size


def _nodes(positions: Real, name: str, axis: str) -> tuple[_Indices, float]:
    """The node of each position along an axis, from 0, and the distance of nodes."""
    values, inverse = np.unique(positions, return_inverse=True)
    gaps = np.diff(values)
    if not gaps.size:
        return np.zeros(positions.size, np.intp), 0.0
    # rounding makes gaps far smaller than the steps between columns
    is_step = gaps > _NEAR * np.median(gaps[gaps > 0.1 * gaps.max()])
    column = np.concatenate([[0], np.cumsum(is_step)])
    centres = np.bincount(column, values) / np.bincount(column)
    steps = np.diff(centres)
    nodes = np.concatenate([[0], np.cumsum(np.rint(steps / np.median(steps)))])
    if nodes.size > 2:
        step = float(np.polyfit(nodes, centres, 1)[0]) if nodes[-1] else 0.0
    else:
        step = float(steps[0])
    offsets = values - centres[0] - step * nodes[column]
    if step <= 0 or (np.diff(nodes) < 1).any() or np.ptp(offsets) > 2 * _NEAR * step:
        raise _irregular(name, f"positions along {axis} are {gaps.min():.3g} to {gaps.max():.3g}")
    return nodes.astype(np.intp)[column][inverse], step


def _irregular(name: str, why: str) -> InputError:
    return InputError(
        f"{name} lists points that lie on no regular grid ({why}): interpolate them to one first"
    )


def _refuse_cut_list(i: _Indices, j: _Indices, listed: Mask, name: str) -> None:
    """Refuse a list whose last row alone, in the order of the file, lacks its end."""
    rising = [bool((np.diff(each) >= 0).all() or (np.diff(each) <= 0).all()) for each in (i, j)]
    if not any(rising):
        return  # in no order that an instrument measures in
    slow, fast, rows = (i, j, listed) if rising[0] else (j, i, listed.T)
    others = np.delete(rows, slow[-1], axis=0)
    in_last, before = fast[slow == slow[-1]], fast[slow != slow[-1]]
    last_two = in_last if in_last.size > 1 or before.size < 2 else before
    rises = last_two.size < 2 or last_two[1] > last_two[0]
    end = rows.shape[1] - 1 if rises else 0
    if in_last[-1] != end and others.size and others[:, end].all():
        raise InputError(
            f"{name} ends within a row of its grid of {listed.shape[0]} x {listed.shape[1]} "
            "points, as a file that was cut short: export it again, or list missing points as NaN"
        )
