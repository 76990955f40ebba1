"""Equations for pressures that are uniform over blocks of nodes, on ever coarser lattices."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Real
from roughline.halfspace.inverse import lattice_loops as loops
from roughline.halfspace.inverse.cholesky import Cholesky
from roughline.halfspace.inverse.lattice_loops import GROUP

_COARSEST = 32  # blocks along a side of the lattice whose equations are solved directly
_INVERSES_AT_A_TIME = 2**7  # groups; for fewer, starting a thread does not pay
_SOLUTIONS_AT_A_TIME = 2**10  # groups, likewise


def lattice_shapes(finest: tuple[int, int]) -> list[tuple[int, int]]:
    """Return the blocks along both sides of the finest lattice and of ever coarser ones."""
    shapes = [finest]
    while max(shapes[-1]) > _COARSEST:
        mx, my = shapes[-1]
        shapes.append((-(-mx // GROUP), -(-my // GROUP)))
    return shapes


def lags_for(shapes: Sequence[tuple[int, int]]) -> tuple[int, int]:
    """Return how many distances of the finest lattice's blocks :func:`kernels_on` needs."""
    groups = GROUP ** (len(shapes) - 1)
    return groups * shapes[-1][0], groups * shapes[-1][1]


def kernels_on(shapes: Sequence[tuple[int, int]], kernel: Real) -> tuple[Real, ...]:
    """Return the kernels averaged over the blocks of each lattice, by the distance of two blocks.

    Parameters
    ----------
    shapes : sequence of tuple of int
        Blocks along both sides of each lattice, from :func:`lattice_shapes`.
    kernel : ndarray, shape of lags_for(shapes)
        The kernel averaged over the finest lattice's blocks. [length / pressure]
    """
    kernels = [kernel]
    for _ in shapes[1:]:
        kernel = _group_means(_group_means(kernel).T).T
        kernels.append(kernel)
    return tuple(k[:mx, :my].copy() for k, (mx, my) in zip(kernels, shapes, strict=True))


def _group_means(kernel: Real) -> Real:
    """Average over all pairs of blocks of two groups along the first axis."""
    means = np.zeros((len(kernel) // GROUP, kernel.shape[1]))
    for distance in range(1 - GROUP, GROUP):
        pairs = kernel[abs(GROUP * np.arange(len(means)) + distance)]
        means += (GROUP - abs(distance)) / GROUP**2 * pairs
    return means


class Lattices:
    """Equations for even pressures on blocks, on a lattice of blocks and ever coarser ones.

    The energies of two blocks are those of the kernel averaged over them. The energy of a block by
    itself is given, and is never taken below that, so all matrices are positive definite.

    Parameters
    ----------
    kernels : tuple of ndarray
        For each lattice, the averaged kernel by the distance of two blocks. [length / pressure]
    count : ndarray
        Nodes in each block of the finest lattice.
    energy : ndarray
        Energy of unit pressure on the nodes of each block. [length / pressure]
    """

    def __init__(self, kernels: tuple[Real, ...], count: Real, energy: Real) -> None:
        self._groups: list[_Groups] = []
        for kernel in kernels[:-1]:
            self._groups.append(_Groups(kernel, count, energy))
            count, energy = self._groups[-1].count, self._groups[-1].energy
        self._coarsest = _Coarsest(kernels[-1], count, energy)

    def __call__(self, sums: Real) -> Real:
        """Return the pressure on the nodes of each block, from the sums of their residuals."""
        levels = []
        for groups in self._groups:
            levels.append(groups.details(sums))
            sums = groups.sums(sums)
        pressure = self._coarsest(sums)
        for details in reversed(levels):
            loops.add_groups(pressure, details)
            pressure = details
        return pressure


class _Coarsest:
    """The equations of all blocks of the coarsest lattice, solved in single precision.

    Residuals that are the same on all nodes are taken by themselves, in double precision: they are
    many orders larger than the others where the total of the pressures is fixed.
    """

    def __init__(self, kernel: Real, count: Real, energy: Real) -> None:
        self._shape = count.shape
        self._occupied = np.flatnonzero(count)
        self._count = count.ravel()[self._occupied]
        self._scale = np.empty(self._occupied.size)
        matrix = np.empty((self._occupied.size, self._occupied.size), dtype=np.float32)
        loops.fill_matrix(kernel, count, energy, self._occupied, matrix, self._scale)
        self._factor = Cholesky(matrix)
        self._per_node = 1 / self._count.sum()
        self._even = self._solve(self._count)

    def __call__(self, sums: Real) -> Real:
        """Return the pressure on the nodes of each block, from the sums of their residuals."""
        residual = sums.ravel()[self._occupied]
        mean = residual.sum() * self._per_node
        residual -= mean * self._count
        pressure = np.zeros(self._shape)
        pressure.ravel()[self._occupied] = mean * self._even + self._solve(residual)
        return pressure

    def _solve(self, sums: Real) -> Real:
        """Solve the equations, scaled to the room that single precision has."""
        residual = sums * self._scale
        unit = sqrt(residual @ residual) or 1.0
        return self._factor.solve(residual / unit) * (unit * self._scale)


class _Groups:
    """Groups of the blocks of a lattice, in each of which pressures sum to zero."""

    def __init__(self, kernel: Real, count: Real, energy: Real) -> None:
        self._lattice = tuple(-(-n // GROUP) for n in count.shape)
        self.count = self.sums(count)
        self.energy = np.zeros(self._lattice)
        self._occupied = np.flatnonzero(self.count)
        self._inverses = np.empty((self._occupied.size, GROUP**2, GROUP**2))

        def invert(first: int, last: int) -> None:
            blocks, of_groups = (count, energy), (self._inverses, self.energy)
            loops.invert_groups(kernel, blocks, self._occupied, first, last, *of_groups)

        fft.share_out_blocks(invert, self._occupied.size, _INVERSES_AT_A_TIME)

    def sums(self, values: Real) -> Real:
        """Sum over each group."""
        sums = np.empty(self._lattice)
        loops.sum_groups(values, sums)
        return sums

    def details(self, sums: Real) -> Real:
        """Return the pressures that sum to zero in each group."""
        pressure = np.zeros(sums.shape)

        def solve(first: int, last: int) -> None:
            loops.solve_groups(self._inverses, self._occupied, sums, first, last, pressure)

        fft.share_out_blocks(solve, self._occupied.size, _SOLUTIONS_AT_A_TIME)
        return pressure
