"""Scores of what is measured, if it were by chance."""

import math

import pytest
from scipy import stats

from roughline.measurement.chance import score_of_square


@pytest.mark.parametrize(("freedom", "ratio"), [(3, 0.2), (20, 1.0), (20, 3.0), (400, 0.7)])
def test_a_score_is_as_rare_as_the_square_that_it_is_of(freedom, ratio):
    expected = stats.norm.isf(stats.chi2.sf(freedom * ratio, freedom))
    assert score_of_square(freedom, ratio) == pytest.approx(expected, rel=1e-9)


def test_a_square_beyond_all_chance_has_an_infinite_score():
    assert score_of_square(1e4, 1e3) == math.inf
    assert score_of_square(1e5, 1e-3) == -math.inf
