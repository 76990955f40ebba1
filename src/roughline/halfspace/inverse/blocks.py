"""Equations for the pressures on few nodes, and for even pressures on blocks of nodes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import sqrt

import numpy as np
from scipy.linalg import blas, lapack

from roughline.computing import fft
from roughline.computing.arrays import Floats, Integers, Real
from roughline.computing.compiled import compiled

MOST_DENSE = 500
"""Nodes, or blocks, whose equations are solved directly; of more blocks, by a convolution."""

_RIDGE = 1 + 1e-6  # factor on diagonals, against rounding in single precision
_LEAST = 0.1  # eigenvalue of a kernel of blocks over the median; cut short, it may have others


@dataclass(frozen=True, eq=False)
class BlockKernel:
    """The kernel averaged over blocks.

    Attributes
    ----------
    values : ndarray, shape of the lattice of blocks
        Displacement of a node by the pressure on another, averaged over the blocks of the two, by
        the distance of these blocks. [length / pressure]
    periodic : bool
        Whether the lattice repeats itself.
    """

    values: Real
    periodic: bool

    @cached_property
    def periods(self) -> tuple[int, int]:
        """Blocks after which the inverse convolution repeats itself."""
        mx, my = self.values.shape
        return (mx, my) if self.periodic else (max(1, 2 * mx - 2), max(1, 2 * my - 2))

    @cached_property
    def inverse(self) -> Real:
        """Half of the eigenvalues of the inverse, over the product of the periods."""
        x, y = (np.minimum(np.arange(n), -np.arange(n) % n) for n in self.periods)
        spectrum = fft.half_spectrum(self.values[x[:, np.newaxis], y]).real
        return 1 / (np.maximum(spectrum, _LEAST * np.median(spectrum)) * x.size * y.size)


def even_on_blocks(kernel: BlockKernel, count: Real, energy: Real) -> Callable[[Real], Real]:
    """Return what gives even pressures on blocks from the sums of the residuals of their nodes.

    Parameters
    ----------
    kernel : BlockKernel
        Averaged kernel.
    count : ndarray, shape of the lattice
        Nodes in each block.
    energy : ndarray, shape of the lattice
        Energy of unit pressure on them. [length / pressure]
    """
    occupied = np.flatnonzero(count)
    if occupied.size > MOST_DENSE:
        return _convolved(kernel, count, energy)
    rows, columns = np.divmod(occupied, count.shape[1])
    dense = Dense(kernel.values, rows, columns, count.flat[occupied], energy.flat[occupied])

    def solve(sums: Real) -> Real:
        pressure = np.zeros(count.shape)
        pressure.flat[occupied] = dense(sums.flat[occupied])
        return pressure

    return solve


def _convolved(kernel: BlockKernel, count: Real, energy: Real) -> Callable[[Real], Real]:
    """Solve for the pressures as if all blocks were full; each counts by its own energy."""
    (mx, my), periods, full = count.shape, kernel.periods, kernel.values[0, 0]
    occupied, per_node = count > 0, np.zeros(count.shape)
    per_node[occupied] = np.sqrt(full / _own_energy(energy[occupied], count[occupied], full))

    def solve(sums: Real) -> Real:
        padded = np.zeros(periods)
        padded[:mx, :my] = sums * per_node
        modes = fft.half_spectrum(padded) * kernel.inverse
        return fft.synthesise(modes, periods[1])[:mx, :my] * per_node

    return solve


class Dense:
    """The equations of few nodes or blocks, solved in single precision.

    Residuals that are the same on all nodes are taken by themselves, in double precision: they are
    many orders larger than the others where the total of the pressures is fixed.

    Parameters
    ----------
    kernel : ndarray
        Kernel of nodes, or of blocks, by the distance of two. [length / pressure]
    rows, columns : ndarray of int
        Where they are.
    count : ndarray
        Nodes in each block; one of a node.
    energy : ndarray
        Energy of unit pressure on these; never taken below that of the averaged kernel, so that the
        matrix is positive definite. [length / pressure]
    """

    def __init__(
        self, kernel: Floats, rows: Integers, columns: Integers, count: Real, energy: Real
    ) -> None:
        self._count = count
        self._scale = 1 / np.sqrt(_own_energy(energy, count, kernel[0, 0]))
        matrix = np.empty((count.size, count.size), dtype=np.float32)
        _fill_matrix(kernel, rows, columns, count * self._scale, matrix)
        # LAPACK and BLAS without detours: there are many such matrices, and most are small
        self._factor, failed = lapack.spotrf(matrix.T, lower=1, clean=0, overwrite_a=1)
        if failed:
            raise np.linalg.LinAlgError("the matrix is not positive definite")
        self._even = self._solve(count) if count.size else count

    def __call__(self, sums: Real) -> Real:
        """Return the pressure on the nodes of each block, from the sums of their residuals."""
        if not sums.size:
            return sums
        mean = sums.sum() / self._count.sum()
        return mean * self._even + self._solve(sums - mean * self._count)

    def _solve(self, sums: Real) -> Real:
        """Solve the equations, scaled to the room that single precision has."""
        residual = sums * self._scale
        unit = sqrt(residual @ residual) or 1.0
        half = blas.strsv(self._factor, residual / unit, lower=1)
        solution = blas.strsv(self._factor, half, lower=1, trans=1, overwrite_x=1)
        return solution * (unit * self._scale)


def _own_energy(energy: Real, count: Real, kernel: float) -> Real:
    """Return the energies of blocks by themselves, at least those of the averaged kernel."""
    own = np.maximum(energy, count**2 * kernel)
    if not own.min(initial=np.inf) > 0:
        raise np.linalg.LinAlgError("the half-space is not positive definite")
    return own


@compiled
def _fill_matrix(
    kernel: Floats, rows: Integers, columns: Integers, weights: Real, matrix: Floats
) -> None:
    """Fill the upper triangle with the weighted kernel; the diagonal is one, and a ridge."""
    for i in range(rows.size):
        for j in range(i + 1, rows.size):
            apart = kernel[abs(rows[i] - rows[j]), abs(columns[i] - columns[j])]
            matrix[i, j] = weights[i] * weights[j] * apart
        matrix[i, i] = _RIDGE
