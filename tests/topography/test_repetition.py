"""The jump of a repeated surface across its borders."""

import numpy as np
import pytest

import roughline as rl
from roughline.topography.repetition import border_jump


def test_a_slope_jumps_by_its_whole_rise():
    x = np.arange(10.0)
    tilted = rl.Surface(np.broadcast_to(x[:, np.newaxis], (10, 20)), (10.0, 20.0))
    found = border_jump(tilted)
    # 20 of 30 pairs of border points rise by 9, and 180 of 370 pairs of neighbours by 1
    assert found.jump == pytest.approx(9 * np.sqrt(20 / 30))
    assert found.step == pytest.approx(np.sqrt(180 / 370))
    assert found.share_of_slope == pytest.approx(20 * 81 / (20 * 81 + 180))


def test_a_periodic_surface_steps_at_its_borders_as_anywhere():
    surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(128, 1)
    found = border_jump(surface)
    assert found.jump == pytest.approx(found.step, rel=0.2)  # 256 pairs tell it within a tenth
    assert found.share_of_slope == pytest.approx(1 / 128, rel=0.4)


def test_a_flat_surface_does_not_jump():
    found = border_jump(rl.Surface(np.zeros((8, 8)), (1.0, 1.0)))
    assert (found.jump, found.step, found.share_of_slope) == (0.0, 0.0, 0.0)
