"""Student's t of the mean of a few values."""

import numpy as np
import pytest

from roughline.statistics.student import student


@pytest.mark.parametrize(
    ("count", "expected"), [(2, 12.706), (4, 3.182), (16, 2.131), (10**6, 1.960)]
)
def test_it_is_that_of_tables(count, expected):
    assert student(count - 1) == pytest.approx(expected, abs=5e-4)


def test_the_interval_of_four_values_holds_their_mean_in_95_of_100_cases():
    values = np.random.default_rng(1).normal(size=(20000, 4))
    widths = student(3) * values.std(axis=1, ddof=1) / 2
    assert np.mean(np.abs(values.mean(axis=1)) <= widths) == pytest.approx(0.95, abs=0.005)
