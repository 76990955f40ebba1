"""Loads in a wrong unit, which strain a body beyond any half-space, are warned of."""

import warnings

import numpy as np
import pytest

import roughline as rl

SPECTRUM = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=2.5e4)
SURFACE = SPECTRUM.surface(16, rng=1)


def test_a_depth_of_many_sides_and_a_pressure_of_many_moduli_are_warned_of():
    with pytest.warns(rl.UnitWarning, match=r"mean pressure is 1[01]00 times the contact modulus"):
        rl.press(SURFACE, E_star=1.0, depths=[1.0])
    with pytest.warns(rl.UnitWarning, match="mean pressure is 10000 times the contact modulus"):
        rl.press(SURFACE, E_star=1.0, forces=[1e4 * SURFACE.area])
    with pytest.warns(rl.UnitWarning, match="depth is 100 times the shorter side"):
        rl.press(SPECTRUM.line(64, rng=1), E_star=1.0, depths=[0.1])
    r = np.linspace(0, 1e-3, 40)
    with pytest.warns(rl.UnitWarning, match="times the"):
        rl.press(rl.Profile(r, -10 * r**2), E_star=1.0, depths=[1.0])
    with pytest.warns(rl.UnitWarning, match="depth is 1000 times the shorter side of the body"):
        rl.press(SURFACE, half_space=rl.Layered(1.0, 0.3, 1e-3, 1.0, 0.3), depths=[1.0])


def test_heights_in_a_unit_of_their_own_are_left_alone():
    """Contacts are alike whatever that unit: a linear theory does not know it."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rl.press(rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(16, 1), E_star=1.0, depths=[50.0])
        rl.press(rl.Surface(np.zeros((4, 4)), (1.0, 1.0)), E_star=1.0, depths=[50.0])
        rl.press(SURFACE, E_star=1.0, n_loads=3)


def test_a_modulus_without_its_prefix_is_warned_of():
    with pytest.warns(rl.UnitWarning, match=r"E of steel is 210 Pa, softer .* E=210e9") as found:
        rl.Material("steel", E=210, nu=0.3)
    assert found[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rl.Material("gel", E=2e3, nu=0.49)
