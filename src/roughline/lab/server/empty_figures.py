"""The empty figures of all views, drawn by a process of its own: Bokeh is slow, and takes memory.

    python -m roughline.lab.server.empty_figures MODULE MODULE ...

calls the function ``figures`` of each module in turn, and writes the length of what it gives (8
bytes, least first; 0 if it failed) and that itself.
"""

from __future__ import annotations

import asyncio
import os
import subprocess
import sys
import traceback
from collections.abc import Mapping, Sequence
from contextlib import suppress
from importlib import import_module
from typing import IO

from roughline.lab.server.process import without_interrupts

_LENGTH = 8  # bytes


class EmptyFigures:
    """The figures, as they come from the process that draws them.

    Parameters
    ----------
    modules : mapping of str to str
        Names of the sets of figures, and the module of each; the first is drawn first.
    """

    def __init__(self, modules: Mapping[str, str]) -> None:
        self._names = list(modules)
        self._drawn: dict[str, asyncio.Task[bytes | None]] = {}
        with without_interrupts():
            self._process = subprocess.Popen(
                [sys.executable, "-m", __name__, *modules.values()],
                stdout=subprocess.PIPE,
                stdin=subprocess.DEVNULL,
            )

    def of_view(self, view: str) -> asyncio.Future[bytes | None]:
        """The figures of a view, as soon as they are there; None if they could not be drawn."""
        if not self._drawn:
            self._read()
        return asyncio.shield(self._drawn[view])

    def close(self) -> None:
        """Stop drawing."""
        self._process.kill()
        self._process.wait()

    def _read(self) -> None:
        """Have a thread wait for one view after the other."""
        before: asyncio.Task[bytes | None] | None = None
        for view in self._names:
            before = self._drawn[view] = asyncio.create_task(self._next(before))

    async def _next(self, before: asyncio.Task[bytes | None] | None) -> bytes | None:
        if before is not None:
            await before
        assert self._process.stdout is not None
        return await asyncio.to_thread(_received, self._process.stdout)


def _received(stream: IO[bytes]) -> bytes | None:
    """Figures of one view; None if there are none."""
    length = int.from_bytes(stream.read(_LENGTH), "little")
    drawn = stream.read(length)
    return drawn if len(drawn) == length > 0 else None


def _write(modules: Sequence[str], stream: IO[bytes]) -> None:
    """Draw the figures of views, and write them."""
    for module in modules:
        drawn = b""
        try:
            drawn = import_module(module).figures()
        except Exception:
            traceback.print_exc(file=sys.stderr)
        stream.write(len(drawn).to_bytes(_LENGTH, "little") + drawn)
        stream.flush()
        with suppress(AttributeError, OSError):
            os.nice(10)  # the others are wanted later


if __name__ == "__main__":
    with suppress(BrokenPipeError):  # the server is gone
        _write(sys.argv[1:], sys.stdout.buffer)
