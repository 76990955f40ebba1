"""Names of the array types that signatures use."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]  # numbers in double precision
Single = NDArray[np.float32]  # numbers in single precision
Indices = NDArray[np.intp]  # positions in another array
Mask = NDArray[np.bool_]  # true for what is chosen
Floats = NDArray[np.floating]  # numbers in single or double precision
Integers = NDArray[np.integer]  # whole numbers of any width
