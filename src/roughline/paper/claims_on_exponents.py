"""The paper's claims about power laws and their exponents."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughline.paper.claim import (
    ENOUGH_LOADS,
    Numbers,
    basis_in,
    ensemble_in_words,
    exact_claim,
    undecided_claim,
)
from roughline.paper.laws import exponent_estimate
from roughline.paper.stated import (
    EXPONENT_TOLERANCE,
    REDUCED_ENDS,
    SMALL_DISCREPANCY,
    STIFFNESS_TOLERANCE,
    ModelLabel,
    is_smooth,
)
from roughline.paper.windows import MEDIUM_FORCE, OTHER_WINDOWS_REDUCED, WINDOW_AGREEMENT
from roughline.statistics.power_law import linear_exponent, scaling_exponent
from roughline.statistics.verdict import Claim, Range, Verdict, around

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import xarray

    from roughline.paper.laws import DimensionLaws, LocalExponents
    from roughline.paper.results import PaperResults
    from roughline.paper.windows import ForceWindow
    from roughline.statistics.bootstrap import IntervalEstimate

_NO_CHANGE = around(0, EXPONENT_TOLERANCE)
_EXPONENT_RANGE = (0.5 - EXPONENT_TOLERANCE, 0.8 + EXPONENT_TOLERANCE)  # of §7, for both
_BOTH_MODELS = "lines with the waves and the loads of the surfaces, across this range"


def claims_on_exponents(results: PaperResults) -> list[Claim]:
    """Judge them all."""
    windows = results.windows
    reduced = _ModelResults("1D", results.reduced, windows.reduced, results.laws)
    full = _ModelResults("3D", results.full, windows.full, results.laws)
    both = (reduced, full)
    return [
        _constant(reduced, "over low and medium forces (§6, §8)"),
        _constant(full, "k = ζ F^α (eq. 5)"),
        *(
            model.claim(
                "the power law holds down to the lowest forces that the grid represents (§6)",
                "α of the lowest half decade, less that of the window: {}",
                lambda model, laws: model.local(laws).at_lowest,
            )
            for model in both
        ),
        _reduced_ends(reduced),
        *(
            model.claim(
                "α between 0.5 and 0.8 for D_f from 2 to 3, in both investigations (§7)",
                "{}",
                _ModelResults.exponent,
                _EXPONENT_RANGE,
                form=".3f",
            )
            for model in both
        ),
        _great_accuracy(reduced),
        full.claim(
            "α ≈ 0.2567 D_f (§7)",
            "off by {}",
            lambda model, laws: model.exponent(laws) - linear_exponent(laws.fractal_dimension),
        ),
        *(_scaling_argument(model) for model in both),
        *(_small_discrepancy(model) for model in both),
        exact_claim(
            "Entering eqs. 9, 11 and 12 in eq. 5 underlines its validity (§7)",
            "it gives 1 = 1^α: true for every α, and for any other law k̄(F̄), as k̄ and F̄ are "
            "dimensionless; it speaks neither for a power law nor against one",
            "all loads",
            Verdict.UNDECIDED,
            ": the argument cannot tell",
        ),
        *_agreement(results),
    ]


@dataclass(frozen=True, eq=False)
class _ModelResults:
    """One of the two models: its bodies, its window, and the laws of both."""

    label: ModelLabel
    data: xarray.Dataset
    window: ForceWindow
    laws: Sequence[DimensionLaws]

    def claim(
        self,
        words: str,
        found: str,
        number: Callable[[_ModelResults, DimensionLaws], IntervalEstimate],
        allowed: Range = _NO_CHANGE,
        *,
        form: str = "+.3f",
        needed: str = ENOUGH_LOADS,
        of: Callable[[float], bool] = lambda dimension: True,
    ) -> Claim:
        """Return a claim about a number of its laws, at some or at every fractal dimension."""
        laws = [each for each in self.laws if of(each.fractal_dimension)]
        numbers = Numbers.of(laws, lambda each: number(self, each), form)
        return numbers.claim(f"{self.label}: {words}", found, self.basis, allowed, needed)

    @property
    def basis(self) -> str:
        """Window, averaging and grid of its exponents."""
        return basis_in(self.window, self.data)

    def exponent(self, laws: DimensionLaws) -> IntervalEstimate:
        """Return its exponent of one fractal dimension."""
        return exponent_estimate(laws.reduced if self.label == "1D" else laws.full)

    def local(self, laws: DimensionLaws) -> LocalExponents:
        """Return its exponents at the lowest loads."""
        return laws.reduced_local if self.label == "1D" else laws.full_local

    def off_scaling(self, laws: DimensionLaws) -> IntervalEstimate:
        """Return its exponent less that of the scaling argument."""
        return self.exponent(laws) - scaling_exponent(laws.fractal_dimension)


def _constant(model: _ModelResults, words: str) -> Claim:
    """Judge whether the exponent stays the same from the lowest loads to medium ones."""
    lowest = min(model.local(laws).lowest for laws in model.laws)
    carriers = "springs" if model.label == "1D" else "cells"
    drifts = Numbers.of(model.laws, lambda laws: model.local(laws).drift, "+.3f")
    return drifts.claim(
        f"{model.label}: a power law {words}",
        "α in the lowest decade less α in the highest (in the two halves of a range below two "
        "decades): {}",
        f"F̄ = {lowest:.2g} (ten {carriers} touch in every body) to {MEDIUM_FORCE:g}; mean k at "
        f"fixed F̄; {ensemble_in_words(model.data)}",
        _NO_CHANGE,
        f"three loads in each half of the range from where ten {carriers} touch to "
        f"F̄ = {MEDIUM_FORCE:g}",
    )


def _reduced_ends(model: _ModelResults) -> Claim:
    """Judge whether the reduced model has the paper's exponents at D_f = 2 and 3."""
    statement = "1D: α from 0.5 to 0.75 as D_f goes from 2 to 3 (§6)"
    at_ends = [laws for laws in model.laws if laws.fractal_dimension in REDUCED_ENDS]
    ends = Numbers.of(at_ends, model.exponent)
    if not ends.known:
        return undecided_claim(statement, model.basis, "D_f = 2 or 3 with loads across this range")
    off = Numbers.of(
        at_ends, lambda laws: model.exponent(laws) - REDUCED_ENDS[laws.fractal_dimension]
    )
    found = ends.with_places
    elsewhere = [law.exponent for law in at_ends[-1].reduced_elsewhere if law.points]
    if elsewhere:
        found += f"; in other windows {min(elsewhere):.3f} to {max(elsewhere):.3f} at the latter"
    allowed = f"± {EXPONENT_TOLERANCE:g} of {', '.join(f'{x:g}' for x in REDUCED_ENDS.values())}"
    judged = off.judge(_NO_CHANGE)
    claim = Claim.of(statement, found, ends.intervals, judged, model.basis, allowed)
    return off.drawn_with(claim, _NO_CHANGE)


