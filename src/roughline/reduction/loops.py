"""Compiled loops over springs; they take arrays only."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roughline.computing.arrays import Real
from roughline.computing.compiled import compiled


@compiled
def fill_bins(
    heights: Real,
    highest: float,
    bins_per_length: float,
    bins: NDArray[np.uint16],
    counts: NDArray[np.intp],
    sums: Real,
) -> None:
    """Find the bin of each spring; add it to the number and the sum there."""
    for i in range(heights.size):
        separation = highest - heights[i]
        bin_ = int(separation * bins_per_length)
        bins[i] = bin_
        counts[bin_] += 1
        sums[bin_] += separation


@compiled
def fill_totals(
    counts: NDArray[np.intp], sums: Real, below: NDArray[np.intp], sum_below: Real
) -> None:
    """Add up the numbers and the sums of all bins below each, and in all."""
    number, total = 0, 0.0
    below[0], sum_below[0] = number, total
    for bin_ in range(counts.size):
        number += counts[bin_]
        total += sums[bin_]
        below[bin_ + 1], sum_below[bin_ + 1] = number, total


@compiled
def fill_edge_forces(
    below: NDArray[np.intp],
    sum_below: Real,
    bins_per_length: float,
    spring_stiffness: float,
    forces: Real,
) -> None:
    """Find the force at which each bin begins to touch; rounding does not make it fall."""
    largest = -np.inf
    for bin_ in range(forces.size):
        edge = bin_ / bins_per_length
        largest = max(largest, spring_stiffness * (below[bin_] * edge - sum_below[bin_]))
        forces[bin_] = largest
