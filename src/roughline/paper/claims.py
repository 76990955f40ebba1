"""All claims of the paper, judged by the results of a study."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughline.paper import claims_on_computing as on_computing
from roughline.paper import claims_on_contact as on_contact
from roughline.paper import claims_on_exponents as on_exponents
from roughline.paper.claim import STIFFNESS_TOLERANCE, Claim
from roughline.paper.stated import EXPONENT_TOLERANCE
from roughline.report.page import Section, Table

if TYPE_CHECKING:
    from roughline.paper.results import PaperResults


def judge_claims(results: PaperResults) -> list[Claim]:
    """Put each claim of the paper beside the same number here, with a verdict."""
    return [
        on_exponents.constant_exponent(results, "1D", "over low and medium forces (§6, §8)"),
        on_exponents.constant_exponent(results, "3D", "k = ζ F^α (eq. 5)"),
        on_exponents.lowest_forces(results, "1D"),
        on_exponents.lowest_forces(results, "3D"),
        on_exponents.ends_of_reduced(results),
        on_exponents.between_half_and_four_fifths(results, "1D"),
        on_exponents.between_half_and_four_fifths(results, "3D"),
        on_exponents.great_accuracy(results),
        on_exponents.linear_in_dimension(results),
        on_exponents.scaling_argument(results, "1D"),
        on_exponents.scaling_argument(results, "3D"),
        on_exponents.small_discrepancy(results, "1D"),
        on_exponents.small_discrepancy(results, "3D"),
        on_exponents.scaling_identity(),
        on_exponents.same_behaviour(results),
        on_contact.stiffness_agrees(results),
        on_contact.area_is_linear(results),
        on_contact.equal_moments(results),
        on_contact.punch_constant(results),
        on_contact.configuration_alone(results),
        on_contact.saturates_early(results),
        on_contact.saturates_with_all_springs(results),
        on_computing.no_difficulties(results),
        *on_computing.reduced_within_minutes(results),
        *on_computing.full_takes_weeks(results),
    ]


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
