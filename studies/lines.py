"""A run that writes a line for each body, and goes on where it stopped."""

from __future__ import annotations

import multiprocessing
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from roughline.errors import RoughlineError

_DIGITS = 5


@dataclass(frozen=True)
class Run:
    """Bodies that are measured one after the other, or in processes; each is one line of a file.

    What the file has is not computed again, and no more is lost than the bodies in work. The file
    is the same whatever the processes. After each body it is said how long the rest will take.
    """

    line: Callable[[Any], str]  # measures a body, and returns its line
    body_of: Callable[[str], Any]  # which body a line is of
    seconds: Callable[[Any], float]  # about how long a body takes [s]

    def __call__(self, bodies: Sequence[Any], file: Path, processes: int = 1) -> None:
        """Measure those bodies that a file does not have, and append them to it."""
        file.parent.mkdir(parents=True, exist_ok=True)
        done = set(map(self.body_of, _whole_lines(file)))
        missing = [body for body in bodies if body not in done]
        left, took = sum(map(self.seconds, missing)), 0.0
        start = time.perf_counter()
        with file.open("a", encoding="utf-8") as out:
            lines = zip(missing, self._lines(missing, processes), strict=True)
            for number, (body, line) in enumerate(lines, len(done) + 1):
                out.write(line)
                out.flush()
                took += self.seconds(body)
                minutes = (time.perf_counter() - start) / 60 * (left / took - 1)
                print(f"{number} of {len(bodies)}, {minutes:.0f} min left", flush=True)

    def _lines(self, bodies: Sequence[Any], processes: int) -> Iterator[str]:
        """Measure bodies, and return the line of each in their order."""
        if processes == 1:
            yield from map(self.line, bodies)
            return
        context = multiprocessing.get_context("spawn")
        with context.Pool(processes, _leave_interrupts) as pool:
            yield from pool.imap(self.line, bodies)

    def main(self, bodies: Sequence[Any], file: str, processes: str = "1") -> None:
        """Run a study from the command line; an error is one line, and so are Ctrl-C, SIGTERM."""
        signal.signal(signal.SIGTERM, signal.default_int_handler)
        try:
            self(bodies, Path(file), int(processes))
        except RoughlineError as error:
            sys.exit(f"error: {error}")
        except KeyboardInterrupt:
            sys.exit("stopped; the same command goes on from here")


def rounded(value: float | list[float]) -> float | list[float]:
    """Round to the digits that are written."""
    if isinstance(value, list):
        return [float(f"{each:.{_DIGITS}g}") for each in value]
    return float(f"{value:.{_DIGITS}g}")


def in_turns(counts: dict[Any, int]) -> list[tuple[Any, int]]:
    """Return the bodies of cases in an order that takes the same share of each case."""
    shares = [
        ((number + 0.5) / count, i, (case, number))
        for i, (case, count) in enumerate(counts.items())
        for number in range(count)
    ]
    return [body for *_, body in sorted(shares, key=lambda each: each[:2])]


def kept_lines(file: Path, bodies: Sequence[Any], body_of: Callable[[str], Any]) -> str:
    """Return the lines of a file that are of some bodies, in their order; a run may go on."""
    lines = file.read_text(encoding="utf-8").splitlines(keepends=True)
    found = {body_of(line): line for line in lines if line.endswith("\n")}
    return "".join(found[body] for body in bodies if body in found)


def _whole_lines(file: Path) -> list[str]:
    """Lines that a file has, after one that was cut off is taken away."""
    file.touch()
    with file.open("r+b") as lines:
        content = lines.read()
        whole = content.rfind(b"\n") + 1
        lines.truncate(whole)
    return content[:whole].decode("utf-8").splitlines()


def _leave_interrupts() -> None:
    """Leave Ctrl-C to the process that writes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
