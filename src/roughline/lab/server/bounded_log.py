"""What the server and its processes write as errors: of each kind a few, and all within a size."""

from __future__ import annotations

import os
import re
import select
import sys
import threading
import time
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress

_MOST_OF_KIND, _MINUTE = 5, 60.0  # messages of a kind within so many seconds
_MOST_BYTES, _HOUR = 200_000, 3600.0  # of all messages within so many seconds
_LONGEST_MESSAGE = 10_000  # [bytes]
_MOST_KINDS = 1000  # that are told apart
_VARIES = re.compile(r"0x[0-9A-Fa-f]+|\d+(?:\.\d+)?(?:e[+-]?\d+)?|'[^']*'|\"[^\"]*\"")
_END = b"\0"


@contextmanager
def bounded_log() -> Iterator[None]:
    """Bound what this process, and all that it starts, write as errors."""
    if sys.stderr is None:  # there is nobody who reads it
        yield
        return
    terminal = os.dup(2)
    source, sink = os.pipe()
    os.dup2(sink, 2)
    os.close(sink)
    ending = threading.Event()
    limited = _Limiter(terminal).pass_on
    relay = threading.Thread(target=limited, args=(_messages(source, ending),), daemon=True)
    relay.start()
    try:
        yield
    finally:
        ending.set()
        os.write(2, _END)
        relay.join()
        os.dup2(terminal, 2)
        os.close(source)
        os.close(terminal)


def _messages(source: int, ending: threading.Event) -> Iterator[str]:
    """Messages as they come: a traceback is one, any other line is one; empty after a quiet minute.

    What has no end within a long line is a message as well.
    """
    rest, traceback, is_last = b"", "", False
    while not is_last:
        if sys.platform != "win32" and not select.select([source], [], [], _MINUTE)[0]:
            yield ""
            continue
        piece = os.read(source, 2**16)
        is_last = ending.is_set() and _END in piece
        *lines, rest = (rest + piece.replace(_END, b"")).split(b"\n")
        if len(rest) > _LONGEST_MESSAGE or (is_last and rest):
            lines, rest = [*lines, rest], b""
        for line in (each[:_LONGEST_MESSAGE].decode(errors="replace") + "\n" for each in lines):
            is_inside = traceback != ""
            if is_inside or line.startswith("Traceback (most recent call last)"):
                traceback += line
            if not traceback:
                yield line
            elif (is_inside and not line.startswith(" ")) or len(traceback) > _LONGEST_MESSAGE:
                yield traceback
                traceback = ""
    yield traceback


class _Limiter:
    """Passes messages on to a terminal as long as they are few."""

    def __init__(self, terminal: int) -> None:
        self._terminal = terminal
        self._counts: Counter[str] = Counter()
        self._minute = self._hour = time.monotonic()
        self._written = 0

    def pass_on(self, messages: Iterable[str]) -> None:
        """Pass on what comes, until the end."""
        for message in messages:
            self._take(message)
        self._tell()

    def _take(self, message: str) -> None:
        """Pass a message on unless there were many of its kind, or too many bytes."""
        now = time.monotonic()
        if now - self._minute >= _MINUTE:
            self._tell()
            self._minute = now
        if now - self._hour >= _HOUR:
            self._hour, self._written = now, 0
        kind = _kind(message)
        if kind not in self._counts and len(self._counts) >= _MOST_KINDS:
            kind = "others"
        self._counts[kind] += 1
        if self._counts[kind] <= _MOST_OF_KIND:
            self._write(message)

    def _tell(self) -> None:
        """Say how much was left out, and begin anew."""
        for kind, count in self._counts.items():
            if count > _MOST_OF_KIND and kind:
                self._write(f"… and {count - _MOST_OF_KIND} more like this: {kind[-100:]}\n")
        self._counts.clear()

    def _write(self, message: str) -> None:
        before, self._written = self._written, self._written + len(message.encode())
        if self._written > _MOST_BYTES:
            message = f"… more than {_MOST_BYTES / 1000:g} kB within an hour: no more of it\n"
        if before <= _MOST_BYTES:
            with suppress(OSError):  # such as no room on the disk
                os.write(self._terminal, message.encode())


def _kind(message: str) -> str:
    """What messages of a kind have in common: the places of a traceback, or the fixed words."""
    lines = message.splitlines() or [""]
    if len(lines) == 1:
        return _VARIES.sub("#", lines[0])
    places = [line for line in lines if line.startswith("  File ")]
    return "\n".join([*places, lines[-1].partition(":")[0]])
