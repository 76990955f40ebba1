"""The paper's claims about numerical difficulties and computing times, one function each."""

from __future__ import annotations

import numpy as np

from roughline.paper.claim import EXACT, Claim, bodies_of
from roughline.paper.results import ROW_FULL, ROW_REDUCED, PaperResults
from roughline.statistics.verdict import Verdict, verdict

_SOME_MINUTES = 3600  # longest time that counts as minutes [s]
_SOME_WEEKS = 7 * 24  # shortest time that counts as weeks [h]


def no_difficulties(results: PaperResults) -> Claim:
    """Judge whether every load of every line was solved."""
    status = results.reduced.status.values
    failed = int(np.count_nonzero(status))
    judged = Verdict.REFUTED if failed else Verdict.CONFIRMED
    return Claim(
        "1D: no numerical difficulties arise (§8)",
        found=f"{failed} of {status.size} loads failed; the whole curve is a sorted sum, without "
        "iteration",
        interval=EXACT,
        basis=f"all loads; no average; {bodies_of(results.reduced)} for each D_f",
        verdict=judged,
        cases=str(judged),
    )


def reduced_within_minutes(results: PaperResults) -> list[Claim]:
    """Judge whether lines of 2^20 points take minutes; no claim where times are not known."""
    if results.computing is None:
        return []
    seconds, data = results.computing.core_seconds[ROW_REDUCED], results.reduced
    dimensions = results.exponents.sizes["fractal_dimension"]
    ensemble = seconds * data.sizes["realisation"]
    judged = verdict(ensemble, ensemble, 0, _SOME_MINUTES)
    return [
        Claim(
            "1D: samples of 2^20 points within minutes (§8)",
            found=f"{seconds:.3g} s a line of {data.attrs['n']} points with "
            f"{data.sizes['force_bar']} loads; {ensemble:.3g} s for the "
            f"{data.sizes['realisation']} lines of one D_f, {ensemble * dimensions / 60:.3g} "
            f"minutes for all {dimensions}; one core, generation included",
            interval="mean of a sample",
            basis="all loads",
            verdict=judged,
            cases=str(judged),
        )
    ]


def full_takes_weeks(results: PaperResults) -> list[Claim]:
    """Judge whether a study of surfaces takes weeks; no claim where times are not known."""
    if results.computing is None:
        return []
    computing, data = results.computing, results.full
    seconds = computing.core_seconds[ROW_FULL]
    bodies = data.sizes["realisation"] * data.sizes["fractal_dimension"]
    hours = seconds * bodies / computing.cores / 3600
    judged = verdict(hours, hours, _SOME_WEEKS, np.inf)
    return [
        Claim(
            "3D: the study takes several weeks at 2049² (§8)",
            found=f"today {hours:.1f} hours for the {bodies} surfaces of {data.attrs['n']}² with "
            f"{data.sizes['force_bar']} loads each, on {computing.cores} cores ("
            f"{computing.processor}): {seconds:.0f} core seconds a surface. How many loads the "
            "paper computed is not known",
            interval="mean of all surfaces",
            basis="all loads",
            verdict=judged,
            cases=f"{judged}: hours",
        )
    ]
