"""The paper's claims against the ensembles, all of them."""

from __future__ import annotations

from roughline.paper.claim import EXPONENT_TOLERANCE, STIFFNESS_TOLERANCE, Claim
from roughline.paper.claims_on_contact import on_contact
from roughline.paper.claims_on_exponents import on_exponents
from roughline.paper.exponents import DimensionSummary
from roughline.paper.results import PaperResults
from roughline.report.page import Section, Table


def judge(summaries: list[DimensionSummary], results: PaperResults) -> list[Claim]:
    """Put each claim of the paper beside our numbers."""
    return [*on_exponents(summaries, results), *on_contact(summaries, results)]


def claims_section(claims: list[Claim]) -> Section:
    """Return the table of the claims, and how they are judged."""
    header = (
        *("The paper says", "Found here", "95 % interval"),
        *("Window, averaging, grid", "Verdict"),
    )
    rows = [(c.statement, c.found, c.interval, c.basis, c.cases) for c in claims]
    return Section(
        "The paper's claims",
        tables=[Table(header, rows, verdict=4)],
        note=(
            "Confirmed: the whole 95 % interval lies within the tolerance of the claim. Refuted: "
            "the whole interval lies outside. Undecided: it lies across, and this sample cannot "
            f"tell. The tolerance of an exponent is {EXPONENT_TOLERANCE:g}, that of a stiffness "
            f"or a height {STIFFNESS_TOLERANCE:.0%}; a claim about every D_f is refuted by one. "
            "The intervals are studentised, from resampled realisations; they do not hold what "
            "another window or another average would give, which is "
            "why both stand beside them. The paper does not state its windows. Not judged: "
            "definitions, what it reports of others' work, and what its Fig. 1 is meant to show."
        ),
    )
