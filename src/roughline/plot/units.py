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

    Parameters
    ----------
    name : str
        What the axis shows.
    values : array_like
        What will be drawn; the largest chooses the prefix.
    unit : str or None
        Their unit. SI units get a prefix; a dimension such as "force/length", which stands for any
        coherent unit, and None are left out of the label.
    scale : float, optional
        What the values are multiplied by first; the factor includes it.
    """
    if unit in (None, "1") or _DIMENSIONS & set(unit.split("/")):
        return name, scale
    if unit not in SI:
        return f"{name} [{unit}]", scale
    largest = scale * float(np.nanmax(np.abs(values), initial=0.0))
    factor, prefixed = prefix(largest, unit)
    return f"{name} [{prefixed}]", factor * scale
