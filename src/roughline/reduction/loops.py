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
