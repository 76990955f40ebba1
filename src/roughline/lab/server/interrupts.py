"""Ctrl-C while the server is being loaded."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager


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
