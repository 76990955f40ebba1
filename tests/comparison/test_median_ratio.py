"""The ratio of the models' middle stiffnesses, as a table and as surfaces have it."""

import numpy as np
import pytest

import roughline as rl
from roughline.comparison.median_ratio import median_ratio

LOADS = np.array([0.01, 0.1, 1.0])  # F / (E* h L)
SCATTER = 0.35  # of a stiffness's logarithm, at most, under these loads


def test_it_lies_in_the_map_of_trust():
    """Means of 20 surfaces scatter, and their 95 % intervals hold most of the ratios."""
    trust = rl.trust_map()
    held = []
    for i, roll in enumerate(trust.roll_off_ratios):
        for j, dimension in enumerate(trust.fractal_dimensions[2:8], 2):
            found = median_ratio(dimension, trust.force_bars, roll) - 1
            sure = trust.resolved[i, j] & (trust.force_bars <= 1)
            held += list(((trust.low[i, j] <= found) & (found <= trust.high[i, j]))[sure])
    assert np.mean(held) > 0.8


@pytest.mark.parametrize("surfaces", [4, 24])
def test_surfaces_and_their_lines_have_it(surfaces):
    """Elsewhere than in the table: with a roll-off of 12 waves, and other seeds."""
    spectrum = rl.SelfAffine(hurst=0.6, rms_height=1.0, q_roll=24 * np.pi, q_high=64 * np.pi)
    bodies = (
        (spectrum.surface(128, 900 + i) for i in range(surfaces)),
        (spectrum.line(8192, 900 + i) for i in range(10 * surfaces)),
    )
    full, reduced = (
        np.mean([np.log(rl.press(one, E_star=1.0, forces=LOADS).stiffness) for one in each], axis=0)
        for each in bodies
    )
    within = 2.5 * SCATTER / np.sqrt(surfaces)
    assert np.exp(full - reduced) == pytest.approx(median_ratio(2.4, LOADS, 12.0), rel=within)


def test_beyond_the_table_it_is_that_of_the_nearest_place():
    assert median_ratio(2.0, np.array([1e-6]), 0.5) == median_ratio(2.2, np.array([1e-3]), 1.0)
    assert median_ratio(3.0, np.array([9.0]), 99.0) == median_ratio(2.7, np.array([1.0]), 32.0)
