"""What the solver needs of an elastic body on a grid: the displacement under given pressures."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Indices, Real
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.operators.loops import list_rows
from roughline.halfspace.operators.restricted_loops import find_runs
from roughline.halfspace.operators.workspace import Workspace

Precision = Literal["float32", "float64"]

_APART = 8  # columns between nodes that belong to one run, at most
_SMALL_IN_SINGLE = 1e-20  # single precision ends at 1e-38, and transforms divide by their size


@dataclass(frozen=True, eq=False)
class GridNodes:
    """Some nodes of a grid, listed row by row.

    Attributes
    ----------
    indices : ndarray of int
        Flat indices in the grid, ascending.
    rows : ndarray of int
        The rows that hold any of the nodes, ascending.
    starts : ndarray of int, shape (len(rows) + 1,)
        Where each of these rows begins in `indices`.
    columns : ndarray of int32
        Column of each node.
    shape : tuple of int
        Points of the grid, (nx, ny).
    """

    indices: Indices
    rows: Indices
    starts: Indices
    columns: NDArray[np.int32]
    shape: tuple[int, int]

    @classmethod
    def of(cls, indices: Indices, shape: tuple[int, int]) -> GridNodes:
        """List the nodes with these ascending flat indices."""
        most = min(shape[0], indices.size)
        rows, starts = np.empty(most, dtype=np.intp), np.empty(most + 1, dtype=np.intp)
        columns = np.empty(indices.size, dtype=np.int32)
        found = list_rows(indices, shape[1], rows, starts, columns)
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

    def rows_of(self, nodes: int) -> int:
        """Return how many of the rows hold so many nodes, about."""
        return 1 + nodes * self.rows.size // max(1, self.indices.size)

    @cached_property
    def runs(self) -> tuple[Indices, NDArray[np.int32]]:
        """Where the runs of neighbouring nodes of each row begin, and the runs.

        For each run: its first node, the node after its last one, and the columns that it takes,
        rounded up to eight.
        """
        most = self.rows.size + int(np.count_nonzero(np.diff(self.columns) > _APART))
        runs = np.empty((most, 3), dtype=np.int32)
        first_run = np.empty(self.rows.size + 1, dtype=np.intp)
        find_runs(self.starts, self.columns, _APART, runs, first_run)
        return first_run, runs[: first_run[-1]].copy()


class Operator(Protocol):
    """Linear map K from the pressures on a grid to the displacements of its nodes, u = K p.

    K is symmetric, and it is a convolution with a kernel that is even in x and in y. Its spectrum
    is therefore real and even, and a quarter of the spectrum says all.
    """

    @property
    def shape(self) -> tuple[int, int]:
        """Points of the grid, (nx, ny)."""

    @property
    def spacing(self) -> tuple[float, float]:
        """Sides of a cell, (dx, dy). [length]"""

    @property
    def cell_area(self) -> float:
        """Area of one cell. [length²]"""

    @property
    def mean_is_free(self) -> bool:
        """Whether displacements count from their mean, so that even pressure displaces nothing."""

    @property
    def half_space(self) -> HalfSpace | None:
        """Whose displacements they are; None for another kernel."""

    @property
    def workspace(self) -> Workspace:
        """Memory to work in."""

    @property
    def periods(self) -> tuple[int, int]:
        """Points after which the convolution repeats itself along x and y."""

    @property
    def spectrum(self) -> Real:
        """Eigenvalues over the product of the periods, for a quarter of the modes.

        The shape is (periods[0] // 2 + 1, periods[1] // 2 + 1). [length / pressure]
        """

    @property
    def least(self) -> float:
        """Least displacement anywhere under unit pressure on one cell. [length / pressure]"""

    def sums_are_cheap(self, sources: int, targets: int) -> bool:
        """Whether to sum over pairs of so many nodes takes less time than to transform the grid."""

    def displacement(
        self,
        pressure: Real,
        sources: GridNodes,
        targets: GridNodes | None = None,
        precision: Precision = "float64",
        out: Real | None = None,
    ) -> Real:
        """Return the displacement of some nodes, or of all, under the pressure on some nodes.

        Parameters
        ----------
        pressure : ndarray
            Pressures on the sources. [pressure]
        sources, targets : GridNodes
            Where the pressure acts, and where the displacement is wanted; None: everywhere.
        precision : {"float64", "float32"}
            Precision of the computation. Single precision errs by some 1e-7 of the largest
            displacement.
        out : ndarray, optional
            Where to write the result.

        Returns
        -------
        ndarray, shape of targets or (nx, ny)
            Displacement. [length]
        """


def unit_in_single(values: Real) -> float:
    """Return in which unit values have room in single precision; 1 unless all are very small."""
    if values.size and abs(values[0]) >= _SMALL_IN_SINGLE:  # no need to look at the others
        return 1.0
    largest = max(float(values.max(initial=0.0)), -float(values.min(initial=0.0)))
    return largest if 0 < largest < _SMALL_IN_SINGLE else 1.0


def displacement_field(operator: Operator, pressure: Real) -> Real:
    """Return u = K p on the whole grid.

    Parameters
    ----------
    operator : Operator
        The map K.
    pressure : ndarray, shape (nx, ny)
        Pressure on each cell. [pressure]

    Returns
    -------
    ndarray, shape (nx, ny)
        Displacement at the centre of each cell. [length]
    """
    nodes = np.flatnonzero(pressure)
    return operator.displacement(pressure.flat[nodes], GridNodes.of(nodes, operator.shape))
