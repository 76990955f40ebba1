"""The paper's claims about power laws and their exponents, one function each."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughline.paper.claim import (
    BOTH_MODELS,
    EXACT,
    Claim,
    around,
    basis_in,
    bodies_of,
    by_dimension,
    cases_of,
    claim_about_every_dimension,
    in_both_models,
    intervals,
    known,
    not_judged,
    numbers_by_dimension,
)
from roughline.paper.exponents import LocalExponents, exponent_estimate
from roughline.paper.stated import (
    ENDS_OF_REDUCED,
    EXPONENT_TOLERANCE,
    SMALL_DISCREPANCY,
    ModelLabel,
    is_smooth,
)
from roughline.paper.windows import (
    MEDIUM_FORCE,
    OTHER_WINDOWS_REDUCED,
    Window,
)
from roughline.statistics.power_law import linear_exponent, scaling_exponent
from roughline.statistics.verdict import Verdict

if TYPE_CHECKING:
    import xarray

    from roughline.paper.laws import DimensionLaws
    from roughline.paper.results import PaperResults
    from roughline.statistics.bootstrap import IntervalEstimate

_NO_CHANGE = around(0, EXPONENT_TOLERANCE)
_RANGE_OF_BOTH = (0.5 - EXPONENT_TOLERANCE, 0.8 + EXPONENT_TOLERANCE)  # of §7, for both


def constant_exponent(results: PaperResults, model: ModelLabel, said: str) -> Claim:
    """Judge whether the exponent stays the same from the lowest loads to medium ones."""
    drifts = cases_of(results.laws, lambda laws: _local(laws, model).drift)
    lowest = min(_local(laws, model).lowest for laws in results.laws)
    carriers = "springs" if model == "1D" else "cells"
    return claim_about_every_dimension(
        f"{model}: a power law {said}",
        found="α in the lowest decade less α in the highest (in the two halves of a range below "
        f"two decades): {numbers_by_dimension(drifts, '+.3f')}",
        basis=f"F̄ = {lowest:.2g} (ten {carriers} touch in every body) to {MEDIUM_FORCE:g}; "
        f"mean k at fixed F̄; {bodies_of(_data(results, model))}",
        cases=drifts,
        allowed=_NO_CHANGE,
        form="+.3f",
        needed=f"three loads in each half of the range from where ten {carriers} touch to "
        f"F̄ = {MEDIUM_FORCE:g}",
    )


def lowest_forces(results: PaperResults, model: ModelLabel) -> Claim:
    """Judge whether the exponent of the window holds at the lowest loads of the grid."""
    changes = cases_of(results.laws, lambda laws: _local(laws, model).at_lowest)
    return claim_about_every_dimension(
        f"{model}: the power law holds down to the lowest forces that the grid represents (§6)",
        found="α of the lowest half decade, less that of the window: "
        f"{numbers_by_dimension(changes, '+.3f')}",
        basis=basis_in(_window(results, model), _data(results, model)),
        cases=changes,
        allowed=_NO_CHANGE,
        form="+.3f",
    )


def ends_of_reduced(results: PaperResults) -> Claim:
    """Judge whether the reduced model has the paper's exponents at D_f = 2 and 3."""
    statement = "1D: α from 0.5 to 0.75 as D_f goes from 2 to 3 (§6)"
    at_ends = [laws for laws in results.laws if laws.fractal_dimension in ENDS_OF_REDUCED]
    ends = cases_of(at_ends, lambda laws: exponent_estimate(laws.reduced))
    basis = basis_in(_window(results, "1D"), results.reduced)
    if not known(ends):
        return not_judged(statement, basis, "D_f = 2 or 3 with loads across this range")
    off = [(d, end - ENDS_OF_REDUCED[d]) for d, end in ends]
    found = numbers_by_dimension(ends)
    elsewhere = [law.exponent for law in at_ends[-1].reduced_elsewhere if law.points]
    if elsewhere:
        found += f"; in other windows {min(elsewhere):.3f} to {max(elsewhere):.3f} at the latter"
    whole, in_words = by_dimension(off, _NO_CHANGE)
    return Claim(
        statement,
        found=found,
        interval=intervals(ends),
        basis=basis,
        verdict=whole,
        cases=in_words,
    )


def between_half_and_four_fifths(results: PaperResults, model: ModelLabel) -> Claim:
    """Judge whether all exponents lie in the range that the paper gives for both models."""
    exponents = cases_of(results.laws, lambda laws: _exponent(laws, model))
    return claim_about_every_dimension(
        f"{model}: α between 0.5 and 0.8 for D_f from 2 to 3, in both investigations (§7)",
        found=numbers_by_dimension(exponents),
        basis=basis_in(_window(results, model), _data(results, model)),
        cases=exponents,
        allowed=_RANGE_OF_BOTH,
    )


