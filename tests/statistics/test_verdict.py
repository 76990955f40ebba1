"""Verdicts on intervals."""

import numpy as np
import pytest

from roughline.statistics.verdict import Verdict, joint_verdict, verdict


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
