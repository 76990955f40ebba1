"""Claims as rows: a dot is green within the shaded range, and red outside it."""

import numpy as np
import pytest

from roughline.report.judged import JudgedClaim
from roughline.statistics.bootstrap import IntervalEstimate
from roughline.statistics.verdict import Claim, Verdict


def judged(*numbers, within=(-0.05, 0.05), more=None):
    places = {f"at D_f = {2 + i / 5:.1f}": each for i, each in enumerate(numbers)}
    claim = Claim("said", "found", "-", "basis", Verdict.UNDECIDED, "", "", places, within)
    return JudgedClaim(claim, more and judged(*more, within=within).claim)


@pytest.mark.parametrize("seed", range(20))
def test_a_dot_lies_on_the_band_as_its_number_in_the_range(seed):
    rng = np.random.default_rng(seed)
    low, value, high = np.sort(rng.normal(0.9, 0.2, 3))
    least, most = np.sort(rng.normal(1, 0.1, 2))
    row = judged(IntervalEstimate(value, low, high), within=(least, most))
    ((name, dot, behind),) = row.dots
    begin, width = row.band
    assert (name, behind) == ("2.0", None)
    assert 0 < dot.low <= dot.at <= dot.high < 100
    lies_within = begin <= dot.low and dot.high <= begin + width
    lies_outside = dot.high < begin or dot.low > begin + width
    words = {Verdict.CONFIRMED: lies_within, Verdict.REFUTED: lies_outside}
    assert words.get(dot.verdict, not (lies_within or lies_outside))


def test_a_number_without_interval_is_a_dot_that_is_not_decided():
    ((_, dot, _),) = judged(IntervalEstimate(0.01, np.nan, np.nan)).dots
    assert dot.low == dot.at == dot.high
    assert dot.verdict is Verdict.UNDECIDED
    assert dot.words == "0.010"


def test_what_lies_far_off_is_an_arrow_at_the_edge():
    far = judged(*(IntervalEstimate(x, x, x) for x in (-9.0, 0.0, 9.0)))
    assert [dot.beyond for _, dot, _ in far.dots] == ["◂", "", "▸"]


def test_the_larger_study_stands_behind_the_same_fractal_dimension():
    one, other = IntervalEstimate(0.0, -0.1, 0.1), IntervalEstimate(0.02, 0.01, 0.03)
    row = judged(one, one, more=[other])
    behind = [each for _, _, each in row.dots]
    assert behind[0].words == "0.020 (0.010 to 0.030)"
    assert behind[1] is None
    assert row.otherwise == ""
