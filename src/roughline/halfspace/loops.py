"""Compiled loops; they know arrays only."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roughline.computing.compiled import compiled

Real = NDArray[np.floating]
Indices = NDArray[np.integer]


@compiled
def scatter_pairs(
    values: Real, starts: Indices, columns: Indices, first: int, last: int, pairs: Real
) -> None:
    """Write the values of two rows each into the real and imaginary parts of one complex row.

    Parameters
    ----------
    values : ndarray
        Values of all rows, one row after the other.
    starts, columns : ndarray of int
        Where each row begins in `values`; column of each value.
    first, last : int
        The pairs to fill.
    pairs : ndarray, shape (pairs, period, 2)
        Overwritten, zero where there are no values.
    """
    for pair in range(first, last):
        pairs[pair] = 0
        for part in range(2):
            row = 2 * pair + part
            if row + 1 < starts.size:
                for i in range(starts[row], starts[row + 1]):
                    pairs[pair, columns[i], part] = values[i]


@compiled
def gather_pairs(
    pairs: Real, starts: Indices, columns: Indices, first: int, last: int, values: Real
) -> None:
    """Read the values back that belong to the places of some rows; undoes scatter_pairs."""
    for row in range(2 * first, min(2 * last, starts.size - 1)):
        for i in range(starts[row], starts[row + 1]):
            values[i] = pairs[row // 2, columns[i], row % 2]


@compiled
def gather_rows(pairs: Real, first: int, last: int, field: Real) -> None:
    """Read whole rows back, cropped to the field."""
    for row in range(2 * first, min(2 * last, field.shape[0])):
        for column in range(field.shape[1]):
            field[row, column] = pairs[row // 2, column, row % 2]


@compiled
def load_columns(pairs: Real, rows: Indices, first: int, columns: Real) -> None:
    """Separate two real rows from each complex one, for a block of modes, and pad with zeros.

    A = (Z(k) + Z(-k)*) / 2 and B = (Z(k) - Z(-k)*) / 2i are the spectra of the real and imaginary
    parts of z. All complex numbers come as two real ones.

    Parameters
    ----------
    pairs : ndarray, shape (pairs, period, 2)
        Transformed rows.
    rows : ndarray of int
        Where in the columns each of the real rows belongs.
    first : int
        The mode of the block's first column.
    columns : ndarray, shape (padded rows, modes, 2)
        Overwritten.
    """
    period = pairs.shape[1]
    half = pairs.dtype.type(0.5)
    columns[:] = 0
    for pair in range((rows.size + 1) // 2):
        z = pairs[pair]
        a = columns[rows[2 * pair]]
        for j in range(columns.shape[1]):
            mirror = period - first - j if first + j else 0
            a[j, 0] = half * (z[first + j, 0] + z[mirror, 0])
            a[j, 1] = half * (z[first + j, 1] - z[mirror, 1])
        if 2 * pair + 1 < rows.size:
            b = columns[rows[2 * pair + 1]]
            for j in range(columns.shape[1]):
                mirror = period - first - j if first + j else 0
                b[j, 0] = half * (z[first + j, 1] + z[mirror, 1])
                b[j, 1] = half * (z[mirror, 0] - z[first + j, 0])


@compiled
def weigh_columns(columns: Real, quarter: Real, first: int) -> None:
    """Multiply a block of modes by an even spectrum of which a quarter is given."""
    period = columns.shape[0]
    for i in range(period):
        weights = quarter[min(i, period - i)]
        row = columns[i]
        for j in range(row.shape[0]):
            row[j, 0] *= weights[first + j]
            row[j, 1] *= weights[first + j]


@compiled
def store_columns(columns: Real, rows: Indices, first: int, pairs: Real) -> None:
    """Join two rows into each complex one; undoes load_columns, for the rows wanted."""
    period = pairs.shape[1]
    for pair in range((rows.size + 1) // 2):
        z = pairs[pair]
        a = columns[rows[2 * pair]]
        if 2 * pair + 1 < rows.size:
            b = columns[rows[2 * pair + 1]]
            for j in range(columns.shape[1]):
                mirror = period - first - j if first + j else 0
                z[mirror, 0] = a[j, 0] + b[j, 1]
                z[mirror, 1] = b[j, 0] - a[j, 1]
                z[first + j, 0] = a[j, 0] - b[j, 1]
                z[first + j, 1] = a[j, 1] + b[j, 0]
        else:
            for j in range(columns.shape[1]):
                mirror = period - first - j if first + j else 0
                z[mirror, 0] = a[j, 0]
                z[mirror, 1] = -a[j, 1]
                z[first + j, 0] = a[j, 0]
                z[first + j, 1] = a[j, 1]


@compiled
def sum_blocks(values: Real, block: Indices, sums: Real) -> None:
    """Sum the values of the nodes of each block."""
    sums[:] = 0
    for i in range(values.size):
        sums[block[i]] += values[i]


@compiled
def undo_details(
    residual: Real,
    places: Indices,
    block: Indices,
    means: Real,
    grid: Real,
    offsets: Indices,
    taps: Real,
    result: Real,
    sums: Real,
) -> None:
    """Apply a stencil to what is left of a residual without its means over blocks.

    Parameters
    ----------
    residual : ndarray, shape (nodes,)
        Values on the contact nodes.
    places, block : ndarray of int, shape (nodes,)
        Where each node lies in `grid`, and the block to which it belongs.
    means : ndarray, shape (blocks,)
        Mean of the residual over each block's nodes.
    grid : ndarray
        A flat grid with a margin as wide as the stencil; zero on entry and again on return.
    offsets, taps : ndarray, shape (taps,)
        Flat offsets of the stencil and its coefficients.
    result, sums : ndarray, shape (nodes,) and (blocks,)
        Overwritten: the pressures and their sums over blocks.
    """
    for i in range(places.size):
        grid[places[i]] = residual[i] - means[block[i]]
    sums[:] = 0
    for i in range(places.size):
        total = 0.0
        for j in range(offsets.size):
            total += taps[j] * grid[places[i] + offsets[j]]
        result[i] = total
        sums[block[i]] += total
    for i in range(places.size):
        grid[places[i]] = 0.0


@compiled
def add_blocks(values: Real, block: Indices, result: Real) -> None:
    """Add to each node the value of its block."""
    for i in range(block.size):
        result[i] += values[block[i]]
