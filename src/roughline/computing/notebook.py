"""What a notebook shows of values: looked up by type, filled by the room of pictures."""

from __future__ import annotations

from collections.abc import Callable
from functools import singledispatch
from typing import Any

_loaders: list[Callable[[], object]] = []


def filled_by(loader: Callable[[], object]) -> None:
    """Name what loads pictures, which register themselves; it is called when one is wanted."""
    _loaders.append(loader)


@singledispatch
def in_notebook(value: Any) -> str | None:
    """Return what a notebook shows of a value, as HTML; None: nothing but its text."""
    if not _loaders:
        return None
    _loaders[-1]()
    _loaders.pop()  # not one that raised: it is called again
    return in_notebook(value)
