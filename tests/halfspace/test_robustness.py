"""Random problems of every kind end certified: sizes, aspects, roughness, scales, loads, bounds."""

import numpy as np
import pytest

import roughline as rl
from random_problems import E_STAR, random_problem


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(1, 6))
def test_random_problems_are_certified(seed):
    for i in range(500):
        problem = random_problem(np.random.default_rng([seed, i]))
        curve = rl.press(problem.surface, E_star=E_STAR, periodic=problem.periodic, **problem.loads)
        assert curve.converged.all()
        assert (curve.residual <= 1e-6).all()
        assert (curve.stiffness > 0).all()
        assert np.isfinite([curve.depth, curve.force, curve.area_fraction]).all()
        rising = curve.stiffness[1:] >= (1 - 1e-6) * curve.stiffness[:-1]
        assert rising.all()


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
