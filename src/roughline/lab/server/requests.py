"""The requests of pages to a lane of processes, and their limits."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from roughline.lab.server.tasks import Outcome, Place


@dataclass(frozen=True)
class Request:
    """One thing that a page asks for.

    Attributes
    ----------
    address, session, slot : str
        Where the page is, which page asks, and for which of its parts: a newer request for the same
        part replaces an older one.
    place : Place
        Where the task is.
    arguments : mapping
        Of the task; with "refines" it refines an existing answer, and lets other requests pass.
    answer : callable
        Told the outcome, unless the request was replaced or withdrawn.
    progress : callable
        Told (steps done, steps in all).
    since : float
        When it, or an older one that it replaced, began to wait, on the monotonic clock. [s]
    """

    address: str
    session: str
    slot: str
    place: Place
    arguments: Mapping[str, Any]
    answer: Callable[[Outcome], None]
    progress: Callable[[int, int], None]
    since: float = field(default_factory=time.monotonic)

    @property
    def key(self) -> tuple[str, str]:
        """What a newer request must share to take its place."""
        return self.session, self.slot

    @property
    def refines(self) -> bool:
        """Whether it makes an answer finer that is there already."""
        return self.arguments.get("refines") is True


@dataclass(frozen=True)
class Limits:
    """What a lane and one task in it may take.

    Attributes
    ----------
    count : int
        Processes that work side by side; one that takes long lets others start beside it.
    most : int
        Processes in all.
    per_session : int
        Processes that work for one page.
    seconds : float
        Time of a task. [s]
    memory : float
        Memory of a task, beside the program. [bytes]
    """

    count: int
    most: int
    per_session: int
    seconds: float
    memory: float
