"""The mean over all places of a part, from a few of them."""

import numpy as np
import pytest

from roughline.statistics.places import agreement, average_of_places

DRAWS = 20_000
TOLERANCE = 4 * np.sqrt(0.05 * 0.95 / DRAWS)  # four standard errors of a share of 95 %


def unknown(values):
    return np.full(values.shape, np.nan)


@pytest.mark.parametrize("count", [2, 3, 5, 10])
@pytest.mark.parametrize("scatter", [0.05, 0.7])
def test_the_interval_holds_the_mean_over_all_places_in_95_of_100(count, scatter):
    rng = np.random.default_rng(count)
    values = 3.0 * np.exp(scatter * rng.standard_normal((count, DRAWS)))
    found = average_of_places(values, unknown(values), unknown(values))
    held = (found.low <= 3.0) & (found.high >= 3.0)
    assert held.mean() == pytest.approx(0.95, abs=TOLERANCE)


@pytest.mark.parametrize("bias", [-0.2, 0.2])
def test_what_all_places_miss_alike_does_not_average_out(bias):
    """However many maps there are; their own ends hold it at either side."""
    rng = np.random.default_rng(1)
    values = np.exp(bias + 0.1 * rng.standard_normal((100, 1000)))
    found = average_of_places(values, values * np.exp(-0.25), values * np.exp(0.25))
    assert ((found.low < 1) & (found.high > 1)).all()
    alone = average_of_places(values, unknown(values), unknown(values))
    assert not ((alone.low < 1) & (alone.high > 1)).any()


def test_what_holds_of_a_quantity_holds_of_its_reciprocal():
    rng = np.random.default_rng(2)
    values = np.exp(rng.standard_normal((4, 3)))
    low, high = values / 1.2, values * 1.5
    found = average_of_places(values, low, high)
    inverse = average_of_places(1 / values, 1 / high, 1 / low)
    for name, other in (("mean", "mean"), ("low", "high"), ("high", "low")):
        assert getattr(inverse, name) == pytest.approx(1 / getattr(found, other), rel=1e-12)
    assert inverse.scatter == pytest.approx(found.scatter, rel=1e-12)


def test_a_single_place_has_no_scatter_and_equal_ones_no_interval():
    one = average_of_places(np.array([[2.0]]), np.array([[1.0]]), np.array([[3.0]]))
    assert (one.mean, one.count) == (2.0, 1)
    assert np.isnan([one.scatter, one.low, one.high]).all()
    values = np.full((3, 1), 10.0)
    given = average_of_places(values, unknown(values), unknown(values))
    assert (given.mean, given.scatter) == (pytest.approx(10.0), 1.0)
    assert np.isnan([given.low, given.high]).all()


def test_places_without_a_value_are_left_out_and_infinite_ones_have_no_mean():
    values = np.array([[1.0, np.nan, 1.0, np.nan], [4.0, 5.0, np.inf, np.nan]])
    found = average_of_places(values, unknown(values), unknown(values))
    assert found.mean[:2] == pytest.approx([2.0, 5.0])
    assert np.isnan(found.mean[2:]).all()
    assert found.count.tolist() == [2, 1, 1, 0]
    assert np.isnan(found.low[1:]).all()
    alike = np.array([[0.0, np.inf], [0.0, np.inf]])
    found = average_of_places(alike, unknown(alike), unknown(alike))
    assert found.mean.tolist() == [0.0, np.inf]
    assert np.isnan(found.low).all()


def test_an_interval_may_be_open_at_one_end_alone():
    """As that of a share which is all there is in each place; else values that agree have none."""
    values = np.ones((3, 2))
    low = np.stack([np.full(3, 0.8), np.ones(3)], axis=1)
    found = average_of_places(values, low, np.ones((3, 2)))
    assert found.low[0] == pytest.approx(0.8)
    assert found.high[0] == 1
    assert np.isnan([found.low[1], found.high[1]]).all()


@pytest.mark.parametrize("count", [2, 5])
def test_what_a_whole_may_differ_from_its_places_is_added(count):
    rng = np.random.default_rng(4)
    values = np.exp(0.1 * rng.standard_normal((count, 3)))
    without = average_of_places(values, values / 1.2, values * 1.2)
    found = average_of_places(values, values / 1.2, values * 1.2, (values * np.exp(-0.5), values))
    assert found.low == pytest.approx(without.low * np.exp(-0.5), rel=1e-12)
    assert found.high == pytest.approx(without.high, rel=1e-12)
    unknown_bounds = average_of_places(values, values / 1.2, values * 1.2, (unknown(values),) * 2)
    assert unknown_bounds.low == pytest.approx(without.low, rel=1e-12)


def test_no_values_at_all_and_infinite_ends_give_no_warning(recwarn):
    values = np.array([[np.nan, 1.0, np.inf, 0.0], [np.nan, 2.0, np.inf, 0.0]])
    nothing = np.zeros_like(values)
    found = average_of_places(values, nothing, nothing + np.inf, (nothing, values))
    assert (found.low[1], found.high[1]) == (0.0, np.inf)
    assert np.isnan(found.mean[0])
    assert not recwarn.list


@pytest.mark.parametrize("places", [2, 3, 10])
def test_places_that_are_alike_agree_in_99_of_100(places):
    rng = np.random.default_rng(places)
    agree = [agreement(rng.normal(size=(places, 4))).holds for _ in range(3000)]
    assert np.mean(agree) == pytest.approx(0.99, abs=4 * np.sqrt(0.01 * 0.99 / 3000))


def test_places_that_differ_do_not_agree_and_it_is_known_how_far_they_differ():
    rng = np.random.default_rng(5)
    of_places = 0.5 * rng.normal(size=(200, 1))
    found = agreement(of_places + 0.2 * rng.normal(size=(200, 4)))
    assert not found.holds
    assert found.between == pytest.approx(np.hypot(0.5, 0.1), rel=0.2)
    assert found.within == pytest.approx(0.1, rel=0.1)
    assert found.place_share == pytest.approx(0.25 / 0.26, abs=0.02)


@pytest.mark.parametrize("shape", [(1, 4), (3, 1), (3, 4)])
def test_without_differences_between_parts_nothing_is_said_of_places(shape):
    assert agreement(np.ones(shape)) is None
