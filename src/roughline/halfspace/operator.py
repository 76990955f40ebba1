"""Pressure to surface displacement on a grid, free or periodic: one immutable convolution."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from roughline.computing import fft
from roughline.halfspace import loops
from roughline.halfspace.kernel import love

Field = NDArray[np.float64]
Precision = Literal["float32", "float64"]

_BLOCK = 64  # modes whose columns are transformed at a time: they fit into a core's cache
_PAIRS = 64  # pairs of rows transformed at a time


@dataclass(frozen=True, eq=False)
class Places:
    """Some nodes of a grid, row by row.

    Attributes
    ----------
    nodes : ndarray of int
        Flat indices in the grid, ascending.
    rows : ndarray of int
        The rows that hold any, ascending.
    starts : ndarray of int, shape (len(rows) + 1,)
        Where each row begins in `nodes`.
    columns : ndarray of int32
        Column of each node.
    """

    nodes: NDArray[np.intp]
    rows: NDArray[np.intp]
    starts: NDArray[np.intp]
    columns: NDArray[np.int32]

    @classmethod
    def of(cls, nodes: NDArray[np.intp], shape: tuple[int, int]) -> Places:
        """List nodes, given as ascending flat indices."""
        edges = np.searchsorted(nodes, np.arange(shape[0] + 1) * shape[1])
        rows = np.flatnonzero(np.diff(edges))
        starts = np.append(edges[rows], nodes.size)
        return cls(nodes, rows, starts, (nodes % shape[1]).astype(np.int32))


@dataclass(frozen=True, eq=False)
class Operator:
    """Displacement of the half-space under the pressures on a grid, u = K p.

    The kernel is even in x and y, so its spectrum is real and even: a quarter of it is stored.

    Attributes
    ----------
    shape : tuple of int
        Points of the grid, (nx, ny).
    spacing : tuple of float
        Sides of a cell, (dx, dy). [length]
    periods : tuple of int
        Points of the transform: twice the grid or more (free), the grid itself (periodic).
    spectrum : ndarray, shape (periods[0] // 2 + 1, periods[1] // 2 + 1)
        Eigenvalues of the convolution over ``periods[0] * periods[1]``, the normalisation of the
        two transforms. [length / pressure]
    """

    shape: tuple[int, int]
    spacing: tuple[float, float]
    periods: tuple[int, int]
    spectrum: Field

    @property
    def cell_area(self) -> float:
        """Area of one cell. [length²]"""
        return self.spacing[0] * self.spacing[1]

    @property
    def is_periodic(self) -> bool:
        """Whether displacements are counted from their mean, so that none is under even load."""
        return bool(self.spectrum[0, 0] == 0)

    @cached_property
    def _spectrum_float32(self) -> NDArray[np.float32]:
        return self.spectrum.astype(np.float32)

    @cached_property
    def _rooms(self) -> dict[Precision, tuple[Any, Any]]:
        """Room for the row transforms; single precision takes half of double's once that exists."""
        return {}

    def _room(self, precision: Precision) -> tuple[Any, Any]:
        """Complex rows, two rows of the grid in each, and the same memory as real numbers."""
        if precision not in self._rooms:
            shape = ((self.shape[0] + 1) // 2, self.periods[1])
            if precision == "float64":
                double = np.empty(shape, dtype=np.complex128)
                self._rooms["float64"] = double, double.view(np.float64).reshape(*shape, 2)
                single = double.reshape(-1).view(np.complex64)[: double.size].reshape(shape)
            else:
                single = np.empty(shape, dtype=np.complex64)
            self._rooms["float32"] = single, single.view(np.float32).reshape(*shape, 2)
        return self._rooms[precision]

    def displacement(self, pressure: Field) -> Field:
        """Return u = K p on the whole grid.

        Parameters
        ----------
        pressure : ndarray, shape (nx, ny)
            Pressure on each cell. [pressure]

        Returns
        -------
        ndarray, shape (nx, ny)
            Displacement at the centre of each cell. [length]
        """
        nodes = np.flatnonzero(pressure)
        return self.convolve(pressure.flat[nodes], Places.of(nodes, self.shape))

    def convolve(
        self,
        pressure: Field,
        sources: Places,
        targets: Places | None = None,
        precision: Precision = "float64",
        out: Field | None = None,
    ) -> Field:
        """Displacement at some places, or on the whole grid, from the pressure on some places.

        Rows without pressure are never transformed, nor rows that nobody asks for. Two rows make
        one complex row: rows first, then the columns a block at a time (separate, pad, transform,
        multiply, back, crop, join), then rows.

        Parameters
        ----------
        pressure : ndarray
            Pressures on the sources. [pressure]
        sources, targets : Places
            Where the pressure acts and where the displacement is wanted; None: everywhere.
        precision : {"float64", "float32"}
            Of the transforms; single precision errs by some 1e-7 of the largest displacement.
        out : ndarray, optional
            Where to write the result.

        Returns
        -------
        ndarray, shape of targets or (nx, ny)
            Displacement. [length]
        """
        (nx, ny), (mx, my) = self.shape, self.periods
        spectrum = self._spectrum_float32 if precision == "float32" else self.spectrum
        modes, real_modes = self._room(precision)
        rows_out = np.arange(nx) if targets is None else targets.rows
        if out is None:
            out = np.empty((nx, ny) if targets is None else targets.nodes.size)
        result = out

        def transform_rows(first: int, last: int) -> None:
            loops.scatter_pairs(pressure, sources.starts, sources.columns, first, last, real_modes)
            fft.fft_rows(modes[first:last], forward=True)

        def convolve_columns(first: int, last: int) -> None:
            columns = np.empty((mx, last - first), dtype=modes.dtype)
            real_columns = columns.view(real_modes.dtype).reshape(mx, last - first, 2)
            loops.load_columns(real_modes, sources.rows, first, real_columns)
            fft.fft_columns(columns, forward=True)
            loops.weigh_columns(real_columns, spectrum, first)
            fft.fft_columns(columns, forward=False)
            loops.store_columns(real_columns, rows_out, first, real_modes)

        def transform_rows_back(first: int, last: int) -> None:
            fft.fft_rows(modes[first:last], forward=False)
            if targets is None:
                loops.gather_rows(real_modes, first, last, result)
            else:
                loops.gather_pairs(real_modes, targets.starts, targets.columns, first, last, result)

        _in_blocks(transform_rows, (sources.rows.size + 1) // 2, _PAIRS)
        _in_blocks(convolve_columns, my // 2 + 1, _BLOCK)
        _in_blocks(transform_rows_back, (rows_out.size + 1) // 2, _PAIRS)
        return result


def _in_blocks(work: Callable[[int, int], None], count: int, size: int) -> None:
    fft.share_out(lambda i: work(i * size, min((i + 1) * size, count)), -(-count // size))


def free(shape: tuple[int, int], spacing: tuple[float, float], E_star: float) -> Operator:
    """Half-space loaded on one rectangle and free around it.

    The convolution over twice the rectangle is exact: equal to the dense matrix of
    :func:`roughline.halfspace.kernel.love`.

    Parameters
    ----------
    shape : tuple of int
        Points of the grid, (nx, ny).
    spacing : tuple of float
        Sides of a cell, (dx, dy). [length]
    E_star : float
        Contact modulus E*. [pressure]
    """
    mx, my = fft.good_size(2 * shape[0]), fft.good_size(2 * shape[1])
    dx, dy = spacing
    spectrum = np.empty((mx // 2 + 1, my // 2 + 1))
    offsets_y = dy * np.arange(my // 2 + 1)

    def fill(first: int, last: int) -> None:
        offsets_x = dx * np.arange(first, last)[:, np.newaxis]
        spectrum[first:last] = love(offsets_x, offsets_y, dx, dy)

    _in_blocks(fill, len(spectrum), max(1, 2**16 // len(offsets_y)))
    fft.cosine_spectrum(spectrum)
    spectrum /= E_star * mx * my
    return Operator(shape, spacing, (mx, my), spectrum)


def periodic(shape: tuple[int, int], spacing: tuple[float, float], E_star: float) -> Operator:
    """Half-space loaded periodically; displacements are counted from their mean.

    Each Fourier mode of the pressure displaces the surface by 2 / (E* |q|) times itself
    (Johnson 1985, §13.2); the mode q = 0 is dropped.

    Parameters
    ----------
    shape, spacing, E_star
        As for :func:`free`.
    """
    (nx, ny), (dx, dy) = shape, spacing
    qx = 2 * np.pi / (nx * dx) * np.arange(nx // 2 + 1)[:, np.newaxis]
    qy = 2 * np.pi / (ny * dy) * np.arange(ny // 2 + 1)[np.newaxis, :]
    q = np.hypot(qx, qy)
    q[0, 0] = np.inf
    return Operator(shape, spacing, shape, 2 / (E_star * q) / (nx * ny))
