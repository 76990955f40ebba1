"""The page on the contact area: the numbers and tables that its text names."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from roughline.report.page import Table
from roughline.statistics.bootstrap import IntervalEstimate
from studies.area.claims import (
    LIGHT,
    MIDDLE,
    claims,
    common_law,
    grid_error,
    main_samples,
    over_law,
)
from studies.area.figures import kappa_figure
from studies.area.measure import (
    AREAS,
    BANDS,
    FINE_BANDS,
    HURSTS,
    LARGE_BANDS,
    REDUCED,
    grid_shift,
    kappa,
    kappa_in_cells,
    sample,
    size_shift,
)
from studies.area.rings import COUNT, POINTS, SHORT_WAVES, rings, version
from studies.judged import cell, change, spread
from studies.study import Study, claims_table

_NAYAKS = (3, 10, 30, 100)


def told() -> dict[str, object]:
    """Return what the text names."""
    law = common_law(MIDDLE)
    unsolved, loads = REDUCED.unsolved_loads()
    return {
        "LIGHT": LIGHT,
        "MIDDLE": MIDDLE,
        "HURSTS": HURSTS,
        "rings_of_each": COUNT,
        "points": POINTS,
        "short_waves": SHORT_WAVES,
        "light": spread(kappa(one, LIGHT).value for one in main_samples()),
        "law": law,
        "fall": -law.per_decade.value,
        "others": spread((over_law(one).value for one in rings()), ".1%"),
        "grid_error": grid_error(MIDDLE),
        "bands": ", ".join(map(str, BANDS)),
        "hursts": ", ".join(f"{hurst:g}" for hurst in HURSTS),
        "counts": ", ".join(f"{sample('main', band, HURSTS[0]).count}" for band in BANDS),
        "solved": loads - unsolved,
        "loads": loads,
        "kappas": _kappa_table(),
        "laws": _law_table(),
        "other_spectra": _rings_table(),
        "grid": _table_of_shifts(FINE_BANDS, grid_shift),
        "size": _table_of_shifts(LARGE_BANDS, size_shift),
        "version": REDUCED.version,
        "version_of_rings": version(),
    }


def _kappa_table() -> Table:
    header = ("Hurst", "q_high/q_roll", "α", *(f"{level:.1%}" for level in AREAS), "in cells")
    rows = []
    for one in main_samples():
        area = one.area.mean(axis=0)
        kappas = [cell(kappa(one, level)) if area[0] < level < area[-1] else "-" for level in AREAS]
        cells = f"{kappa_in_cells(one, MIDDLE):.2f}"
        rows.append((f"{one.hurst:g}", f"{one.band}", f"{one.nayak:.1f}", *kappas, cells))
    return Table(header, rows, range(len(header)))


def _law_table() -> Table:
    nayaks = (f"α = {each}" for each in _NAYAKS)
    header = ("in contact", "κ at α = 10", "for ten times α", "largest deviation", *nayaks)
    rows = [
        (
            f"{law.level:.0%}",
            cell(law.at_ten, ".3f", " to "),
            cell(law.per_decade, ".3f", " to "),
            f"{law.deviation:.1%}",
            *(f"{law(each):.2f}" for each in _NAYAKS),
        )
        for law in map(common_law, AREAS[1:])
    ]
    return Table(header, rows, range(len(header)))


def _rings_table() -> Table:
    header = ("long waves along a side", "α", "κ", "on the line", "κ over it, less 1")
    rows = [
        (
            f"{one.long_waves[0]} to {one.long_waves[1]}",
            f"{one.nayak:.1f}",
            cell(one.kappa(MIDDLE)),
            f"{common_law(MIDDLE)(one.nayak):.2f}",
            change(over_law(one)),
        )
        for one in rings()
    ]
    return Table(header, rows, range(1, len(header)))


def _table_of_shifts(
    bands: Sequence[int], shift: Callable[[int, float, float], IntervalEstimate]
) -> Table:
    """Return by how much kappa is higher on finer grids, or on larger surfaces."""
    header = ("Hurst", "q_high/q_roll", *(f"{level:.1%}" for level in AREAS[1:]))
    rows = [
        (f"{hurst:g}", f"{band}", *(change(shift(band, hurst, level)) for level in AREAS[1:]))
        for hurst in HURSTS
        for band in bands
    ]
    return Table(header, rows, range(len(header)))


STUDY = Study(
    REDUCED.folder,
    verdicts=lambda: claims_table({"Verdict": claims()}),
    told=told,
    figures={"kappa": kappa_figure},
)
publish, reduce = STUDY.publish, REDUCED.reduce
