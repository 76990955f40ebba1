"""Bounds of pressures, the nodes on their wrong side, and the residuals of a contact."""

import numpy as np
import pytest

from halfspace.dense_contact import love_matrix
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.unilateral import Unilateral
from roughline.halfspace.laws.yielding import Yielding
from roughline.halfspace.search.active_set import Partition
from roughline.halfspace.search.carriers import Carriers
from roughline.halfspace.search.cascade import first_guess
from roughline.halfspace.search.problem import Grid, Load, Method, Problem
from roughline.halfspace.search.region import Region, Trial
from roughline.halfspace.search.tangent import response
from roughline.halfspace.search.turns import Turns
from roughline.halfspace.search.window import GridWindow

ELASTIC = Bounds.of(Unilateral(), None)
YIELDING = Bounds.of(Yielding(hardness=4.0), None)
PULLING = Bounds(np.array([-2.0, -2.0, 0.0, -2.0]), np.inf)


def problem(separation, law, rms_height):
    grid = Grid(Homogeneous(1.0), separation.shape, (1.0, 1.0))
    return Problem(grid, separation, rms_height, 0.0, law)


def test_pressures_are_led_to_the_nearest_within_their_bounds():
    pressure = np.array([1.0, -0.5, 0.0, 5.0])
    assert ELASTIC.nearest(pressure).tolist() == [1.0, 0.0, 0.0, 5.0]
    assert YIELDING.nearest(pressure).tolist() == [1.0, 0.0, 0.0, 4.0]
    assert PULLING.nearest(pressure - 2).tolist() == [-1.0, -2.0, 0.0, 3.0]
    assert ELASTIC.violations(pressure) == (0.5, 0.0)
    assert YIELDING.violations(pressure) == (0.5, 1.0)
    assert YIELDING.violations(YIELDING.nearest(pressure)) == (0.0, 0.0)
    assert PULLING.violations(pressure - 2) == (2.0, 0.0)


def test_nodes_between_their_bounds_touch():
    pressure = np.array([1.0, 0.0, 4.0])
    assert ELASTIC.touching(pressure).tolist() == [True, True, True]
    assert YIELDING.touching(pressure).tolist() == [True, True, False]
    assert YIELDING.yielding(pressure).tolist() == [False, False, True]
    pulled = np.array([-2.0, 0.0, 0.0, 1.0])
    assert PULLING.pulling(pulled).tolist() == [True, False, False, False]
    assert PULLING.touching(pulled).tolist() == [False, True, True, True]
    assert PULLING.pulled.tolist() == [0, 1, 3]
    assert ELASTIC.pulled.size == 0


def test_pressures_are_scaled_to_a_total_up_to_their_bounds():
    pressure = np.array([1.0, 2.0, 3.0])
    assert ELASTIC.with_total(pressure, 12.0).tolist() == [2.0, 4.0, 6.0]
    # by the same part of what is left to the hardness: 3, 2 and 1
    assert YIELDING.with_total(pressure, 9.0).tolist() == [2.5, 3.0, 3.5]
    assert YIELDING.with_total(pressure, 12.0).tolist() == [4.0, 4.0, 4.0]
    assert YIELDING.with_total(pressure, 3.0).tolist() == [0.5, 1.0, 1.5]
    assert YIELDING.with_total(np.array([0.0, 0.0, 4.0]), 6.0).tolist() == [1.0, 1.0, 4.0]
    assert YIELDING.with_total(np.array([1.0, 2.0, 4.0]), 5.5).tolist() == [0.5, 1.0, 4.0]
    # the nodes at the hardness carry more than there is: all are scaled down
    assert YIELDING.with_total(np.array([1.0, 4.0]), 2.5).tolist() == [0.5, 2.0]
    # pulls stay, and the others bear them as well
    pulled = PULLING.with_total(np.array([-2.0, 1.0, 1.0, 2.0]), 6.0)
    assert pulled.tolist() == [-2.0, 2.0, 2.0, 4.0]


def sides(touching, bounds, watched, at_bounds, at_upper):
    """Sides of some nodes: watched ones come first, then those at a bound."""
    gap = np.concatenate([watched, at_bounds])
    return Partition(
        touching,
        bounds,
        np.arange(gap.size),
        np.arange(gap.size) < len(watched),
        np.concatenate([np.zeros(len(watched), dtype=bool), at_upper]),
        gap,
    )


def test_nodes_that_pull_and_nodes_that_overlap_are_wrong():
    every, none = np.ones(3, dtype=bool), np.zeros(0, dtype=bool)
    watched, pressure = np.array([0.5, -0.5, 0.0, -3.0]), np.array([1.0, -0.5, 0.0])
    beside = sides(every, ELASTIC, watched, np.empty(0), none)
    wrong = beside.wrong(pressure, beside.gap, slack=0.0)
    assert wrong.below.tolist() == [False, True, False]
    assert wrong.overlapping.tolist() == [False, True, False, True]
    assert wrong.count == 3
    assert beside.squared(pressure, beside.gap, 4.0) == pytest.approx(2.0**2 + 0.5**2 + 3.0**2)


