"""The paper's dimensionless force and stiffness, and the two punches that may normalise them."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

_Value = TypeVar("_Value", float, NDArray[np.float64])

PAPER_PUNCH = 1.1419
"""k_s / (E* L) of the square punch as the paper takes it, 1.012 * 2 / sqrt(pi) (King 1987)."""

EXACT_PUNCH = 1.15230
"""k_s / (E* L) of the rigid square punch: pi times the capacity of the unit square, 0.366788."""

PUNCH_GRID_ERROR = 0.396
"""By how much k_s / (E* L) of the square punch is too small on n x n cells, times n."""


def force_bar(force: _Value, E_star: float, rms_height: float, length: float) -> _Value:
    """Dimensionless force F / (E* h L), the paper's eq. 2."""
    return force / (E_star * rms_height * length)


def stiffness_bar(
    stiffness: _Value, E_star: float, length: float, punch: float = PAPER_PUNCH
) -> _Value:
    """Dimensionless stiffness k / (punch E* L), the paper's eq. 1.

    The punch is :data:`PAPER_PUNCH` or :data:`EXACT_PUNCH` for a surface, and 1 for a line or for
    the raw stiffness k / (E* L).
    """
    return stiffness / (punch * E_star * length)
