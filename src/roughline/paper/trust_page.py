"""The page about the trust map: where the reduced model may be trusted."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughline.report.page import Section, Table, render_markdown
from roughline.statistics.verdict import Verdict, verdict

if TYPE_CHECKING:
    from roughline.contact.comparison.trust import Difference, TrustMap

_TOLERANCE = 0.1
_TABLE_FORCES = (1e-3, 1e-2, 1e-1, 1.0)
_TABLE_DIMENSIONS = (2.0, 2.2, 2.4, 2.6, 2.8, 3.0)


def trust_page(trust: TrustMap, fine: TrustMap, folder: str) -> str:
    """Return the page about the map as Markdown; its figure lies in a folder beside it.

    Parameters
    ----------
    trust : TrustMap
        The map.
    fine : TrustMap
        The same with twice the waves and points, at some places.
    folder : str
        Folder of the figure, relative to the page.
    """
    sections = [
        _map_section(folder),
        _numbers_section(),
        *(_roll_off_section(trust, float(roll_off)) for roll_off in trust.roll_off_ratios),
        _cutoff_section(trust, fine),
        _use_section(trust),
    ]
    lead = (
        "The reduced model gives a stiffness in milliseconds, without interactions between "
        "contacts. How far off is it? With roughness that reaches up to the size of the body "
        "(q_roll = q_0) it is close over much of the map. The more of the long waves are missing, "
        "the larger its error, as its law is an effect of the finite size (Pastewka et al., "
        "Phys. Rev. E 87, 062809, 2013). It does not predict area, gap and pressure at all, and "
        "roughline does not derive them from it."
    )
    return render_markdown("Where may the reduced model be trusted?", lead, sections, folder)


def _map_section(folder: str) -> Section:
    return Section(
        "The map",
        [
            f"![The map]({folder}/trust_map.png)",
            "Raw stiffness k / (E* L) of the full model over that of the reduced one, less 1, "
            "at the same F̄ = F / (E* h L), over fractal dimension and load, for five roll-off "
            "ratios q_roll / q_0. Both models have the same self-affine spectrum, from q_0 = "
            "2π/L to 32 q_0, and the same rms height. Hatched: in some surface, fewer than ten "
            "cells were in contact. 20 surfaces of 256² points (eight for the shortest wave), "
            "free half-space, and 200 lines of 65,536 points at each place.",
        ],
    )


def _numbers_section() -> Section:
    return Section(
        "In numbers",
        [
            "Differences of the means with 95 % intervals; a star where the grid decides.",
            "The intervals are studentised; those of 20 surfaces and 200 lines contain the true "
            "value in 94 to 96 of 100 ensembles ([how that was found](how-to/intervals.md)).",
        ],
    )


def _roll_off_section(trust: TrustMap, roll_off: float) -> Section:
    header = ("D_f", *(f"F̄ = {force:g}" for force in _TABLE_FORCES))
    rows = [
        (f"{dimension:.1f}", *(_cell(trust, roll_off, dimension, f) for f in _TABLE_FORCES))
        for dimension in _TABLE_DIMENSIONS
    ]
    table = Table(header, rows, numbers=range(len(header)))
    return Section(f"q_roll / q_0 = {roll_off:g}", tables=[table])


def _cutoff_section(trust: TrustMap, fine: TrustMap) -> Section:
    header = ["q_roll / q_0", "D_f"]
    header += [f"F̄ = {force:g}, {end} q_0" for force in _TABLE_FORCES[1:] for end in (32, 64)]
    rows = []
    for roll_off in map(float, fine.roll_off_ratios):
        for dimension in map(float, fine.fractal_dimensions):
            cells = [
                _cell(of, roll_off, dimension, force)
                for force in _TABLE_FORCES[1:]
                for of in (trust, fine)
            ]
            rows.append([f"{roll_off:g}", f"{dimension:.1f}", *cells])
    return Section(
        "How much it depends on its cutoff",
        [
            "The difference from the map, and from surfaces of 512² points with waves down to "
            "64 q_0 (20 surfaces, 200 lines)."
        ],
        tables=[Table(header, rows, numbers=range(len(header)))],
    )


def _use_section(trust: TrustMap) -> Section:
    return Section(
        "How to use it",
        [
            "`rl.trust_map().at(fractal_dimension=2.3, force_bar=0.05, roll_off_ratio=2)` "
            "gives the difference of the means, its interval, and the scatter of single "
            "surfaces, by which one of your own may differ from the mean. Its "
            '`verdict(tolerance)` is "confirmed" where the whole interval lies within the '
            'tolerance, "refuted" where it lies outside, and "undecided" otherwise. At 10 % and '
            f"where the grid resolves it, {_counts_of_verdicts(trust)}. `roughline compare` "
            "presses both models of your own spectrum or surface.",
            "The map holds within its borders only: it says nothing about other boundaries, bodies "
            "that are not square, or heights that are not Gaussian.",
        ],
    )


def _counts_of_verdicts(trust: TrustMap) -> str:
    """Say at how many places of the map each verdict stands."""
    ends = zip(trust.low[trust.resolved], trust.high[trust.resolved], strict=True)
    verdicts = [verdict(low, high, -_TOLERANCE, _TOLERANCE) for low, high in ends]
    counts = ", ".join(f"{verdicts.count(each)} {each}" for each in Verdict)
    return f"the {len(verdicts)} places of the map are {counts}"


def _cell(trust: TrustMap, roll_off: float, dimension: float, force_bar: float) -> str:
    return trust_cell(trust.at(dimension, force_bar, roll_off))


def trust_cell(difference: Difference) -> str:
    """Write a difference with its interval; a star stands where the grid decides."""
    if np.isnan(difference.value):
        return "-"
    star = "" if difference.resolved else " *"
    return f"{difference.value:+.0%} ({difference.low:+.0%} to {difference.high:+.0%}){star}"
