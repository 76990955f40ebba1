"""Intervals of a curve: the uncertainty of its two stiffnesses and of its contact area."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any, TypeVar

import numpy as np

from roughline.computing.arrays import Indices, Real

Ends = tuple[Real, Real]
"""Both ends of an interval, each of shape (loads,)."""

_Value = TypeVar("_Value")


@dataclass(frozen=True, eq=False)
class Intervals:
    """Both ends of the intervals of a curve, over its loads."""

    stiffness: Ends  # on further loading [N / m]
    unloading: Ends  # without yield it is the same [N / m]
    area: Ends | None = None  # of the corrected fraction; None where the model has no area [1]


def taken(value: _Value, loads: Indices) -> _Value:
    """Pick some of the loads, by their numbers: they are the last axis of all arrays of a value."""
    found: Any = value
    if isinstance(value, np.ndarray):
        found = value[..., loads]
    elif isinstance(value, tuple):
        found = tuple(taken(each, loads) for each in value)
    elif isinstance(value, Mapping):
        found = {key: taken(each, loads) for key, each in value.items()}
    elif is_dataclass(value) and not isinstance(value, type):
        names = [each.name for each in fields(value)]
        found = replace(value, **{name: taken(getattr(value, name), loads) for name in names})
    return found
