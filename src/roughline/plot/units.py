"""Units of axes: SI units get a prefix that suits what is drawn, others stay as they are."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from roughline.units import SI, prefix

_DIMENSIONS = {"length", "force", "pressure", "energy"}


def in_unit(
    name: str, values: ArrayLike, unit: str | None, scale: float = 1.0
) -> tuple[str, float]:
    """Return the label of an axis with its unit, and the factor from the values to that unit.

    The largest value chooses the prefix of an SI unit. A dimension such as "force/length", which
    stands for any coherent unit, and None are left out of the label.
    """
    if unit in (None, "1") or _DIMENSIONS & set(unit.split("/")):
        return name, scale
    if unit not in SI:
        return f"{name} [{unit}]", scale
    largest = scale * float(np.nanmax(np.abs(values), initial=0.0))
    factor, prefixed = prefix(largest, unit)
    return f"{name} [{prefixed}]", factor * scale
