"""The paper's claims about stiffness, area, saturation, spectra and computing times."""

from __future__ import annotations

import numpy as np

from roughline.contact import scaling
from roughline.paper.claim import (
    EXPONENT_TOLERANCE,
    STIFFNESS_TOLERANCE,
    Claim,
    basis,
    by_dimension,
    grid,
    intervals,
    values,
)
from roughline.paper.contact_area import SATURATED, WINDOW_AREA, saturation
from roughline.paper.exponents import WINDOW_AGREEMENT, DimensionSummary
from roughline.paper.results import ROW_1D, PaperResults, row_of
from roughline.spectra.self_affine import SelfAffine
from roughline.statistics.bootstrap import Estimate
from roughline.statistics.verdict import Verdict, of_all, verdict

Summaries = list[DimensionSummary]

_EXACT = "exact"
_SMALL_AREA = 0.5  # real area fraction: saturated well before all is in contact
_PAPERS_GRID = 2048
_ROUNDING = 1e-5  # of depths, which are kept in single precision


def on_contact(summaries: Summaries, results: PaperResults) -> list[Claim]:
    """Judge every claim about stiffness, area, saturation, spectra and times."""
    return [
        stiffness_agrees(summaries, results),
        area_is_linear(summaries, results),
        equal_moments(summaries),
        punch_constant(results),
        configuration_alone(results),
        saturates_early(summaries, results),
        saturates_with_all_springs(results),
        no_difficulties(results),
        *reduced_within_minutes(results),
        *full_takes_weeks(results),
    ]


def stiffness_agrees(summaries: Summaries, results: PaperResults) -> Claim:
    """Whether the stiffness of the two models is the same."""
    ratios = [(s.fractal_dimension, s.agreement) for s in summaries]
    return Claim(
        "Excellent agreement of the stiffness of the two models (abstract, §6)",
        f"k / (E* L), 3D over 1D with the same waves: {values(ratios, '.2f')}",
        intervals(ratios, ".2f"),
        f"{basis(WINDOW_AGREEMENT, results.full)}, {grid(results.matched)}; every load alike",
        *by_dimension(ratios, 1 - STIFFNESS_TOLERANCE, 1 + STIFFNESS_TOLERANCE),
    )


def area_is_linear(summaries: Summaries, results: PaperResults) -> Claim:
    """Whether the real area is proportional to the force; kappa of both areas."""
    exponents = [(s.fractal_dimension, s.corrected.exponent) for s in summaries]
    in_cells = [(s.fractal_dimension, s.cells.exponent) for s in summaries]
    corrected, cells = (
        ", ".join(f"{law.kappa.value:.2f}" for law in laws)
        for laws in ([s.corrected for s in summaries], [s.cells for s in summaries])
    )
    return Claim(
        "The real contact area is linear in the force, A = κ F / (E* ∇h) (eq. 4)",
        f"A ~ F^{values(exponents)}, corrected for the outline (in cells: "
        f"{', '.join(f'{number.value:.3f}' for _, number in in_cells)}); κ = {corrected} (in "
        f"cells: {cells}, which is the grid's)",
        intervals(exponents),
        f"{basis(WINDOW_AREA, results.full, 'A')}; every load alike",
        *by_dimension(exponents, 1 - EXPONENT_TOLERANCE, 1 + EXPONENT_TOLERANCE),
    )


def equal_moments(summaries: Summaries) -> Claim:
    """Whether eq. 7 gives the line the rms height of the surface, on the lattice of both."""
    ratios = []
    for s in summaries:
        spectrum = SelfAffine(
            fractal_dimension=s.fractal_dimension, C_0=1.0, q_high=128 * 2 * np.pi
        )
        ratio = spectrum.line(2**14, 0).rms_height / spectrum.surface(512, 0).rms_height
        ratios.append((s.fractal_dimension, Estimate(ratio, ratio, ratio)))
    return Claim(
        "C_1D = π q C_2D gives the line the surface's rms roughness and moments (eq. 7)",
        "as integrals they are equal; as sums over the waves of a body of length L = 2π/q_0 the "
        f"rms height of the line over that of the surface is {values(ratios)}",
        _EXACT,
        "waves from q_0 to 128 q_0; no average",
        *by_dimension(ratios, 1 - STIFFNESS_TOLERANCE, 1 + STIFFNESS_TOLERANCE),
    )


def punch_constant(results: PaperResults) -> Claim:
    """Whether the paper's constant of the square punch is right."""
    low = 1 - scaling.PAPER_PUNCH / scaling.EXACT_PUNCH
    at_top = results.full.stiffness.values[..., -1]
    return Claim(
        f"3D: the stiffness saturates at {scaling.PAPER_PUNCH} E* L (§3, §5)",
        f"the rigid square punch has {scaling.EXACT_PUNCH:.4f} E* L: the constant is {low:.1%} "
        f"low; at F̄ = {results.full.force_bar.values[-1]:g} the largest stiffness of a surface is "
        f"{np.nanmax(at_top):.4f} E* L",
        _EXACT,
        f"full contact; no average; {grid(results.full)} for each D_f",
        Verdict.REFUTED,
        "refuted in its third digit",
    )


