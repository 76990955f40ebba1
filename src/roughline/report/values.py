"""How values and their intervals are written."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import numpy as np

from roughline.units import MOST_DIGITS, decimal, engineering, prefix, supported_digits

_NARROW = 0.1  # half width of an interval up to which it is written as ±
_ONE_SIDED = 0.5  # shorter over longer half below which both ends are written
_LEAST = 1e-4  # half width below which an interval says nothing
_DIGITS_OF_ENDS = 2  # of both ends of an interval, at least
_FAR_APART = 100.0  # of both ends, from which on they have the unit as well
_SHORTEST = 1e-12  # length, a hundredth of an atom, below which it is told as that [m]
_SHOWN = 3  # digits on a page of the lab
_INTERVAL = re.compile(r" (?=[(±])")

Write = Callable[[float, tuple[float, float] | None, str], str]
"""Writes a value with its interval, if that is known, and its unit."""


def with_interval(value: float, ends: tuple[float, float] | None, unit: str) -> str:
    """Write a value, and its interval: as ± where that is narrow and even, else by both ends."""
    if not np.isfinite(value):
        return "not solved" if np.isnan(value) else "infinite"
    if is_below_atoms(value, unit):
        return _below_atoms(ends)
    digits = supported_digits(value, ends)
    factor, sign = scale_of(value, unit, digits)
    shown = f"{decimal(value * factor, digits)}{sign}"
    if ends is None or np.isnan(ends).any():
        return shown
    low, high = ends
    if not value:
        return f"{shown} (up to {with_interval(high, None, unit)})" if high > 0 else shown
    shorter, half_width = sorted(((value - low) / value, (high - value) / value))
    one_sided = shorter < _ONE_SIDED * half_width and half_width > _LEAST
    reached = value * (1 + max(half_width, _LEAST))  # by an even interval
    if unit == "%" and high <= 1 < reached:  # no share is more than all
        ends = min(low, value * (1 - _LEAST)), high
    elif half_width < _NARROW and not one_sided:
        return f"{shown} ± {100 * max(half_width, _LEAST):.2g}%"
    least = max(digits, _DIGITS_OF_ENDS)
    first, last = (decimal(end * factor, least) if np.isfinite(end) else "infinite" for end in ends)
    far_apart = not high <= _FAR_APART * low  # the unit is then said once more
    last += sign if np.isfinite(high) and (far_apart or unit == "%") else ""
    return f"{shown} ({first} to {last})"


def length(value: float, digits: int) -> str:
    """Write a length in metres with so many digits; one far below an atom as that."""
    below = is_below_atoms(value, "m")
    return _below_atoms(None) if below else engineering(value, "m", digits)


def is_below_atoms(value: float, unit: str) -> bool:
    """Whether a length is so much smaller than an atom that it is none, but for rounding."""
    return unit == "m" and 0 < abs(value) < _SHORTEST


def _below_atoms(ends: tuple[float, float] | None) -> str:
    shown = f"below {_with_unit(_SHORTEST, 'm', 1)}"
    if ends is None or not ends[1] >= _SHORTEST:
        return shown
    return f"{shown} (up to {_with_unit(ends[1], 'm', _DIGITS_OF_ENDS)})"


def _with_unit(value: float, unit: str, digits: int) -> str:
    return engineering(value, unit, digits) if np.isfinite(value) else "infinite"


def up_to_three_digits(value: float, ends: tuple[float, float] | None, unit: str) -> str:
    """Write a value with the digits that are known of it, and both ends of its interval."""
    if not np.isfinite(value) or not value or is_below_atoms(value, unit):
        return with_interval(value, ends, unit)
    digits = supported_digits(value, ends, _SHOWN)
    factor, sign = scale_of(value, unit, digits)
    shown = f"{figure(value * factor, digits)}{sign}"
    if ends is None or np.isnan(ends).any():
        return shown
    first, last = (figure(end * factor) for end in ends)
    return f"{shown} ({first} to {last}{sign if np.isfinite(ends[1]) else ''})"


def figure(value: float, digits: int = _SHOWN) -> str:
    """A number with significant digits, its zeros kept: 0.200."""
    text = "infinite" if np.isinf(value) else decimal(value, digits)
    if not value or not math.isfinite(value) or "e" in text:
        return text
    exponent = math.floor(math.log10(abs(float(text))))
    return f"{float(text):.{max(digits - 1 - exponent, 0)}f}"


def scale_of(value: float, unit: str, digits: int = MOST_DIGITS) -> tuple[float, str]:
    """Factor of a value of some digits, and the unit or sign that is then written after it."""
    if unit == "1":
        return 1.0, ""
    if unit == "%":
        return 100.0, "%"
    factor, prefixed = prefix(value, unit, digits)
    return factor, f" {prefixed}"


def value_and_interval(cell: str) -> list[str]:
    """Split a cell into the value and, if it has one, its interval: a line may break between."""
    return _INTERVAL.split(cell, maxsplit=1)
