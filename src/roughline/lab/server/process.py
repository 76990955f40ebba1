"""A process that computes, seen from the server: it gets a task, reports progress, and answers.

Processes are forked from one that has loaded and compiled everything, where the system can fork.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from concurrent.futures import wait as wait_for
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection, wait
from typing import Any

from roughline.lab.server.tasks import Place, TaskOutcome, run_task

_FORKS = "forkserver" in multiprocessing.get_all_start_methods()
_CONTEXT: Any = multiprocessing.get_context("forkserver" if _FORKS else "spawn")
_warms_up: Callable[[], None] | None = None
_LOW_PRIORITY = 3  # of tasks that are not quick, as `nice` counts

LOST = TaskOutcome(
    error="the process that computed this ended unexpectedly, perhaps for lack of memory: ask "
    "again, or take fewer points"
)
"""The outcome of a task whose process was lost."""


class Process:
    """A process that does one task at a time, with so much memory beside the program. [bytes]

    It begins in one of some threads. When it has begun it is asked and ended in threads. Processes
    that do not give way come first when both want a core.
    """

    def __init__(self, threads: ThreadPoolExecutor, memory: float, *, gives_way: bool) -> None:
        self.tasks = 0  # that it was asked for
        self._process: Any = None
        self._is_stopped = False  # it may take a moment until it is gone
        self.begun = threads.submit(self._begin, memory, gives_way)

    def _begin(self, memory: float, gives_way: bool) -> None:
        self._connection, theirs = _CONTEXT.Pipe()
        with _without_interrupts():
            arguments = theirs, memory, _warms_up
            process = _CONTEXT.Process(target=_serve, args=arguments, daemon=True)
            process.start()
        theirs.close()
        self._process = process
        if gives_way:
            with suppress(AttributeError, OSError):  # not everywhere, and it may have ended
                os.setpriority(os.PRIO_PROCESS, process.pid, _LOW_PRIORITY)

    @property
    def is_alive(self) -> bool:
        """Whether it can be asked; one that waits has nothing to say unless it has just died."""
        if not self.begun.done():
            return True
        try:
            alive = self._process is not None and self._process.is_alive()
            return alive and not self._is_stopped and not self._connection.poll()
        except OSError:  # on Windows, where it has died
            return False

    def ask(
        self, place: Place, arguments: Mapping[str, Any], progress: Callable[[int, int], None]
    ) -> TaskOutcome:
        """Have a task done; waits for it, so it is called from a thread."""
        self.tasks += 1
        try:
            self._connection.send((place, arguments))
            while not isinstance(received := self._connection.recv(), TaskOutcome):
                progress(*received)
        except (EOFError, OSError):  # it was stopped, or died
            return LOST
        return received

    def stop(self) -> None:
        """Stop it at once, whatever it is doing, if it has begun."""
        if self._process is not None:
            self._is_stopped = True
            self._process.kill()

    def end(self) -> None:
        """Stop it, wait until it is gone, and give back what the server keeps for it."""
        wait_for([self.begun])
        if self._process is not None:
            self.stop()
            self._process.join()
            self._process.close()  # one that no signal reaches any more ends itself now
            self._connection.close()


def start_forking(warm_up: Callable[[], None], preloaded: str) -> None:
    """Start the process that the others are forked from, so that the first task need not wait.

    It loads a module by its name; `warm_up` is called in each process before its first task.
    """
    global _warms_up
    _warms_up = warm_up
    if _FORKS:
        from multiprocessing import forkserver

        _CONTEXT.set_forkserver_preload(["__main__", preloaded])
        with _without_interrupts():
            forkserver.ensure_running()


@contextmanager
def noted_interrupts() -> Iterator[Callable[[], bool]]:
    """Note Ctrl-C instead of raising it, and give a function that says whether it came.

    What is raised while a module is loaded may be lost, since Python ignores it in what it calls
    then. Windows raises it all the same, as the event loop needs it there.
    """
    if sys.platform == "win32":
        yield lambda: False
        return
    came = threading.Event()
    before = signal.signal(signal.SIGINT, lambda number, frame: came.set())
    try:
        yield came.is_set
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def _without_interrupts() -> Iterator[None]:
    """Start processes that Ctrl-C does not reach, as it is meant for the server."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    from multiprocessing import resource_tracker

    resource_tracker.ensure_running()  # now, since it unblocks interrupts when it has started
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _serve(connection: Connection, memory: float, warm_up: Callable[[], None] | None) -> None:
    """Do tasks until the other end is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # where it could not be kept away from the start
    threading.Thread(target=_end_with_server, daemon=True).start()
    if warm_up is not None:
        warm_up()
    from roughline.computing.memory import limit_process  # here because the server needs it not

    limit_process(int(memory))
    with suppress(EOFError, OSError):  # the server is gone
        while True:
            place, arguments = connection.recv()
            outcome = run_task(place, arguments, lambda *steps: connection.send(steps))
            connection.send(outcome)


def _end_with_server() -> None:
    """End this process, even during a task, when the server is gone or no longer needs it."""
    server = multiprocessing.parent_process()
    if server is not None:
        wait([server.sentinel])
        os._exit(1)
