"""Contact patches: cells in contact that hang together, across periodic borders too."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Mask, Real
from roughline.computing.summary import summary
from roughline.contact.distribution import Distribution, binned
from roughline.halfspace.elasticity.half_space import Periodic, repeated_axes

_WITH_CORNERS = np.ones((3, 3), dtype=int)


@dataclass(frozen=True, eq=False)
class Patches:
    """Connected patches of a contact, the largest first.

    Cells that meet at an edge or at a corner belong to one patch: no fluid passes where two cells
    in contact meet at a corner. On a periodic half-space patches go on across the borders, and on a
    strip across those along which it repeats.

    Attributes
    ----------
    areas : ndarray, shape (count,)
        Area of each patch, its cells counted whole; falling. [length²]
    forces : ndarray, shape (count,)
        Force that each carries. [force]
    centroids : ndarray, shape (count, 2)
        Centre of the area of each, from the corner of the surface; within the surface. Along a
        side that a patch crosses to meet itself it has none: NaN. [length]
    labels : ndarray of int, shape (nx, ny)
        Number of each cell's patch, from 1 for the largest; 0 where the bodies do not touch.
    cell_area : float
        Area of a cell. [length²]
    """

    areas: Real
    forces: Real
    centroids: Real
    labels: NDArray[np.intp]
    cell_area: float

    __repr__ = summary

    @property
    def count(self) -> int:
        """Number of patches."""
        return self.areas.size

    def distribution(self) -> Distribution:
        """Return how the areas of the patches are distributed, each patch counted once.

        The bins reach from 1 to 2, 2 to 4, 4 to 8 cells and so on, the upper end left out; their
        edges lie half a cell lower, between whole numbers of cells.
        """
        largest = round(self.areas[0] / self.cell_area) if self.count else 0  # [cells]
        edges = np.exp2(np.arange(largest.bit_length() + 1.0)) - 0.5
        return binned(self.areas, 0, edges=edges * self.cell_area)


def find_patches(
    contact: Mask, pressure: Real, sizes: tuple[float, float], *, periodic: Periodic
) -> Patches:
    """Return the patches of a contact on a rectangle with these sides, which may repeat."""
    from scipy import ndimage  # here because it loads slowly

    pieces, count = ndimage.label(contact, _WITH_CORNERS)
    patch, turns, winds = _joined(pieces, count, repeated_axes(periodic))
    number = len(winds)
    cell_area = sizes[0] * sizes[1] / contact.size
    cells = np.bincount(pieces.ravel(), minlength=count + 1)[1:]
    forces_by_piece = np.bincount(pieces.ravel(), pressure.ravel(), count + 1)[1:]
    of_patch = np.bincount(patch, cells, number).astype(np.float64)
    forces = np.bincount(patch, forces_by_piece, number).astype(np.float64) * cell_area
    order = np.argsort(-of_patch, kind="stable")
    centroids = np.empty((number, 2))
    for axis, (side, n) in enumerate(zip(sizes, contact.shape, strict=True)):
        # the sum of a piece's places, moved on by whole sides to where its patch goes on
        places = np.arange(n).reshape((-1, 1) if axis == 0 else (1, -1)) + 0.5
        sums = np.bincount(
            pieces.ravel(), np.broadcast_to(places, contact.shape).ravel(), count + 1
        )
        moved = sums[1:] + turns[:, axis] * n * cells
        centroids[:, axis] = np.bincount(patch, moved, number) / of_patch % n * (side / n)
    centroids[winds] = np.nan
    rank = np.empty(number, dtype=np.intp)
    rank[order] = np.arange(1, number + 1)
    return Patches(
        areas=of_patch[order] * cell_area,
        forces=forces[order],
        centroids=centroids[order],
        labels=np.concatenate([[0], rank[patch]])[pieces],
        cell_area=cell_area,
    )


def _joined(
    pieces: NDArray[np.intp], count: int, repeats: tuple[bool, bool]
) -> tuple[NDArray[np.intp], NDArray[np.intp], Mask]:
    """Join pieces across the borders along which a surface repeats.

    Returns the number of each piece's patch, by how many sides (x, y) the piece is moved on to
    meet the others, shape (count, 2), and along which sides each patch meets itself.
    """
    patch = np.full(count, -1, dtype=np.intp)
    turns = np.zeros((count, 2), dtype=np.intp)
    neighbours = defaultdict(list)
    for one, other, *sides in _across_borders(pieces, repeats):
        neighbours[one].append((other, np.array(sides)))
        neighbours[other].append((one, -np.array(sides)))
    winds: list[Mask] = []
    for first in range(count):
        if patch[first] >= 0:
            continue
        patch[first] = len(winds)
        winds.append(np.zeros(2, dtype=bool))
        waiting = [first]
        while waiting:
            piece = waiting.pop()
            for other, turn in neighbours[piece]:
                there = turns[piece] + turn
                if patch[other] < 0:
                    patch[other], turns[other] = patch[piece], there
                    waiting.append(other)
                winds[-1] |= turns[other] != there
    return patch, turns, np.array(winds, dtype=bool).reshape(-1, 2)


def _across_borders(pieces: NDArray[np.intp], repeats: tuple[bool, bool]) -> list[list[int]]:
    """Return which pieces meet across a border, from 0, and by how many sides (x, y) it is."""
    met = [np.empty((0, 4), dtype=np.intp)]
    for axis in np.flatnonzero(repeats).tolist():
        last, next_pieces = np.take(pieces, -1, axis), np.take(pieces, 0, axis)
        for step in (-1, 0, 1):  # along the border: corners meet too
            place = np.arange(last.size) + step
            turn = np.ones((last.size, 2), dtype=np.intp)
            turn[:, 1 - axis] = place // last.size
            pair = np.stack([last, next_pieces[place % last.size]], axis=1) - 1
            meet = (pair >= 0).all(axis=1)
            if not repeats[1 - axis]:  # a corner has none beyond the end of the border
                meet &= turn[:, 1 - axis] == 0
            met.append(np.concatenate([pair, turn], axis=1)[meet])
    return np.unique(np.concatenate(met), axis=0).tolist()
