"""The residuals that a curve tells are those that `press` defines, and so is the contact."""

import numpy as np
import pytest

import roughline as rl
from halfspace.dense_contact import Body
from roughline.contact import loads
from roughline.halfspace.elasticity.kernel import love

pytestmark = pytest.mark.usefixtures("either_search")

RTOL = 1e-6
ROUGH = np.random.default_rng(5).normal(size=(16, 12))
GROOVES = np.where(np.arange(16) % 2, -1.0, 0.0)[:, None] * np.ones((16, 12))
PITS = np.where(np.random.default_rng(6).random((16, 12)) < 0.1, -1.0, 0.0)
ONE_PIT = np.where(np.arange(192).reshape(16, 12) == 70, -1.0, 0.0)
FLAT = np.zeros((16, 12))
BODIES = {"rough": ROUGH, "grooves": GROOVES, "pits": PITS, "one pit": ONE_PIT, "flat": FLAT}
SIDES = [(1.0, 0.75), (1.0, 300.0), (1e4, 1.0)]


def residual_as_defined(curve, load, kernel, heights):
    """Return the largest residual of a load by the docstring of `press`, and its length scale."""
    fields, cell = curve.fields[load], curve.length**2 / heights.size
    pressure = fields.pressure.ravel()
    displacement = kernel @ pressure
    separation = (heights.max() - heights + fields.indentation).ravel()
    gap = displacement + separation - curve.depth[load]
    contact = pressure > 0
    least = 2 * np.finfo(float).eps / RTOL * curve.force[load] / (curve.E_star * curve.length)
    rms = curve.rms_height or np.inf
    scale = min(rms, max(displacement[contact].max(), least))
    pull, hardness = max(0.0, -pressure.min()), curve.hardness or np.inf
    excess = max(0.0, pressure.max() - hardness)
    force = abs(cell * pressure.sum() - curve.force[load]) / curve.force[load]
    if curve.settings["control"] == "depths":
        force = 0.0
    violations = [np.abs(gap[contact]).max() / scale, max(0.0, -gap.min()) / scale]
    violations += [max(pull, excess) / pressure[contact].mean(), force]
    return max(violations), scale


def assert_residuals_as_defined(curve, heights, sizes, *, periodic):
    kernel = Body(heights, sizes, curve.E_star, periodic).matrix()
    assert curve.converged.all()
    for load, fields in enumerate(curve.fields):
        again, scale = residual_as_defined(curve, load, kernel, heights)
        depth = curve.depth[load]
        rounding = np.abs(kernel).sum(axis=1).max() * fields.pressure.max()
        rounding = 4 * np.finfo(float).eps * max(rounding, depth, np.ptp(heights))
        assert curve.residual[load] <= RTOL
        assert again == pytest.approx(curve.residual[load], rel=1e-3, abs=rounding / scale)
        assert (fields.contact == (fields.pressure > 0)).all()
        assert curve.area_fraction[load] == fields.contact.mean()


# heights are in a unit of their own
@pytest.mark.filterwarnings("ignore::roughline.UnitWarning")
@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("sizes", SIDES)
@pytest.mark.parametrize("body", BODIES)
def test_residuals_are_relative_to_what_is_documented(body, sizes, periodic):
    heights = BODIES[body]
    surface = rl.Surface(heights, sizes)
    forces = np.array([1e-6, 1e-2, 1.0, 30.0]) * surface.length
    curve = rl.press(surface, E_star=1.0, forces=forces, periodic=periodic, fields=True, rtol=RTOL)
    assert_residuals_as_defined(curve, heights, sizes, periodic=periodic)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("hardness", [1e-3, 0.3, 10.0])
def test_residuals_of_bodies_that_yield_are_those_documented(hardness, periodic):
    sizes = (1.0, 0.75)
    forces = hardness * 0.75 * np.array([1e-3, 0.3, 0.1, 0.7])
    curve = rl.press(
        rl.Surface(ROUGH, sizes),
        E_star=1.0,
        forces=forces,
        hardness=hardness,
        periodic=periodic,
        fields=True,
    )
    assert_residuals_as_defined(curve, ROUGH, sizes, periodic=periodic)


