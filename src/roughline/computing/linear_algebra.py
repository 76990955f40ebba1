"""Linear algebra on one thread, as long as any computation needs that."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Lock, Thread

from threadpoolctl import threadpool_limits

_lock = Lock()
_at_work = 0
_limits: list[threadpool_limits] = []  # one, as long as anyone is at work


@contextmanager
def on_one_thread() -> Iterator[None]:
    """Keep the linear algebra of this process to one thread within a ``with`` block.

    The number of its threads belongs to the process, and the last bits of results depend on it. So
    it is changed when the first of several threads of this process begins to compute, and restored
    when the last of them has ended.
    """
    global _at_work
    with _lock:
        if not _limits:
            _in_passing(lambda: _limits.append(threadpool_limits(limits=1, user_api="blas")))
        _at_work += 1
    try:
        yield
    finally:
        with _lock:
            _at_work -= 1
            if not _at_work:
                _in_passing(lambda: _limits.pop().restore_original_limits())


def _in_passing(change: Callable[[], None]) -> None:
    """Change the number of threads from a thread that ends with it.

    threadpoolctl lets no other thread change it as long as the one that did is alive.
    """
    thread = Thread(target=change)
    thread.start()
    thread.join()
