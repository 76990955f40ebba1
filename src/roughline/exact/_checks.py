"""The array type and the check that all exact solutions share."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Real = NDArray[np.float64]
"""Numbers in double precision."""


def positive(**quantities: ArrayLike) -> None:
    """Refuse quantities, or arrays of them, that are not positive and finite.

    Raises
    ------
    ValueError
        With the name and the value of the first that is not.
    """
    for name, value in quantities.items():
        values = np.asarray(value, dtype=np.float64)
        wrong = ~((values > 0) & (values < np.inf))
        if wrong.any():
            first = values[wrong].flat[0]
            raise ValueError(f"{name} is {first}; a positive, finite number is needed")
