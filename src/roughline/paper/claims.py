"""The claims of the paper, judged by a study; those on exponents are in a file of their own."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughline.contact import scaling
from roughline.paper.claim import (
    Numbers,
    at,
    basis_in,
    ensemble_in_words,
    exact_claim,
    in_range,
    undecided_claim,
)
from roughline.paper.claims_on_exponents import claims_on_exponents
from roughline.paper.contact_area import SATURATED, saturation
from roughline.paper.plan import ENSEMBLE_FULL, ENSEMBLE_REDUCED
from roughline.paper.stated import EXPONENT_TOLERANCE, STIFFNESS_TOLERANCE
from roughline.paper.windows import WINDOW_AREA
from roughline.spectra.self_affine import SelfAffine
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Claim, Verdict, around, joint_verdict, verdict

if TYPE_CHECKING:
    from roughline.paper.laws import DimensionLaws
    from roughline.paper.results import Computing, PaperResults

_LARGEST_SMALL_AREA = 0.5  # fraction that counts as a small part of the nominal area
_DEPTH_ROUNDING = 1e-5  # relative: depths are kept in single precision
_MOST_MINUTES = 3600  # longest time that counts as minutes [s]
_LEAST_WEEKS = 7 * 24  # shortest time that counts as weeks [h]


def judge_claims(results: PaperResults) -> list[Claim]:
    """Put each claim of the paper beside the same number here, with a verdict.

    Computing times are judged where they are known.
    """
    found = [
        *claims_on_exponents(results),
        _area_is_linear(results),
        _equal_moments(results),
        _punch_constant(results),
        _configuration_alone(results),
        _saturates_early(results),
        _saturates_with_all_springs(results),
        _no_difficulties(results),
    ]
    if (computing := results.computing) is not None:
        found += [
            _reduced_within_minutes(results, computing),
            _full_takes_weeks(results, computing),
        ]
    return found


def _area_is_linear(results: PaperResults) -> Claim:
    """Judge whether the real area is proportional to the force; give κ of both areas."""
    exponents = Numbers.of(results.laws, lambda laws: laws.corrected.exponent)
    in_cells = Numbers.of(results.laws, lambda laws: laws.cells.exponent)
    kappas = Numbers.of(results.laws, lambda laws: laws.corrected.kappa, ".2f")
    kappas_in_cells = Numbers.of(results.laws, lambda laws: laws.cells.kappa, ".2f")
    return exponents.claim(
        "The real contact area is linear in the force, A = κ F / (E* ∇h) (eq. 4)",
        f"A ~ F^{{}}, corrected for the outline (in cells: {in_cells}); κ = "
        f"{kappas} (in cells: {kappas_in_cells}, which depends on the grid)",
        f"{basis_in(WINDOW_AREA, results.full, averaged='A')}; all loads weighted equally",
        around(1, EXPONENT_TOLERANCE),
    )


def _equal_moments(results: PaperResults) -> Claim:
    """Judge whether eq. 7 gives the line the rms height of the surface, on the same lattice."""
    ratios = Numbers.of(results.laws, _rms_height_of_line_over_surface)
    allowed = around(1, STIFFNESS_TOLERANCE)
    claim = Claim.of(
        "C_1D = π q C_2D gives the line the surface's rms roughness and moments (eq. 7)",
        "as integrals they are equal; as sums over the waves of a body of length L = 2π/q_0 the "
        f"rms height of the line over that of the surface is {ratios.with_places}",
        "exact",
        ratios.judge(allowed),
        "waves from q_0 to 128 q_0; no average",
        in_range(allowed, ".2f"),
    )
    return ratios.drawn_with(claim, allowed)


def _rms_height_of_line_over_surface(laws: DimensionLaws) -> IntervalEstimate:
    spectrum = SelfAffine(fractal_dimension=laws.fractal_dimension, C_0=1.0, q_high=128 * 2 * np.pi)
    ratio = spectrum.line(2**14, 0).rms_height / spectrum.surface(512, 0).rms_height
    return IntervalEstimate(ratio, ratio, ratio)


def _punch_constant(results: PaperResults) -> Claim:
    """Judge whether the paper's constant of the square punch is right."""
    low = 1 - scaling.PAPER_PUNCH / scaling.EXACT_PUNCH
    largest = np.nanmax(results.full.stiffness.values[..., -1])
    return exact_claim(
        f"3D: the stiffness saturates at {scaling.PAPER_PUNCH} E* L (§3, §5)",
        f"the rigid square punch has {scaling.EXACT_PUNCH:.4f} E* L: the constant is "
        f"{low:.1%} low; at F̄ = {results.full.force_bar.values[-1]:g} the largest stiffness of a "
        f"surface is {largest:.4f} E* L",
        f"full contact; no average; {ensemble_in_words(results.full)} for each D_f",
        Verdict.REFUTED,
        " in its third digit",
        allowed="its digits",
    )


