"""Press all bodies of the study, one after the other, and write each down when it is done.

    python -m studies.sealing.run FILE [PROCESSES]

goes on where it stopped, as :class:`studies.lines.Run` says. It takes some four hours of one core,
or half of that of two.
"""

from __future__ import annotations

import json
import sys
from dataclasses import asdict
from functools import cache

from roughline._version import __version__
from roughline.errors import ConvergenceError, StoreError
from studies.lines import Run, in_turns, rounded
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
    return in_turns({case: count for case, (count, _) in counts().items()})


def leaks(body: Body) -> bool:
    """Whether it is measured what leaks through a body."""
    case, number = body
    return number < counts().get(case, (0, 0))[1]


def seconds(body: Body) -> float:
    """About how long a body takes. [s]"""
    case, _ = body
    alone = _SECONDS * (case.points / Case(FINE_WAVES, HURSTS[0], ELASTIC).points) ** _GROWTH
    return alone * (_LEAKING_TIMES if leaks(body) else 1.0)


def _line(body: Body) -> str:
    """Press a body, and write its line; nothing was found where a load was not solved."""
    case, number = body
    try:
        found = measured(case, number, leaks(body))
    except ConvergenceError:
        found = {}
    values = {name: rounded(value) for name, value in found.items()}
    of = {**asdict(case), "hardness": str(case.hardness), "number": number}
    return json.dumps({**of, "flow": _FLOW, "version": __version__, **values}) + "\n"


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


run = Run(_line, body_of, seconds)

if __name__ == "__main__":
    run.main(planned(), *sys.argv[1:])
