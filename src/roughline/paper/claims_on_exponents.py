"""The paper's claims about power laws and their exponents, one function each."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

from roughline.paper.claim import (
    EXPONENT_TOLERANCE,
    Claim,
    alpha,
    basis,
    by_dimension,
    grid,
    intervals,
    values,
)
from roughline.paper.exponents import (
    MEDIUM,
    OTHER_WINDOWS_REDUCED,
    WINDOW_FULL,
    WINDOW_REDUCED,
    WINDOW_SAME,
    DimensionSummary,
    LocalExponents,
    Window,
)
from roughline.paper.results import PaperResults
from roughline.statistics.bootstrap import Estimate
from roughline.statistics.power_law import linear_exponent, scaling_exponent
from roughline.statistics.verdict import Verdict

if TYPE_CHECKING:
    import xarray

Summaries = list[DimensionSummary]
Model = Literal["1D", "3D"]

_EXTREMELY_WELL_UP_TO = 2.6  # D_f
_SMALL = 2 * EXPONENT_TOLERANCE  # a "small discrepancy" of exponents

_WINDOWS: dict[Model, Window] = {"1D": WINDOW_REDUCED, "3D": WINDOW_FULL}


def on_exponents(summaries: Summaries, results: PaperResults) -> list[Claim]:
    """Judge every claim about power laws and exponents."""
    return [
        power_law(summaries, results, "1D", "over low and medium forces (§6, §8)"),
        power_law(summaries, results, "3D", "k = ζ F^α (eq. 5)"),
        lowest_forces(summaries, results, "1D"),
        lowest_forces(summaries, results, "3D"),
        ends_of_reduced(summaries, results),
        *(between_half_and_four_fifths(summaries, results, model) for model in _WINDOWS),
        great_accuracy(summaries, results),
        linear_in_dimension(summaries, results),
        *(scaling_argument(summaries, results, model) for model in _WINDOWS),
        *(small_discrepancy(summaries, results, model) for model in _WINDOWS),
        scaling_identity(),
        same_behaviour(summaries, results),
    ]


def power_law(summaries: Summaries, results: PaperResults, model: Model, said: str) -> Claim:
    """Whether the exponent stays the same from the lowest loads to medium ones."""
    local = [(s.fractal_dimension, _local(s, model)) for s in summaries]
    drifts = [(d, one.drift) for d, one in local]
    least = min(one.lowest for _, one in local)
    return Claim(
        f"{model}: a power law {said}",
        "α in the lowest decade (of less than two decades: in their lower half) less α in the "
        f"highest: {values(drifts, '+.3f')}",
        intervals(drifts, "+.3f"),
        f"F̄ = {least:.2g} (where ten {'springs' if model == '1D' else 'cells'} touch in all) to "
        f"{MEDIUM:g}; mean k at fixed F̄; {grid(_data(results, model))}",
        *by_dimension(drifts, -EXPONENT_TOLERANCE, EXPONENT_TOLERANCE),
    )


def lowest_forces(summaries: Summaries, results: PaperResults, model: Model) -> Claim:
    """Whether the exponent of the window still holds at the lowest loads of the grid."""
    changes = [(s.fractal_dimension, _local(s, model).at_lowest) for s in summaries]
    window = _WINDOWS[model]
    return Claim(
        f"{model}: the power law holds down to the lowest forces that the grid represents (§6)",
        f"α of the lowest half decade, less that of the window: {values(changes, '+.3f')}",
        intervals(changes, "+.3f"),
        basis(window, _data(results, model)),
        *by_dimension(changes, -EXPONENT_TOLERANCE, EXPONENT_TOLERANCE),
    )


def ends_of_reduced(summaries: Summaries, results: PaperResults) -> Claim:
    """Whether the exponents of the reduced model begin and end where the paper says."""
    ends = [(s.fractal_dimension, alpha(s.reduced)) for s in (summaries[0], summaries[-1])]
    off = [(d, end - said) for (d, end), said in zip(ends, (0.5, 0.75), strict=True)]
    elsewhere = [law.exponent for law in summaries[-1].reduced_elsewhere]
    return Claim(
        "1D: α from 0.5 to 0.75 as D_f goes from 2 to 3 (§6)",
        f"{values(ends)}; in other windows {min(elsewhere):.3f} to {max(elsewhere):.3f} at the "
        "latter",
        intervals(ends),
        basis(WINDOW_REDUCED, results.reduced),
        *by_dimension(off, -EXPONENT_TOLERANCE, EXPONENT_TOLERANCE),
    )


def between_half_and_four_fifths(
    summaries: Summaries, results: PaperResults, model: Model
) -> Claim:
    """Whether all exponents lie in the range that the paper gives for both models."""
    found = [(s.fractal_dimension, _alpha(s, model)) for s in summaries]
    return Claim(
        f"{model}: α between 0.5 and 0.8 for D_f from 2 to 3, in both investigations (§7)",
        values(found),
        intervals(found),
        basis(_WINDOWS[model], _data(results, model)),
        *by_dimension(found, 0.5 - EXPONENT_TOLERANCE, 0.8 + EXPONENT_TOLERANCE),
    )


def great_accuracy(summaries: Summaries, results: PaperResults) -> Claim:
    """Whether the exponent of the reduced model depends on where it is fitted."""
    widest = max(float(np.ptp(s.reduced.exponent_interval)) / 2 for s in summaries)
    moved = [(s.fractal_dimension, s.reduced_by_window[-1]) for s in summaries]
    low, high = OTHER_WINDOWS_REDUCED[-1]
    return Claim(
        "1D: α is deduced with great accuracy (§7)",
        f"± {widest:.3f} or less in a given window, but lower by {values(moved)} in the window F̄ "
        f"= {low:g} to {high:g}; averages at fixed level differ by more",
        intervals(moved),
        basis(WINDOW_REDUCED, results.reduced),
        *by_dimension(moved, -EXPONENT_TOLERANCE, EXPONENT_TOLERANCE),
    )


def linear_in_dimension(summaries: Summaries, results: PaperResults) -> Claim:
    """Whether the exponent of the full model is 0.2567 D_f."""
    off = [
        (s.fractal_dimension, alpha(s.full) - linear_exponent(s.fractal_dimension))
        for s in summaries
    ]
    return Claim(
        "3D: α ≈ 0.2567 D_f (§7)",
        f"off by {values(off, '+.3f')}",
        intervals(off, "+.3f"),
        basis(WINDOW_FULL, results.full),
        *by_dimension(off, -EXPONENT_TOLERANCE, EXPONENT_TOLERANCE),
    )


def scaling_argument(summaries: Summaries, results: PaperResults, model: Model) -> Claim:
    """Whether eq. 14 gives the exponent of smooth surfaces."""
    off = [
        (s.fractal_dimension, _alpha(s, model) - scaling_exponent(s.fractal_dimension))
        for s in summaries
        if s.fractal_dimension <= _EXTREMELY_WELL_UP_TO + 1e-9
    ]
    return Claim(
        f"{model}: α = 1 / (4 - D_f) extremely well for D_f ≤ 2.6 (eq. 14, §7)",
        f"off by {values(off, '+.3f')}",
        intervals(off, "+.3f"),
        basis(_WINDOWS[model], _data(results, model)),
        *by_dimension(off, -EXPONENT_TOLERANCE, EXPONENT_TOLERANCE),
    )


def small_discrepancy(summaries: Summaries, results: PaperResults, model: Model) -> Claim:
    """Whether eq. 14 is off by little for rough surfaces."""
    off = [
        (s.fractal_dimension, _alpha(s, model) - scaling_exponent(s.fractal_dimension))
        for s in summaries
        if s.fractal_dimension > _EXTREMELY_WELL_UP_TO + 1e-9
    ]
    return Claim(
        f"{model}: a small discrepancy from 1 / (4 - D_f) for D_f > 2.6 (§7; small: {_SMALL:g})",
        f"off by {values(off, '+.3f')}",
        intervals(off, "+.3f"),
        basis(_WINDOWS[model], _data(results, model)),
        *by_dimension(off, -_SMALL, _SMALL),
    )


def scaling_identity() -> Claim:
    """Whether the scaling of eqs. 9 to 12 supports the power law."""
    return Claim(
        "Entering eqs. 9, 11 and 12 in eq. 5 underlines its validity (§7)",
        "it gives 1 = 1^α: true for every α, and for any other law k̄(F̄), as k̄ and F̄ are "
        "dimensionless; it speaks neither for a power law nor against one",
        "exact",
        "all loads",
        Verdict.UNDECIDED,
        "undecided: the argument cannot tell",
    )


def same_behaviour(summaries: Summaries, results: PaperResults) -> Claim:
    """Whether both models have the same exponent, of the same waves in the same window."""
    apart = [(s.fractal_dimension, s.models_apart) for s in summaries]
    return Claim(
        "The same power-law behaviour in both models (abstract)",
        f"α 3D less α 1D with the same waves: {values(apart, '+.3f')}",
        intervals(apart, "+.3f"),
        f"{basis(WINDOW_SAME, results.full)}, {grid(results.matched)}",
        *by_dimension(apart, -EXPONENT_TOLERANCE, EXPONENT_TOLERANCE),
    )


def _alpha(summary: DimensionSummary, model: Model) -> Estimate:
    return alpha(summary.reduced if model == "1D" else summary.full)


def _local(summary: DimensionSummary, model: Model) -> LocalExponents:
    return summary.reduced_local if model == "1D" else summary.full_local


def _data(results: PaperResults, model: Model) -> xarray.Dataset:
    return results.reduced if model == "1D" else results.full
