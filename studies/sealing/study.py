"""The page on sealing: the numbers and tables that its text names."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from pathlib import Path

from roughline.errors import StoreError
from roughline.report.page import Table
from studies.judged import Found, cell, change, spread
from studies.lines import kept_lines
from studies.sealing.body import (
    BAND,
    COMPARED,
    ELASTIC,
    FULL,
    LOADS,
    MOSTLY,
    TENFOLD,
    WEAK,
    Case,
)
from studies.sealing.claims import BELOW, BEYOND, KINDS, THEORIES, claims
from studies.sealing.figures import SHOWN, sealing_figure
from studies.sealing.measure import (
    Data,
    area_shift,
    mean,
    over_theory,
    plastic_factor,
    ratio,
    taken_off,
    tightening,
    until_open,
)
from studies.sealing.run import (
    CELLS,
    COUNTS,
    FINE_CELLS,
    FINE_COUNTS,
    FINE_WAVES,
    FINEST_CELLS,
    HARDNESSES,
    HURSTS,
    LEAKING,
    LEAKS,
    MIDDLE,
    body_of,
    planned,
)
from studies.sealing.scaling import (
    LARGEST,
    WINDING,
    at_sealing,
    at_share,
    first_and_last,
    scaling,
    threshold,
)
from studies.study import Study, claims_table

DATA = Path(__file__).parent / "data.jsonl"
_OF_EACH = ((ELASTIC, LEAKING), (WEAK, LEAKING), (MOSTLY, MIDDLE), (FULL, LEAKING))


@cache
def data() -> Data:
    """Read the data of the study, all of them; a part is refused."""
    found = Data.of(DATA.read_text(encoding="utf-8").splitlines() if DATA.exists() else ())
    bodies = planned()
    if missing := sum(body not in found.bodies for body in bodies):
        raise StoreError(
            f"{DATA.name}: {missing} of {len(bodies)} bodies of the study of sealing are not "
            "pressed yet; go on with make sealing"
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
        "sizes": ", ".join(map(str, COUNTS)),
        "counts": ", ".join(map(str, COUNTS.values())),
        "largest": LARGEST,
        "leaking": LEAKING,
        "leak_count": LEAKS,
        "cells_of_wave": CELLS,
        "fine_waves": FINE_WAVES,
        "fine_cells": FINE_CELLS,
        "finest_cells": FINEST_CELLS,
        "fine_count": FINE_COUNTS[FINE_CELLS],
        "finest_count": FINE_COUNTS[FINEST_CELLS],
        "winding": f"{WINDING:.3f}",
        "hardness": {"weak": WEAK, "mostly": MOSTLY, "full": FULL},
        "plastic": _by_kind(lambda *of: _plastic(found, *of), ".0%"),
        "area": _by_kind(lambda *of: at_sealing(found, *of).value, ".3f"),
        "cells": _by_kind(lambda *of: _in_cells(found, *of), ".3f"),
        "taken_off": _by_kind(lambda *of: _taken_off(found, *of), ".0%"),
        "tenfold": TENFOLD,
        "compared": COMPARED,
        "peaks": " and ".join(f"{peak:g}" for peak in BELOW),
        "nearest": BELOW[-1],
        "beyond": BEYOND,
        "areas": _area_table(found),
        "limits": _limit_table(found),
        "leaks": _theory_table(found),
        "factors": _factor_table(found),
        "unloading": _unloading_table(found),
        "grid": _grid_table(found),
        "bodies": len(found.bodies),
        "unsolved": found.unsolved,
        "version": found.version,
    }


def _by_kind(number: Callable[[float, float], float], form: str) -> dict[str, str]:
    """Return a number of a Hurst exponent and a hardness, of all spectra, by the kind."""
    return {
        KINDS[hardness].split()[0]: spread((number(hurst, hardness) for hurst in HURSTS), form)
        for hardness in HARDNESSES
    }


def _plastic(found: Data, hurst: float, hardness: float) -> float:
    return float(found.sample(LARGEST, hurst, hardness).of_both("plastic").mean())


def _in_cells(found: Data, hurst: float, hardness: float) -> float:
    return float(found.sample(LARGEST, hurst, hardness).of_both("cells").mean())


def _taken_off(found: Data, hurst: float, hardness: float) -> float:
    return taken_off(found.leaks(LEAKING, hurst, hardness), BELOW[-1]).value


def _area_table(found: Data) -> Table:
    header = (
        *("Hurst", "contact", "gap winds along"),
        *(f"{waves} waves" for waves in COUNTS),
        *("in cells", "p/(E*∇h)"),
    )
    rows = []
    for hurst in HURSTS:
        for hardness in HARDNESSES:
            samples = [found.sample(waves, hurst, hardness) for waves in COUNTS]
            cells = f"{samples[-1].of_both('cells').mean():.3f}"
            load = cell(mean(samples[-1].of_both("sealing")), ".3f", " to ")
            kinds = {
                "both": [first_and_last(one)[:, 0] for one in samples],
                "a given side": [one.of_both("area") for one in samples],
                "any": [first_and_last(one)[:, 1] for one in samples],
            }
            for name, areas in kinds.items():
                written = (cell(mean(each), ".3f", " to ") for each in areas)
                more = (cells, load) if name == "a given side" else ("", "")
                rows.append((f"{hurst:g}", KINDS[hardness], name, *written, *more))
    return Table(header, rows, range(3, len(header)))


def _limit_table(found: Data) -> Table:
    header = (
        *("Hurst", "contact", f"{WINDING:.3f} wind", f"of {LARGEST} waves", "with the grid"),
        *("means, 1/ν = 3/4", "misfit", "means, best 1/ν", "best 1/ν", "misfit"),
    )
    rows = []
    for hurst in HURSTS:
        for hardness in HARDNESSES:
            fixed, free = (scaling(found, hurst, hardness, each) for each in (False, True))
            whole = at_sealing(found, hurst, hardness)
            numbers = (
                cell(threshold(found, hurst, hardness).interval_estimate(), ".3f", " to "),
                cell(at_share(found.sample(LARGEST, hurst, hardness)), ".3f", " to "),
                f"{whole.low:.3f} to {whole.high:.3f}",
                cell(fixed.limit(), ".3f", " to "),
                f"{fixed.misfit:.1f}",
                cell(free.limit(), ".3f", " to "),
                cell(free.exponent(), ".2f", " to "),
                f"{free.misfit:.1f}",
            )
            rows.append((f"{hurst:g}", KINDS[hardness], *numbers))
    return Table(header, rows, range(2, len(header)))


def _theory_table(found: Data) -> Table:
    header = ("Hurst", "theory", *(f"{load:g}" for load in LOADS))
    rows = [
        (
            f"{hurst:g}",
            name,
            *(_told(over_theory(found, of, Case(LEAKING, hurst, ELASTIC), load)) for load in LOADS),
        )
        for hurst in HURSTS
        for name, of in THEORIES.items()
    ]
    return Table(header, rows, range(2, len(header)))


def _factor_table(found: Data) -> Table:
    header = ("Hurst", "contact", "waves", *(f"{load:g}" for load in LOADS))
    rows = [
        (
            f"{hurst:g}",
            KINDS[hardness],
            f"{waves}",
            *(_told(plastic_factor(found, waves, hurst, hardness, load)) for load in LOADS),
        )
        for hurst in HURSTS
        for hardness, waves in _OF_EACH[1:]
    ]
    return Table(header, rows, range(2, len(header)))


def _percent(shift: float) -> str:
    return "-" if math.isnan(shift) else f"{shift:+.1%}"


def _told(one: Found | None) -> str:
    return "-" if one is None else f"{one.value:.3g} ({one.low:.3g}-{one.high:.3g})"


def _unloading_table(found: Data) -> Table:
    header = (
        "Hurst",
        "contact",
        "waves",
        *(f"taken off from {peak:g}" for peak in BELOW),
        *(f"leak on loading over unloading, {peak:g}" for peak in BELOW),
        f"until open, from {BEYOND:g}",
    )
    rows = []
    for hurst in HURSTS:
        for hardness, waves in _OF_EACH:
            one = found.leaks(waves, hurst, hardness)
            numbers = (
                *(cell(taken_off(one, peak), ".3f", " to ") for peak in BELOW),
                *(cell(tightening(one, peak), ".3g", " to ") for peak in BELOW),
                cell(until_open(one), ".2f", " to "),
            )
            rows.append((f"{hurst:g}", KINDS[hardness], f"{waves}", *numbers))
    return Table(header, rows, range(2, len(header)))


def _grid_table(found: Data) -> Table:
    header = (
        *("Hurst", "contact", "A/A_0", "A/A_0 in cells", f"A/A_0, {FINEST_CELLS} cells"),
        *(f"{load:g}" for load in LOADS),
    )
    rows = []
    for hurst in HURSTS:
        for hardness in HARDNESSES:
            fine, coarse = found.leaking_grids(hurst, hardness)
            shifts = [
                change(area_shift(found, hurst, hardness, *of).over(1e-3), "+.1f")
                for of in (("area",), ("cells",), ("area", FINEST_CELLS))
            ]
            leaks = [ratio(fine.leak(load), coarse.leak(load)).value - 1 for load in LOADS]
            rows.append((f"{hurst:g}", KINDS[hardness], *shifts, *map(_percent, leaks)))
    return Table(header, rows, range(2, len(header)))


STUDY = Study(
    DATA.parent,
    verdicts=lambda: claims_table({"Verdict": claims(data())}),
    told=lambda: told(data()),
    figures={"sealing": lambda: sealing_figure(data())},
)
publish = STUDY.publish
