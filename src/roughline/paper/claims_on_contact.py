"""The paper's claims about stiffness, contact area, saturation and spectra, one function each."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughline.contact import scaling
from roughline.paper.claim import (
    BOTH_MODELS,
    EXACT,
    STIFFNESS_TOLERANCE,
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
    numbers,
    numbers_by_dimension,
)
from roughline.paper.contact_area import SATURATED, saturation
from roughline.paper.stated import EXPONENT_TOLERANCE
from roughline.paper.windows import WINDOW_AGREEMENT, WINDOW_AREA
from roughline.spectra.self_affine import SelfAffine
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Verdict, joint_verdict, verdict

if TYPE_CHECKING:
    from roughline.paper.laws import DimensionLaws
    from roughline.paper.results import PaperResults

_SAME_SIZE = around(1, STIFFNESS_TOLERANCE)  # ratios of stiffnesses, and of heights
_LINEAR = around(1, EXPONENT_TOLERANCE)  # exponents of a linear law
_SMALL_AREA = 0.5  # largest real area fraction that counts as a small part of the nominal area
_ROUNDING = 1e-5  # of depths, which are kept in single precision


def stiffness_agrees(results: PaperResults) -> Claim:
    """Judge whether the stiffness of the two models is the same."""
    ratios = cases_of(results.laws, lambda laws: laws.agreement)
    return claim_about_every_dimension(
        "Excellent agreement of the stiffness of the two models (abstract, §6)",
        found=f"k / (E* L), 3D over 1D with the same waves: {numbers_by_dimension(ratios, '.2f')}",
        basis=f"{in_both_models(WINDOW_AGREEMENT, results)}; all loads weighted equally",
        cases=ratios,
        allowed=_SAME_SIZE,
        form=".2f",
        needed=BOTH_MODELS,
    )


def area_is_linear(results: PaperResults) -> Claim:
    """Judge whether the real area is proportional to the force; give κ of both areas."""
    exponents = cases_of(results.laws, lambda laws: laws.corrected.exponent)
    exponents_in_cells = cases_of(results.laws, lambda laws: laws.cells.exponent)
    kappas = cases_of(results.laws, lambda laws: laws.corrected.kappa)
    kappas_in_cells = cases_of(results.laws, lambda laws: laws.cells.kappa)
    return claim_about_every_dimension(
        "The real contact area is linear in the force, A = κ F / (E* ∇h) (eq. 4)",
        found=f"A ~ F^{numbers_by_dimension(exponents)}, corrected for the outline (in cells: "
        f"{numbers(exponents_in_cells)}); κ = {numbers(kappas, '.2f')} (in cells: "
        f"{numbers(kappas_in_cells, '.2f')}, which depends on the grid)",
        basis=f"{basis_in(WINDOW_AREA, results.full, 'A')}; all loads weighted equally",
        cases=exponents,
        allowed=_LINEAR,
    )


def equal_moments(results: PaperResults) -> Claim:
    """Judge whether eq. 7 gives the line the rms height of the surface, on the same lattice."""
    ratios = cases_of(results.laws, _rms_height_of_line_over_surface)
    whole, in_words = by_dimension(ratios, _SAME_SIZE)
    return Claim(
        "C_1D = π q C_2D gives the line the surface's rms roughness and moments (eq. 7)",
        found="as integrals they are equal; as sums over the waves of a body of length L = 2π/q_0 "
        f"the rms height of the line over that of the surface is {numbers_by_dimension(ratios)}",
        interval=EXACT,
        basis="waves from q_0 to 128 q_0; no average",
        verdict=whole,
        cases=in_words,
    )


def _rms_height_of_line_over_surface(laws: DimensionLaws) -> IntervalEstimate:
    spectrum = SelfAffine(fractal_dimension=laws.fractal_dimension, C_0=1.0, q_high=128 * 2 * np.pi)
    ratio = spectrum.line(2**14, 0).rms_height / spectrum.surface(512, 0).rms_height
    return IntervalEstimate(ratio, ratio, ratio)


def punch_constant(results: PaperResults) -> Claim:
    """Judge whether the paper's constant of the square punch is right."""
    low = 1 - scaling.PAPER_PUNCH / scaling.EXACT_PUNCH
    largest = np.nanmax(results.full.stiffness.values[..., -1])
    return Claim(
        f"3D: the stiffness saturates at {scaling.PAPER_PUNCH} E* L (§3, §5)",
        found=f"the rigid square punch has {scaling.EXACT_PUNCH:.4f} E* L: the constant is "
        f"{low:.1%} low; at F̄ = {results.full.force_bar.values[-1]:g} the largest stiffness of a "
        f"surface is {largest:.4f} E* L",
        interval=EXACT,
        basis=f"full contact; no average; {bodies_of(results.full)} for each D_f",
        verdict=Verdict.REFUTED,
        cases="refuted in its third digit",
    )


