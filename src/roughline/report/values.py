"""How values and their intervals are written."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import numpy as np

from roughline.units import MOST_DIGITS, decimal, engineering, prefix, supported_digits

_NARROW_HALF_WIDTH = 0.1  # up to which an interval is written as ±
_ONE_SIDED_RATIO = 0.5  # shorter over longer half below which both ends are written
_LEAST_HALF_WIDTH = 1e-4  # below which an interval says nothing
_END_DIGITS = 2  # of both ends of an interval, at least
_REPEATED_UNIT_RATIO = 100.0  # of both ends, from which on they have the unit as well
_SHORTEST_LENGTH = 1e-12  # a hundredth of an atom: what is shorter is written as below it [m]
_LAB_DIGITS = 3  # on a page of the lab
_BEFORE_INTERVAL = re.compile(r" (?=[(±])")

Write = Callable[[float, tuple[float, float] | None, str], str]
"""Writes a value with its interval, if that is known, and its unit."""


def with_interval(value: float, ends: tuple[float, float] | None, unit: str) -> str:
    """Write a value, and its interval: as ± where that is narrow and even, else by both ends."""
    if not np.isfinite(value):
        return "not solved" if np.isnan(value) else "infinite"
    if is_below_atoms(value, unit):
        return _below_atoms(ends)
    digits = supported_digits(value, ends)
    factor, sign = written_scale(value, unit, digits)
    text = f"{decimal(value * factor, digits)}{sign}"
    if ends is None or np.isnan(ends).any():
        return text
    low, high = ends
    if not value:
        return f"{text} (up to {with_interval(high, None, unit)})" if high > 0 else text
    shorter, half_width = sorted(((value - low) / value, (high - value) / value))
    one_sided = shorter < _ONE_SIDED_RATIO * half_width and half_width > _LEAST_HALF_WIDTH
    reached = value * (1 + max(half_width, _LEAST_HALF_WIDTH))  # by an even interval
    if unit == "%" and high <= 1 < reached:  # no share is more than all
        ends = min(low, value * (1 - _LEAST_HALF_WIDTH)), high
    elif half_width < _NARROW_HALF_WIDTH and not one_sided:
        return f"{text} ± {100 * max(half_width, _LEAST_HALF_WIDTH):.2g}%"
    least = max(digits, _END_DIGITS)
    first, last = (decimal(end * factor, least) if np.isfinite(end) else "infinite" for end in ends)
    repeats_unit = not high <= _REPEATED_UNIT_RATIO * low  # the unit is then said once more
    last += sign if np.isfinite(high) and (repeats_unit or unit == "%") else ""
    return f"{text} ({first} to {last})"


def length(value: float, digits: int) -> str:
    """Write a length in metres with so many digits; one far below an atom as that."""
    below = is_below_atoms(value, "m")
    return _below_atoms(None) if below else engineering(value, "m", digits)


def is_below_atoms(value: float, unit: str) -> bool:
    """Whether a length is so much smaller than an atom that it is none, but for rounding."""
    return unit == "m" and 0 < abs(value) < _SHORTEST_LENGTH


def _below_atoms(ends: tuple[float, float] | None) -> str:
    text = f"below {_with_unit(_SHORTEST_LENGTH, 'm', 1)}"
    if ends is None or not ends[1] >= _SHORTEST_LENGTH:
        return text
    return f"{text} (up to {_with_unit(ends[1], 'm', _END_DIGITS)})"


def _with_unit(value: float, unit: str, digits: int) -> str:
    return engineering(value, unit, digits) if np.isfinite(value) else "infinite"


def up_to_three_digits(value: float, ends: tuple[float, float] | None, unit: str) -> str:
    """Write a value with the digits that are known of it, and both ends of its interval."""
    if not np.isfinite(value) or not value or is_below_atoms(value, unit):
        return with_interval(value, ends, unit)
    digits = supported_digits(value, ends, _LAB_DIGITS)
    factor, sign = written_scale(value, unit, digits)
    text = f"{figure(value * factor, digits)}{sign}"
    if ends is None or np.isnan(ends).any():
        return text
    first, last = (figure(end * factor, max(digits, _END_DIGITS)) for end in ends)
    return f"{text} ({first} to {last}{sign if np.isfinite(ends[1]) else ''})"


def figure(value: float, digits: int = _LAB_DIGITS) -> str:
    """A number with significant digits, its zeros kept: 0.200."""
    text = "infinite" if np.isinf(value) else decimal(value, digits)
    if not value or not math.isfinite(value) or "e" in text:
        return text
    exponent = math.floor(math.log10(abs(float(text))))
    return f"{float(text):.{max(digits - 1 - exponent, 0)}f}"


def written_scale(value: float, unit: str, digits: int = MOST_DIGITS) -> tuple[float, str]:
    """Factor of a value of some digits, and the unit or sign that is then written after it."""
    if unit == "1":
        return 1.0, ""
    if unit == "%":
        return 100.0, "%"
    factor, prefixed = prefix(value, unit, digits)
    return factor, f" {prefixed}"


def value_and_interval(cell: str) -> list[str]:
    """Split a cell into the value and, if it has one, its interval: a line may break between."""
    return _BEFORE_INTERVAL.split(cell, maxsplit=1)
