"""Names of the array types that signatures use."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]
"""Numbers in double precision."""

Complex = NDArray[np.complex128]
"""Complex numbers in double precision."""

Indices = NDArray[np.intp]
"""Positions in another array."""

Mask = NDArray[np.bool_]
"""True for what is chosen."""