def configuration_alone(results: PaperResults) -> Claim:
    """Judge whether dF/dd is the stiffness that is solved from the contact area alone."""
    full = results.full.transpose("fractal_dimension", "realisation", "force_bar")
    slopes = np.diff(full.force_bar.values) / np.diff(full.depth.values.astype(float), axis=-1)
    stiffness = full.stiffness.values
    statement = "k = ∂F/∂d depends only on which areas are in contact (§3)"
    basis = f"all loads; no average; {bodies_of(results.full)} for each D_f"
    solved = np.isfinite(slopes)
    if not solved.any():
        return not_judged(statement, basis, "two neighbouring loads")
    between = (slopes >= stiffness[..., :-1] * (1 - _ROUNDING)) & (
        slopes <= stiffness[..., 1:] * (1 + _ROUNDING)
    )
    share = float(between[solved].mean())
    judged = Verdict.CONFIRMED if share == 1 else Verdict.REFUTED
    return Claim(
        statement,
        found="here k is solved from the contact area alone; the slope of F(d) between "
        f"neighbouring loads lies between its values at these in {share:.1%} of {solved.sum()} "
        "steps",
        interval=EXACT,
        basis=basis,
        verdict=judged,
        cases=str(judged),
    )


def saturates_early(results: PaperResults) -> Claim:
    """Judge whether a part of the area in contact is enough for the stiffness of the punch."""
    statement = (
        "3D: a relatively small real area suffices for the saturated stiffness (§3, §5; small: "
        f"{_SMALL_AREA:.0%})"
    )
    basis = f"linear between loads; mean k and A at fixed F̄; {bodies_of(results.full)}"
    areas = cases_of(results.laws, lambda laws: laws.saturation)
    if results.full.attrs["boundary"] == "periodic":
        return not_judged(statement, basis, "surfaces with free borders, which a punch has")
    if not known(areas):
        return not_judged(statement, basis, f"loads up to {SATURATED:.0%} of the punch's stiffness")
    found = (
        f"{SATURATED:.0%} of the exact limit at {numbers_by_dimension(areas, '.1%')} real "
        "contact, in cells"
    )
    every = [area for _, area in known(areas)]
    if (other := results.other_grid) is not None:
        there = [
            (float(d), saturation(other.sel(fractal_dimension=d)))
            for d in other.fractal_dimension.values
        ]
        found += (
            f"; on {other.attrs['n']}² {numbers_by_dimension(there, '.1%')}: except at D_f = 2 it "
            "depends on the grid, and is less the finer the grid is"
        )
        every += [area for _, area in known(there)]
    judged = joint_verdict(verdict(area.low, area.high, 0, _SMALL_AREA) for area in every)
    return Claim(
        statement,
        found=found,
        interval=intervals(areas, ".1%"),
        basis=basis,
        verdict=judged,
        cases=str(judged),
    )


def saturates_with_all_springs(results: PaperResults) -> Claim:
    """Judge whether the lines are saturated when all springs touch, and not before."""
    largest_force = float(results.reduced.force_bar.values[-1])
    stiffness = results.reduced.stiffness.values[..., -1]
    solved = stiffness[np.isfinite(stiffness)]
    return Claim(
        "1D: the stiffness is saturated only when all springs are in contact (§5)",
        found="k / (E* L) is the share of springs in contact; at F̄ = "
        f"{largest_force:g} all are, in {np.mean(solved == 1):.0%} of {solved.size} lines",
        interval=EXACT,
        basis=f"all loads; no average; {bodies_of(results.reduced)} for each D_f",
        verdict=Verdict.CONFIRMED,
        cases="confirmed, by construction",
    )
