"""Convolutions of whole fields on a small grid, with few calls and no memory of their own."""

from __future__ import annotations

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Floats, Real
from roughline.computing.compiled import compiled


class SmallGrid:
    """Transforms of fields on a grid of few modes, by one thread and in double precision.

    A field has the rows of the grid, each as long as the period; what lies beyond the columns of
    the grid is zero before a convolution, and of no meaning after it.
    """

    def __init__(self, shape: tuple[int, int], periods: tuple[int, int]) -> None:
        self.shape = shape
        self._modes = np.zeros((periods[0], periods[1] // 2 + 1), dtype=np.complex128)
        self._pairs = self._modes.view(np.float64).reshape(*self._modes.shape, 2)
        self._of_rows = self._modes[: shape[0]]
        self._padding = self._modes[shape[0] :]
        self._periods = periods

    @property
    def nbytes(self) -> int:
        """Memory that it holds. [bytes]"""
        return self._modes.nbytes

    def field(self) -> Real:
        """Return a new field of zeros, shape (nx, period along y)."""
        return np.zeros((self.shape[0], self._periods[1]))

    def convolve(self, field: Real, spectrum: Real, result: Real) -> None:
        """Convolve a field with the kernel of a spectrum that is even and given as its quarter."""
        fft.real_rows_forward(field, self._of_rows)
        self._padding[...] = 0
        fft.fft_along(self._modes, 0, forward=True)
        _weigh(self._pairs, spectrum)
        fft.fft_along(self._modes, 0, forward=False)
        fft.real_rows_back(self._of_rows, result)


@compiled
def _weigh(modes: Floats, quarter: Floats) -> None:
    """Multiply modes, q_y >= 0 and as two real numbers each, by a spectrum even along x."""
    period = modes.shape[0]
    for i in range(period):
        row, weights = modes[i], quarter[min(i, period - i)]
        for j in range(row.shape[0]):
            row[j, 0] *= weights[j]
            row[j, 1] *= weights[j]
