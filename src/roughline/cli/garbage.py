"""When a command looks for garbage: seldom while libraries load, as usual in long work.

Libraries make many objects that stay. To look through them again and again takes some per cent of
the time to the first answer, and to look through them before the process ends, a fifth.
"""

from __future__ import annotations

import atexit
import gc

_USUAL = gc.get_threshold()
_SELDOM = (10_000, 100, 1_000)


def seldom() -> None:
    """Look for garbage seldom until long work begins, and not when the process ends."""
    gc.set_threshold(*_SELDOM)
    atexit.unregister(gc.freeze)
    atexit.register(gc.freeze)


def as_usual() -> None:
    """Look for garbage as usual, but not among what is there by now."""
    gc.freeze()
    gc.set_threshold(*_USUAL)
