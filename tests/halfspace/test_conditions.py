"""The contact conditions of elastic bodies, and of bodies that yield at a hardness."""

import numpy as np
import pytest

from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.elasticity.kernel import love
from roughline.halfspace.inverse.approximate_inverse import ApproximateInverse
from roughline.halfspace.laws.conditions import (
    UnilateralContact,
    YieldingContact,
    out_of_bounds,
    residuals,
    violations,
)
from roughline.halfspace.operators.discretisation import on_grid
from roughline.halfspace.search.cascade import first_guess
from roughline.halfspace.search.correction import solve
from roughline.halfspace.search.state import Load, Method, Problem
from roughline.halfspace.search.tangent import response

ELASTIC = UnilateralContact()
YIELDING = YieldingContact(hardness=4.0)


def test_nodes_that_pull_and_nodes_that_overlap_are_wrong():
    pressure, watched = np.array([1.0, -0.5, 0.0]), np.array([2.5, 1.5, 2.0, -1.0])
    every, none = np.ones(3, dtype=bool), np.empty(0)
    wrong = violations(ELASTIC, every, pressure, watched, none, depth=2.0, slack=0.0)
    assert wrong.pulling.tolist() == [False, True, False]
    assert wrong.overlapping.tolist() == [False, True, False, True]
    assert wrong.pull.tolist() == [-0.5]
    assert wrong.overlap.tolist() == [-0.5, -3.0]
    assert wrong.count == 3
    assert wrong.squared(diagonal=4.0) == pytest.approx(2.0**2 + 0.5**2 + 3.0**2)


def test_nodes_above_the_hardness_and_nodes_at_it_that_come_apart_are_wrong():
    elastic = np.array([True, False, True, False, False])
    held = np.array([2.5, 2.05, 1.0])
    pressure = np.array([4.5, 3.0])
    wrong = violations(YIELDING, elastic, pressure, np.empty(0), held, depth=2.0, slack=0.1)
    assert wrong.yielding.tolist() == [True, False, False, False, False]
    assert wrong.lifting.tolist() == [False, True, False, False, False]
    assert wrong.excess.tolist() == [0.5]
    assert wrong.lift.tolist() == [0.5]
    assert wrong.count == 2
    assert wrong.squared(diagonal=4.0) == pytest.approx(2.0**2 + 0.5**2)


def test_projected_pressures_are_the_nearest_that_are_allowed():
    pressure = np.array([1.0, -0.5, 0.0, 5.0])
    assert ELASTIC.projected(pressure).tolist() == [1.0, 0.0, 0.0, 5.0]
    assert YIELDING.projected(pressure).tolist() == [1.0, 0.0, 0.0, 4.0]
    assert out_of_bounds(ELASTIC, pressure) == (0.5, 0.0)
    assert out_of_bounds(YIELDING, pressure) == (0.5, 1.0)
    assert out_of_bounds(YIELDING, YIELDING.projected(pressure)) == (0.0, 0.0)


def test_nodes_below_the_hardness_are_elastic():
    pressure = np.array([1.0, 0.0, 4.0])
    assert ELASTIC.elastic(pressure).tolist() == [True, True, True]
    assert YIELDING.elastic(pressure).tolist() == [True, True, False]


def test_pressures_are_scaled_to_a_total_up_to_the_hardness():
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


def test_residuals_tell_gap_on_contact_from_overlap_off_it():
    nodes, pressure = np.array([0, 3]), np.array([3.0, 1.0])
    gap = np.array([[1e-3, 0.5], [2.0, -2e-3]])
    found = residuals(ELASTIC, gap, nodes, pressure, length_scale=0.1, load_error=1e-4)
    assert found.gap == pytest.approx(2e-2)
    assert found.penetration == 0
    assert found.tension == found.excess == 0
    assert found.worst == found.gap
    assert found.worst_is_of == "the gap within the contact"
    gap[0, 1] = -0.5
    found = residuals(ELASTIC, gap, nodes, pressure - 1.5, length_scale=0.1, load_error=9.0)
    assert found.penetration == pytest.approx(5.0)
    assert found.load == found.worst == found.violation == 9.0
    assert found.worst_is_of == "the force"


def test_rounding_is_a_residual_and_is_named():
    gap, pressure = np.zeros((1, 2)), np.ones(2)
    found = residuals(ELASTIC, gap, np.arange(2), pressure, 1e-9, 0.0, approach=100.0)
    assert found.violation == 0
    assert found.worst == found.rounding == np.spacing(100.0) / 1e-9
    assert found.worst_is_of == "the rounding of the depth"


def test_a_pull_and_an_excess_are_compared_with_the_mean_pressure():
    found = residuals(
        YIELDING, np.zeros((2, 2)), np.arange(4), np.array([5.0, 5.0, 3.0, -1.0]), 1.0, 0.0
    )
    assert found.tension == pytest.approx(1 / 3)
    assert found.excess == pytest.approx(1 / 3)


def test_the_stiffness_on_loading_is_that_of_the_elastic_nodes_and_on_unloading_of_all():
    n, method = 12, Method(rtol=1e-6, max_iterations=100)
    x, y = np.indices((n, n)) - (n - 1) / 2
    half_space = Homogeneous(1.0)
    inverse = ApproximateInverse.of(on_grid(half_space, (n, n), (1.0, 1.0)))
    problem = Problem(
        half_space, inverse, (x**2 + y**2) / 20, 1.0, 0.0, YieldingContact(hardness=0.1)
    )
    load = Load(depth=1.0)
    contact = solve(problem, load, first_guess(problem, load)[0], method)
    assert 0 < contact.plastic.sum() < contact.nodes.size
    answer = response(problem, contact, None, method)
    assert answer.converged
    for tangent, follow in (
        (answer.loading, ~contact.plastic),
        (answer.unloading, np.ones_like(contact.plastic)),
    ):
        i, j = (axis.flat[contact.nodes[follow]] for axis in (x, y))
        pressure = np.linalg.solve(love(i[:, None] - i, j[:, None] - j, 1.0, 1.0), np.ones(i.size))
        assert tangent.stiffness == pytest.approx(pressure.sum(), rel=1e-8)
        assert (tangent.pressure_per_force[~follow] == 0).all()
        assert tangent.pressure_per_force.sum() == pytest.approx(1.0)
