"""The requests of pages to a lane of processes, and their limits."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from roughline.lab.server.tasks import Outcome, Place


@dataclass(frozen=True)
class Request:
    """One thing that a page asks for."""

    # where the page is, which page asks, and for which of its parts: a newer request for the same
    # part replaces an older one
    address: str
    session: str
    slot: str
    place: Place  # where the task is
    # of the task; with "refines" it refines an existing answer, and lets other requests pass
    arguments: Mapping[str, Any]
    # told the outcome, unless the request was replaced or withdrawn
    answer: Callable[[Outcome], None]
    progress: Callable[[int, int], None]  # told (steps done, steps in all)
    # when it, or an older one that it replaced, began to wait, on the monotonic clock [s]
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
    """What a lane and one task in it may take."""

    count: int  # processes that work side by side; one that takes long lets others start beside it
    most: int  # processes in all
    per_session: int  # processes that work for one page
    seconds: float  # time of a task [s]
    memory: float  # memory of a task, beside the program [bytes]
