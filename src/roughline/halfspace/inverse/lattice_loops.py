"""Compiled loops over blocks and groups of blocks."""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Floats, Indices, Integers, Real
from roughline.computing.compiled import compiled

GROUP = 4
"""Blocks along a side of a group; a group is one block of the next lattice."""

RIDGE = 1 + 1e-9
"""Factor on diagonals, against rounding."""

RIDGE_IN_SINGLE = 1 + 1e-6
"""The same where matrices come in single precision."""

_BLOCKS = GROUP**2  # of a group


@compiled
def sum_groups(values: Real, sums: Real) -> None:
    """Sum the values of the blocks of each group."""
    sums[:] = 0
    for x in range(values.shape[0]):
        for y in range(values.shape[1]):
            sums[x // GROUP, y // GROUP] += values[x, y]


@compiled
def invert_groups(
    kernel: Real,
    blocks: tuple[Real, Real],
    groups: Indices,
    first: int,
    last: int,
    inverses: Real,
    group_energy: Real,
) -> None:
    """Invert the equations of some groups for pressures that sum to zero in each.

    Parameters
    ----------
    kernel : ndarray
        Averaged kernel by the distance of two blocks. [length / pressure]
    blocks : tuple of ndarray, shape of the lattice
        Nodes in each block, and the energies of the blocks. [length / pressure]
    groups : ndarray of int
        Flat indices of the groups that hold nodes.
    first, last : int
        The groups to do.
    inverses : ndarray, shape (groups, GROUP², GROUP²)
        Overwritten; zero at blocks without nodes.
    group_energy : ndarray, shape of the lattice of groups
        Overwritten at these groups: the energy of unit pressure on their nodes.
    """
    count, energy = blocks
    counts, energies, even = np.empty(_BLOCKS), np.empty(_BLOCKS), np.empty(_BLOCKS)
    near = np.zeros((GROUP, GROUP))
    near[: kernel.shape[0], : kernel.shape[1]] = kernel[:GROUP, :GROUP]
    for g in range(first, last):
        x, y = groups[g] // group_energy.shape[1], groups[g] % group_energy.shape[1]
        gather_group(count, x, y, counts)
        gather_group(energy, x, y, energies)
        matrix, total = inverses[g], 0.0
        for i in range(_BLOCKS):
            for j in range(_BLOCKS):
                kernel_here = near[abs(i // GROUP - j // GROUP), abs(i % GROUP - j % GROUP)]
                matrix[i, j] = counts[i] * counts[j] * kernel_here
            matrix[i, i] = RIDGE * max(matrix[i, i], energies[i])
            for j in range(_BLOCKS):
                total += matrix[i, j]
        group_energy[x, y] = total
        invert_occupied(matrix, counts, even)
        even[:] = 0
        for i in range(_BLOCKS):
            for j in range(_BLOCKS):
                even[j] += matrix[i, j] * counts[i]
        total = 0.0
        for i in range(_BLOCKS):
            total += even[i] * counts[i]
        share = np.divide(1.0, total)
        for i in range(_BLOCKS):
            for j in range(_BLOCKS):
                matrix[i, j] -= share * even[i] * even[j]


@compiled
def gather_group(values: Real, x: int, y: int, gathered: Real) -> None:
    """Collect the values of a group's blocks, zero where it reaches beyond the lattice."""
    for i in range(GROUP):
        for j in range(GROUP):
            row, column = GROUP * x + i, GROUP * y + j
            inside = row < values.shape[0] and column < values.shape[1]
            gathered[GROUP * i + j] = values[row, column] if inside else 0.0


@compiled
def invert_occupied(matrix: Real, counts: Real, pivot_row: Real) -> None:
    """Invert a positive definite matrix in place (Gauss-Jordan), where counts are not zero.

    The result is zero where they are. The last argument is memory for a row.
    """
    for k in range(_BLOCKS):
        if counts[k] == 0:
            for j in range(_BLOCKS):
                matrix[k, j] = 0.0
            continue
        inverse = np.divide(1.0, matrix[k, k])
        matrix[k, k] = 1.0
        for j in range(_BLOCKS):
            pivot_row[j] = matrix[k, j] * inverse
        for i in range(_BLOCKS):
            factor = matrix[i, k]
            matrix[i, k] = 0.0
            for j in range(_BLOCKS):
                matrix[i, j] -= factor * pivot_row[j]
        for j in range(_BLOCKS):
            matrix[k, j] = pivot_row[j]


@compiled
def solve_groups(
    inverses: Real, groups: Indices, sums: Real, first: int, last: int, pressure: Real
) -> None:
    """Write the pressures of some groups that sum to zero in each.

    Parameters
    ----------
    inverses, groups
        As of :func:`invert_groups`.
    sums : ndarray, shape of the lattice
        Residuals, summed over each block.
    first, last : int
        The groups to do.
    pressure : ndarray, shape of the lattice
        Overwritten in these groups.
    """
    across = -(-sums.shape[1] // GROUP)
    gathered, details = np.empty(_BLOCKS), np.empty(_BLOCKS)
    for g in range(first, last):
        x, y = groups[g] // across, groups[g] % across
        gather_group(sums, x, y, gathered)
        details[:] = 0
        for i in range(_BLOCKS):
            for j in range(_BLOCKS):
                details[j] += gathered[i] * inverses[g, i, j]
        for i in range(min(GROUP, sums.shape[0] - GROUP * x)):
            for j in range(min(GROUP, sums.shape[1] - GROUP * y)):
                pressure[GROUP * x + i, GROUP * y + j] = details[GROUP * i + j]


@compiled
def add_groups(values: Real, pressure: Real) -> None:
    """Add to each block the value of its group."""
    for x in range(pressure.shape[0]):
        for y in range(pressure.shape[1]):
            pressure[x, y] += values[x // GROUP, y // GROUP]


@compiled
def fill_matrix(
    kernel: Real, count: Real, energy: Real, occupied: Indices, matrix: Floats, scale: Real
) -> None:
    """Fill the equations of a lattice's blocks, scaled so that the diagonal is one, and a ridge.

    Parameters
    ----------
    kernel : ndarray
        Averaged kernel by the distance of two blocks. [length / pressure]
    count, energy : ndarray, shape of the lattice
        Nodes in each block, and the energies of the blocks. [length / pressure]
    occupied : ndarray of int
        Flat indices of the blocks that hold nodes.
    matrix : ndarray, shape (blocks, blocks)
        Its upper triangle is overwritten.
    scale : ndarray, shape (blocks,)
        Overwritten with the scale of each row and column.
    """
    width = count.shape[1]
    places, nodes = np.empty((2, occupied.size), dtype=np.intp), np.empty(occupied.size)
    for i in range(occupied.size):
        x, y = occupied[i] // width, occupied[i] % width
        places[0, i], places[1, i] = x, y
        own = max(count[x, y] ** 2 * kernel[0, 0], energy[x, y])
        scale[i] = np.divide(1.0, np.sqrt(own))
        nodes[i] = count[x, y] * scale[i]
    x, y = places
    for i in range(occupied.size):
        for j in range(i + 1, occupied.size):
            matrix[i, j] = nodes[i] * nodes[j] * kernel[abs(x[i] - x[j]), abs(y[i] - y[j])]
        matrix[i, i] = RIDGE_IN_SINGLE


@compiled
def fill_direct(kernel: Floats, rows: Integers, columns: Integers, matrix: Real) -> None:
    """Fill the upper triangle of a matrix with the kernel at the distances of nodes."""
    for i in range(rows.size):
        for j in range(i + 1, rows.size):
            matrix[i, j] = kernel[abs(rows[i] - rows[j]), abs(columns[i] - columns[j])]
        matrix[i, i] = RIDGE_IN_SINGLE * kernel[0, 0]