def _great_accuracy(model: _ModelResults) -> Claim:
    """Judge whether the exponent of the reduced model is the same in another window."""
    widest = max(float(np.ptp(laws.reduced.exponent_interval)) / 2 for laws in model.laws)
    low, high = OTHER_WINDOWS_REDUCED[-1]
    return model.claim(
        "α is deduced with great accuracy (§7)",
        f"± {widest:.3f} or less in a given window, but lower by {{}} in the window F̄ = {low:g} to "
        f"{high:g}; averages at fixed level differ by more",
        lambda model, laws: laws.reduced_by_window,
        form=".3f",
        needed=f"loads across this range and from F̄ = {low:g} to {high:g}",
    )


def _scaling_argument(model: _ModelResults) -> Claim:
    """Judge whether eq. 14 gives the exponent of smooth surfaces."""
    return model.claim(
        "α = 1 / (4 - D_f) extremely well for D_f ≤ 2.6 (eq. 14, §7)",
        "off by {}",
        _ModelResults.off_scaling,
        needed="D_f ≤ 2.6 with loads across this range",
        of=is_smooth,
    )


def _small_discrepancy(model: _ModelResults) -> Claim:
    """Judge whether eq. 14 differs little from the exponent of rough surfaces."""
    return model.claim(
        f"a small discrepancy from 1 / (4 - D_f) for D_f > 2.6 (§7; small: {SMALL_DISCREPANCY:g})",
        "off by {}",
        _ModelResults.off_scaling,
        around(0, SMALL_DISCREPANCY),
        needed="D_f > 2.6 with loads across this range",
        of=lambda dimension: not is_smooth(dimension),
    )


def _agreement(results: PaperResults) -> list[Claim]:
    """Judge whether exponent and stiffness of both models are the same, with the same waves."""
    bodies = [each for each in (results.full, results.matched) if each is not None]
    return [
        Numbers.of(results.laws, lambda laws: laws.models_difference, "+.3f").claim(
            "The same power-law behaviour in both models (abstract)",
            "α 3D less α 1D with the same waves: {}",
            basis_in(results.windows.full, *bodies),
            _NO_CHANGE,
            _BOTH_MODELS,
        ),
        Numbers.of(results.laws, lambda laws: laws.agreement, ".2f").claim(
            "Excellent agreement of the stiffness of the two models (abstract, §6)",
            "k / (E* L), 3D over 1D with the same waves: {}",
            f"{basis_in(WINDOW_AGREEMENT, *bodies)}; all loads weighted equally",
            around(1, STIFFNESS_TOLERANCE),
            _BOTH_MODELS,
        ),
    ]
