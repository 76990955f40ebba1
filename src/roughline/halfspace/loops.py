"""Compiled loops over the contact nodes; they know arrays only."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray


@njit(cache=True)
def apply_stencil(
    values: NDArray[np.float64],
    places: NDArray[np.intp],
    grid: NDArray[np.float64],
    offsets: NDArray[np.intp],
    taps: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Sum, around each contact node, the neighbours' values times the taps; others count as zero.

    Parameters
    ----------
    values : ndarray, shape (nodes,)
        Values on the contact nodes.
    places : ndarray of int, shape (nodes,)
        Where the nodes lie in `grid`.
    grid : ndarray
        A flat grid with a margin as wide as the stencil; zero on entry and again on return.
    offsets, taps : ndarray, shape (taps,)
        Flat offsets of the stencil and its coefficients.
    """
    for i in range(places.size):
        grid[places[i]] = values[i]
    result = np.empty_like(values)
    for i in range(places.size):
        total = 0.0
        for j in range(offsets.size):
            total += taps[j] * grid[places[i] + offsets[j]]
        result[i] = total
    for i in range(places.size):
        grid[places[i]] = 0.0
    return result
