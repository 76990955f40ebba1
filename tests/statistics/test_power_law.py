"""Fits recover what was put in, and refuse what cannot be fitted."""

import numpy as np
import pytest
from scipy.stats import linregress, t

import roughline as rl
from roughline.statistics import bootstrap
from roughline.statistics.power_law import linear_exponent, scaling_exponent

FORCE = np.geomspace(1e-5, 1, 51)


def test_an_exact_power_law_is_recovered():
    law = rl.fit_power_law(FORCE, 0.9 * FORCE**0.55, window=(1e-4, 1e-2))
    assert law.exponent == pytest.approx(0.55, abs=1e-12)
    assert law.prefactor == pytest.approx(0.9, rel=1e-12)
    assert np.ptp(law.exponent_interval) < 1e-12
    assert (law.window, law.points, law.realisations) == ((1e-4, 1e-2), 21, 1)
    assert law(1e-3) == pytest.approx(0.9 * 1e-3**0.55)
    assert law.interval_from == "regression"


def test_only_the_window_counts_and_its_edges_belong_to_it():
    broken = np.where(FORCE > 1.0001e-2, 7.0, 0.9 * FORCE**0.55)
    assert rl.fit_power_law(FORCE, broken, (1e-4, 1e-2)).exponent == pytest.approx(0.55)
    assert rl.fit_power_law(FORCE, broken, (1e-4, 2e-2)).exponent != pytest.approx(0.55, abs=0.01)


@pytest.mark.parametrize("realisations", [10, 20, 60])
def test_the_interval_of_an_exponent_is_studentised_and_holds_the_truth(realisations):
    """Each realisation is off by a factor and a tilt of its own, as surfaces are."""
    rng, force = np.random.default_rng(1), np.geomspace(1e-2, 1e-1, 10)
    factor, tilt = rng.normal(size=(2, realisations, 1))
    steep = 0.1 * np.log(force / 0.03)
    noise = np.exp(0.3 * factor + steep * tilt - steep**2 / 2)  # of the same mean
    stiffness = 0.8 * force**0.6 * noise
    law = rl.fit_power_law(force, stiffness, (1e-2, 1e-1))
    assert law.exponent_interval[0] < 0.6 < law.exponent_interval[1]

    draws = np.random.default_rng(0).integers(realisations, size=(bootstrap.ROUNDS, realisations))
    weights = np.polyfit(np.log(force), np.eye(force.size), 1)[0]
    ensembles = [stiffness, *(stiffness[draw] for draw in draws)]
    slopes = np.array([np.log(each.mean(axis=0)) @ weights for each in ensembles])
    # how far each realisation moves the slope
    moves = np.array([(each / each.mean(axis=0)) @ weights for each in ensembles])
    errors = moves.std(axis=1, ddof=1) / np.sqrt(realisations)
    steps, last = np.sort((slopes[1:] - slopes[0]) / errors[1:]), bootstrap.ROUNDS - 1
    width = t.ppf(0.975, realisations - 1)
    assert law.exponent_interval == pytest.approx(
        (
            slopes[0] - max(width, steps[round(0.975 * last)]) * errors[0],
            slopes[0] + max(width, -steps[round(0.025 * last)]) * errors[0],
        )
    )


def test_the_intervals_of_a_single_curve_are_those_of_a_regression():
    force = np.geomspace(1e-2, 1e-1, 6)
    stiffness = 0.8 * force**0.6 * np.exp([0.02, -0.03, 0.01, 0.04, -0.02, -0.01])
    law = rl.fit_power_law(force, stiffness, (1e-2, 1e-1), confidence=0.9)
    line = linregress(np.log(force), np.log(stiffness))
    width = t.ppf(0.95, 6 - 2)
    for found, expected, error in (
        (law.exponent_interval, line.slope, line.stderr),
        (np.log(law.prefactor_interval), line.intercept, line.intercept_stderr),
    ):
        assert found == pytest.approx([expected - width * error, expected + width * error])


def test_the_mean_at_fixed_force_is_fitted():
    stiffness = np.array([1.0, 3.0])[:, None] * FORCE**0.5
    law = rl.fit_power_law(FORCE, stiffness, (1e-4, 1e-2))
    assert law.prefactor == pytest.approx(2.0)  # the geometric mean would give 1.73
    assert law.realisations == 2
    assert law.interval_from == "resampled realisations"


def test_the_same_seed_gives_the_same_interval():
    stiffness = np.random.default_rng(0).uniform(1, 2, (20, 1)) * FORCE**0.5
    fits = [rl.fit_power_law(FORCE, stiffness, (1e-4, 1e-2), rng=seed) for seed in (3, 3, 4)]
    assert fits[0] == fits[1]
    assert fits[0].prefactor_interval != fits[2].prefactor_interval


def test_predicted_exponents():
    dimensions = np.array([2.0, 2.2, 2.4, 2.6, 2.8, 3.0])
    assert scaling_exponent(dimensions).round(3).tolist() == [0.5, 0.556, 0.625, 0.714, 0.833, 1.0]
    assert linear_exponent(dimensions).round(3).tolist() == [
        0.513,
        0.565,
        0.616,
        0.667,
        0.719,
        0.77,
    ]


@pytest.mark.parametrize(
    ("stiffness", "window", "message"),
    [
        (FORCE, (2.0, 3.0), "holds too few loads, 0; at least 3"),
        (FORCE, (1e-2, 1e-3), "window is .0.01, 0.001.; two rising"),
        (np.full(51, np.nan), (1e-4, 1e-2), "21 values of stiffness_bar in the window are not"),
        (-FORCE, (1e-4, 1e-2), "are not positive"),
        (FORCE[:-1], (1e-4, 1e-2), r"force_bar has shape \(51,\) and stiffness_bar \(50,\)"),
    ],
)
def test_what_cannot_be_fitted_is_refused(stiffness, window, message):
    with pytest.raises(rl.InputError, match=message):
        rl.fit_power_law(FORCE, stiffness, window)
    with pytest.raises(rl.InputError, match="confidence is 1.5"):
        rl.fit_power_law(FORCE, FORCE, (1e-4, 1e-2), confidence=1.5)


def test_the_geometric_mean_is_fitted_on_request(law_with_scatter):
    force, stiffness = law_with_scatter(bend=0.0)
    law = rl.fit_power_law(force, stiffness, (1e-3, 1e3), averaging="geometric")
    logs = np.polyfit(np.log(force), np.log(stiffness).mean(axis=0), 1)
    assert law.exponent == pytest.approx(logs[0])
    assert law.prefactor == pytest.approx(np.exp(logs[1]))
    assert law.exponent_interval[0] < law.exponent < law.exponent_interval[1]
    assert rl.fit_power_law(force, stiffness, (1e-3, 1e3)).prefactor > law.prefactor
