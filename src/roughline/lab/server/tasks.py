"""Tasks: where they are defined, and how their outcomes are reported."""

from __future__ import annotations

import ntpath  # takes both kinds of slash
import os
import sys
import traceback
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from roughline.computing.disk import is_full
from roughline.errors import RoughlineError

_NO_ROOM = "the disk has no room for the files of this: make some, and ask again"
_NO_MEMORY = "this needs more memory than one page may have: take fewer points or a smaller piece"
_UNKNOWN = (
    "the computation failed for a reason that the lab does not know; the terminal in which the lab "
    "was started shows more. Change a setting and ask again"
)
PACKING = 4
"""Of 9: how hard a websocket packs bytes, against the time that this takes."""

Arguments = Mapping[str, Any]  # of a task, and the "session" that asks
Progress = Callable[[int, int], None]  # called with (steps done, steps in all)
Task = Callable[[Arguments, Progress], bytes | None]  # gives a message for the page


@dataclass(frozen=True)
class Place:
    """Where a task is, and how it is done."""

    # Loads what the task is in, in the process that computes, and gives the task of a name. The
    # process knows it by the module that it is in, so that this one must load fast.
    load: Callable[[str], Task]
    name: str
    # Whether it is so short that it waits only for other quick tasks. Other tasks have a process
    # each, with limits of time and memory, and are stopped when they are no longer wanted.
    is_quick: bool = False
    # Whether it reads a file that a page has sent. Its process does nothing else and then ends.
    reads_files: bool = False


@dataclass(frozen=True)
class TaskOutcome:
    """How a task ended."""

    answer: bytes | None = None  # the message for the page; None if there is none
    error: str = ""  # why there is none, in one sentence; empty if there is one
    at: str = ""  # key of the control that the sentence belongs to; empty if it belongs to none


@dataclass(frozen=True)
class Site:
    """What a server serves."""

    page: Callable[[], str]  # gives the page, as HTML
    door: Callable[[str], str]  # gives the page that asks for the token, with what was wrong
    parts: Path  # folder of scripts and styles
    tasks: Mapping[str, Place]  # all tasks, by the names that pages know them by


def run_task(place: Place, arguments: Mapping[str, Any], progress: Progress) -> TaskOutcome:
    """Do a task; a refusal and a failure become one line, in the user's names of files."""
    try:
        task = place.load(place.name)
        return TaskOutcome(task(arguments, progress))
    except MemoryError:
        return TaskOutcome(error=_NO_MEMORY)
    except Exception as error:
        if is_full(error):
            return TaskOutcome(error=_NO_ROOM)
        if isinstance(error, RoughlineError):
            sentence = " ".join(without_paths(str(error), arguments).split())
            return TaskOutcome(error=sentence, at=getattr(error, "at", ""))
        with suppress(OSError):  # the terminal is a file, and there is no room for more
            traceback.print_exc(file=sys.stderr)
        if isinstance(error, OSError) and error.errno:
            why = os.strerror(error.errno)
            return TaskOutcome(
                error=f"a file of the lab could not be read or written ({why}): ask again"
            )
        return TaskOutcome(error=_UNKNOWN)


def without_paths(text: str, arguments: Mapping[str, Any]) -> str:
    """Replace the lab's names of files by those that the user knows."""
    session = arguments["session"]
    for path, name in session["names"].items():
        text = text.replace(path, name).replace(ntpath.basename(path), name)
    return text.replace(session.get("folder") or "\0", "the folder of the lab")
