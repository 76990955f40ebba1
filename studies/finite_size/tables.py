"""The tables of the page."""

from __future__ import annotations

import math

from roughline.report.page import Table
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.units import decimal
from studies.finite_size.crossover import Passing
from studies.finite_size.findings import BETWEEN
from studies.finite_size.measures import (
    crossing,
    exponent_in,
    grid_shift,
    over_persson,
    reduced_over_full,
)
from studies.finite_size.samples import BAND, FINE_SIZES, HURSTS, SIZES, Geometry, sample
from studies.finite_size.statements import between_ends

_FORCES = (0.1, 0.3, 1.0, 3.0)
_DECADES = (0, 1, 2)


def crossing_table(geometry: Geometry, band: int) -> Table:
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
                    _cell(exponent_in(one, BETWEEN), ".2f"),
                    _load(found.reaches, 1),
                    _load(found.reaches, size**2),
                    _gamma(found.gamma),
                    f"{decimal(found.gamma_force / size**2, 2)}",
                )
            )
    return Table(header, rows, range(len(header)))


def others_table() -> Table:
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
            *(
                _cell(over_persson(sample("periodic", BAND, size, hurst), each), ".2f")
                for each in _DECADES
            ),
            *(_percent(reduced_over_full(size, hurst, force)) for force in _FORCES),
        )
        for hurst in HURSTS
        for size in SIZES[BAND]
    ]
    return Table(header, rows, range(len(header)))


def grid_table() -> Table:
    """Return what finer grids change."""
    header = ("Hurst", "L/λ_r", *(f"F/(E* h λ_r) = {force:g}" for force in _FORCES), "γ")
    rows = [
        (
            f"{hurst:g}",
            f"{size}",
            *(_percent(grid_shift(size, hurst, force)) for force in _FORCES),
            _percent(grid_shift(size, hurst, None)),
        )
        for hurst in HURSTS
        for size in FINE_SIZES
    ]
    return Table(header, rows, range(len(header)))


def _load(passed: Passing, unit: float) -> str:
    """Write a load with its interval."""
    force = passed.force
    value, low, high = (each / unit for each in (force.value, force.low, force.high))
    if passed.always:
        return f"< {decimal(high, 2)}" if not math.isnan(high) else "below all"
    if passed.never:
        return f"> {decimal(low, 2)}" if not math.isnan(low) else "above all"
    return f"{decimal(value, 2)} ({between_ends(low, high)})"


def _gamma(gamma: IntervalEstimate) -> str:
    """Write gamma with its interval, or what it is more than."""
    return f"> {gamma.low:.3f}" if math.isnan(gamma.value) else _cell(gamma, ".3f")


def _cell(estimate: IntervalEstimate, form: str) -> str:
    if math.isnan(estimate.value):
        return "-"
    return f"{estimate.value:{form}} ({estimate.low:{form}}-{estimate.high:{form}})"


def _percent(estimate: IntervalEstimate) -> str:
    if math.isnan(estimate.value):
        return "-"
    return f"{estimate.value:+.1%} ({estimate.low:+.1%} to {estimate.high:+.1%})"
