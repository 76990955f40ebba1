"""Checks of what callers give; each refuses in one line, in terms of the caller's own argument."""

from __future__ import annotations

import math
from collections.abc import Iterable
from numbers import Integral, Real
from typing import Any, NoReturn, TypeVar

from roughline.errors import InputError

_LONGEST_VALUE = 80  # characters of a value that a message shows
_MOST_BITS = 10_000  # of a whole number that Python writes out
_Allowed = TypeVar("_Allowed")


def refuse(argument: str, given: Any, needed: str) -> NoReturn:
    """Refuse a value.

    What is needed is a clause, such as "a positive number is needed".
    """
    raise InputError(f"is {shown(given)}; {needed}", argument)


def shown(given: Any) -> str:
    """Write a value for a message: short, on one line, arrays and objects by what they are."""
    if isinstance(given, str):
        return f'"{shortened(given)}"'
    if given is None or isinstance(given, bool | complex):
        return repr(given)
    if isinstance(given, Integral):
        integer = int(given)
        is_short = integer.bit_length() < _MOST_BITS
        return shortened(str(integer)) if is_short else "a number of thousands of digits"
    if isinstance(given, Real) and (value := as_number(given)) is not None:
        return repr(value)
    shape = getattr(given, "shape", None)
    if isinstance(shape, tuple) and shape and type(given).__module__ == "numpy":
        return f"an array of shape {shape}"
    if isinstance(given, list | tuple | set | dict):
        return shortened(_members_in_words(given))
    if isinstance(given, type):
        return f"the class {given.__name__}"
    name = type(given).__name__
    return f"{'an' if name[0] in 'AEIOUaeio' else 'a'} {name}"


def shortened(text: str) -> str:
    """A text on one line, its middle left out where it is long."""
    line = " ".join(text.split())
    half = _LONGEST_VALUE // 2
    return line if len(line) <= _LONGEST_VALUE else f"{line[:half]} ... {line[-half:]}"


def number(argument: str, given: Any, needed: str = "a number is needed") -> float:
    """Return a real number as a float; text, arrays, True and False are refused."""
    value = as_number(given)
    if value is None:
        refuse(argument, given, needed)
    return value


def positive(
    argument: str, given: Any, needed: str = "a positive, finite number is needed"
) -> float:
    """Return a positive, finite number."""
    value = number(argument, given, needed)
    if not 0 < value < math.inf:
        refuse(argument, given, needed)
    return value


def between(argument: str, given: Any, low: float, high: float, needed: str) -> float:
    """Return a number from `low` to `high`, both included."""
    value = number(argument, given, needed)
    if not low <= value <= high:
        refuse(argument, given, needed)
    return value


def whole_number(argument: str, given: Any, least: int, needed: str) -> int:
    """Return a whole number of at least so much."""
    if not is_whole(given) or given < least:
        refuse(argument, given, needed)
    return int(given)


def flag(argument: str, given: Any) -> bool:
    """Return True or False; refuse all else, whose truth would be a guess."""
    value = as_plain(given)
    if not isinstance(value, bool):
        refuse(argument, given, "True or False is needed")
    return value


def refuse_other_seeds(rng: Any) -> None:
    """Refuse a seed that is no whole number."""
    whole_number("rng", rng, 0, "a seed, a whole number from 0 on, is needed")


def rising_pair(argument: str, given: Any, needed: str) -> tuple[float, float]:
    """Return two numbers, the second of them larger."""
    both = [as_number(each) for each in several(given)]
    if len(both) != 2 or both[0] is None or both[1] is None or not both[0] < both[1]:
        refuse(argument, given, needed)
    return both[0], both[1]


def allowed_choice(argument: str, given: Any, allowed: Iterable[_Allowed]) -> _Allowed:
    """Return the one of the allowed texts that is given."""
    choices = list(allowed)
    for each in choices:
        if isinstance(given, str) and given == each:
            return each
    *first, last = [f'"{each}"' for each in choices]
    names = f"{', '.join(first)} and {last}" if first else last
    refuse(argument, given, f"allowed {'are' if first else 'is'} {names}")


def several(given: Any) -> list[Any]:
    """The members of a sequence or an array; none of a text or of what has no members."""
    if isinstance(given, str) or not hasattr(given, "__iter__") or getattr(given, "ndim", 1) == 0:
        return []
    return list(given)


def as_number(given: Any) -> float | None:
    """Return a real number, or an array of no dimensions, as a float; None for all else."""
    single = as_plain(given)
    if isinstance(single, bool) or not isinstance(single, Real):
        return None
    try:
        return float(single)
    except (TypeError, ValueError, OverflowError):
        return None


def is_whole(given: Any) -> bool:
    """Whether a value is a whole number; True and False are none."""
    return isinstance(given, Integral) and not isinstance(given, bool)


def as_plain(given: Any) -> Any:
    """Return what NumPy or xarray hold as a single value as Python's own; NaN if it is masked."""
    if getattr(given, "ndim", None) != 0 or not hasattr(given, "item"):
        return given
    return math.nan if getattr(given, "mask", False) else given.item()


def _members_in_words(given: Any) -> str:
    """Several values in their brackets."""
    if isinstance(given, dict):
        return f"a dict with {', '.join(map(str, given)) or 'nothing in it'}"
    inside = ", ".join(map(shown, given))
    if isinstance(given, tuple):
        return f"({inside}{',' if len(given) == 1 else ''})"
    return f"[{inside}]" if isinstance(given, list) else f"{{{inside}}}"
