"""All claims of the paper, judged by the results of a study."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughline.paper.claims_on_contact import claims_on_contact
from roughline.paper.claims_on_exponents import claims_on_exponents
from roughline.paper.stated import EXPONENT_TOLERANCE, STIFFNESS_TOLERANCE
from roughline.report.page import Section, Table

if TYPE_CHECKING:
    from roughline.paper.results import PaperResults
    from roughline.statistics.verdict import Claim


def judge_claims(results: PaperResults) -> list[Claim]:
    """Put each claim of the paper beside the same number here, with a verdict."""
    return [*claims_on_exponents(results), *claims_on_contact(results)]


def claims_section(claims: list[Claim]) -> Section:
    """Return the table of the claims, and how they are judged."""
    header = (
        *("The paper says", "Found here", "95 % interval"),
        *("Window, averaging, grid", "Verdict"),
    )
    rows = [
        (claim.statement, claim.found, claim.interval, claim.basis, claim.cases) for claim in claims
    ]
    return Section(
        "The paper's claims",
        tables=[Table(header, rows, verdict=4)],
        note=(
            "Confirmed: the whole 95 % interval lies within the tolerance of the claim. Refuted: "
            "the whole interval lies outside. Undecided: it lies partly within, and this sample "
            "does not decide. "
            f"The tolerance of an exponent is {EXPONENT_TOLERANCE:g}, that of a stiffness "
            f"or a height {STIFFNESS_TOLERANCE:.0%}; a claim about every D_f is refuted by one. "
            "The intervals are studentised, from resampled realisations; they do not include the "
            "effect of another window or another average, so both are stated with them. "
            "The paper does not state its windows. Not judged: definitions, what the paper "
            "reports of others' work, and what its Fig. 1 is meant to show."
        ),
    )
