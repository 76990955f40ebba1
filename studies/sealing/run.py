"""Press all bodies of the study, one after the other, and write each down when it is done.

    python -m studies.sealing.run FILE [PROCESSES]

goes on where it stopped: what the file has is not computed again, and no more is lost than the
bodies in work. It takes six hours of one core; the file is the same whatever the processes.
"""

from __future__ import annotations

import json
import multiprocessing
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path

from roughline._version import __version__
from roughline.errors import ConvergenceError
from studies.sealing.body import ELASTIC, FULL, MOSTLY, WEAK, Case, measured

HURSTS = (0.3, 0.5, 0.8)
HARDNESSES = (ELASTIC, WEAK, FULL)
COUNTS = {4: 60, 8: 40, 16: 30}
"""Surfaces of each case, by the roll-off waves along a side."""
MIDDLE = 8
"""Waves along a side of the bodies with one more hardness, MOSTLY."""
FINE_CELLS, FINE_WAVES, FINE_COUNT = 16, 4, 12
"""Cells for the shortest wave of the bodies that show the error of the grid, and how many."""

Body = tuple[Case, int]
"""A case, and the number of one of its bodies."""

_DIGITS = 5


def planned() -> list[Body]:
    """Return all bodies in the order in which they are pressed: the same number of each case."""
    counts = {
        Case(waves, hurst, hardness): count
        for waves, count in COUNTS.items()
        for hurst in HURSTS
        for hardness in HARDNESSES
    }
    for hurst in HURSTS:
        counts[Case(FINE_WAVES, hurst, MOSTLY)] = FINE_COUNT
        counts[Case(MIDDLE, hurst, MOSTLY)] = COUNTS[MIDDLE]
    for hurst in HURSTS:
        for hardness in (*HARDNESSES, MOSTLY):
            counts[Case(FINE_WAVES, hurst, hardness, FINE_CELLS)] = FINE_COUNT
    return [
        (case, number)
        for number in range(max(counts.values()))
        for case, count in counts.items()
        if number < count
    ]


def run(bodies: Sequence[Body], file: Path, processes: int = 1) -> None:
    """Press those bodies that a file does not have, and append them to it."""
    file.parent.mkdir(parents=True, exist_ok=True)
    lines = file.read_text(encoding="utf-8").splitlines(keepends=True) if file.exists() else []
    whole = [line for line in lines if line.endswith("\n")]
    file.write_text("".join(whole), encoding="utf-8")  # without a line that was cut off
    done = set(map(body_of, whole))
    open_bodies = [body for body in bodies if body not in done]
    with file.open("a", encoding="utf-8") as out:
        for number, line in enumerate(_lines(open_bodies, processes), len(done) + 1):
            out.write(line)
            out.flush()
            print(f"{number} of {len(bodies)}", flush=True)


def _lines(bodies: Sequence[Body], processes: int) -> Iterator[str]:
    """Press bodies, and return the line of each in their order."""
    if processes == 1:
        yield from map(_line, bodies)
        return
    with multiprocessing.get_context("spawn").Pool(processes) as pool:
        yield from pool.imap(_line, bodies)


def _line(body: Body) -> str:
    """Press a body, and write its line; nothing was found where a load was not solved."""
    case, number = body
    try:
        found = measured(case, number)
    except ConvergenceError:
        found = {}
    rounded = {name: _rounded(value) for name, value in found.items()}
    of = {**asdict(case), "hardness": str(case.hardness), "number": number, "version": __version__}
    return json.dumps({**of, **rounded}) + "\n"


def _rounded(value: float | list[float]) -> float | list[float]:
    """Round to the digits that are written."""
    if isinstance(value, list):
        return [float(f"{each:.{_DIGITS}g}") for each in value]
    return float(f"{value:.{_DIGITS}g}")


def body_of(line: str) -> Body:
    """Return which body a line is of."""
    content = json.loads(line)
    waves, hurst, cells = (content[name] for name in ("waves", "hurst", "cells"))
    return Case(waves, hurst, float(content["hardness"]), cells), content["number"]


if __name__ == "__main__":
    run(planned(), Path(sys.argv[1]), *map(int, sys.argv[2:]))
