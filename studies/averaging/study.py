"""The page on averages and windows: the numbers and tables that its text names."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from roughline.paper.stated import EXPONENT_TOLERANCE
from roughline.paper.windows import ForceWindow
from roughline.report.page import Table
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.power_law import linear_exponent, scaling_exponent
from roughline.statistics.verdict import Verdict, about
from studies.averaging.figures import exponents_figure
from studies.averaging.measure import (
    BODIES,
    DIMENSIONS,
    HELD_AT_LEVEL,
    HERE,
    PUBLISHED,
    Choice,
    choices,
    count,
    exponent,
    fit,
    reproductions,
    windows,
)
from studies.judged import cell, spread
from studies.paper.data import dataset
from studies.reduced_data import version_of
from studies.study import Study

FORCE, LEVEL = Choice("force", "arithmetic"), Choice("level", "arithmetic")
_GEOMETRIC, _DEPTH = Choice("force", "geometric"), Choice("depth", "arithmetic")
USUAL: dict[str, ForceWindow] = {"surfaces": (1e-2, 1e-1), "lines": (1e-4, 1e-2)}
"""Windows of the page "The paper, recomputed"."""


def told() -> dict[str, object]:
    """Return what the text names."""
    light, usual = windows("surfaces")[0], USUAL["surfaces"]
    every = [
        exponent("surfaces", window, choice, 2.0).value
        for window in windows("surfaces")
        for choice in choices()
    ]
    excess = {
        each: _width(FORCE, each) / np.nanmin([_width(one, each) for one in choices()]) - 1
        for each in DIMENSIONS
    }
    return {
        "surfaces": count("surfaces"),
        "lines": count("lines"),
        "spread": spread(each for each in every if not np.isnan(each)),
        "laws_apart": max(abs(scaling_exponent(d) - linear_exponent(d)) for d in DIMENSIONS),
        "held_at_level": HELD_AT_LEVEL,
        "tolerance": EXPONENT_TOLERANCE,
        "verdicts_on_lines": _verdict_table("lines"),
        "usual": spread(usual, "g"),
        "narrowest_at": ", ".join(str(each) for each, share in excess.items() if share == 0),
        "excess": max(excess.values()),
        "width_at_force": _width(FORCE, 2.0),
        "width_at_level": _width(LEVEL, 2.0),
        "by_means": _largest_change(_GEOMETRIC),
        "by_depth": _largest_change(_DEPTH),
        "light": spread(light, "g"),
        "light_at_level": cell(exponent("surfaces", light, LEVEL, 2.0)),
        "light_at_force": cell(exponent("surfaces", light, FORCE, 2.0)),
        "exponents": _exponent_table("surfaces"),
        "exponents_of_lines": _exponent_table("lines"),
        "version": version_of(map(dataset, BODIES)),
    }


def _verdict_table(bodies: str) -> Table:
    """Return what every window and mean reproduces."""
    return _table(
        bodies,
        tuple(f"{law} ± {EXPONENT_TOLERANCE:g}" for law in PUBLISHED),
        lambda window, choice: [_reproduced(bodies, window, choice, law) for law in PUBLISHED],
    )


def _exponent_table(bodies: str) -> Table:
    return _table(
        bodies,
        tuple(f"D_f = {each}" for each in DIMENSIONS),
        lambda window, choice: [cell(exponent(bodies, window, choice, d)) for d in DIMENSIONS],
        numbers=range(3, 3 + len(DIMENSIONS)),
    )


def _table(
    bodies: str,
    header: tuple[str, ...],
    cells: Callable[[ForceWindow, Choice], list[str]],
    numbers: range = range(0),
) -> Table:
    """Return a table with a row for every window and mean."""
    rows = [
        (spread(window, "g"), f"fixed {choice.fixed}", choice.averaging, *cells(window, choice))
        for window in windows(bodies)
        for choice in choices()
    ]
    return Table(("F̄", "averaged at", "mean", *header), rows, numbers)


def _reproduced(bodies: str, window: ForceWindow, choice: Choice, law: str) -> str:
    """Say for which fractal dimensions a published exponent is confirmed or left open."""
    found = reproductions(bodies, window, choice, law)
    if not found:
        return "not covered"
    parts = []
    for each in (Verdict.CONFIRMED, Verdict.UNDECIDED):
        cases = {d: case for d, case in found.items() if case.verdict is each}
        if not cases:
            continue
        where = "all D_f" if len(cases) == len(DIMENSIONS) else ", ".join(map(str, cases))
        enough = max(case.enough for case in cases.values())
        parts.append(f"{each}: {where}" + (f" ({about(enough)})" if enough == enough else ""))
    missing = [str(each) for each in DIMENSIONS if each not in found]
    parts = parts or [str(Verdict.REFUTED)]
    return "; ".join([*parts, f"not covered: {', '.join(missing)}"] if missing else parts)


def _usual(choice: Choice, fractal_dimension: float) -> IntervalEstimate:
    return exponent("surfaces", USUAL["surfaces"], choice, fractal_dimension)


def _width(choice: Choice, fractal_dimension: float) -> float:
    """Return the width of the interval of an exponent of surfaces."""
    found = _usual(choice, fractal_dimension)
    return found.high - found.low


def _largest_change(other: Choice) -> float:
    """Return by how much an exponent of surfaces differs at most from the recommended one."""
    return max(abs(_usual(other, each).value - _usual(FORCE, each).value) for each in DIMENSIONS)


STUDY = Study(
    HERE,
    verdicts=partial(_verdict_table, "surfaces"),
    told=told,
    figures={"exponents": exponents_figure},
)
publish, reduce = STUDY.publish, fit
