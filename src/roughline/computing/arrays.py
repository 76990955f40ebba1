"""Names of the array types that signatures use."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]
"""Numbers in double precision."""

Complex = NDArray[np.complex128]
"""Complex numbers in double precision."""

Single = NDArray[np.float32]
"""Numbers in single precision."""

Indices = NDArray[np.intp]
"""Positions in another array."""

Mask = NDArray[np.bool_]
"""True for what is chosen."""

Floats = NDArray[np.floating]
"""Numbers in single or double precision."""

ComplexFloats = NDArray[np.complexfloating]
"""Complex numbers in single or double precision."""

Integers = NDArray[np.integer]
"""Whole numbers of any width."""
