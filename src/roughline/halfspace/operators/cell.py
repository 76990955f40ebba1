"""What pressure on one cell of a grid displaces that cell by, without the operator of the grid."""

from __future__ import annotations

import numpy as np

from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.operators.images import fill_with_images

_WAVES_AT_A_TIME = 2**20  # of the periodic half-space, over which is summed


def cell_compliance(
    half_space: HalfSpace, shape: tuple[int, int], spacing: tuple[float, float]
) -> float:
    """Return the displacement of a cell by unit pressure on it alone. [length / pressure]

    It is the number that contacts on the grid are solved with, without the grid's operator. Where
    displacements count from their mean, an even pressure displaces by as much as the wave does that
    displaces most.

    Parameters
    ----------
    half_space : HalfSpace
        What is pressed.
    shape : tuple of int
        Cells along x and y.
    spacing : tuple of float
        Sides of a cell, (dx, dy). [length]
    """
    if all(half_space.repeats):
        return _under_waves(half_space, shape, spacing)
    if any(half_space.repeats):
        along = half_space.repeats.index(True)
        period, across = shape[along], spacing[1 - along]
        width = shape[1 - along] * across
        table = np.empty((period // 2 + 1, 1))
        fill_with_images(half_space, period, (spacing[along], across), width, table)
    else:
        table = np.empty((1, 1))
        half_space.kernel(0, spacing, table)
    return float(table[0, 0])


def _under_waves(
    half_space: HalfSpace, shape: tuple[int, int], spacing: tuple[float, float]
) -> float:
    """Return the mean over the waves of a grid of what each displaces over its pressure."""
    modes = [np.arange(n // 2 + 1) for n in shape]
    qx, qy = (
        2 * np.pi / (n * side) * each for each, n, side in zip(modes, shape, spacing, strict=True)
    )
    times_x, times_y = (  # how often a wavenumber comes, with either sign
        np.where((each == 0) | (2 * each == n), 1.0, 2.0)
        for each, n in zip(modes, shape, strict=True)
    )
    rows = 1 + _WAVES_AT_A_TIME // qy.size
    total, largest = 0.0, 0.0
    for first in range(0, qx.size, rows):
        some = slice(first, first + rows)
        with np.errstate(divide="ignore", invalid="ignore"):
            moved = half_space.spectrum(np.hypot(qx[some, np.newaxis], qy))
        moved = np.where(np.isinf(moved), 0.0, moved)
        total += float(times_x[some] @ moved @ times_y)
        largest = max(largest, float(moved.max()))
    even = largest if half_space.mean_is_free else 0.0
    return (total + even) / (shape[0] * shape[1])
