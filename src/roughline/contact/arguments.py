"""What callers give to a press, checked before anything is computed."""

from __future__ import annotations

import contextlib
import math
import sys
from collections.abc import Iterable
from numbers import Integral
from numbers import Real as RealNumber
from typing import Any

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError

LARGEST = 1e150
"""Beyond it, squares leave the range of double precision."""

_MOST = 10**9  # loads, points along a side, or iterations


def checked_number(
    name: str, value: Any, allowed: str, least: float = 0.0, most: float = sys.float_info.max
) -> float:
    """Return a positive number; refuse what is none, or lies outside least to most."""
    number, plain = math.nan, _plain(value)
    if not isinstance(plain, bool) and isinstance(plain, RealNumber):
        with contextlib.suppress(OverflowError):  # of whole numbers without bound
            number = float(plain)
    if not (least <= number <= most and number > 0):
        raise InputError(f"{name} is {shown(value)}; {allowed} is needed")
    return number


def checked_count(name: str, value: Any, least: int = -_MOST) -> int:
    """Return a whole number; refuse what is none, too small, or beyond all that is countable."""
    plain = _plain(value)
    whole = isinstance(plain, Integral) or (isinstance(plain, float) and plain.is_integer())
    if isinstance(plain, bool) or not whole or not least <= plain <= _MOST:
        bound = "" if least == -_MOST else f" of at least {least}"
        at_most = f" and at most {_MOST:.0e}" if whole and plain > _MOST else ""
        raise InputError(f"{name} is {shown(value)}; a whole number{bound}{at_most} is needed")
    return int(plain)


def checked_flag(name: str, value: Any) -> bool:
    """Return True or False; refuse all else, whose truth would be a guess."""
    plain = _plain(value)
    if not isinstance(plain, bool):
        raise InputError(f"{name} is {shown(value)}; True or False is needed")
    return plain


def refuse_unknown_precision(precision: Any) -> None:
    """Refuse what is no precision of the convolutions."""
    if not isinstance(precision, str) or precision not in ("mixed", "float64", "float32"):
        raise InputError(
            f'precision is {shown(precision)}; allowed are "mixed", "float64" and "float32"'
        )


def refuse_mute(progress: Any) -> None:
    """Refuse what cannot be called with the progress."""
    if progress is not None and not callable(progress):
        raise InputError(
            f"progress is {shown(progress)}; a function of (loads done, loads in all) is needed"
        )


def checked_shape(shape: Any) -> tuple[int, int]:
    """Return the points of a surface along x and y."""
    try:
        nx, ny = shape
        return checked_count("shape", nx, 1), checked_count("shape", ny, 1)
    except (TypeError, ValueError):
        raise InputError(
            f"shape is {shown(shape)}; the points of the surface along x and y are needed, two "
            "positive whole numbers such as shape=(1024, 1024)"
        ) from None


def checked_values(name: str, values: Any) -> Real:
    """Return one number or a list of them as an array; refuse text, and what is no number."""
    try:
        array = np.atleast_1d(np.ma.filled(np.ma.asarray(values), np.nan))
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} are not numbers ({error}); give a list of numbers") from error
    if array.size and array.dtype.kind not in "iuf":
        raise InputError(f"{name} are not numbers ({name}={shown(values)}); give a list of numbers")
    return array.astype(np.float64)


def kept_loads(fields: Any, count: int) -> frozenset[int]:
    """Return the numbers of the loads whose fields are kept."""
    plain = _plain(fields)
    if isinstance(plain, bool):
        return frozenset(range(count)) if plain else frozenset()
    numbers = list(plain) if isinstance(plain, Iterable) and not isinstance(plain, str) else None
    if numbers is None or not all(_is_load(each, count) for each in numbers):
        raise InputError(
            f"fields is {shown(fields)}; give True, False, or numbers of loads, 0 to {count - 1}, "
            "such as fields=[0]"
        )
    return frozenset(int(each) for each in numbers)


def _plain(value: Any) -> Any:
    """Return what NumPy or xarray hold as a single value as Python's own; NaN if it is masked."""
    if value is np.ma.masked:
        return math.nan
    single = getattr(value, "ndim", None) == 0 and hasattr(value, "item")
    return value.item() if single else value


def _is_load(number: Any, count: int) -> bool:
    whole = isinstance(number, Integral) and not isinstance(number, bool)
    return whole and 0 <= int(number) < count


def checked_share(name: str, value: Any) -> float:
    """Return a share, from 0 to 1."""
    plain = _plain(value)
    if isinstance(plain, int | float) and not isinstance(plain, bool) and plain == 0:
        return 0.0
    return checked_number(name, value, "a share of the surface from 0 to 1", most=1.0)


def shown(value: Any) -> str:
    """Show what was given in one short line."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."
