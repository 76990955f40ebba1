"""Histories of load of bodies that yield, against an independent solution on dense matrices."""

import numpy as np
import pytest
from scipy.linalg import cholesky, solve_triangular
from scipy.optimize import lsq_linear
from threadpoolctl import threadpool_limits

import roughline as rl
from halfspace.dense_contact import Body
from halfspace.dense_hardness import History
from halfspace.small_bodies import needle, rough

pytestmark = pytest.mark.usefixtures("either_search")

E_STAR = 2.0
LOADS = np.array([0.2, 0.5, 0.3, 1.0, 0.4, 0.0, 1.0, 1.3, 0.7])  # over the force drawn for a body

EXACT = 1e-10  # of the oracle's own conditions
FORCE = 1e-6  # the certified tolerance
STIFFNESS = 1e-6


@pytest.fixture(autouse=True)
def small_matrices_need_one_thread():
    with threadpool_limits(limits=1, user_api="blas"):
        yield


BODIES = {
    "H = 0": ((16, 16), (1.0, 1.0), lambda shape: rough(shape, 0.0)),
    "H = 0.5": ((16, 16), (1.0, 1.6), lambda shape: rough(shape, 0.5)),
    "H = 1": ((12, 18), (1.0, 1.0), lambda shape: rough(shape, 1.0)),
    "white noise": (
        (18, 12),
        (1.0, 1.3),
        lambda shape: 0.1 * np.random.default_rng(2).normal(size=shape),
    ),
    "plateaus": ((16, 16), (1.0, 1.0), lambda shape: np.round(10 * rough(shape, 0.8)) / 10),
    "needle": ((12, 18), (1.0, 1.6), needle),
    "punch": ((10, 14), (1.0, 1.6), np.zeros),
}
# hardness and largest mean pressure, over E* times the rms slope
STATES = {
    "hard": (0.4, 0.12),
    "softer": (0.2, 0.1),
    "soft": (0.04, 0.0237),
    "butter": (0.01, 0.0061),
}


def posed(name, state, periodic):
    """Return body, hardness and forces."""
    shape, sizes, heights = BODIES[name]
    body = Body(heights(shape), sizes, E_STAR, periodic)
    slope = rl.Surface(body.heights, sizes).rms_slope or 0.1
    hardness, mean_pressure = (each * E_STAR * slope for each in STATES[state])
    return body, hardness, LOADS * mean_pressure * sizes[0] * sizes[1] / LOADS.max()


def assert_solved(history, state, force, before):
    """Check the oracle's conditions with sums of its own."""
    p, H = state.pressure, history.hardness
    gap = history.K @ p + history.separation + before - state.depth
    scale = max(history.separation.max(), np.abs(history.K @ p).max())
    assert history.body.cell * p.sum() == pytest.approx(force, rel=EXACT)
    assert p.min() >= 0
    assert p.max() <= H
    assert (gap[p == 0] >= -EXACT * scale).all()
    assert (np.abs(gap[(p > 0) & (p < H)]) <= EXACT * scale).all()
    assert (gap[p == H] <= EXACT * scale).all()
    assert state.indentation - before == pytest.approx(
        np.where(p == H, np.maximum(-gap, 0), 0), abs=EXACT * scale
    )


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("name", BODIES)
def test_histories_of_nine_loads_are_the_oracles(name, state, periodic):
    if name == "punch" and periodic:
        pytest.skip("even pressure displaces nothing there")
    body, hardness, forces = posed(name, state, periodic)
    history, states, dissipated = History(body, hardness), [], [0.0]
    for force in forces:
        before = history.indentation
        states.append(history.press(force))
        assert_solved(history, states[-1], force, before)
        # what p = H has done on the way of each dent
        dents = states[-1].indentation - before
        dissipated.append(dissipated[-1] + body.cell * float(states[-1].pressure @ dents))
    surface = rl.Surface(body.heights, body.sizes)
    settings = {"E_star": E_STAR, "hardness": hardness, "periodic": periodic, "fields": True}
    assert any(each.plastic.any() for each in states) or state == "hard"
    by_force = rl.press(surface, forces=forces, **settings)
    depths = np.array([each.depth for each in states])
    assert by_force.depth == pytest.approx(depths, rel=FORCE)
    depths[6], depths[5] = depths[3], 0.0  # the same load again, and apart
    assert by_force.force == pytest.approx(forces, rel=FORCE)
    by_depth = rl.press(surface, depths=depths, **settings)
    assert by_depth.force == pytest.approx(forces, rel=FORCE, abs=FORCE * forces.max())
    for curve in (by_force, by_depth):
        for i, expected in enumerate(states):
            assert_same_contact(curve, i, expected, body)
        # each dent may err by what a gap may
        dented = max(np.count_nonzero(each.indentation) for each in states) * body.cell
        error = hardness * dented * FORCE * (curve.rms_height or curve.depth.max())
        assert curve.dissipated_work == pytest.approx(dissipated[1:], rel=10 * FORCE, abs=error)


def assert_same_contact(curve, i, expected, body):
    """Compare one load of a curve with the oracle."""
    fields = curve.fields[i]
    assert (fields.contact.ravel() == expected.contact).all()
    assert (fields.plastic.ravel() == expected.plastic).all()
    for name in ("stiffness", "unloading_stiffness"):
        assert getattr(curve, name)[i] == pytest.approx(getattr(expected, name), rel=STIFFNESS)
    deepest = expected.indentation.max()
    error = FORCE * (curve.rms_height or curve.depth.max())
    assert np.abs(fields.indentation.ravel() - expected.indentation).max() <= error
    assert curve.indentation[i] == pytest.approx(deepest, abs=error)
    count = np.count_nonzero(expected.contact)
    assert curve.area_fraction[i] == count / expected.contact.size
    if count:
        assert curve.plastic_fraction[i] == np.count_nonzero(expected.plastic) / count
    assert curve.work[i] == pytest.approx(expected.work, rel=10 * FORCE)


def test_the_oracle_is_scipys_least_squares_between_bounds():
    """With K = R^T R one load is min |R p - R^-T aim|, 0 <= p <= H."""
    body, hardness, forces = posed("H = 0.5", "softer", periodic=False)
    history = History(body, hardness)
    state = history.press(forces.max())
    R = cholesky(history.K)
    aim = solve_triangular(R, state.depth - history.separation, trans="T")
    found = lsq_linear(R, aim, (0.0, hardness), method="bvls", tol=1e-15, max_iter=10**4)
    assert 0 < np.count_nonzero(state.plastic) < np.count_nonzero(state.contact)
    assert found.x == pytest.approx(state.pressure, abs=EXACT * hardness)