def test_nodes_above_the_hardness_and_nodes_at_it_that_come_apart_are_wrong():
    touching = np.array([True, False, True, False, False])
    held, pressure = np.array([0.5, 0.05, -1.0]), np.array([4.5, 3.0])
    beside = sides(touching, YIELDING, np.empty(0), held, np.ones(3, dtype=bool))
    wrong = beside.wrong(pressure, beside.gap, slack=0.1)
    assert wrong.above.tolist() == [True, False, False, False, False]
    assert wrong.leaving.tolist() == [False, True, False, False, False]
    assert wrong.off.tolist() == [0.5]
    assert wrong.count == 2
    assert beside.squared(pressure, beside.gap, 4.0) == pytest.approx(2.0**2 + 0.5**2 + 0.05**2)


def test_nodes_at_a_lower_bound_that_overlap_are_wrong():
    touching = np.array([True, False, False])
    held, pressure = np.array([0.5, -0.5]), np.array([-2.5])
    bounds = Bounds(np.full(1, -2.0), np.inf)
    beside = sides(touching, bounds, np.empty(0), held, np.zeros(2, dtype=bool))
    wrong = beside.wrong(pressure, beside.gap, slack=0.1)
    assert wrong.below.tolist() == [True, False, False]
    assert wrong.leaving.tolist() == [False, False, True]
    assert wrong.off.tolist() == [-0.5]


def trial(gap, places, pressure, law=None, *, load=None, approach=0.0, rms_height=1.0):
    """A trial with these gaps and pressures."""
    region = Region.everywhere(problem(np.zeros(gap.shape), law or Unilateral(), rms_height))
    load = Load(depth=approach) if load is None else load
    return Trial.of(region, load, Carriers(places, pressure), approach, gap.ravel().copy())


def test_residuals_tell_gap_on_contact_from_overlap_off_it():
    places, pressure = np.array([0, 3]), np.array([3.0, 1.0])
    gap = np.array([[1e-3, 0.5], [2.0, -2e-3]])
    found = trial(gap, places, pressure, rms_height=0.1, approach=1.0).residuals
    assert found.gap == pytest.approx(2e-2)
    assert found.penetration == 0
    assert found.tension == found.excess == 0
    assert found.worst == found.gap
    assert found.worst_name == "the gap within the contact"
    gap[0, 1] = -0.5
    load = Load(force=0.2)
    found = trial(gap, places, pressure - 1.5, load=load, rms_height=0.1, approach=1.0).residuals
    assert found.penetration == pytest.approx(5.0)
    assert found.tension == pytest.approx(0.5)  # over the mean magnitude
    assert found.load == pytest.approx(0.8 / 2.0)  # over the sum of magnitudes


def test_rounding_is_a_residual_and_is_named():
    found = trial(
        np.zeros((1, 2)), np.arange(2), np.ones(2), approach=100.0, rms_height=1e-9
    ).residuals
    assert found.violation == 0
    assert found.worst == found.rounding == np.spacing(100.0) / 1e-9
    assert found.worst_name == "the rounding of the depth"


def test_a_residual_that_is_no_number_is_the_largest():
    found = trial(np.array([[np.nan, 0.0]]), np.arange(2), np.ones(2), approach=1.0)
    assert np.isnan(found.residuals.worst)
    assert not found.certified(1.0)


def test_a_pull_and_an_excess_are_compared_with_the_mean_pressure():
    pressure = np.array([5.0, 5.0, 3.0, -1.0])
    found = trial(np.zeros((2, 2)), np.arange(4), pressure, Yielding(hardness=4.0), approach=1.0)
    assert found.residuals.tension == pytest.approx(1 / 3.5)
    assert found.residuals.excess == pytest.approx(1 / 3.5)


def test_the_stiffness_on_loading_is_that_of_the_elastic_nodes_and_on_unloading_of_all():
    n, method = 12, Method(rtol=1e-6, max_iterations=100)
    x, y = np.indices((n, n)) - (n - 1) / 2
    bodies, load = problem((x**2 + y**2) / 20, Yielding(hardness=0.1), 1.0), Load(depth=1.0)
    contact = Turns(bodies, load, first_guess(bodies, load)[0], method).contact()
    assert 0 < contact.plastic.sum() < contact.nodes.size
    answer = response(contact, GridWindow.everywhere(bodies), None, method)
    assert answer.converged
    for tangent, follow in (
        (answer.loading, ~contact.plastic),
        (answer.unloading, np.ones_like(contact.plastic)),
    ):
        nodes = contact.nodes[follow]
        kernel = love_matrix((n, n), (1.0, 1.0))[np.ix_(nodes, nodes)]
        pressure = np.linalg.solve(kernel, np.ones(nodes.size))
        assert tangent.stiffness == pytest.approx(pressure.sum(), rel=1e-8)
        assert (tangent.pressure_per_force[~follow] == 0).all()
        assert tangent.pressure_per_force.sum() == pytest.approx(1.0)
