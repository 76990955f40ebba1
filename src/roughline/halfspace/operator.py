"""Pressure to surface displacement on a grid, free or periodic: one immutable convolution."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from roughline import fft
from roughline.halfspace.kernel import love

_BLOCK = 2**19  # complex numbers held at once while the columns are transformed


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
    spectrum: NDArray[np.float64]

    @property
    def cell_area(self) -> float:
        """Area of one cell. [length²]"""
        return self.spacing[0] * self.spacing[1]

    @cached_property
    def all_rows(self) -> NDArray[np.intp]:
        """Indices of every row of the grid."""
        return np.arange(self.shape[0])

    def displacement(self, pressure: NDArray[np.float64]) -> NDArray[np.float64]:
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
        return self.convolve(pressure, self.all_rows, self.all_rows)

    def convolve(
        self,
        pressure_rows: NDArray[np.float64],
        rows_in: NDArray[np.intp],
        rows_out: NDArray[np.intp],
    ) -> NDArray[np.float64]:
        """Displacement on some rows of the grid from the pressure on some rows.

        Rows without pressure are never transformed, nor rows that nobody asks for: rows first,
        then the columns a block at a time (pad, transform, multiply, back, crop), then rows.

        Parameters
        ----------
        pressure_rows : ndarray, shape (len(rows_in), ny)
            The rows that carry pressure. [pressure]
        rows_in, rows_out : ndarray of int
            Their indices in the grid, and the indices of the rows wanted.

        Returns
        -------
        ndarray, shape (len(rows_out), ny)
            Displacement. [length]
        """
        (_, ny), (mx, my) = self.shape, self.periods
        padded = pressure_rows
        if my > ny:
            padded = np.zeros((len(rows_in), my))
            padded[:, :ny] = pressure_rows
        modes_in = fft.rfft_rows(padded)
        modes_out = np.empty((len(rows_out), my // 2 + 1), dtype=np.complex128)
        width = max(64, _BLOCK // mx)
        for start in range(0, my // 2 + 1, width):
            block = slice(start, min(start + width, my // 2 + 1))
            columns = np.zeros((mx, block.stop - start), dtype=np.complex128)
            columns[rows_in] = modes_in[:, block]
            columns = fft.fft_columns(columns, forward=True)
            columns[: mx // 2 + 1] *= self.spectrum[:, block]
            columns[mx // 2 + 1 :] *= self.spectrum[(mx - 1) // 2 : 0 : -1, block]
            columns = fft.fft_columns(columns, forward=False)
            modes_out[:, block] = columns[rows_out]
        return fft.irfft_rows(modes_out, my)[:, :ny]


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
    offsets_x = dx * np.arange(mx // 2 + 1)[:, np.newaxis]
    offsets_y = dy * np.arange(my // 2 + 1)[np.newaxis, :]
    kernel = love(offsets_x, offsets_y, dx, dy)
    spectrum = fft.cosine_spectrum(kernel) / (E_star * mx * my)
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
