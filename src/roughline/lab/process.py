"""One process that computes, seen from the server: it is asked, tells its progress, answers.

Processes are forked from one that has loaded and compiled everything, where the system can fork.
"""

from __future__ import annotations

import multiprocessing
import signal
import sys
from collections.abc import Callable, Mapping
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import Any

from roughline.lab.tasks import Outcome

_FORKS = "forkserver" in multiprocessing.get_all_start_methods()
_CONTEXT: Any = multiprocessing.get_context("forkserver" if _FORKS else "spawn")
if _FORKS:
    _CONTEXT.set_forkserver_preload(["__main__", "roughline.lab.warm"])

LOST = Outcome(
    error="the process that computed this ended unexpectedly, perhaps for want of memory: ask "
    "again, or take fewer points"
)
"""The outcome of a task whose process was lost."""


class Process:
    """A process that does one task at a time.

    Parameters
    ----------
    memory : int
        What it may take beside the program itself. [bytes]
    """

    def __init__(self, memory: int) -> None:
        self._connection, theirs = _CONTEXT.Pipe()
        self._process = _CONTEXT.Process(
            target=_serve, args=(theirs, memory), daemon=True, name="roughline lab"
        )
        self._process.start()
        theirs.close()

    @property
    def pid(self) -> int | None:
        """Its number in the system; None if it was stopped."""
        try:
            return self._process.pid
        except ValueError:
            return None

    @property
    def is_alive(self) -> bool:
        """Whether it can be asked."""
        try:
            return self._process.is_alive()
        except ValueError:  # it was stopped
            return False

    def ask(
        self, task: str, arguments: Mapping[str, Any], progress: Callable[[int, int], None]
    ) -> Outcome:
        """Have a task done; waits for it, so it is called from a thread."""
        try:
            self._connection.send((task, arguments))
            while True:
                said = self._connection.recv()
                if isinstance(said, Outcome):
                    return said
                progress(*said)
        except (EOFError, OSError):  # it was stopped, or died
            return LOST

    def stop(self) -> None:
        """End it at once, whatever it is doing."""
        with suppress(ValueError):  # it is closed already
            self._process.kill()
            self._process.join()
            self._process.close()


def start_forking() -> None:
    """Start the process that the others are forked from, so that the first task need not wait."""
    if _FORKS:
        from multiprocessing import forkserver

        forkserver.ensure_running()


def _serve(connection: Connection, memory: int) -> None:
    """Do tasks until the other end is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the server's
    from roughline.lab import warm
    from roughline.lab.tasks import outcome_of

    warm.up()
    _limit_memory(memory)
    with suppress(EOFError, OSError):  # the server is gone
        while True:
            task, arguments = connection.recv()
            outcome = outcome_of(task, arguments, lambda *steps: connection.send(steps))
            connection.send(outcome)


def _limit_memory(memory: int) -> None:
    """Refuse more memory than allowed beside what is loaded, where the system can."""
    if sys.platform != "linux":
        return
    import resource

    import psutil

    loaded = psutil.Process().memory_info().vms
    resource.setrlimit(resource.RLIMIT_AS, (loaded + memory, loaded + memory))