def _configuration_alone(results: PaperResults) -> Claim:
    """Judge whether dF/dd is the stiffness that is solved from the contact area alone."""
    full = results.full.transpose("fractal_dimension", "realisation", "force_bar")
    slopes = np.diff(full.force_bar.values) / np.diff(full.depth.values.astype(float), axis=-1)
    stiffness = full.stiffness.values
    statement = "k = ∂F/∂d depends only on which areas are in contact (§3)"
    basis = f"all loads; no average; {ensemble_in_words(results.full)} for each D_f"
    solved = np.isfinite(slopes)
    if not solved.any():
        return undecided_claim(statement, basis, "two neighbouring loads")
    between = (slopes >= stiffness[..., :-1] * (1 - _DEPTH_ROUNDING)) & (
        slopes <= stiffness[..., 1:] * (1 + _DEPTH_ROUNDING)
    )
    share = float(between[solved].mean())
    return exact_claim(
        statement,
        "here k is solved from the contact area alone; the slope of F(d) between neighbouring "
        f"loads lies between its values at these in {share:.1%} of {solved.sum()} steps",
        basis,
        Verdict.CONFIRMED if share == 1 else Verdict.REFUTED,
        allowed="every step",
    )


def _saturates_early(results: PaperResults) -> Claim:
    """Judge whether a part of the area in contact is enough for the stiffness of the punch."""
    statement = (
        "3D: a relatively small real area suffices for the saturated stiffness (§3, §5; small: "
        f"{_LARGEST_SMALL_AREA:.0%})"
    )
    basis = f"linear between loads; mean k and A at fixed F̄; {ensemble_in_words(results.full)}"
    areas = Numbers.of(results.laws, lambda laws: laws.saturation, ".1%")
    if results.full.attrs["boundary"] == "periodic":
        return undecided_claim(statement, basis, "surfaces with free borders, which a punch has")
    if not areas.known:
        return undecided_claim(
            statement, basis, f"loads up to {SATURATED:.0%} of the punch's stiffness"
        )
    found = f"{SATURATED:.0%} of the exact limit at {areas.with_places} real contact, in cells"
    every = [*areas.known.values()]
    if (other := results.other_grid) is not None:
        there = Numbers(
            {
                at(float(d)): saturation(other.sel(fractal_dimension=d))
                for d in other.fractal_dimension.values
            },
            ".1%",
        )
        found += (
            f"; on {other.attrs['n']}² {there.with_places}: except at D_f = 2 it "
            "depends on the grid, and is less the finer the grid is"
        )
        every += there.known.values()
    small = (0.0, _LARGEST_SMALL_AREA)
    together = joint_verdict(verdict(area.low, area.high, *small) for area in every)
    allowed = f"up to {_LARGEST_SMALL_AREA:.0%}"
    claim = exact_claim(
        statement, found, basis, together, interval=areas.intervals, allowed=allowed
    )
    return areas.drawn_with(claim, small)


def _saturates_with_all_springs(results: PaperResults) -> Claim:
    """Judge whether the lines are saturated when all springs touch, and not before."""
    stiffness = results.reduced.stiffness.values[..., -1]
    solved = stiffness[np.isfinite(stiffness)]
    return exact_claim(
        "1D: the stiffness is saturated only when all springs are in contact (§5)",
        "k / (E* L) is the share of springs in contact; at F̄ = "
        f"{float(results.reduced.force_bar.values[-1]):g} all are, in {np.mean(solved == 1):.0%} "
        f"of {solved.size} lines",
        f"all loads; no average; {ensemble_in_words(results.reduced)} for each D_f",
        Verdict.CONFIRMED,
        ", by construction",
    )


def _no_difficulties(results: PaperResults) -> Claim:
    """Judge whether every load of every line was solved."""
    status = results.reduced.status.values
    failed = int(np.count_nonzero(status))
    return exact_claim(
        "1D: no numerical difficulties arise (§8)",
        f"{failed} of {status.size} loads failed; the whole curve is a sorted sum, without "
        "iteration",
        f"all loads; no average; {ensemble_in_words(results.reduced)} for each D_f",
        Verdict.REFUTED if failed else Verdict.CONFIRMED,
        allowed="no failed load",
    )


def _reduced_within_minutes(results: PaperResults, computing: Computing) -> Claim:
    """Judge whether lines of 2^20 points take minutes."""
    seconds, data = computing.core_seconds[ENSEMBLE_REDUCED], results.reduced
    dimensions = results.exponents.sizes["fractal_dimension"]
    ensemble = seconds * data.sizes["realisation"]
    return exact_claim(
        "1D: samples of 2^20 points within minutes (§8)",
        f"{seconds:.3g} s a line of {data.attrs['n']} points with {data.sizes['force_bar']} loads; "
        f"{ensemble:.3g} s for the {data.sizes['realisation']} lines of one D_f, "
        f"{ensemble * dimensions / 60:.3g} minutes for all {dimensions}; one core, generation "
        "included",
        "all loads",
        verdict(ensemble, ensemble, 0, _MOST_MINUTES),
        interval="mean of a sample",
        allowed=f"up to {_MOST_MINUTES / 60:g} minutes for one D_f",
    )


def _full_takes_weeks(results: PaperResults, computing: Computing) -> Claim:
    """Judge whether a study of surfaces takes weeks."""
    seconds, data = computing.core_seconds[ENSEMBLE_FULL], results.full
    bodies = data.sizes["realisation"] * data.sizes["fractal_dimension"]
    hours = seconds * bodies / computing.cores / 3600
    return exact_claim(
        "3D: the study takes several weeks at 2049² (§8)",
        f"today {hours:.1f} hours for the {bodies} surfaces of {data.attrs['n']}² with "
        f"{data.sizes['force_bar']} loads each, on {computing.cores} cores ({computing.processor}"
        f"): {seconds:.0f} core seconds a surface. How many loads the paper computed is not known",
        "all loads",
        verdict(hours, hours, _LEAST_WEEKS, np.inf),
        ": hours",
        "mean of all surfaces",
        f"{_LEAST_WEEKS} hours or more",
    )
