"""Verdicts on intervals, and claims about several cases."""

import numpy as np
import pytest

from roughline.statistics.verdict import Claim, ClaimCase, Verdict, joint_verdict, places, verdict


@pytest.mark.parametrize(
    ("interval", "expected"),
    [
        ((0.1, 0.9), Verdict.CONFIRMED),
        ((0.0, 1.0), Verdict.CONFIRMED),
        ((1.1, 2.0), Verdict.REFUTED),
        ((-0.2, -0.1), Verdict.REFUTED),
        ((0.9, 1.1), Verdict.UNDECIDED),
        ((-1.0, 2.0), Verdict.UNDECIDED),
        ((np.nan, np.nan), Verdict.UNDECIDED),
    ],
)
def test_the_whole_interval_decides(interval, expected):
    assert verdict(*interval, 0, 1) is expected


def test_one_refuted_case_refutes_and_one_undecided_case_leaves_undecided():
    assert joint_verdict([Verdict.CONFIRMED, Verdict.CONFIRMED]) is Verdict.CONFIRMED
    assert joint_verdict([Verdict.CONFIRMED, Verdict.UNDECIDED]) is Verdict.UNDECIDED
    assert joint_verdict([Verdict.UNDECIDED, Verdict.REFUTED]) is Verdict.REFUTED


YES, NO, OPEN = Verdict.CONFIRMED, Verdict.REFUTED, Verdict.UNDECIDED


def claim(*verdicts):
    cases = [ClaimCase(f"at H = 0.{i}", each) for i, each in enumerate(verdicts)]
    return Claim.of("a statement", "a number", "an interval", cases)


@pytest.mark.parametrize(
    ("verdicts", "whole", "words"),
    [
        ((YES, YES), YES, "confirmed"),
        ((YES, NO, YES), NO, "refuted at H = 0.1; confirmed at H = 0.0, 0.2"),
        ((YES, OPEN), OPEN, "undecided at H = 0.1; confirmed at H = 0.0"),
        ((YES, None), YES, "confirmed; not judged at H = 0.1"),
        ((NO, None, YES), NO, "refuted at H = 0.0; confirmed at H = 0.2; not judged at H = 0.1"),
        # cases of the commonest verdict are not named if they are many
        ((NO,) * 7 + (YES,), NO, "refuted; confirmed at H = 0.7"),
        ((YES,) * 7 + (OPEN,), OPEN, "undecided at H = 0.7; confirmed elsewhere"),
    ],
)
def test_a_claim_says_its_verdict_first_and_case_by_case_where_they_differ(verdicts, whole, words):
    found = claim(*verdicts)
    assert (found.verdict, found.cases) == (whole, words)
    assert found.cases.startswith(found.verdict)


def test_neighbours_that_differ_in_the_last_word_share_the_others():
    assert places(["with 1 wave at H = 1", "with 1 wave at H = 2", "with 2 waves at H = 1"]) == (
        "with 1 wave at H = 1, 2, with 2 waves at H = 1"
    )


@pytest.mark.parametrize(
    ("enough", "told"),
    [
        (1234.0, "some 1,200 surfaces would decide"),
        (41.2, "some 41 surfaces would decide"),
        (3e6, "over 100,000 surfaces would decide"),
        (np.inf, "finer grids would decide"),
    ],
)
def test_what_would_decide_is_told_of_the_case_that_needs_most(enough, told):
    cases = [ClaimCase("at H = 1", OPEN, 10.0), ClaimCase("at H = 2", OPEN, enough)]
    assert Claim.of("", "", "", cases).cases == f"undecided ({told})"
    both = ClaimCase.together("at H = 1, 2", cases)
    assert (both.verdict, both.enough) == (OPEN, enough)
    assert np.isnan(ClaimCase.together("", [*cases, ClaimCase("at H = 3", NO)]).enough)
