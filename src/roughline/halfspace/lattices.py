"""Equations for pressures that are even over blocks of nodes, on ever coarser lattices."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from roughline.computing.arrays import Real

GROUP = 4
"""Blocks along a side of a group; a group is one block of the next lattice."""

_COARSEST = 32  # blocks along a side of the lattice whose equations are solved directly
_RIDGE = 1 + 1e-9  # factor on diagonals, against rounding


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
        self._occupied = np.flatnonzero(count)
        x, y = np.divmod(self._occupied, count.shape[1])
        matrix = kernels[-1][abs(x[:, np.newaxis] - x), abs(y[:, np.newaxis] - y)]
        weights = count.ravel()[self._occupied]
        matrix *= weights[:, np.newaxis] * weights
        set_diagonal(matrix, energy.ravel()[self._occupied])
        self._factor = cho_factor(matrix, overwrite_a=True, check_finite=False)
        self._shape = count.shape

    def __call__(self, sums: Real) -> Real:
        """Return the pressure on the nodes of each block, from the sums of their residuals."""
        levels = []
        for groups in self._groups:
            levels.append(groups.details(sums))
            sums = groups.sums(sums)
        pressure = np.zeros(self._shape)
        pressure.flat[self._occupied] = cho_solve(
            self._factor, sums.ravel()[self._occupied], check_finite=False
        )
        for details in reversed(levels):
            nx, ny = details.shape
            pressure = np.repeat(np.repeat(pressure, GROUP, axis=0), GROUP, axis=1)[:nx, :ny]
            pressure = pressure + details
        return pressure


class _Groups:
    """Groups of the blocks of a lattice, in each of which pressures sum to zero."""

    def __init__(self, kernel: Real, count: Real, energy: Real) -> None:
        self._shape = count.shape
        self._lattice = tuple(-(-n // GROUP) for n in count.shape)
        counts, energies = self._grouped(count), self._grouped(energy)
        near = np.zeros((GROUP, GROUP))
        near[: kernel.shape[0], : kernel.shape[1]] = kernel[:GROUP, :GROUP]
        x, y = np.divmod(np.arange(GROUP**2), GROUP)
        matrices = counts[:, :, np.newaxis] * counts[:, np.newaxis, :]
        matrices *= near[abs(x[:, np.newaxis] - x), abs(y[:, np.newaxis] - y)]
        set_diagonal(matrices, energies)
        self.count = counts.sum(axis=1).reshape(self._lattice)
        self.energy = matrices.sum(axis=(1, 2)).reshape(self._lattice)
        set_diagonal(matrices, np.where(counts == 0, 1.0, energies))  # no node: any number
        self._inverses = np.linalg.inv(matrices)
        even = np.einsum("gij,gj->gi", self._inverses, counts)
        total = np.maximum(np.einsum("gi,gi->g", even, counts), 1e-300)
        even /= np.sqrt(total)[:, np.newaxis]
        self._inverses -= even[:, :, np.newaxis] * even[:, np.newaxis, :]

    def _grouped(self, values: Real) -> Real:
        """Rearrange a lattice to groups, zero where they reach beyond it."""
        padding = [(0, m * GROUP - n) for m, n in zip(self._lattice, self._shape, strict=True)]
        padded = np.pad(values, padding)
        split = padded.reshape(self._lattice[0], GROUP, self._lattice[1], GROUP)
        return split.transpose(0, 2, 1, 3).reshape(-1, GROUP**2)

    def sums(self, values: Real) -> Real:
        """Sum over each group."""
        return self._grouped(values).sum(axis=1).reshape(self._lattice)

    def details(self, sums: Real) -> Real:
        """Return the pressures that sum to zero in each group."""
        pressure = np.einsum("gij,gj->gi", self._inverses, self._grouped(sums))
        (mx, my), (nx, ny) = self._lattice, self._shape
        split = pressure.reshape(mx, my, GROUP, GROUP).transpose(0, 2, 1, 3)
        return split.reshape(mx * GROUP, my * GROUP)[:nx, :ny]


def set_diagonal(matrices: Real, energies: Real) -> None:
    """Set the last two axes' diagonal to the energies, or to what is there where that is more."""
    diagonal = np.arange(matrices.shape[-1])
    matrices[..., diagonal, diagonal] = _RIDGE * np.maximum(
        matrices[..., diagonal, diagonal], energies
    )
