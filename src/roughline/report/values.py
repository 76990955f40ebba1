"""How values and their intervals are written."""

from __future__ import annotations

import re

import numpy as np

from roughline.units import decimal, prefix

_NARROW = 0.1  # half width of an interval up to which it is written as ±
_ONE_SIDED = 0.5  # shorter over longer half below which both ends are written
_LEAST = 1e-4  # half width below which an interval says nothing
_INTERVAL = re.compile(r" (?=[(±])")


def with_interval(value: float, ends: tuple[float, float] | None, unit: str) -> str:
    """Write a value, and its interval: as ± where that is narrow and even, else by both ends."""
    if not np.isfinite(value):
        return "not solved" if np.isnan(value) else "infinite"
    factor, sign = scale_of(value, unit)
    shown = f"{decimal(value * factor, 4)}{sign}"
    if ends is None or np.isnan(ends).any() or not value:
        return shown
    low, high = ends
    shorter, half_width = sorted(((value - low) / value, (high - value) / value))
    one_sided = shorter < _ONE_SIDED * half_width and half_width > _LEAST
    if half_width < _NARROW and not one_sided:
        return f"{shown} ± {100 * max(half_width, _LEAST):.2g}%"
    first, last = (decimal(end * factor, 3) if np.isfinite(end) else "infinite" for end in ends)
    return f"{shown} ({first} to {last})"


def scale_of(value: float, unit: str) -> tuple[float, str]:
    """Factor of a value, and the unit or sign that is then written after it."""
    if unit == "1":
        return 1.0, ""
    if unit == "%":
        return 100.0, "%"
    factor, prefixed = prefix(value, unit)
    return factor, f" {prefixed}"


def value_and_interval(cell: str) -> list[str]:
    """Split a cell into the value and, if it has one, its interval: a line may break between."""
    return _INTERVAL.split(cell, maxsplit=1)
