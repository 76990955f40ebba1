"""Tasks: where they are defined, and how their outcomes are reported."""

from __future__ import annotations

import ntpath  # takes both kinds of slash
import sys
import traceback
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from roughline.errors import RoughlineError

Progress = Callable[[int, int], None]
"""Called with (steps done, steps in all)."""

Task = Callable[[Mapping[str, Any], Progress], bytes]
"""Arguments and progress in, a message for the page out."""


@dataclass(frozen=True)
class Place:
    """Where a task is, and how it is done.

    Attributes
    ----------
    module, function : str
        The module by its whole name, and the function in it.
    is_quick : bool
        Whether it is so short that it waits only for other quick tasks. Other tasks have a process
        each, with limits of time and memory, and are stopped when they are no longer wanted.
    reads_files : bool
        Whether it reads a file that a page has sent. Its process does nothing else and then ends.
    """

    module: str
    function: str
    is_quick: bool = False
    reads_files: bool = False


@dataclass(frozen=True)
class Outcome:
    """How a task ended.

    Attributes
    ----------
    answer : bytes or None
        The message for the page; None if there is none.
    error : str
        Why there is none, in one sentence; empty if there is one.
    at : str
        Key of the control that the sentence belongs to; empty if it belongs to none.
    """

    answer: bytes | None = None
    error: str = ""
    at: str = ""


def outcome_of(place: Place, arguments: Mapping[str, Any], progress: Progress) -> Outcome:
    """Do a task; a refusal and a failure become one line, without names of files and folders."""
    try:
        task: Task = getattr(import_module(place.module), place.function)
        return Outcome(task(arguments, progress))
    except RoughlineError as error:
        sentence = " ".join(without_paths(str(error), arguments).split())
        return Outcome(error=sentence, at=getattr(error, "at", ""))
    except MemoryError:
        return Outcome(
            error="this needs more memory than one session may have: take fewer points or a "
            "smaller piece"
        )
    except Exception:
        traceback.print_exc(file=sys.stderr)
        return Outcome(
            error="the computation failed for a reason that the lab does not know; the terminal "
            "in which the lab was started shows more. Change a setting and ask again"
        )


def without_paths(text: str, arguments: Mapping[str, Any]) -> str:
    """Replace the lab's own names of files by the names that the user knows."""
    for path, name in arguments["session"]["names"].items():
        text = text.replace(path, name).replace(ntpath.basename(path), name)
    return text
