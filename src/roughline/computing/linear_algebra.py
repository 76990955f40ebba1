"""Linear algebra on one thread, as long as any computation needs that."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from threading import Lock, Thread
from typing import Any

from threadpoolctl import ThreadpoolController

_lock = Lock()
_at_work = 0
_before: list[tuple[Any, int]] = []  # libraries and their threads, as long as anyone is at work


@contextmanager
def on_one_thread() -> Iterator[None]:
    """Keep the linear algebra of this process to one thread within a ``with`` block.

    The number of its threads belongs to the process, and the last bits of results depend on it. So
    it is changed when the first of several threads of this process begins to compute, and restored
    when the last of them has ended. Where there is one thread already, as in the workers of a
    campaign, nothing is changed.
    """
    global _at_work
    with _lock:
        if not _before and any(library.num_threads > 1 for library in _libraries()):
            _in_passing(_limit)
        _at_work += 1
    try:
        yield
    finally:
        with _lock:
            _at_work -= 1
            if _before and not _at_work:
                _in_passing(_restore)


def _limit() -> None:
    """Note how many threads each library has, and let it have one."""
    _before.extend((library, library.num_threads) for library in _libraries())
    for library, _ in _before:
        library.set_num_threads(1)


def _restore() -> None:
    for library, threads in _before:
        library.set_num_threads(threads)
    _before.clear()


@cache
def _libraries() -> list[Any]:
    """Libraries of linear algebra; to look for them takes as long as to press a small surface."""
    import scipy.linalg  # noqa: F401  loads a library of its own

    return ThreadpoolController().select(user_api="blas").lib_controllers


def _in_passing(change: Callable[[], None]) -> None:
    """Change the number of threads from a thread that ends with it.

    OpenBLAS lets no other thread change it as long as the one that did is alive.
    """
    thread = Thread(target=change)
    thread.start()
    thread.join()
