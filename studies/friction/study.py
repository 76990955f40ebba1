"""The page of the study of friction: its numbers, tables and text."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cache
from pathlib import Path

import numpy as np

from roughline.errors import StoreError
from roughline.report.page import Table
from studies.friction.body import BAND, COUPLED_POINTS, CYCLES, GROWTH, POINTS, SHARES, Case
from studies.friction.claims import WORDS, Pair, beside_jaeger, claims, ratio, rubber, two_materials
from studies.friction.figures import SHOWN, friction_figure
from studies.friction.measure import FEWEST, LINES, Data, over_lines
from studies.friction.run import COUNT, FEWER, HURSTS, MIDDLE, PAIRS, body_of, one_material, planned
from studies.judged import Found, spread
from studies.lines import kept_lines
from studies.study import Study, claims_table

DATA = Path(__file__).parent / "data.jsonl"


@cache
def data() -> Data:
    """Read the data of the study; fewer than two bodies of a case are refused."""
    found = Data.of(DATA.read_text(encoding="utf-8").splitlines() if DATA.exists() else ())
    fewest = min(found.sample(case).count for case in _cases())
    if fewest < FEWEST:
        raise StoreError(
            f"{DATA.name}: a case of the study of friction has {fewest} bodies, and intervals need "
            f"{FEWEST}; go on with make friction"
        )
    return found


def reduce(file: Path) -> None:
    """Keep what a run has of the plan, in its order; it need not have ended."""
    DATA.write_text(kept_lines(file, planned(), body_of), encoding="utf-8")
    data.cache_clear()


def told(found: Data) -> dict[str, object]:
    """Return what the text names."""
    return {
        "hursts": ", ".join(f"{hurst:g}" for hurst in HURSTS),
        "shown": SHOWN,
        "band": BAND,
        "points": POINTS,
        "coupled_points": COUPLED_POINTS,
        "growth": GROWTH,
        "cycles": CYCLES,
        "largest": SHARES[-1],
        "middle": MIDDLE,
        "lines": LINES,
        "planned": f"{COUNT}, and {FEWER} of three of the pairs of materials",
        "counts": spread((found.sample(case).count for case in one_material()), "d"),
        "pressed": spread((found.pressed(case).count for case in one_material()), "d"),
        "coupled_counts": spread((found.sample(case).count for case in _coupled()), "d"),
        "is_part": "A part of the plan was run. " if len(found.bodies) < len(planned()) else "",
        "stiffness": _percents(found.sample(case).stiffness() for case in one_material()),
        "off": _percent_of_single(found),
        "slip": _percents(
            found.sample(case).slip(i) for case in one_material() for i in range(len(SHARES))
        ),
        "added": {
            ratio(pair) if i < len(PAIRS) - 1 else "other": _percents(
                found.sample(case).by_coupling(k)
                for case in two_materials(pair)
                for k in range(len(SHARES))
            )
            for i, pair in enumerate(PAIRS)
        },
        "more": {ratio(pair): f"{_beside_jaeger(found, pair):.0%}" for pair in list(PAIRS)[:-1]},
        "first": _percents(found.sample(case).loop(0) for case in _coupled()),
        "third": _percents(found.sample(case).loop(CYCLES - 1) for case in _coupled()),
        "reduced": {
            quantity: _percents(
                over_lines(found.pressed(case), quantity) for case in one_material()
            )
            for quantity in WORDS
        },
        "sheared": _sheared_table(found),
        "coupled": _coupled_table(found),
        "lines_table": _reduced_table(found),
        "bodies": len(found.bodies),
        "unsolved": found.unsolved,
        "version": found.version,
    }


def _beside_jaeger(found: Data, pair: Pair) -> float:
    """Return the mean over Hurst exponents of the largest slide over Jäger's, less 1."""
    return float(np.mean([*found.over_hursts(two_materials(pair), beside_jaeger).values()]))


def _coupled() -> list[Case]:
    return [case for pair in PAIRS for case in two_materials(pair)]


def _cases() -> list[Case]:
    return [*one_material(), *rubber(), *_coupled()]


def _percents(found: Iterable[Found]) -> str:
    """Return the smallest and the largest of some relative changes."""
    return spread((one.value for one in found if not math.isnan(one.value)), "+.1%")


def _percent_of_single(found: Data) -> str:
    """Return the standard deviations of single bodies and directions from Jäger's slides."""
    rms = (
        float(np.sqrt(np.mean(np.square(found.sample(case).off(len(SHARES) - 1)))))
        for case in one_material()
    )
    return spread(rms, ".1%")


def _told(one: Found) -> str:
    return "-" if math.isnan(one.value) else f"{one.value:+.1%} ({one.low:+.1%} to {one.high:+.1%})"


def _of_shares() -> list[str]:
    return [f"slide at {share:g} μF" for share in SHARES]


def _sheared_table(found: Data) -> Table:
    header = ("Hurst", "ν", "F̄", "surfaces", "k_t/k_n", *_of_shares(), "loop")
    rows = []
    for case in (*one_material(), *rubber()):
        one = found.sample(case)
        slides = (_told(one.slip(i)) for i in range(len(SHARES)))
        numbers = (_told(one.stiffness()), *slides, _told(one.loop(0)))
        rows.append(
            (
                f"{case.hurst:g}",
                f"{case.poisson:g}",
                f"{case.force_bar:g}",
                f"{one.count}",
                *numbers,
            )
        )
    return Table(header, rows, range(len(header)))


def _coupled_table(found: Data) -> Table:
    header = (
        *("μ/β", "β", "μ", "Hurst", "surfaces", "depth"),
        *_of_shares(),
        *(f"beside β = 0, {share}" for share in _of_shares()),
        *(f"loop {cycle + 1}" for cycle in range(CYCLES)),
    )
    rows = []
    for case in _coupled():
        one = found.sample(case)
        pair = case.beta, case.friction
        of = (ratio(pair), f"{case.beta:.3g}", f"{case.friction:g}", f"{case.hurst:g}")
        numbers = (
            one.nearer(),
            *(one.slip(i) for i in range(len(SHARES))),
            *(one.by_coupling(i) for i in range(len(SHARES))),
            *(one.loop(cycle) for cycle in range(CYCLES)),
        )
        rows.append((*of, f"{one.count}", *map(_told, numbers)))
    return Table(header, rows, range(len(header)))


def _reduced_table(found: Data) -> Table:
    header = ("Hurst", "F̄", "surfaces", *WORDS.values())
    rows = []
    for case in one_material():
        one = found.pressed(case)
        numbers = (_told(over_lines(one, quantity)) for quantity in WORDS)
        rows.append((f"{case.hurst:g}", f"{case.force_bar:g}", f"{one.count}", *numbers))
    return Table(header, rows, range(len(header)))


STUDY = Study(
    DATA.parent,
    verdicts=lambda: claims_table({"Verdict": claims(data())}),
    told=lambda: told(data()),
    figures={"friction": lambda: friction_figure(data())},
)
publish = STUDY.publish
