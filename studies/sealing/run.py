"""Press all bodies of the study, one after the other, and write each down when it is done.

    python -m studies.sealing.run FILE [PROCESSES]

goes on where it stopped, by Ctrl-C or else: what the file has is not computed again, and no more is
lost than the bodies in work. It takes some four hours of one core, or half of that of two; the
file is the same whatever the processes. After each body it says how long the rest will take.
"""

from __future__ import annotations

import json
import multiprocessing
import signal
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from functools import cache
from pathlib import Path

from roughline._version import __version__
from roughline.errors import ConvergenceError, RoughlineError, StoreError
from studies.sealing.body import ELASTIC, FULL, MOSTLY, WEAK, Case, measured

HURSTS = (0.3, 0.5, 0.8)
HARDNESSES = (ELASTIC, WEAK, FULL)
COUNTS = {4: 160, 8: 100, 16: 56, 32: 32}
"""Surfaces of each case, by the roll-off waves along a side."""
LEAKING, LEAKS = 16, 16
"""Waves along a side of the bodies of which the leak is judged, and how many leak of each case."""
MIDDLE, MIDDLE_COUNT = 8, 20
"""Waves of the bodies with one more hardness, MOSTLY, and how many; all of them leak."""
CELLS, FINE_WAVES = 8, 4
"""Cells for the shortest wave, and waves of the bodies that show the error of the grid."""
FINE_COUNTS = {16: 80, 32: 12}
"""How many of these, by their cells for the shortest wave."""
FINE_LEAKS = 8
"""How many of those with twice as many cells leak, and of the same on the grid of the study."""
FINE_CELLS, FINEST_CELLS = FINE_COUNTS

Body = tuple[Case, int]
"""A case, and the number of one of its bodies."""

_DIGITS = 5
_FLOW = "cell"  # how gaps are closed along the flow; rows without it are of gaps with two ends
_SECONDS, _GROWTH = 0.28, 1.85
"""What a small body takes without leaks [s], and the power of the side with which it grows."""
_LEAKING_TIMES = 8.0  # as long takes a body of which leaks are measured


@cache
def counts() -> dict[Case, tuple[int, int]]:
    """How many bodies there are of each case, and how many of these leak."""
    leaking = {FINE_WAVES: FINE_LEAKS, LEAKING: LEAKS}
    found = {
        Case(waves, hurst, hardness): (count, leaking.get(waves, 0))
        for waves, count in COUNTS.items()
        for hurst in HURSTS
        for hardness in HARDNESSES
    }
    for hurst in HURSTS:
        found[Case(MIDDLE, hurst, MOSTLY)] = MIDDLE_COUNT, MIDDLE_COUNT
        found[Case(MIDDLE, hurst, ELASTIC)] = COUNTS[MIDDLE], MIDDLE_COUNT  # to stand beside these
        for cells in (CELLS, FINE_CELLS):
            found[Case(FINE_WAVES, hurst, MOSTLY, cells)] = FINE_LEAKS, FINE_LEAKS
        for hardness in HARDNESSES:
            for cells, count in FINE_COUNTS.items():
                leaks_too = FINE_LEAKS if cells == FINE_CELLS else 0
                found[Case(FINE_WAVES, hurst, hardness, cells)] = count, leaks_too
    return found


def planned() -> list[Body]:
    """Return all bodies in the order in which they are pressed: the same share of each case."""
    shares = [
        ((number + 0.5) / count, i, (case, number))
        for i, (case, (count, _)) in enumerate(counts().items())
        for number in range(count)
    ]
    return [body for *_, body in sorted(shares, key=lambda each: each[:2])]


def leaks(body: Body) -> bool:
    """Whether it is measured what leaks through a body."""
    case, number = body
    return number < counts().get(case, (0, 0))[1]


def seconds(body: Body) -> float:
    """About how long a body takes. [s]"""
    case, _ = body
    alone = _SECONDS * (case.points / Case(FINE_WAVES, HURSTS[0], ELASTIC).points) ** _GROWTH
    return alone * (_LEAKING_TIMES if leaks(body) else 1.0)


def run(bodies: Sequence[Body], file: Path, processes: int = 1) -> None:
    """Press those bodies that a file does not have, and append them to it."""
    file.parent.mkdir(parents=True, exist_ok=True)
    done = set(map(body_of, _whole_lines(file)))
    missing = [body for body in bodies if body not in done]
    left, took = sum(map(seconds, missing)), 0.0
    start = time.perf_counter()
    with file.open("a", encoding="utf-8") as out:
        lines = zip(missing, _lines(missing, processes), strict=True)
        for number, (body, line) in enumerate(lines, len(done) + 1):
            out.write(line)
            out.flush()
            took += seconds(body)
            minutes = (time.perf_counter() - start) / 60 * (left / took - 1)
            print(f"{number} of {len(bodies)}, {minutes:.0f} min left", flush=True)


def _whole_lines(file: Path) -> list[str]:
    """Lines that a file has, after one that was cut off is taken away."""
    file.touch()
    with file.open("r+b") as lines:
        content = lines.read()
        whole = content.rfind(b"\n") + 1
        lines.truncate(whole)
    return content[:whole].decode("utf-8").splitlines()


def _lines(bodies: Sequence[Body], processes: int) -> Iterator[str]:
    """Press bodies, and return the line of each in their order."""
    if processes == 1:
        yield from map(_line, bodies)
        return
    context = multiprocessing.get_context("spawn")
    with context.Pool(processes, _leave_interrupts) as pool:
        yield from pool.imap(_line, bodies)


def _leave_interrupts() -> None:
    """Leave Ctrl-C to the process that writes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _line(body: Body) -> str:
    """Press a body, and write its line; nothing was found where a load was not solved."""
    case, number = body
    try:
        found = measured(case, number, leaks(body))
    except ConvergenceError:
        found = {}
    rounded = {name: _rounded(value) for name, value in found.items()}
    of = {**asdict(case), "hardness": str(case.hardness), "number": number}
    return json.dumps({**of, "flow": _FLOW, "version": __version__, **rounded}) + "\n"


def _rounded(value: float | list[float]) -> float | list[float]:
    """Round to the digits that are written."""
    if isinstance(value, list):
        return [float(f"{each:.{_DIGITS}g}") for each in value]
    return float(f"{value:.{_DIGITS}g}")


def body_of(line: str) -> Body:
    """Return which body a line is of; one of a gap with two ends is refused."""
    content = json.loads(line)
    if content.get("flow") != _FLOW:
        raise StoreError(
            "the data of sealing are of gaps with an inlet and an outlet, by an older version, and "
            "gaps repeat along the flow now: move them away, and run make sealing again"
        )
    waves, hurst, cells = (content[name] for name in ("waves", "hurst", "cells"))
    return Case(waves, hurst, float(content["hardness"]), cells), content["number"]


def main(file: str, processes: str = "1") -> None:
    """Run the study; an error is one line, and so are Ctrl-C and SIGTERM."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        run(planned(), Path(file), int(processes))
    except RoughlineError as error:
        sys.exit(f"error: {error}")
    except KeyboardInterrupt:
        sys.exit("stopped; the same command goes on from here")


if __name__ == "__main__":
    main(*sys.argv[1:])
