"""The page on finite size: the numbers and tables that its text names."""

from __future__ import annotations

import math

from roughline.paper.stated import EXPONENT_TOLERANCE
from roughline.report.page import Table
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.units import decimal
from studies.finite_size.claims import BETWEEN, MANY, between_ends, claims
from studies.finite_size.crossover import BETWEEN_THEM, Passing
from studies.finite_size.figures import crossover_figure
from studies.finite_size.measure import (
    SEVERAL,
    crossing,
    decades_of_linear_law,
    exponent_in,
    exponents_beside_gamma,
    grid_shift,
    most_by_size,
    over_persson,
    pressures_near_one,
    reduced_over_full,
)
from studies.finite_size.samples import (
    BAND,
    FINE_SIZES,
    HURSTS,
    REDUCED,
    RESOLVED,
    SIZES,
    WIDE,
    Geometry,
    sample,
)
from studies.judged import cell, change, spread
from studies.study import Study, claims_table

_FORCES = (0.1, 0.3, 1.0, 3.0)
_DECADES = (0, 1, 2)
_LEAD_HURST = 0.8


def told() -> dict[str, object]:
    """Return what the text names."""
    unsolved, loads = REDUCED.unsolved_loads()
    every = [(size, hurst) for size in SIZES[BAND] for hurst in HURSTS]
    periodic = {case: sample("periodic", BAND, *case) for case in every}
    gammas = [crossing("periodic", BAND, *case).gamma.value for case in every]
    halves = {
        size: crossing("periodic", BAND, size, _LEAD_HURST).halfway.force.value
        for size in SIZES[BAND]
    }
    middle = [exponent_in(one, BETWEEN).value for (n, _), one in periodic.items() if n >= MANY]
    before, after = zip(*exponents_beside_gamma(), strict=True)
    sure, perhaps = zip(*map(decades_of_linear_law, periodic.values()), strict=True)
    by_hurst = {hurst: spread(pressures_near_one(BAND, SEVERAL, hurst)) for hurst in HURSTS}
    return {
        "lead_hurst": _LEAD_HURST,
        "between_them": BETWEEN_THEM,
        "tolerance": EXPONENT_TOLERANCE,
        "band": BAND,
        "wide": WIDE,
        "many": MANY,
        "several": min(SEVERAL),
        "largest": max(SIZES[BAND]),
        "largest_of_wide": max(SIZES[WIDE]),
        "sizes": ", ".join(map(str, SIZES[BAND])),
        "hursts": ", ".join(f"{hurst:g}" for hurst in HURSTS),
        "counts": ", ".join(f"{periodic[size, 0.5].count}" for size in SIZES[BAND]),
        "between": spread(BETWEEN, "g"),
        "half_of_one": halves[1],
        "halves_of_many": spread((x for size, x in halves.items() if size >= MANY), ".2g"),
        "middle": (min(middle), max(middle)),
        "near_1": {
            "one": spread(pressures_near_one(BAND, (1,))),
            "two": spread(pressures_near_one(BAND, (2,))),
            "wide": spread(pressures_near_one(WIDE, SIZES[WIDE])),
        },
        "near_1_by_hurst": ", ".join(f"{x} at Hurst {hurst:g}" for hurst, x in by_hurst.items()),
        "most_by_size": most_by_size(),
        "gammas": spread((each for each in gammas if not math.isnan(each)), ".3f"),
        "before_gamma": spread(before),
        "after_gamma": spread(after),
        "cases_beside_gamma": len(after),
        "surely_linear": spread(sure, ".2g"),
        "perhaps_linear": max(perhaps),
        "shifts_of_wide": spread(_shifts_of_wide(), "+.0%"),
        "resolved": RESOLVED,
        "solved": loads - unsolved,
        "loads": loads,
        "periodic": _crossing_table("periodic", BAND),
        "free": _crossing_table("free", BAND),
        "wide_band": _crossing_table("periodic", WIDE),
        "others": _others_table(),
        "grid": _grid_table(),
        "seed": REDUCED.plan.ensembles[0].seed,
        "version": REDUCED.version,
    }


