"""Bodies that are flat in contact: hardly anything moves there, and all the more is certified."""

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

import roughline as rl
from halfspace.dense_contact import Body
from halfspace.dense_hardness import History

pytestmark = pytest.mark.usefixtures("either_search")

RTOL = {"mixed": 1e-6, "float64": 1e-6, "float32": 1e-4}
SIZES = (1.0, 1.3)
PRESSURE = 5e-5  # over the mean one: a pressure answers a gap with the grid's stiffness
FORCE = 1e-6
STIFFNESS = 1e-6


@pytest.mark.parametrize("precision", RTOL)
@pytest.mark.parametrize("hardness", [None, 1.0, 1e3])
@pytest.mark.parametrize("shape", [(8, 8), (17, 23), (1, 40), (101, 97), (1, 600)])
def test_a_periodic_punch_bears_evenly_under_any_load(shape, hardness, precision):
    punch = rl.Surface(np.zeros(shape), SIZES)
    forces = 0.9 * punch.area * np.array([1.0, 1e-3, 1e-6, 1e-9, 1.0])
    curve = rl.press(
        punch,
        E_star=1.0,
        hardness=hardness,
        forces=forces,
        periodic=True,
        solver=rl.Solver(precision=precision),
        rtol=RTOL[precision],
        fields=True,
    )
    for force, fields in zip(forces, curve.fields, strict=True):
        mean = force / punch.area
        assert np.abs(fields.pressure - mean).max() <= RTOL[precision] * mean
    assert (curve.area_fraction == 1).all()
    assert (curve.stiffness == np.inf).all()


def nearly_flat(rng):
    """Draw heights that are flat, or flat but for little, and a hardness over E*."""
    shape = tuple(int(n) for n in rng.integers(3, 15, 2))
    little = 10.0 ** rng.uniform(-9, -1)
    heights = np.zeros(shape)
    kind = rng.integers(4)
    if kind == 1:
        heights = little * rng.normal(size=shape)
    elif kind == 2:
        heights = np.where(rng.random(shape) < 0.5, little, 0.0)
    elif kind == 3:
        heights[0, 0] = little
    return heights, 10.0 ** rng.uniform(-6, 1)


@pytest.mark.parametrize("yields", [False, True])
@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("seed", range(15))
def test_nearly_flat_bodies_under_nearly_no_load(seed, periodic, yields):
    """After each load a dense solution starts from the surface that is left, as from a new one."""
    rng = np.random.default_rng([11, seed])
    heights, hardness = nearly_flat(rng)
    area = SIZES[0] * SIZES[1]
    most = hardness * area * rng.uniform(0.05, 0.99)
    forces = most * np.append(1.0, 10.0 ** rng.uniform(-9, 0, 3))
    surface = rl.Surface(heights, SIZES)
    settings = {
        "E_star": 1.0,
        "hardness": hardness if yields else None,
        "periodic": periodic,
        "fields": True,
    }
    by_force = rl.press(surface, forces=forces, **settings)
    curves = [by_force]
    if not (periodic and by_force.area_fraction.max() == 1):  # else there is no depth to prescribe
        curves.append(rl.press(surface, depths=by_force.depth, **settings))
    for curve in curves:
        with threadpool_limits(limits=1, user_api="blas"):
            assert_every_load(curve, heights, periodic)


def assert_every_load(curve, heights, periodic):
    """Compare each load with a dense solution."""
    before = np.zeros(heights.shape)
    for i, found in enumerate(curve.fields):
        if not found.contact.any():
            continue  # by depth, apart within the rounding of the depth
        separation = heights.max() - heights + before
        touch = separation.min()
        hardness = curve.hardness or 1e3 * found.pressure.max()
        left = Body(touch - separation, SIZES, 1.0, periodic)
        expected = History(left, hardness).press(curve.force[i])
        before = found.indentation
        told = 10 * np.spacing(curve.depth[i]) / max(expected.depth, 1e-300)
        if curve.settings["control"] == "depths" and told > FORCE:
            continue  # the depth, as a number, does not say the load
        off = np.abs(found.pressure.ravel() - expected.pressure).max()
        assert off <= PRESSURE * found.pressure.mean()
        assert (found.contact.ravel() == expected.contact).all()
        alone = curve.length * found.pressure.mean()
        error = FORCE * max(expected.depth, alone) + 10 * np.spacing(curve.depth[i])
        assert curve.depth[i] - touch == pytest.approx(expected.depth, abs=error)
        assert curve.unloading_stiffness[i] == pytest.approx(
            expected.unloading_stiffness, rel=STIFFNESS
        )
