"""What the server and its processes write as errors: of each kind a few, and all within a size."""

from __future__ import annotations

import os
import re
import select
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

_MOST_ALIKE, _MINUTE = 5, 60.0  # messages of a kind within so many seconds
_MOST_BYTES, _HOUR = 200_000, 3600.0  # of all messages within so many seconds
_LONGEST = 10_000  # message [bytes]
_MOST_KINDS = 1000  # that are told apart
_VARIES = re.compile(r"0x[0-9A-Fa-f]+|\d+(?:\.\d+)?(?:e[+-]?\d+)?|'[^']*'|\"[^\"]*\"")
_END = b"\0"


class _Limiter:
    """Passes messages on as long as they are few."""

    def __init__(self, write: Callable[[str], None]) -> None:
        self._write = write
        self._counts: dict[str, int] = {}
        self._minute = self._hour = time.monotonic()
        self._written = 0

    def take(self, message: str) -> None:
        """Pass a message on unless there were many of its kind, or too many bytes."""
        self.look_at_clock()
        kind = _kind(message)
        if kind not in self._counts and len(self._counts) >= _MOST_KINDS:
            kind = "others"
        self._counts[kind] = self._counts.get(kind, 0) + 1
        if self._counts[kind] <= _MOST_ALIKE:
            self._pass_on(message)

    def look_at_clock(self) -> None:
        """Tell at the end of a minute what was left out, and begin anew; so with an hour."""
        now = time.monotonic()
        if now - self._minute >= _MINUTE:
            self.tell()
            self._minute = now
        if now - self._hour >= _HOUR:
            self._hour, self._written = now, 0

    def tell(self) -> None:
        """Say how much was left out."""
        for kind, count in self._counts.items():
            if count > _MOST_ALIKE:
                self._pass_on(f"… and {count - _MOST_ALIKE} more like this: {kind[-100:]}\n")
        self._counts.clear()

    def _pass_on(self, message: str) -> None:
        before, self._written = self._written, self._written + len(message.encode())
        if self._written <= _MOST_BYTES:
            self._write(message)
        elif before <= _MOST_BYTES:
            self._write(f"… more than {_MOST_BYTES / 1000:g} kB within an hour: no more of it\n")


class _Messages:
    """Puts lines together to messages: a traceback is one, any other line is one."""

    def __init__(self, take: Callable[[str], None]) -> None:
        self._take = take
        self._rest, self._traceback = b"", ""

    def read(self, piece: bytes) -> None:
        """Take what was written, up to the last end of a line; more than a long line is one."""
        *lines, self._rest = (self._rest + piece).split(b"\n")
        if len(self._rest) > _LONGEST:
            lines, self._rest = [*lines, self._rest], b""
        for line in lines:
            self._read_line(line[:_LONGEST].decode(errors="replace") + "\n")

    def end(self) -> None:
        """Take what has no end."""
        if self._rest:
            self.read(b"\n")
        if self._traceback:
            self._take(self._traceback)
            self._traceback = ""

    def _read_line(self, line: str) -> None:
        if self._traceback or line.startswith("Traceback (most recent call last)"):
            is_last = bool(self._traceback) and not line.startswith(" ")
            self._traceback += line
            if is_last or len(self._traceback) > _LONGEST:
                self._take(self._traceback)
                self._traceback = ""
        else:
            self._take(line)


def _kind(message: str) -> str:
    """What messages of a kind have in common: the places of a traceback, or the fixed words."""
    lines = message.splitlines() or [""]
    if len(lines) == 1:
        return _VARIES.sub("#", lines[0])
    places = [line for line in lines if line.startswith("  File ")]
    return "\n".join([*places, lines[-1].partition(":")[0]])


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
    relay = threading.Thread(target=_relay, args=(source, terminal, ending), daemon=True)
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


def _relay(source: int, terminal: int, ending: threading.Event) -> None:
    """Pass on what comes, until the end."""

    def write(message: str) -> None:
        with suppress(OSError):  # such as no room on the disk
            os.write(terminal, message.encode())

    limiter = _Limiter(write)
    messages = _Messages(limiter.take)
    has_ended = False
    while not has_ended:
        if sys.platform != "win32" and not select.select([source], [], [], _MINUTE)[0]:
            limiter.look_at_clock()
            continue
        piece = os.read(source, 2**16)
        has_ended = ending.is_set() and _END in piece
        messages.read(piece.replace(_END, b""))
    messages.end()
    limiter.tell()
