"""What notebooks and prints show of values: looked up by type, filled by the rooms that show."""

from __future__ import annotations

from collections.abc import Callable
from functools import singledispatch
from typing import Any

_loaders: list[Callable[[], object]] = []


def filled_by(loader: Callable[[], object]) -> None:
    """Name what loads pictures and texts, which register themselves; it is called when wanted."""
    _loaders.append(loader)


def _filled() -> bool:
    """Load what shows values, one room after another; False if there is no further one."""
    if not _loaders:
        return False
    _loaders[-1]()
    _loaders.pop()  # not one that raised: it is called again
    return True


@singledispatch
def in_notebook(value: Any) -> str | None:
    """Return what a notebook shows of a value, as HTML; None: nothing but its text."""
    return in_notebook(value) if _filled() else None


@singledispatch
def printed(value: Any) -> str:
    """Return what ``print`` shows of a value: what the terminal says of it, or its repr."""
    return printed(value) if _filled() else repr(value)
