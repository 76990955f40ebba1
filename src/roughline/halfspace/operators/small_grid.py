"""Convolutions of whole fields on a small grid, in single precision and by one thread."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Real, Single
from roughline.halfspace.operators.workspace import Workspace

_SPARE = 8  # values at the end of each row, as caches hold few rows a power of two apart


@dataclass(frozen=True, eq=False)
class SmallGrid:
    """A convolution by real transforms; on small grids, calls cost more than the work in them.

    Attributes
    ----------
    shape : tuple of int
        Points of the grid, (nx, ny).
    periods : tuple of int
        Points of the transform.
    spectrum : ndarray, shape (periods[0], periods[1] // 2 + 1)
        Eigenvalues over ``periods[0] * periods[1]``.
    workspace : Workspace
        Memory to work in.
    """

    shape: tuple[int, int]
    periods: tuple[int, int]
    spectrum: Single
    workspace: Workspace

    @classmethod
    def of(
        cls,
        shape: tuple[int, int],
        periods: tuple[int, int],
        quarter: Real,
        workspace: Workspace,
    ) -> SmallGrid:
        """Take an even spectrum of which a quarter is given."""
        modes = np.arange(periods[0])
        half = quarter[np.minimum(modes, periods[0] - modes)]
        return cls(shape, periods, half.astype(np.float32), workspace)

    def convolved(self, field: Single, out: Single) -> Single:
        """Write the convolution of a field on the whole grid to `out`, and return that."""
        (nx, ny), my = self.shape, self.periods[1]
        rows = self.workspace.empty("small rows", (nx, my + _SPARE), np.float32)[:, :my]
        modes = self.workspace.empty("small modes", self.spectrum.shape, np.complex64)
        rows[:, :ny] = field
        rows[:, ny:] = 0
        fft.real_rows(rows, modes[:nx])
        modes[nx:] = 0
        fft.fft_columns(modes, forward=True)
        np.multiply(modes, self.spectrum, out=modes)
        fft.fft_columns(modes, forward=False)
        fft.real_rows_back(modes[:nx], rows)
        out[:] = rows[:, :ny]
        return out