def _shifts_of_wide() -> list[float]:
    """Return how much higher the pressure near an exponent of 1 is with the wider band."""
    forces = [
        [crossing("periodic", band, size, hurst).reaches.force.value for band in (WIDE, BAND)]
        for size in SIZES[WIDE]
        for hurst in HURSTS
    ]
    return [wide / narrow - 1 for wide, narrow in forces if not math.isnan(wide)]


def _crossing_table(geometry: Geometry, band: int) -> Table:
    """Return where the laws of all sizes end and begin."""
    header = (
        "Hurst",
        "L/λ_r",
        "end, F/(E* h λ_r)",
        "half way, F/(E* h λ_r)",
        "half way, F/(E* h L)",
        "between",
        "near 1, F/(E* h λ_r)",
        "near 1, p λ_r/(E* h)",
        "γ",
        "p λ_r/(E* h) there",
    )
    rows = []
    for hurst in HURSTS:
        for size in SIZES[band]:
            one, found = sample(geometry, band, size, hurst), crossing(geometry, band, size, hurst)
            rows.append(
                (
                    f"{hurst:g}",
                    f"{size}",
                    _load(found.leaves, 1),
                    _load(found.halfway, 1),
                    _load(found.halfway, size),
                    cell(exponent_in(one, BETWEEN)),
                    _load(found.reaches, 1),
                    _load(found.reaches, size**2),
                    _gamma(found.gamma),
                    decimal(found.gamma_force / size**2, 2),
                )
            )
    return Table(header, rows, range(len(header)))


def _others_table() -> Table:
    """Return the stiffness beside that of Persson's theory and of the reduced model."""
    header = (
        "Hurst",
        "L/λ_r",
        *(f"k over Persson's, {'at γ' if not each else f'1e-{each} of it'}" for each in _DECADES),
        *(f"lines, F/(E* h λ_r) = {force:g}" for force in _FORCES),
    )
    rows = [
        (
            f"{hurst:g}",
            f"{size}",
            *(cell(over_persson(sample("periodic", BAND, size, hurst), each)) for each in _DECADES),
            *(change(reduced_over_full(size, hurst, force)) for force in _FORCES),
        )
        for hurst in HURSTS
        for size in SIZES[BAND]
    ]
    return Table(header, rows, range(len(header)))


def _grid_table() -> Table:
    """Return what finer grids change."""
    header = ("Hurst", "L/λ_r", *(f"F/(E* h λ_r) = {force:g}" for force in _FORCES), "γ")
    rows = [
        (
            f"{hurst:g}",
            f"{size}",
            *(change(grid_shift(size, hurst, force)) for force in _FORCES),
            change(grid_shift(size, hurst, None)),
        )
        for hurst in HURSTS
        for size in FINE_SIZES
    ]
    return Table(header, rows, range(len(header)))


def _load(passed: Passing, unit: float) -> str:
    """Write a load with its interval."""
    force = passed.force.over(unit)
    if passed.always:
        return f"< {decimal(force.high, 2)}" if not math.isnan(force.high) else "below all"
    if passed.never:
        return f"> {decimal(force.low, 2)}" if not math.isnan(force.low) else "above all"
    return f"{decimal(force.value, 2)} ({between_ends(force)})"


def _gamma(gamma: IntervalEstimate) -> str:
    """Write gamma with its interval, or what it is more than."""
    return f"> {gamma.low:.3f}" if math.isnan(gamma.value) else cell(gamma, ".3f")


STUDY = Study(
    REDUCED.folder,
    verdicts=lambda: claims_table({"Verdict": claims()}),
    told=told,
    figures={"crossover": crossover_figure},
)
publish, reduce = STUDY.publish, REDUCED.reduce
