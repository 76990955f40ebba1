"""The displacement of a grid under pressures, as a fast convolution."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Real
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.operators import loops
from roughline.halfspace.operators.grid_nodes import GridNodes, Precision, unit_in_single
from roughline.halfspace.operators.pair_sums import ROWS_AT_A_TIME, displaced_by_pairs
from roughline.halfspace.operators.workspace import Workspace

_PAIRS = 4.0  # of nodes for each mode, up to which sums over pairs take less time ...
_MANY = 2**20  # ... where there are so many modes
_SPARE = 8  # modes at the end of each row, as caches hold few rows a power of two apart
_SMALL = 2**16  # modes, which a thread transforms before another has begun
_LARGE = 2**22  # points of the padded rows, from which on memory counts


@dataclass(frozen=True, eq=False)
class Convolution:
    """Displacement of the surface under the pressures on a grid, computed by Fourier transforms.

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
        two transforms. The kernel is even in x and y, so the spectrum is real and even, and a
        quarter of it is stored. [length / pressure]
    half_space : HalfSpace or None
        Whose convolution it is; None for another kernel, of which the spectrum is all that there
        is.
    workspace : Workspace
        Memory to work in.
    """

    shape: tuple[int, int]
    spacing: tuple[float, float]
    periods: tuple[int, int]
    spectrum: Real
    half_space: HalfSpace | None = None
    workspace: Workspace = field(default_factory=Workspace, repr=False)

    @property
    def cell_area(self) -> float:
        """Area of one cell. [length²]"""
        return self.spacing[0] * self.spacing[1]

    @property
    def mean_is_free(self) -> bool:
        """Whether displacements count from their mean, so that even pressure displaces nothing."""
        return bool(self.spectrum[0, 0] == 0)

    def _parts(self, precision: Precision) -> int:
        """Return in how many parts modes along y are taken: all, or even ones, then odd ones.

        Double precision needs no more memory than single precision so, where rows are padded.
        """
        padded = self.periods[1] >= 2 * self.shape[1] and self.periods[1] % 2 == 0
        large = self.shape[0] * self.periods[1] > _LARGE
        return 2 if padded and large and precision == "float64" else 1

    def _rows(self, precision: Precision) -> tuple[Any, Any]:
        """Complex rows, two rows of the grid in each, and the same memory as real numbers."""
        shape = (self.shape[0] + 1) // 2, self.periods[1] // self._parts(precision) + _SPARE
        modes = self.workspace.empty(
            "rows", shape, np.complex128 if precision == "float64" else np.complex64
        )
        return modes, modes.view(modes.real.dtype).reshape(*shape, 2)

    def sums_are_cheap(self, sources: int, targets: int) -> bool:
        """Whether sums over pairs take less time than transforms, and no more memory than rows."""
        modes = self.periods[0] * self.periods[1]
        fit = targets <= ROWS_AT_A_TIME * self.shape[1]
        few = sources * targets <= _PAIRS * modes
        free = self.half_space is not None and not self.half_space.periodic
        return free and modes >= _MANY and fit and few

    def displacement(
        self,
        pressure: Real,
        sources: GridNodes,
        targets: GridNodes | None = None,
        precision: Precision = "float64",
        out: Real | None = None,
    ) -> Real:
        """Return the displacement of some nodes, or of all, under the pressure on some nodes.

        Pairs of few nodes are summed over; other displacements are transformed.

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
        if precision == "float32" and (unit := unit_in_single(pressure)) != 1:
            result = self.displacement(pressure / unit, sources, targets, precision, out)
            result *= unit
            return result
        if out is None:
            out = np.empty(self.shape if targets is None else targets.indices.size)
        if targets is not None and self.sums_are_cheap(sources.indices.size, targets.indices.size):
            assert self.half_space is not None
            out[:] = displaced_by_pairs(self.half_space, self.spacing, pressure, sources, targets)
        else:
            out[:] = 0
            for odd in range(self._parts(precision)):
                self._transform(pressure, sources, targets, precision, out, odd)
        return out

    def _transform(
        self,
        pressure: Real,
        sources: GridNodes,
        targets: GridNodes | None,
        precision: Precision,
        result: Real,
        odd: int,
    ) -> None:
        """Add to `result` what all modes along y displace, or the even ones, or the odd ones.

        Rows without pressure or targets are not transformed. Two real rows make one complex row.
        Rows come first, then columns block by block (separate, pad, transform, multiply, transform
        back, crop, join), then rows back. Of long padded rows, even modes are taken first: the
        transform of half the period. Odd ones are that of the row turned by one mode.
        """
        (nx, ny), (mx, my), parts = self.shape, self.periods, self._parts(precision)
        modes, real_modes = self._rows(precision)
        period, spectrum = my // parts, self.spectrum[:, odd::parts]
        rows_out = np.arange(nx) if targets is None else targets.rows
        turns = np.exp(2j * np.pi / my * np.arange(ny)).astype(modes.dtype) if odd else None

        def transform_rows(first: int, last: int) -> None:
            loops.scatter_pairs(pressure, *sources.listed[:2], first, last, real_modes)
            if turns is not None:
                modes[first:last, :ny] *= turns.conj()
            fft.fft_rows(modes[first:last, :period], forward=True)

        def convolve_columns(first: int, last: int) -> None:
            columns = np.empty((mx, last - first), dtype=modes.dtype)
            real_columns = columns.view(real_modes.dtype).reshape(mx, last - first, 2)
            loops.load_columns(real_modes, period, sources.rows, first, odd, real_columns)
            fft.fft_columns(columns, forward=True)
            loops.weigh_columns(real_columns, spectrum, first)
            fft.fft_columns(columns, forward=False)
            loops.store_columns(real_columns, rows_out, first, odd, real_modes, period)

        def transform_rows_back(first: int, last: int) -> None:
            fft.fft_rows(modes[first:last, :period], forward=False)
            if turns is not None:
                modes[first:last, :ny] *= turns
            if targets is None:
                loops.gather_rows(real_modes, first, last, result)
            else:
                loops.gather_pairs(real_modes, *targets.listed[:2], first, last, result)

        at_a_time = max(mx, my) if mx * my <= _SMALL else fft.LINES_AT_A_TIME
        pairs, pairs_out = (sources.rows.size + 1) // 2, (rows_out.size + 1) // 2
        fft.share_out_blocks(transform_rows, pairs, at_a_time)
        fft.share_out_blocks(convolve_columns, spectrum.shape[1], at_a_time)
        fft.share_out_blocks(transform_rows_back, pairs_out, at_a_time)


def displacement_field(operator: Convolution, pressure: Real) -> Real:
    """Return the displacement everywhere under the pressure on each cell, shape (nx, ny)."""
    nodes = np.flatnonzero(pressure)
    return operator.displacement(pressure.flat[nodes], GridNodes.of(nodes, operator.shape))
