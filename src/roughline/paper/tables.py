"""Tables of exponents and constants, and how all tables of the study write a number."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughline.paper.laws import exponent_estimate, prefactor_estimate
from roughline.paper.windows import OTHER_WINDOWS_REDUCED
from roughline.plot.style import dimension_label
from roughline.report.page import Table
from roughline.statistics.power_law import linear_exponent, scaling_exponent

if TYPE_CHECKING:
    from roughline.comparison.trust import Difference
    from roughline.paper.laws import DimensionLaws
    from roughline.statistics.bootstrap import IntervalEstimate


def exponent_table(laws: list[DimensionLaws]) -> Table:
    """Return the exponents of both models beside the two predictions."""
    header = (
        "D_f",
        "1/(4 - D_f)",
        "0.2567 D_f",
        "α 1D",
        *(f"α 1D, {low:g} to {high:g}" for low, high in OTHER_WINDOWS_REDUCED),
        "α 3D",
        "3D loads under 10 cells",
    )
    rows = [
        (
            dimension_label(each.fractal_dimension),
            f"{scaling_exponent(each.fractal_dimension):.3f}",
            f"{linear_exponent(each.fractal_dimension):.3f}",
            estimate_cell(exponent_estimate(each.reduced)),
            *(number_cell(law.exponent) for law in each.reduced_elsewhere),
            estimate_cell(exponent_estimate(each.full)),
            "-" if np.isnan(each.unresolved) else f"{each.unresolved:.0%}",
        )
        for each in laws
    ]
    return Table(header, rows, numbers=range(len(header)))


def constant_table(laws: list[DimensionLaws]) -> Table:
    """Return the prefactors, the ratio of the two models and the constants of the area law."""
    header = (
        *("D_f", "ζ 1D", "ζ 3D", "k 3D over 1D", "κ", "A ~ F^"),
        *("κ in cells", "A in cells ~ F^", "κ, first to last load"),
    )
    rows = []
    for each in laws:
        estimates = (
            prefactor_estimate(each.reduced),
            prefactor_estimate(each.full),
            each.agreement,
            *(each.corrected.kappa, each.corrected.exponent),
            *(each.cells.kappa, each.cells.exponent),
        )
        first, last = each.corrected.kappa_ends
        rows.append(
            (
                dimension_label(each.fractal_dimension),
                *(estimate_cell(estimate) for estimate in estimates),
                "-" if np.isnan(first) else f"{first:.2f} to {last:.2f}",
            )
        )
    return Table(header, rows, numbers=range(len(header)))


def estimate_cell(number: IntervalEstimate, to: str = "-") -> str:
    """Write a number with its interval, as all tables of the study do."""
    if np.isnan(number.low):
        return number_cell(number.value)
    return f"{number.value:.3f} ({number.low:.3f}{to}{number.high:.3f})"


def trust_cell(difference: Difference) -> str:
    """Write a difference with its interval; a star stands where the grid decides."""
    if np.isnan(difference.value):
        return "-"
    star = "" if difference.resolved else " *"
    return f"{difference.value:+.0%} ({difference.low:+.0%} to {difference.high:+.0%}){star}"


def three_digits(value: float) -> str:
    """Write a number with three digits, its zeros kept."""
    return f"{value:#.3g}".rstrip(".") if abs(value) >= 1e-4 else f"{value:.2e}"


def number_cell(value: float) -> str:
    """Write a number; a dash stands where it is not known."""
    return "-" if np.isnan(value) else f"{value:.3f}"
