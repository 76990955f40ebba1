"""What a page has had computed, kept in its folder for its next question if there is room."""

from __future__ import annotations

import os
import pickle
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeVar

from roughline.lab.frames import digest

Value = TypeVar("Value")

_MOST_CACHED = {"assessment": 1, "body": 3, "comparison": 1, "measurement": 3}
"""How many are kept of each kind."""


def cached(
    session: Mapping[str, Any],
    kind: str,
    asked: object,
    make: Callable[[], Value],
    most: int | None = None,
) -> Value:
    """Return what a page has kept of a kind for a question, or else make and keep it.

    Two questions that print alike are the same. The oldest of more than so many go.
    """
    folder = Path(session["folder"])
    place = folder / f"{kind}-{digest(asked)}.pickle"
    with suppress(FileNotFoundError):
        found: Value = pickle.loads(place.read_bytes())
        os.utime(place)
        return found
    made = make()
    begun = place.with_suffix(f".{os.getpid()}")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        begun.write_bytes(pickle.dumps(made, protocol=5))
        begun.replace(place)
    except OSError:  # no room, or, on Windows, another process reads what is in its place
        with suppress(OSError):
            begun.unlink()
        return made
    by_age = sorted(folder.glob(f"{kind}-*.pickle"), key=lambda each: each.stat().st_mtime)
    for older in by_age[: -(most or _MOST_CACHED[kind])]:
        with suppress(PermissionError):  # of Windows, while it is read; it goes with a later one
            older.unlink(missing_ok=True)
    return made
