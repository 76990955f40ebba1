"""Compiled loops over arrays."""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Floats, Integers
from roughline.computing.compiled import compiled

ROUNDING = 8
"""Columns to which runs of nodes are rounded up, and so the room they need beyond a stencil."""


@compiled
def list_rows(
    indices: Integers, width: int, rows: Integers, starts: Integers, columns: Integers
) -> int:
    """List nodes of ascending flat indices row by row, and return how many rows hold any.

    These rows, where they begin, and the column of each node are written; one more start follows.
    """
    found, begin, end = 0, 0, 0
    for i in range(indices.size):
        if indices[i] >= end:
            row = indices[i] // width
            begin, end = row * width, (row + 1) * width
            rows[found], starts[found] = row, i
            found += 1
        columns[i] = indices[i] - begin
    starts[found] = indices.size
    return found


@compiled
def scatter_pairs(
    values: Floats, starts: Integers, columns: Integers, first: int, last: int, pairs: Floats
) -> None:
    """Write the values of two rows each into the real and imaginary parts of one complex row.

    The real rows begin at `starts` in `values`, with a column for each value. The complex rows from
    first to last, of shape (columns, 2), are zero where there are no values.
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
    pairs: Floats, starts: Integers, columns: Integers, first: int, last: int, values: Floats
) -> None:
    """Add to values what stands where scatter_pairs would write them."""
    for row in range(2 * first, min(2 * last, starts.size - 1)):
        for i in range(starts[row], starts[row + 1]):
            values[i] += pairs[row // 2, columns[i], row % 2]


@compiled
def gather_rows(pairs: Floats, first: int, last: int, field: Floats) -> None:
    """Add to a field whole rows, cropped to its columns."""
    for row in range(2 * first, min(2 * last, field.shape[0])):
        for column in range(field.shape[1]):
            field[row, column] += pairs[row // 2, column, row % 2]


@compiled
def leave_gaps(field: Floats, separation: Floats, touch: float, approach: float) -> None:
    """Turn displacements into gaps, for a separation, its least value, and an approach from it."""
    for i in range(field.size):
        field[i] = field[i] + (separation[i] - touch) - approach


@compiled
def load_columns(
    pairs: Floats, period: int, rows: Integers, first: int, odd: int, columns: Floats
) -> None:
    """Separate two real rows from each complex one, for a block of modes, and pad with zeros.

    A = (Z(k) + Z(-k)*) / 2 and B = (Z(k) - Z(-k)*) / 2i are the spectra of the real and imaginary
    parts of z. All complex numbers come as two real ones. The real rows go to `rows` of the
    columns, which are modes from `first` on. With `odd` one, mode j stands for the wavenumber
    2 j + 1, so that period - 1 - j is its opposite; with zero that is period - j.
    """
    half, none = pairs.dtype.type(0.5), np.empty_like(columns[0])
    columns[:] = 0
    for pair in range((rows.size + 1) // 2):
        z = pairs[pair]
        a = columns[rows[2 * pair]]
        b = columns[rows[2 * pair + 1]] if 2 * pair + 1 < rows.size else none
        for j in range(columns.shape[1]):
            mirror = period - odd - first - j if first + j + odd else 0
            a[j, 0] = half * (z[first + j, 0] + z[mirror, 0])
            a[j, 1] = half * (z[first + j, 1] - z[mirror, 1])
            b[j, 0] = half * (z[first + j, 1] + z[mirror, 1])
            b[j, 1] = half * (z[mirror, 0] - z[first + j, 0])


@compiled
def weigh_columns(columns: Floats, quarter: Floats, first: int) -> None:
    """Multiply a block of modes by an even spectrum of which a quarter is given.

    The spectrum is rounded to the precision of the modes.
    """
    period, modes = columns.shape[0], columns.shape[1]
    for i in range(period // 2 + 1):
        row, mirror = columns[i], columns[(period - i) % period]
        is_its_own_mirror = 2 * i % period == 0
        for j in range(modes):
            weight = columns.dtype.type(quarter[i, first + j])
            row[j, 0] *= weight
            row[j, 1] *= weight
            if not is_its_own_mirror:
                mirror[j, 0] *= weight
                mirror[j, 1] *= weight


@compiled
def store_columns(
    columns: Floats, rows: Integers, first: int, odd: int, pairs: Floats, period: int
) -> None:
    """Join two real rows into each complex one: the inverse of load_columns, for some rows."""
    none = np.zeros_like(columns[0])
    for pair in range((rows.size + 1) // 2):
        z = pairs[pair]
        a = columns[rows[2 * pair]]
        b = columns[rows[2 * pair + 1]] if 2 * pair + 1 < rows.size else none
        for j in range(columns.shape[1]):
            mirror = period - odd - first - j if first + j + odd else 0
            z[mirror, 0] = a[j, 0] + b[j, 1]
            z[mirror, 1] = b[j, 0] - a[j, 1]
            z[first + j, 0] = a[j, 0] - b[j, 1]
            z[first + j, 1] = a[j, 1] + b[j, 0]


@compiled
def add_pairs(
    table: Floats,
    first: int,
    pressure: Floats,
    sources: tuple[Integers, Integers, Integers],
    targets: tuple[Integers, Integers, Integers],
    result: Floats,
) -> None:
    """Add what pressures displace at some distances of rows, for which there is a table.

    Sources are starts, columns and the places of all rows; targets starts, columns and rows.
    """
    source_starts, source_columns, place = sources
    target_starts, target_columns, target_rows = targets
    for k in range(target_rows.size):
        for distance in range(first, first + table.shape[0]):
            kernel = table[distance - first]
            for side in range(2 if distance else 1):
                row = target_rows[k] + (distance if side else -distance)
                if 0 <= row < place.size and place[row] >= 0:
                    source = place[row]
                    for i in range(target_starts[k], target_starts[k + 1]):
                        total = 0.0
                        for j in range(source_starts[source], source_starts[source + 1]):
                            apart = abs(target_columns[i] - source_columns[j])
                            total += kernel[apart] * pressure[j]
                        result[i] += total
