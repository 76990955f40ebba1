"""Intervals of curves: where contact may be full, stiffness may have no upper end."""

import math
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.margins.grid import intervals_of_grid

YOUNG, POISSON, THICKNESS = 1.0, 0.3, 0.1
CONFINED = YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))
"""Modulus of a layer that cannot move aside, as under even pressure on a rigid base."""

LAYER = rl.Layered(YOUNG, POISSON, THICKNESS, base_young=math.inf, periodic=True)
DEEP = rl.Homogeneous(E_star=YOUNG / (1 - POISSON**2), periodic=True)


def pressed(half_space, force):
    """A unit square in nearly full contact, and its curve as if the grid told little of it."""
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(32, rng=7)
    curve = rl.press(surface, half_space=half_space, forces=[force], grid_error=True)
    error = 9 * curve.stiffness
    return curve, replace(curve, stiffness_error=error, unloading_stiffness_error=error)


@pytest.mark.parametrize("force", [0.6, 1.0])
def test_a_repeated_layer_on_a_rigid_base_is_as_stiff_as_that_lets_it_be(force):
    """Its stiffness in full contact is M A / t, and ends of its interval are finite."""
    curve, unsure = pressed(LAYER, force)
    assert curve.stiffness[0] == pytest.approx(
        CONFINED / THICKNESS, rel=2e-3 if force < 1 else 1e-6
    )
    for found in (intervals_of_grid(curve), intervals_of_grid(unsure)):
        assert np.isfinite([found.stiffness, found.unloading]).all()


def test_a_repeated_deep_body_may_be_rigid_near_full_contact():
    _, unsure = pressed(DEEP, 0.6)
    assert intervals_of_grid(unsure).stiffness[1] == np.inf