def great_accuracy(results: PaperResults) -> Claim:
    """Judge whether the exponent of the reduced model is the same in another window."""
    widest = max(float(np.ptp(laws.reduced.exponent_interval)) / 2 for laws in results.laws)
    changes = cases_of(results.laws, lambda laws: laws.reduced_by_window[-1])
    low, high = OTHER_WINDOWS_REDUCED[-1]
    return claim_about_every_dimension(
        "1D: α is deduced with great accuracy (§7)",
        found=f"± {widest:.3f} or less in a given window, but lower by "
        f"{numbers_by_dimension(changes)} in the window F̄ = {low:g} to {high:g}; averages at "
        "fixed level differ by more",
        basis=basis_in(_window(results, "1D"), results.reduced),
        cases=changes,
        allowed=_NO_CHANGE,
        needed=f"loads across this range and from F̄ = {low:g} to {high:g}",
    )


def linear_in_dimension(results: PaperResults) -> Claim:
    """Judge whether the exponent of the full model is 0.2567 D_f."""
    off = cases_of(
        results.laws,
        lambda laws: exponent_estimate(laws.full) - linear_exponent(laws.fractal_dimension),
    )
    return claim_about_every_dimension(
        "3D: α ≈ 0.2567 D_f (§7)",
        found=f"off by {numbers_by_dimension(off, '+.3f')}",
        basis=basis_in(_window(results, "3D"), results.full),
        cases=off,
        allowed=_NO_CHANGE,
        form="+.3f",
    )


def scaling_argument(results: PaperResults, model: ModelLabel) -> Claim:
    """Judge whether eq. 14 gives the exponent of smooth surfaces."""
    smooth = [laws for laws in results.laws if is_smooth(laws.fractal_dimension)]
    off = cases_of(smooth, lambda laws: _off_scaling(laws, model))
    return claim_about_every_dimension(
        f"{model}: α = 1 / (4 - D_f) extremely well for D_f ≤ 2.6 (eq. 14, §7)",
        found=f"off by {numbers_by_dimension(off, '+.3f')}",
        basis=basis_in(_window(results, model), _data(results, model)),
        cases=off,
        allowed=_NO_CHANGE,
        form="+.3f",
        needed="D_f ≤ 2.6 with loads across this range",
    )


def small_discrepancy(results: PaperResults, model: ModelLabel) -> Claim:
    """Judge whether eq. 14 differs little from the exponent of rough surfaces."""
    rough = [laws for laws in results.laws if not is_smooth(laws.fractal_dimension)]
    off = cases_of(rough, lambda laws: _off_scaling(laws, model))
    return claim_about_every_dimension(
        f"{model}: a small discrepancy from 1 / (4 - D_f) for D_f > 2.6 (§7; small: "
        f"{SMALL_DISCREPANCY:g})",
        found=f"off by {numbers_by_dimension(off, '+.3f')}",
        basis=basis_in(_window(results, model), _data(results, model)),
        cases=off,
        allowed=around(0, SMALL_DISCREPANCY),
        form="+.3f",
        needed="D_f > 2.6 with loads across this range",
    )


def scaling_identity() -> Claim:
    """Judge whether the scaling of eqs. 9 to 12 supports the power law."""
    return Claim(
        "Entering eqs. 9, 11 and 12 in eq. 5 underlines its validity (§7)",
        found="it gives 1 = 1^α: true for every α, and for any other law k̄(F̄), as k̄ and F̄ are "
        "dimensionless; it speaks neither for a power law nor against one",
        interval=EXACT,
        basis="all loads",
        verdict=Verdict.UNDECIDED,
        cases="undecided: the argument cannot tell",
    )


def same_behaviour(results: PaperResults) -> Claim:
    """Judge whether both models have the same exponent, with the same waves and window."""
    apart = cases_of(results.laws, lambda laws: laws.models_apart)
    return claim_about_every_dimension(
        "The same power-law behaviour in both models (abstract)",
        found=f"α 3D less α 1D with the same waves: {numbers_by_dimension(apart, '+.3f')}",
        basis=in_both_models(_window(results, "3D"), results),
        cases=apart,
        allowed=_NO_CHANGE,
        form="+.3f",
        needed=BOTH_MODELS,
    )


def _off_scaling(laws: DimensionLaws, model: ModelLabel) -> IntervalEstimate:
    return _exponent(laws, model) - scaling_exponent(laws.fractal_dimension)


def _exponent(laws: DimensionLaws, model: ModelLabel) -> IntervalEstimate:
    return exponent_estimate(laws.reduced if model == "1D" else laws.full)


def _local(laws: DimensionLaws, model: ModelLabel) -> LocalExponents:
    return laws.reduced_local if model == "1D" else laws.full_local


def _data(results: PaperResults, model: ModelLabel) -> xarray.Dataset:
    return results.reduced if model == "1D" else results.full


def _window(results: PaperResults, model: ModelLabel) -> Window:
    return results.windows.reduced if model == "1D" else results.windows.full
