"""Displacements summed over pairs of nodes, where that is cheaper than a transform."""

from __future__ import annotations

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Floats, Integers, Real
from roughline.computing.compiled import compiled
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.operators.grid_nodes import GridNodes

ROWS_AT_A_TIME = 32
"""Rows of the table whose sums are added up before those of others."""


def displaced_by_pairs(
    half_space: HalfSpace,
    spacing: tuple[float, float],
    pressure: Real,
    sources: GridNodes,
    targets: GridNodes,
) -> Real:
    """Return the displacement of some nodes under the pressure on some nodes.

    The table of the kernel is made row by row, and forgotten. Each row serves all pairs of nodes
    whose rows are so far apart.
    """
    nx, ny = sources.shape
    loaded = sources.starts, sources.columns, sources.place_of_rows
    parts = np.zeros((-(-nx // ROWS_AT_A_TIME), targets.indices.size))

    def add(first: int, last: int) -> None:
        table = np.empty((last - first, ny))
        half_space.kernel(first, spacing, table)
        part = parts[first // ROWS_AT_A_TIME]
        _add_pairs(table, first, pressure, loaded, targets.listed, part)

    fft.share_out_blocks(add, nx, ROWS_AT_A_TIME)
    return parts.sum(axis=0)


@compiled
def _add_pairs(
    table: Floats,
    first: int,
    pressure: Floats,
    sources: tuple[Integers, Integers, Integers],
    targets: tuple[Integers, Integers, Integers],
    result: Floats,
) -> None:
    """Add what pressures displace at some distances of rows.

    Sources are given by starts, columns and the places of all rows; targets by starts, columns and
    rows.
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
