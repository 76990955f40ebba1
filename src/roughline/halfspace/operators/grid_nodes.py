"""Nodes of a grid, listed row by row, and the precision of what is computed on them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Indices, InGrid, Integers, Real
from roughline.computing.compiled import compiled

Precision = Literal["float32", "float64"]

RUN_UNIT = 8
"""Columns to which runs of nodes are rounded up, and so the room they need beyond a stencil."""
_SMALL_IN_SINGLE = 1e-20  # single precision ends at 1e-38, and transforms divide by their size


@dataclass(frozen=True, eq=False)
class GridNodes:
    """Some nodes of a grid, listed row by row."""

    indices: InGrid  # ascending
    rows: Indices  # that hold any of the nodes, ascending
    starts: Indices  # where each of these rows begins among the nodes; one more follows
    columns: NDArray[np.int32]  # of each node
    shape: tuple[int, int]  # of the grid

    @classmethod
    def of(cls, indices: InGrid, shape: tuple[int, int]) -> GridNodes:
        """List the nodes with these ascending flat indices."""
        most = min(shape[0], indices.size)
        rows, starts = np.empty(most, dtype=np.intp), np.empty(most + 1, dtype=np.intp)
        columns = np.empty(indices.size, dtype=np.int32)
        found = _list_rows(indices, shape[1], rows, starts, columns)
        return cls(indices, rows[:found], starts[: found + 1], columns, shape)

    @property
    def listed(self) -> tuple[Indices, NDArray[np.int32], Indices]:
        """Starts, columns and rows, for compiled loops."""
        return self.starts, self.columns, self.rows

    @property
    def place_of_rows(self) -> Indices:
        """Where in `rows` each row of the grid is; -1 where it holds no node."""
        place = np.full(self.shape[0], -1)
        place[self.rows] = np.arange(self.rows.size)
        return place

    def rows_holding(self, nodes: int) -> int:
        """Return how many of the rows hold so many nodes, about."""
        return 1 + nodes * self.rows.size // max(1, self.indices.size)

    @cached_property
    def runs(self) -> tuple[Indices, NDArray[np.int32]]:
        """Where the runs of neighbouring nodes of each row begin, and the runs.

        For each run: its first node, the node after its last one, and the columns that it takes,
        rounded up. Neighbours in a run are no further apart than that.
        """
        columns, is_last = self.columns, np.ones(self.columns.size, dtype=bool)
        is_last[:-1] = columns[1:] - columns[:-1] > RUN_UNIT
        is_last[self.starts[1:] - 1] = True
        last = np.flatnonzero(is_last)
        first = np.zeros_like(last)
        first[1:] = last[:-1] + 1
        runs = np.empty((last.size, 3), dtype=np.int32)
        runs[:, 0], runs[:, 1] = first, last + 1
        runs[:, 2] = (columns[last] - columns[first]) // RUN_UNIT * RUN_UNIT + RUN_UNIT
        return first.searchsorted(self.starts), runs


def unit_in_single(values: Real) -> float:
    """Return in which unit values have room in single precision; 1 unless all are very small."""
    if values.size and abs(values[0]) >= _SMALL_IN_SINGLE:  # no need to look at the others
        return 1.0
    largest = max(float(values.max(initial=0.0)), -float(values.min(initial=0.0)))
    return largest if 0 < largest < _SMALL_IN_SINGLE else 1.0


@compiled
def _list_rows(
    indices: Integers, width: int, rows: Integers, starts: Integers, columns: Integers
) -> int:
    """List nodes of ascending flat indices row by row, and return how many rows hold any.

    These rows, where they begin, and the column of each node are written; one more start follows.
    """
    found, begin, end = 0, 0, 0
    for i in range(indices.size):
        if indices[i] >= end:
            row = indices[i] // width
            begin, end = row * width, (row + 1) * width
            rows[found], starts[found] = row, i
            found += 1
        columns[i] = indices[i] - begin
    starts[found] = indices.size
    return found
