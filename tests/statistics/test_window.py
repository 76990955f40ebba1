"""The automatic window ends where a power law is rejected."""

import numpy as np
import pytest

import roughline as rl


def test_the_window_of_a_true_power_law_is_everything(law_with_scatter):
    """In about 95 of 100 ensembles, as the level of the test says."""
    whole = 0
    for seed in range(100):
        force, stiffness = law_with_scatter(bend=0.0, seed=seed)
        # the tilts bend the arithmetic mean, not the geometric one
        found = rl.find_window(force, stiffness, averaging="geometric")
        whole += found == (force[0], force[-1])
    assert 88 <= whole <= 99


@pytest.mark.parametrize("averaging", ["arithmetic", "geometric"])
def test_the_window_ends_where_the_law_bends(law_with_scatter, averaging):
    force, stiffness = law_with_scatter(bend=1.0)
    low, high = rl.find_window(force, stiffness, averaging=averaging)
    assert low < 1e-2
    assert 0.5 < high < 10
    law = rl.fit_power_law(force, stiffness, (low, high), averaging=averaging)
    assert law.averaging == averaging
    assert law.exponent == pytest.approx(0.6, abs=0.02)


def test_a_larger_ensemble_notices_more(law_with_scatter):
    few = rl.find_window(*law_with_scatter(bend=1.0, realisations=8))
    many = rl.find_window(*law_with_scatter(bend=1.0, realisations=400))
    assert np.log(many[1] / many[0]) <= np.log(few[1] / few[0])


def test_no_window_where_no_power_law_is():
    force = np.geomspace(1, 10, 6)
    wave = 1 + 0.5 * np.sin(np.arange(6) * 2.5)
    noise = np.random.default_rng(0).normal(1, 1e-4, (20, 6))
    assert rl.find_window(force, wave * noise) is None


@pytest.mark.parametrize(
    ("stiffness", "message"),
    [
        (np.ones(5), "with two realisations or more"),
        (np.ones((1, 5)), "with two realisations or more"),
        (np.ones((3, 4)), "with two realisations or more"),
        (np.full((3, 5), np.nan), "must be positive and finite"),
    ],
)
def test_a_window_of_bad_input(stiffness, message):
    with pytest.raises(rl.InputError, match=message):
        rl.find_window(np.geomspace(1, 10, 5), stiffness)
