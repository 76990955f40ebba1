"""One check that all exact solutions share."""

from __future__ import annotations

import math


def positive(**quantities: float) -> None:
    """Refuse quantities that are not positive and finite.

    Raises
    ------
    ValueError
        With the name of the first that is not.
    """
    for name, value in quantities.items():
        if not 0 < value < math.inf:
            raise ValueError(f"{name} is {value}; a positive, finite number is needed")