def configuration_alone(results: PaperResults) -> Claim:
    """Whether dF/dd is the stiffness that is solved from the contact area alone."""
    full = results.full.transpose("fractal_dimension", "realisation", "force_bar")
    steps = np.diff(full.force_bar.values) / np.diff(full.depth.values.astype(float), axis=-1)
    stiffness = full.stiffness.values
    known = np.isfinite(steps)
    between = (steps >= stiffness[..., :-1] * (1 - _ROUNDING)) & (
        steps <= stiffness[..., 1:] * (1 + _ROUNDING)
    )
    share = float(between[known].mean())
    return Claim(
        "k = ∂F/∂d depends only on which areas are in contact (§3)",
        "here k is solved from the contact area alone; the slope of F(d) between neighbouring "
        f"loads lies between its values at these in {share:.1%} of {known.sum()} steps",
        _EXACT,
        f"all loads; no average; {grid(results.full)} for each D_f",
        Verdict.CONFIRMED if share == 1 else Verdict.REFUTED,
        "confirmed" if share == 1 else "refuted",
    )


def saturates_early(summaries: Summaries, results: PaperResults) -> Claim:
    """Whether a part of the area in contact is enough for the stiffness of the punch."""
    areas = [(s.fractal_dimension, s.saturation) for s in summaries]
    found = f"{SATURATED:.0%} of the exact limit at {values(areas, '.1%')} real contact, in cells"
    every = [number for _, number in areas]
    if (fine := results.paper_grid) is not None:
        finer = [
            (float(d), saturation(fine.sel(fractal_dimension=d)))
            for d in fine.fractal_dimension.values
        ]
        found += (
            f"; on {fine.attrs['n']}² {values(finer, '.1%')}: except at D_f = 2 a number of the "
            "grid, less the finer it is"
        )
        every += [number for _, number in finer]
    judged = of_all(verdict(number.low, number.high, 0, _SMALL_AREA) for number in every)
    return Claim(
        "3D: a relatively small real area suffices for the saturated stiffness (§3, §5; small: "
        f"{_SMALL_AREA:.0%})",
        found,
        intervals(areas, ".1%"),
        f"linear between loads; mean k and A at fixed F̄; {grid(results.full)}",
        judged,
        str(judged),
    )


def saturates_with_all_springs(results: PaperResults) -> Claim:
    """Whether the lines are saturated when all springs touch, and not before."""
    top = float(results.reduced.force_bar.values[-1])
    last = results.reduced.stiffness.values[..., -1]
    known = last[np.isfinite(last)]
    return Claim(
        "1D: the stiffness is saturated only when all springs are in contact (§5)",
        "k / (E* L) is the share of springs in contact; at F̄ = "
        f"{top:g} all are, in {np.mean(known == 1):.0%} of {known.size} lines",
        _EXACT,
        f"all loads; no average; {grid(results.reduced)} for each D_f",
        Verdict.CONFIRMED,
        "confirmed, by construction",
    )


def no_difficulties(results: PaperResults) -> Claim:
    """Whether every load of every line was solved."""
    status = results.reduced.status.values
    failed = int(np.count_nonzero(status))
    judged = Verdict.REFUTED if failed else Verdict.CONFIRMED
    return Claim(
        "1D: no numerical difficulties arise (§8)",
        f"{failed} of {status.size} loads failed; the whole curve is a sorted sum, without "
        "iteration",
        _EXACT,
        f"all loads; no average; {grid(results.reduced)} for each D_f",
        judged,
        str(judged),
    )


def reduced_within_minutes(results: PaperResults) -> list[Claim]:
    """Whether lines of 2^20 points take minutes; nothing where times were not kept."""
    if ROW_1D not in results.core_seconds:
        return []
    each, data = results.core_seconds[ROW_1D], results.reduced
    dimensions = results.exponents.sizes["fractal_dimension"]
    ensemble = each * data.sizes["realisation"]
    judged = verdict(ensemble, ensemble, 0, 3600)
    return [
        Claim(
            "1D: samples of 2^20 points within minutes (§8)",
            f"{each:.3g} s a line of {data.attrs['n']} points with {data.sizes['force_bar']} "
            f"loads; {ensemble:.3g} s for the {data.sizes['realisation']} lines of one D_f, "
            f"{ensemble * dimensions / 60:.3g} minutes for all {dimensions}; one core, "
            "generation included",
            "mean of a sample",
            "all loads",
            judged,
            str(judged),
        )
    ]


def full_takes_weeks(results: PaperResults) -> list[Claim]:
    """Whether a study of surfaces takes weeks; nothing where times were not kept."""
    data = results.paper_grid
    if data is None or row_of(_PAPERS_GRID) not in results.core_seconds:
        return []
    each, surfaces = results.core_seconds[row_of(_PAPERS_GRID)], 60 * 6
    hours = each * surfaces / 3600
    judged = verdict(hours, hours, 7 * 24, np.inf)
    return [
        Claim(
            "3D: the study takes several weeks at 2049² (§8)",
            f"today {hours:.0f} hours for the 60 surfaces of six D_f, on one core: {each:.0f} s a "
            f"surface of {data.attrs['n']}² with {data.sizes['force_bar']} loads. How many loads "
            "the paper computed is not known",
            f"mean of one surface for each of {data.sizes['fractal_dimension']} D_f, multiplied",
            "all loads",
            judged,
            f"{judged}: hours",
        )
    ]
