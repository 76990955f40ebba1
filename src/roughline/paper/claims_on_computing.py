"""The paper's claims about numerical difficulties and computing times, one function each."""

from __future__ import annotations

import numpy as np

from roughline.paper.claim import EXACT, Claim, bodies_of
from roughline.paper.results import PAPER_GRID, ROW_REDUCED, PaperResults, row_of_grid
from roughline.statistics.verdict import Verdict, verdict

_SOME_MINUTES = 3600  # longest time that counts as minutes [s]
_SOME_WEEKS = 7 * 24  # shortest time that counts as weeks [h]
_PAPERS_SURFACES = 60 * 6  # 60 surfaces for each of six fractal dimensions


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
    if ROW_REDUCED not in results.core_seconds:
        return []
    seconds, data = results.core_seconds[ROW_REDUCED], results.reduced
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
    data = results.other_grid
    if data is None or row_of_grid(PAPER_GRID) not in results.core_seconds:
        return []
    seconds = results.core_seconds[row_of_grid(PAPER_GRID)]
    hours = seconds * _PAPERS_SURFACES / 3600
    judged = verdict(hours, hours, _SOME_WEEKS, np.inf)
    dimensions = data.sizes["fractal_dimension"]
    return [
        Claim(
            "3D: the study takes several weeks at 2049² (§8)",
            found=f"today {hours:.0f} hours for the 60 surfaces of six D_f, on one core: "
            f"{seconds:.0f} s a surface of {data.attrs['n']}² with {data.sizes['force_bar']} "
            "loads. How many loads the paper computed is not known",
            interval=f"mean of one surface for each of {dimensions} D_f, multiplied",
            basis="all loads",
            verdict=judged,
            cases=f"{judged}: hours",
        )
    ]
