"""The conditions of unilateral contact: p >= 0, gap >= 0 and p gap = 0."""

import dataclasses

import numpy as np
import pytest

from roughline.halfspace.active_set import solve
from roughline.halfspace.cascade import first_guess
from roughline.halfspace.conditions import UnilateralContact
from roughline.halfspace.half_space import HalfSpace
from roughline.halfspace.kernel import love
from roughline.halfspace.state import Load, Method, Problem
from roughline.halfspace.tangent import tangent

CONDITIONS = UnilateralContact()


def test_nodes_that_pull_and_nodes_that_overlap_are_wrong():
    pressure, watched = np.array([1.0, -0.5, 0.0]), np.array([2.5, 1.5, 2.0, -1.0])
    wrong = CONDITIONS.violations(pressure, watched, depth=2.0)
    assert wrong.pulling.tolist() == [False, True, False]
    assert wrong.overlapping.tolist() == [False, True, False, True]
    assert wrong.pull.tolist() == [-0.5]
    assert wrong.overlap.tolist() == [-0.5, -3.0]
    assert wrong.count == 3
    assert wrong.squared(diagonal=4.0) == pytest.approx(2.0**2 + 0.5**2 + 3.0**2)


def test_projected_pressures_are_the_nearest_that_do_not_pull():
    pressure = np.array([1.0, -0.5, 0.0])
    projected = CONDITIONS.projected(pressure)
    assert projected.tolist() == [1.0, 0.0, 0.0]
    assert not CONDITIONS.violations(projected, np.empty(0), depth=1.0).count
    assert CONDITIONS.largest_pull(projected) == 0.0
    assert CONDITIONS.largest_pull(pressure) == 0.5


def test_every_node_in_contact_is_elastic():
    pressure = np.array([1.0, 0.0, 7.0])
    assert pressure[CONDITIONS.elastic(pressure)].tolist() == pressure.tolist()


def test_residuals_tell_gap_on_contact_from_overlap_off_it():
    nodes, pressure = np.array([0, 3]), np.array([3.0, 1.0])
    gap = np.array([[1e-3, 0.5], [2.0, -2e-3]])
    residuals = CONDITIONS.residuals(gap, nodes, pressure, length_scale=0.1, load_error=1e-4)
    assert residuals.gap == pytest.approx(2e-2)
    assert residuals.penetration == 0
    assert residuals.tension == 0
    assert residuals.worst == residuals.gap
    gap[0, 1] = -0.5
    residuals = CONDITIONS.residuals(gap, nodes, pressure - 1.5, length_scale=0.1, load_error=9.0)
    assert residuals.penetration == pytest.approx(5.0)
    assert residuals.load == residuals.worst == 9.0


def test_a_pull_is_compared_with_the_mean_pressure():
    residuals = CONDITIONS.residuals(
        np.zeros((2, 2)), np.arange(4), np.array([5.0, 5.0, 3.0, -1.0]), 1.0, 0.0
    )
    assert residuals.tension == pytest.approx(1 / 3)


@dataclasses.dataclass(frozen=True)
class LimitedPressure(UnilateralContact):
    """Nodes at the limit bear no more: their pressures do not follow a change of the load."""

    limit: float

    def elastic(self, pressure):
        return pressure < self.limit


def test_the_stiffness_is_that_of_the_elastic_nodes():
    n, load, method = 12, Load(depth=1.0), Method(rtol=1e-6, max_iterations=100)
    x, y = np.indices((n, n)) - (n - 1) / 2
    half_space = HalfSpace(1.0)
    operator = half_space.operator((n, n), (1.0, 1.0))
    problem = Problem.of(half_space, operator, (x**2 + y**2) / 20, 1.0, CONDITIONS)
    contact = solve(problem, load, first_guess(problem, load), method)
    conditions = LimitedPressure(float(np.median(contact.pressure)))
    response = tangent(dataclasses.replace(problem, conditions=conditions), contact, None, method)
    elastic = contact.pressure < conditions.limit
    x, y = (axis.flat[contact.nodes[elastic]] for axis in (x, y))
    pressure = np.linalg.solve(love(x[:, None] - x, y[:, None] - y, 1.0, 1.0), np.ones(x.size))
    assert response.converged
    assert response.stiffness == pytest.approx(pressure.sum(), rel=1e-8)
    assert (response.pressure_per_force[~elastic] == 0).all()
    assert response.pressure_per_force.sum() == pytest.approx(1.0)
