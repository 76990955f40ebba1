"""What a server serves: its pages, their parts, and the tasks that they may ask for."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from roughline.lab.server.tasks import Place


@dataclass(frozen=True)
class Site:
    """What a server serves."""

    page: Callable[[], str]  # gives the page, as HTML
    # gives the page that asks for the token, or else for the password, from that choice, a word on
    # what was wrong, and the address to go on to
    login_page: Callable[[bool, str, str], str]
    parts: Path  # folder of scripts and styles
    tasks: Mapping[str, Place]  # all tasks, by the names that pages know them by
    # module that is loaded before processes are forked; its function ``up`` loads the rest
    warm: str
