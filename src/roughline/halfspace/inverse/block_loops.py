"""Compiled loops over contact nodes, band by band; a band is a row of blocks."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from roughline.computing.arrays import Floats, Indices, Integers, Real
from roughline.computing.compiled import compiled


class Layout(NamedTuple):
    """Where contact nodes lie: in a flat grid with margins, and in blocks."""

    bands: Indices  # where in `rows` each band begins, and one more
    blocks: Integers  # of a band, for each column
    # as those of the nodes, and their runs
    rows: Indices
    starts: Indices
    columns: Integers
    first_run: Indices
    runs: Integers
    # place of the first node in the flat grid, and the places from one row to the next
    corner: int
    width: int


@compiled
def count_nodes(at: Layout, first: int, last: int, count: Floats) -> None:
    """Count the nodes of each block of some bands."""
    for band in range(first, last):
        counts = count[band]
        counts[:] = 0
        for i in range(at.starts[at.bands[band]], at.starts[at.bands[band + 1]]):
            counts[at.blocks[at.columns[i]]] += 1


@compiled
def scatter_details(
    values: Real, at: Layout, per_node: Real, first: int, last: int, sums: Real, grid: Floats
) -> None:
    """Write the values of some bands, without their means over blocks, to a flat grid.

    The sums over blocks, of the shape of the lattice, are written, too, in these bands.
    """
    for band in range(first, last):
        total = sums[band]
        total[:] = 0
        for i in range(at.starts[at.bands[band]], at.starts[at.bands[band + 1]]):
            total[at.blocks[at.columns[i]]] += values[i]
        means = total * per_node[band]
        for k in range(at.bands[band], at.bands[band + 1]):
            line = grid[at.corner + at.rows[k] * at.width :]
            for i in range(at.starts[k], at.starts[k + 1]):
                line[at.columns[i]] = values[i] - means[at.blocks[at.columns[i]]]


@compiled
def apply_stencil(
    grid: Floats,
    at: Layout,
    stencil: tuple[Integers, Floats],
    even: tuple[Real, Real],
    first: int,
    last: int,
    result: Real,
) -> None:
    """Apply a stencil at the nodes of some bands, and set the means over blocks.

    The grid is flat, and zero but at the nodes, with margins wider than the stencil by ROUNDING. Of
    the stencil, flat offsets and 1 + 6 n coefficients are given, the central one first; of what is
    even, the means over blocks, and one over the nodes of each block.
    """
    (offsets, taps), (means, per_node) = stencil, even
    sums = np.empty(at.width, dtype=grid.dtype)
    for band in range(first, last):
        totals = np.zeros(means.shape[1])
        for k in range(at.bands[band], at.bands[band + 1]):
            for run in range(at.first_run[k], at.first_run[k + 1]):
                begin, end, length = at.runs[run]
                start = at.columns[begin]
                place = at.corner + at.rows[k] * at.width + start
                total, here, tap = sums[:length], grid[place:], taps[0]
                for j in range(length):
                    total[j] = tap * here[j]
                for m in range(1, offsets.size, 6):
                    t0, t1, t2 = taps[m], taps[m + 1], taps[m + 2]
                    t3, t4, t5 = taps[m + 3], taps[m + 4], taps[m + 5]
                    g0, g1 = grid[place + offsets[m] :], grid[place + offsets[m + 1] :]
                    g2, g3 = grid[place + offsets[m + 2] :], grid[place + offsets[m + 3] :]
                    g4, g5 = grid[place + offsets[m + 4] :], grid[place + offsets[m + 5] :]
                    for j in range(length):
                        total[j] += t0 * g0[j] + t1 * g1[j] + t2 * g2[j]
                        total[j] += t3 * g3[j] + t4 * g4[j] + t5 * g5[j]
                for i in range(begin, end):
                    value = total[at.columns[i] - start]
                    result[i] = value
                    totals[at.blocks[at.columns[i]]] += value
        shifts = means[band] - totals * per_node[band]
        for i in range(at.starts[at.bands[band]], at.starts[at.bands[band + 1]]):
            result[i] += shifts[at.blocks[at.columns[i]]]


@compiled
def fill_triangle(kernel: Floats, rows: Integers, columns: Integers, matrix: Real) -> None:
    """Fill the upper triangle with the kernel at the distances of nodes.

    Its diagonal is raised, as the kernel comes in single precision.
    """
    for i in range(rows.size):
        for j in range(i + 1, rows.size):
            matrix[i, j] = kernel[abs(rows[i] - rows[j]), abs(columns[i] - columns[j])]
        matrix[i, i] = (1 + 1e-6) * kernel[0, 0]
