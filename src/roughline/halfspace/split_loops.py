"""Compiled loops of the split operator."""

from __future__ import annotations

from roughline.computing.arrays import Floats, Integers
from roughline.computing.compiled import compiled


@compiled
def scatter(
    values: Floats, starts: Integers, columns: Integers, rows: Integers, margin: int, grid: Floats
) -> None:
    """Write values to a grid with a margin, or zeros where `values` is empty."""
    for k in range(rows.size):
        line = grid[rows[k] + margin]
        for i in range(starts[k], starts[k + 1]):
            line[columns[i] + margin] = values[i] if values.size else 0.0


@compiled
def spread_along_rows(
    values: Floats,
    starts: Integers,
    columns: Integers,
    weights: Floats,
    first: int,
    last: int,
    lines: Floats,
) -> None:
    """Spread the values of each row over the coarse columns, by splines.

    Parameters
    ----------
    values : ndarray
        Values of all rows, one row after the other.
    starts, columns : ndarray of int
        Where each row begins in `values`; column of each value.
    weights : ndarray, shape (ratio, 4)
        Weights of the four coarse columns around a fine one.
    first, last : int
        The rows to spread.
    lines : ndarray, shape (rows, coarse columns)
        Overwritten.
    """
    ratio = weights.shape[0]
    for k in range(first, last):
        line = lines[k]
        line[:] = 0
        for i in range(starts[k], starts[k + 1]):
            coarse, part = columns[i] // ratio, columns[i] % ratio
            for a in range(4):
                line[coarse + a] += weights[part, a] * values[i]


@compiled
def spread_across_rows(
    lines: Floats, place: Integers, weights: Floats, first: int, last: int, coarse: Floats
) -> None:
    """Spread rows over the coarse rows.

    Parameters
    ----------
    lines : ndarray, shape (rows, coarse columns)
        The rows that hold any value.
    place : ndarray of int, shape (nx,)
        Where in `lines` each row of the grid is; -1 where it holds no value.
    weights : ndarray, shape (ratio, 4)
        Weights of the four coarse rows around a fine one.
    first, last : int
        The coarse rows to fill.
    coarse : ndarray, shape (coarse rows, coarse columns)
        Overwritten.
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
def interpolate_rows(
    coarse: Floats, rows: Integers, weights: Floats, first: int, last: int, lines: Floats
) -> None:
    """Interpolate coarse values at some rows of the grid, between coarse rows only."""
    ratio = weights.shape[0]
    for k in range(first, last):
        row, part = rows[k] // ratio, rows[k] % ratio
        line = lines[k]
        a, b, c, d = coarse[row], coarse[row + 1], coarse[row + 2], coarse[row + 3]
        for j in range(line.size):
            line[j] = (
                weights[part, 0] * a[j]
                + weights[part, 1] * b[j]
                + weights[part, 2] * c[j]
                + weights[part, 3] * d[j]
            )


@compiled
def sum_near_and_far(
    grid: Floats,
    taps: Floats,
    reach: Integers,
    runs: Integers,
    columns: Integers,
    rows: Integers,
    lines: Floats,
    weights: Floats,
    first: int,
    last: int,
    scratch: Floats,
    result: Floats,
) -> None:
    """Add up what near nodes and the coarse grid displace, run by run.

    Parameters
    ----------
    grid : ndarray, shape (nx + 2 margin, ny + 2 margin + 8)
        Pressures, zero where there are none.
    taps : ndarray, shape (2 margin + 1, 2 margin + 4)
        The near part of the kernel, in a margin of zeros.
    reach : ndarray of int, shape (2 margin + 1,)
        How far each row of the near part reaches.
    runs : ndarray of int, shape (runs, 4)
        For each run of neighbouring nodes: index of its row in `rows`, first and last node in
        `columns` (the last one not included), columns spanned.
    columns : ndarray of int
        Column of each node.
    rows : ndarray of int
        Rows that hold nodes.
    lines : ndarray, shape (rows, coarse columns)
        The far part, interpolated at these rows.
    weights : ndarray, shape (ratio, 4)
        Weights of the four coarse columns around a fine one.
    first, last : int
        The runs to do.
    scratch : ndarray
        Room for the longest run.
    result : ndarray
        Displacement of each node.
    """
    margin, ratio = taps.shape[0] // 2, weights.shape[0]
    for k in range(first, last):
        row, begin, end, length = runs[k, 0], runs[k, 1], runs[k, 2], runs[k, 3]
        start = columns[begin]
        total = scratch[:length]
        total[:] = 0
        for di in range(2 * margin + 1):
            line = grid[rows[row] + di]
            for dj in range(margin - reach[di], margin + reach[di] + 1, 4):
                t0, t1, t2, t3 = taps[di, dj], taps[di, dj + 1], taps[di, dj + 2], taps[di, dj + 3]
                p = line[start + dj : start + dj + length + 3]
                for j in range(length):
                    total[j] += t0 * p[j] + t1 * p[j + 1] + t2 * p[j + 2] + t3 * p[j + 3]
        far = lines[row]
        for i in range(begin, end):
            coarse, part = columns[i] // ratio, columns[i] % ratio
            value = total[columns[i] - start]
            for a in range(4):
                value += weights[part, a] * far[coarse + a]
            result[i] = value


@compiled
def find_runs(starts: Integers, columns: Integers, apart: int, runs: Integers) -> int:
    """List runs of nodes of which no two neighbours are further apart; return their number."""
    count = 0
    for row in range(starts.size - 1):
        begin = starts[row]
        for i in range(starts[row], starts[row + 1]):
            if i + 1 == starts[row + 1] or columns[i + 1] - columns[i] > apart:
                runs[count, 0], runs[count, 1], runs[count, 2] = row, begin, i + 1
                runs[count, 3] = (columns[i] - columns[begin] + 8) // 8 * 8
                begin = i + 1
                count += 1
    return count
