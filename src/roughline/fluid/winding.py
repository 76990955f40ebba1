"""How the open parts of a gap that repeats wind round it, by union-find with displacements.

Of two cells that are joined, one keeps by how many periods it lies from the other along the path
between them. An edge that closes a loop of other than no periods shows that its part winds so: only
such parts let a fluid through.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.computing.compiled import compiled

_THREAD_SHARE = 1e-3
"""What joins two cores over what they are made of, below which they hang together by a thread."""


@dataclass(frozen=True, eq=False)
class Windings:
    """Open parts of a gap, and how each of them winds."""

    parts: Indices  # of each cell, (nx, ny); -1 where it is closed
    rank: Indices  # of each part: 0 if it does not wind, 1 along one direction, 2 along all
    direction: Indices  # of each part of rank 1: periods along both sides, (parts, 2)

    @property
    def through(self) -> Mask:
        """Cells of parts that wind."""
        return np.append(self.rank > 0, False)[self.parts]

    def leads(self, axis: int) -> bool:
        """Whether a part winds along a side, be it in a diagonal."""
        return bool(((self.rank == 2) | (self.direction[:, axis] != 0)).any())


def windings(open_cells: Mask, repeats: tuple[bool, bool]) -> Windings:
    """Find the parts of open cells, each beside the next, and how they wind."""
    from scipy.ndimage import label  # here because it loads slowly

    pieces: Indices
    pieces, count = label(open_cells)
    pieces = pieces - 1
    edges = [
        _across_border(np.take(pieces, -1, axis), np.take(pieces, 0, axis), axis)
        for axis in (0, 1)
        if repeats[axis]
    ]
    joined = np.concatenate([np.empty((0, 4), np.int64), *edges])
    roots, rank, direction = _wound(count, joined)
    numbers, parts = np.unique(roots, return_inverse=True)
    of_cells = np.where(pieces >= 0, np.append(parts, -1)[pieces], -1)
    return Windings(of_cells, rank[numbers], direction[numbers])


def leads_through(
    open_cells: Mask, along: Literal["x", "y", "both"], repeats: tuple[bool, bool]
) -> bool:
    """Whether a path of open cells, each beside the next, leads through along a side, or either."""
    if along == "both":
        if all(repeats):
            return bool(windings(open_cells, repeats).rank.any())
        return any(leads_through(open_cells, each, repeats) for each in ("x", "y"))
    k = "xy".index(along)
    if repeats[k]:
        return windings(open_cells, repeats).leads(k)
    from_inlet, from_outlet = joined_to_ends(open_cells if k == 0 else open_cells.T, repeats[1 - k])
    return bool((from_inlet & from_outlet).any())


def joined_to_ends(open_cells: Mask, periodic: bool) -> tuple[Mask, Mask]:
    """Cells from which a path leads to the inlet, and cells from which one leads to the outlet."""
    parts = windings(open_cells, (False, periodic)).parts
    inlet, outlet = (np.isin(parts, border[border >= 0]) for border in (parts[0], parts[-1]))
    return inlet, outlet


def _across_border(last: Indices, first: Indices, axis: int) -> Indices:
    """Pieces that meet across a border, with the periods from one to the other."""
    meet = (last >= 0) & (first >= 0)
    pairs = np.unique(np.stack([last[meet], first[meet]], axis=1), axis=0)
    period = np.zeros_like(pairs)
    period[:, axis] = 1
    return np.concatenate([pairs, period], axis=1)


@compiled
def _root(parent: Indices, shift: Indices, node: int) -> int:
    """Root of a node; its shift is then that from the root, and all on the way hang on the root."""
    root, x, y = node, 0, 0
    while parent[root] != root:
        x += shift[root, 0]
        y += shift[root, 1]
        root = parent[root]
    while parent[node] != root and parent[node] >= 0 and node != root:
        above, dx, dy = parent[node], shift[node, 0], shift[node, 1]
        parent[node], shift[node, 0], shift[node, 1] = root, x, y
        x, y, node = x - dx, y - dy, above
    return root


@compiled
def _wound(count: int, edges: Indices) -> tuple[Indices, Indices, Indices]:
    """Root of each node, and how the part of each root winds: its rank and its direction."""
    parent, shift = np.arange(count), np.zeros((count, 2), np.int64)
    rank, direction = np.zeros(count, np.int64), np.zeros((count, 2), np.int64)
    for edge in range(edges.shape[0]):
        a, b, x, y = edges[edge]
        first, second = _root(parent, shift, a), _root(parent, shift, b)
        x += shift[a, 0] - shift[b, 0]
        y += shift[a, 1] - shift[b, 1]
        if first != second:
            parent[second], shift[second, 0], shift[second, 1] = first, x, y
            x, y = direction[second]
            if rank[second] == 2:
                rank[first] = 2
        if (x != 0 or y != 0) and rank[first] < 2:
            if rank[first] == 0:
                rank[first], direction[first, 0], direction[first, 1] = 1, x, y
            elif direction[first, 0] * y != direction[first, 1] * x:
                rank[first] = 2
    for node in range(count):
        parent[node] = _root(parent, shift, node)
    return parent, rank, direction


@compiled
def _moved(order: Indices, strengths: Real, nx: int, ny: int) -> tuple[Indices, Indices]:
    """Periods by which each cell is moved, and a cell of the place that it belongs to, or -1.

    Of the faces before cells, all along x come first.
    """
    cells = nx * ny
    parent, shift = np.arange(cells), np.zeros((cells, 2), np.int64)
    place, none = np.arange(cells), np.zeros((cells, 2), np.int64)
    winds, core = np.zeros(cells), np.full(cells, -1)
    for face in order:
        cell, strength = face % cells, strengths[face]
        i, j = cell // ny, cell % ny
        x = y = 0
        if face < cells:
            other = (i - 1) % nx * ny + j
            x = int(i == 0)
        else:
            other = i * ny + (j - 1) % ny
            y = int(j == 0)
        first, second = _root(parent, shift, other), _root(parent, shift, cell)
        x += shift[other, 0] - shift[cell, 0]
        y += shift[other, 1] - shift[cell, 1]
        if first != second:
            parent[second], shift[second, 0], shift[second, 1] = first, x, y
            if winds[first] == 0 and winds[second] == 0:
                place[_root(place, none, cell)] = _root(place, none, other)
            elif winds[first] == 0:
                core[first] = core[second]
            elif winds[second] > 0 and strength >= _THREAD_SHARE * max(winds[first], winds[second]):
                place[_root(place, none, core[second])] = _root(place, none, core[first])
            winds[first] = max(winds[first], winds[second])
        elif winds[first] == 0 and (x != 0 or y != 0):
            winds[first], core[first] = strength, cell
    is_core = np.zeros(cells, np.bool_)
    for cell in core:
        if cell >= 0:
            is_core[_root(place, none, cell)] = True
    for cell in range(cells):
        _root(parent, shift, cell)
        root = _root(place, none, cell)
        core[cell] = root if is_core[root] else -1
    return shift, core


@dataclass(frozen=True, eq=False)
class Gauge:
    """Cells moved by whole periods along the strongest tree that joins them.

    That is the tree whose weakest faces are as strong as they can be. So no face of it crosses a
    border, and what crosses is the weakest of a loop: there the pressure of a period falls.

    Attributes
    ----------
    shift : ndarray, shape (nx, ny, 2)
        Periods by which each cell is moved along x and along y.
    cores : ndarray, shape (nx, ny)
        Number of the core that a cell belongs to, -1 of cells beside cores. A core is what winds by
        itself; what joins it later, and more weakly, lies beside it. Two cores that hang together
        by a thread are two, others are one.
    """

    shift: Indices
    cores: Indices

    @classmethod
    def of(cls, along: Real, across: Real) -> Gauge:
        """Move cells by the conductances of the faces before them, (nx, ny) each."""
        strength = np.concatenate([along.ravel(), across.ravel()])
        order = np.flatnonzero(strength > 0)
        order = order[np.argsort(-strength[order], kind="stable")]
        shift, cores = _moved(order, strength, *along.shape)
        return cls(shift.reshape(*along.shape, 2), cores.reshape(along.shape))

    def periods(self, along: Real, across: Real) -> tuple[Indices, Indices]:
        """Periods by which open faces before cells lead on, (2, nx, ny) each."""
        shift = np.moveaxis(self.shift, 2, 0)
        x, y = np.roll(shift, 1, 1) - shift, np.roll(shift, 1, 2) - shift
        x[0, 0] += 1
        y[1, :, 0] += 1
        return np.where(along > 0, x, 0), np.where(across > 0, y, 0)
