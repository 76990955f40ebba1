"""The section of the page with the claims: a row each, and behind it what a larger study found."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from roughline.paper.stated import EXPONENT_TOLERANCE, STIFFNESS_TOLERANCE
from roughline.report.judged import JudgedClaim
from roughline.report.page import Section
from roughline.statistics.verdict import Claim, Verdict

HOW_JUDGED = (
    "Confirmed: the whole 95 % interval lies within what the claim allows. Refuted: "
    "the whole interval lies outside. Undecided: it lies partly within, and this sample "
    "does not decide. "
    f"The tolerance of an exponent is {EXPONENT_TOLERANCE:g}, that of a stiffness "
    f"or a height {STIFFNESS_TOLERANCE:.0%}; a claim about every D_f is refuted by one. "
    "The intervals are studentised, from resampled realisations; they do not include the "
    "effect of another window or another average, so both are stated with them. "
    "The paper does not state its windows. Not judged: definitions, what the paper "
    "reports of others' work, and what its Fig. 1 is meant to show."
)


def claims_section(claims: Sequence[Claim], by_more: Sequence[Claim]) -> Section:
    """Return the claims, those with numbers first; `by_more` are those of a larger study."""
    more = {each.statement: each for each in by_more}
    drawn = sorted(claims, key=lambda each: not each.numbers)
    text = (
        f"Of {len(claims)} claims {_counts(claims)}. A dot is the number at the D_f on the left, "
        "its bar the 95 % interval, and the shaded range is what the claim allows: green lies "
        "within, red outside, and amber is not decided. A row opens to its words."
    )
    if more:
        same = [more[each.statement] for each in claims if each.statement in more]
        text += (
            " In grey behind stands the full study, which comes with the package, in the same "
            f"windows: with it {_counts(same)}."
        )
    return Section(
        "The paper's claims",
        [text],
        claims=[JudgedClaim(each, more.get(each.statement)) for each in drawn],
        note=HOW_JUDGED,
    )


def _counts(claims: Sequence[Claim]) -> str:
    counts = Counter(each.verdict for each in claims)
    words = [
        f"{counts[each]} {'is' if counts[each] == 1 else 'are'} {each}"
        for each in Verdict
        if counts[each]
    ]
    return f"{', '.join(words[:-1])} and {words[-1]}" if words[1:] else words[0]
