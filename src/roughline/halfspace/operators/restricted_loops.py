"""Compiled loops of the operator that is restricted to the contact."""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Floats, Integers
from roughline.computing.compiled import compiled


@compiled
def spread_along_rows(
    values: Floats,
    nodes: tuple[Integers, Integers, Integers],
    weights: Floats,
    block: tuple[int, int],
    grid: Floats,
    margins: tuple[int, int],
    lines: Floats,
) -> None:
    """Write the values of a block of rows to the grid, and spread them over the coarse columns.

    Nodes are starts, columns and rows. Each of the lines gets a row, spread by the weights of the
    four coarse columns around a column, which go by its place between two of them.
    """
    starts, columns, rows = nodes
    ratio = weights.shape[0]
    for k in range(block[0], block[1]):
        places, line = grid[rows[k] + margins[0]], lines[k]
        line[:] = 0
        for i in range(starts[k], starts[k + 1]):
            places[columns[i] + margins[1]] = values[i]
            coarse, part = columns[i] // ratio, columns[i] % ratio
            for a in range(4):
                line[coarse + a] += weights[part, a] * values[i]


@compiled
def clear_runs(
    rows: Integers,
    columns: Integers,
    first_run: Integers,
    runs: Integers,
    grid: Floats,
    margins: tuple[int, int],
) -> None:
    """Set a grid with margins to zero where there are runs of nodes."""
    for k in range(rows.size):
        places = grid[rows[k] + margins[0]]
        for run in range(first_run[k], first_run[k + 1]):
            start = columns[runs[run, 0]] + margins[1]
            places[start : start + runs[run, 2]] = 0


@compiled
def spread_across_rows(
    lines: Floats, place: Integers, weights: Floats, first: int, last: int, coarse: Floats
) -> None:
    """Spread lines, one for each row with values, over the coarse rows from first to last.

    The place of each row of the grid among the lines is -1 where it holds no value. Weights are
    those of the four coarse rows around a row, by its place between two of them.
    """
    ratio = weights.shape[0]
    for row in range(first, last):
        total = coarse[row]
        total[:] = 0
        for i in range(max(0, (row - 3) * ratio), min(place.size, (row + 1) * ratio)):
            if place[i] >= 0:
                weight = weights[i % ratio, row - i // ratio]
                line = lines[place[i]]
                for j in range(line.size):
                    total[j] += weight * line[j]


@compiled
def add_near_and_far(
    grid: Floats,
    margins: tuple[int, int],
    near: tuple[Floats, Integers],
    coarse: Floats,
    weights: tuple[Floats, Floats],
    nodes: tuple[Integers, Integers, Integers, Integers],
    block: tuple[int, int],
    result: Floats,
) -> None:
    """Add what near values and what the coarse grid displace, at each node of a block of rows.

    The near part is the kernel by the distance in cells, each row followed by seven zeros, and the
    columns to which each row of it reaches, to both sides. Weights are those of the coarse rows and
    columns. Nodes are rows, columns, where the runs of each row begin, and the runs.
    """
    rows, columns, first_run, runs = nodes
    ratio, radius = weights[1].shape[0], near[0].shape[0] // 2
    far, sums = np.empty_like(coarse[0]), np.empty_like(grid[0])
    flat, width = grid.reshape(-1), grid.shape[1]
    for k in range(block[0], block[1]):
        _interpolate_row(coarse, weights[0], rows[k], far)
        above = (rows[k] + margins[0] - radius) * width
        for run in range(first_run[k], first_run[k + 1]):
            begin, end, length = runs[run]
            start = columns[begin]
            _sum_near(flat[above + start :], width, margins[1], near, sums[:length])
            for i in range(begin, end):
                column, part = columns[i] // ratio, columns[i] % ratio
                value = sums[columns[i] - start]
                for a in range(4):
                    value += weights[1][part, a] * far[column + a]
                result[i] = value


@compiled
def _interpolate_row(coarse: Floats, weights: Floats, row: int, far: Floats) -> None:
    """Interpolate between coarse rows, for all coarse columns."""
    ratio = weights.shape[0]
    above, part = row // ratio, row % ratio
    c0, c1, c2, c3 = coarse[above], coarse[above + 1], coarse[above + 2], coarse[above + 3]
    w0, w1, w2, w3 = weights[part]
    for j in range(far.size):
        far[j] = w0 * c0[j] + w1 * c1[j] + w2 * c2[j] + w3 * c3[j]


@compiled
def _sum_near(
    flat: Floats, width: int, margin: int, near: tuple[Floats, Integers], sums: Floats
) -> None:
    """Sum the near part over a run, from the first row that it reaches on."""
    taps, reach = near
    across = (taps.shape[1] - 8) // 2
    sums[:] = 0
    for di in range(taps.shape[0]):
        groups = (2 * reach[di] + 8) // 8  # of eight taps
        at = di * width + margin - reach[di]
        line, tap = flat[at : at + 8 * groups + sums.size], taps[di, across - reach[di] :]
        for g in range(0, 8 * groups, 8):
            t0, t1, t2, t3 = tap[g], tap[g + 1], tap[g + 2], tap[g + 3]
            t4, t5, t6, t7 = tap[g + 4], tap[g + 5], tap[g + 6], tap[g + 7]
            p = line[g:]
            for j in range(sums.size):  # summed in pairs, which need not wait for each other
                sums[j] += ((t0 * p[j] + t1 * p[j + 1]) + (t2 * p[j + 2] + t3 * p[j + 3])) + (
                    (t4 * p[j + 4] + t5 * p[j + 5]) + (t6 * p[j + 6] + t7 * p[j + 7])
                )