@pytest.mark.parametrize("body", ["grooves", "pits", "one pit"])
def test_depths_are_as_exact_as_the_tolerance_where_hardly_anything_moves(body):
    heights, sizes = BODIES[body], (1.0, 300.0)
    curve = rl.press(
        rl.Surface(heights, sizes), E_star=1.0, forces=[0.01], periodic=True, fields=True
    )
    contact = np.flatnonzero(curve.fields[0].contact)
    kernel = Body(heights, sizes, 1.0, periodic=True).matrix()[np.ix_(contact, contact)]
    # pressures and the approach that close the gap, under the force
    size = contact.size
    equations = np.block([[kernel, -np.ones((size, 1))], [np.ones((1, size)), np.zeros((1, 1))]])
    cell = sizes[0] * sizes[1] / heights.size
    given = np.append(heights.flat[contact] - heights.max(), 0.01 / cell)
    exact = np.linalg.solve(equations, given)
    assert curve.depth[0] == pytest.approx(exact[-1], rel=2e-6)


@pytest.mark.parametrize("off", [-1e-5, -1e-9, 0.0, 1e-12, 1e-9, 1e-5])
@pytest.mark.parametrize("control", ["depths", "forces"])
def test_a_node_that_touches_and_bears_nothing_is_not_in_contact(control, off):
    """The second of two nodes just touches: it counts in the area and in k, or in neither."""
    alone, beside = love([0], [0, 1], 1.0, 1.0)[0]
    depth = (1 + off) / (1 - beside / alone)
    load = {"depths": [depth], "forces": [depth / alone]}[control]
    surface = rl.Surface(np.array([[0.0, -1.0]]), (1.0, 2.0))
    curve = rl.press(surface, E_star=1.0, fields=True, **{control: load})
    (fields,) = curve.fields
    nodes = int(fields.contact.sum())
    assert nodes == np.count_nonzero(fields.pressure > 0) == 2 * curve.area_fraction[0]
    assert curve.stiffness[0] == pytest.approx({1: 1 / alone, 2: 2 / (alone + beside)}[nodes])
    if abs(off) > 1e-6:
        assert nodes == (1 if off < 0 else 2)


def test_a_load_that_stalls_names_the_residual_that_is_above_the_tolerance(monkeypatch):
    monkeypatch.setattr(loads, "_GAP_ROUNDING", 0.0)  # let it through to the solver
    surface = rl.Surface(ROUGH, (1.0, 0.75))
    deep = {"E_star": 1.0, "depths": [1e12], "rtol": 1e-9}
    with pytest.raises(rl.ConvergenceError, match="stalled") as stalled:
        rl.press(surface, **deep)
    curve = stalled.value.curve
    assert curve.residual[0] > 1e-9
    named = f"worst residual {curve.residual[0]:.1e}, that of {curve.residual_of[0]}: raise rtol,"
    assert named in str(stalled.value)
    soft = {"E_star": 1.0, "hardness": 1e-14, "forces": [1e-15]}
    curve = rl.press(surface, throw=False, **soft)
    assert curve.status[0] == rl.Status.STALLED
    assert curve.residual[0] > 1e-6
    with pytest.raises(rl.ConvergenceError, match="the rounding of the depth: raise rtol"):
        rl.press(surface, **soft)


def test_loads_below_one_that_failed_have_no_residual():
    surface = rl.Surface(ROUGH, (1.0, 0.75))
    curve = rl.press(
        surface,
        E_star=1.0,
        hardness=0.3,
        forces=[0.1, 0.05],
        solver=rl.Solver(max_iterations=3),
        throw=False,
    )
    assert curve.status.tolist() == [rl.Status.MAX_ITERATIONS, rl.Status.UNKNOWN_SURFACE]
    assert curve.residual[0] > 1e-6
    assert np.isnan(curve.residual[1])
    with pytest.raises(rl.ConvergenceError) as failed:
        rl.press(
            surface,
            E_star=1.0,
            hardness=0.3,
            forces=[0.1, 0.05],
            solver=rl.Solver(max_iterations=3),
        )
    assert str(failed.value).count("worst residual") == 1
