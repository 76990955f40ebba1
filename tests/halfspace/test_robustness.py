"""Random problems of every kind end certified: sizes, aspects, roughness, scales, loads, bounds."""

import numpy as np
import pytest

import roughline as rl
from random_cases import cases, seeds
from random_problems import E_STAR, random_problem

pytestmark = pytest.mark.usefixtures("either_search")


@pytest.mark.filterwarnings("ignore::roughline.UnitWarning")  # loads of all sizes
@pytest.mark.parametrize("seed", range(1, 6))
@seeds(10, cases(500, share=8))
def test_random_problems_are_certified(seed, seeds):
    for i in seeds:
        problem = random_problem(np.random.default_rng([seed, i]))
        given = {"periodic": problem.periodic, **problem.loads}
        curve = rl.press(problem.surface, E_star=E_STAR, **given, fields=True)
        assert curve.converged.all()
        assert (curve.residual <= 1e-6).all()
        assert (curve.stiffness > 0).all()
        assert np.isfinite([curve.depth, curve.force, curve.area_fraction]).all()
        rising = curve.stiffness[1:] >= (1 - 1e-6) * curve.stiffness[:-1]
        assert rising.all()
        if min(problem.surface.shape) > 1:  # what a load leaves open lets less through than another
            flows = [rl.flow(each) for each in (curve.fields[0], curve.fields[-1])]
            assert all(flow.imbalance < 1e-10 for flow in flows)
            assert flows[1].permeance <= flows[0].permeance * (1 + 1e-6)


@pytest.mark.parametrize("shape", [(1, 2), (1, 97), (64, 1), (2, 2), (3, 500)])
@pytest.mark.parametrize("periodic", [False, True])
def test_strips_and_tiny_grids(shape, periodic):
    heights = np.random.default_rng(3).normal(size=shape)
    surface = rl.Surface(heights, sizes=shape)
    unit = surface.rms_height * surface.length
    curve = rl.press(surface, E_star=1.0, forces=[1e-6 * unit, unit, 1e3 * unit], periodic=periodic)
    assert curve.converged.all()
    assert curve.area_fraction[-1] == 1.0


@pytest.mark.parametrize("periodic", [False, True])
def test_near_full_contact_and_beyond(periodic):
    surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(64, 5)
    unit = surface.rms_height * surface.length
    curve = rl.press(surface, E_star=1.0, forces=unit * np.geomspace(1, 1e4, 9), periodic=periodic)
    assert curve.converged.all()
    assert curve.area_fraction[-1] == 1.0
    assert ((curve.area_fraction > 0.9) & (curve.area_fraction < 1)).any()


@pytest.mark.parametrize("hardness", [None, 0.1])
@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize(("precision", "rtol"), [("mixed", 1e-6), ("float32", 1e-4)])
@pytest.mark.parametrize("control", ["forces", "depths"])
def test_the_smallest_loads_that_are_not_refused(control, precision, rtol, periodic, hardness):
    """Squares of their pressures still are numbers in double precision, if not in single."""
    rough = rl.SelfAffine(hurst=0.7, rms_height=1.0).surface(24, 3)
    punch = rl.Surface(np.zeros((24, 24)), (1.0, 1.0))
    settings = {"rtol": rtol, "periodic": periodic, "hardness": hardness}
    settings["solver"] = rl.Solver(precision=precision)
    for surface in (rough,) if periodic and control == "depths" else (rough, punch):
        loads = 0.03 * np.array([1e-98, 1e-60, 1e-44, 1e-30, 1e-15])
        loads = np.append(loads, 0.03) if surface is punch else loads
        curve = rl.press(surface, E_star=1.0, **{control: loads}, **settings)
        small = slice(0, 5)
        assert curve.stiffness[small] == pytest.approx(np.full(5, curve.stiffness[0]), rel=rtol)
        if np.isfinite(curve.stiffness[0]):
            force = curve.stiffness[small] * curve.depth[small]
            assert curve.force[small] == pytest.approx(force, rel=rtol)
