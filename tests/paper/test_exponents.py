"""The paper's claims as the two models recompute them: reference exponents, scatter, collapse.

Reference values come from an independent prototype of both models with seeds of its own, so they
agree within the scatter of the ensembles, which resampling tells.
"""

import numpy as np
import pytest
from scipy.special import ndtr

import roughline as rl
from roughline.reduction.springs import Springs
from roughline.statistics.power_law import linear_exponent

HURST = (1.0, 0.8, 0.6, 0.4, 0.2, 0.0)
WINDOWS = ((1e-4, 1e-2), (1e-3, 1e-1), (1e-2, 0.3))
EXPONENT_PREFACTOR = {
    1.0: ((0.497, 0.839), (0.481, 0.766), (0.464, 0.720)),
    0.8: ((0.546, 0.896), (0.530, 0.816), (0.506, 0.752)),
    0.6: ((0.609, 0.974), (0.589, 0.872), (0.569, 0.812)),
    0.4: ((0.701, 1.13), (0.680, 1.01), (0.650, 0.902)),
    0.2: ((0.805, 1.34), (0.783, 1.18), (0.747, 1.04)),
    0.0: ((0.894, 1.65), (0.865, 1.40), (0.818, 1.19)),
}
EXPONENT_FULL = {1.0: 0.515, 0.8: 0.541, 0.6: 0.589, 0.4: 0.647, 0.2: 0.691, 0.0: 0.720}
FORCES = 10 ** (np.arange(-40, 1) / 10)  # 1e-4 to 1, ten a decade

STANDARD_ERRORS = 4.0  # allowed distance of two ensembles, in standard errors of their difference


def lines(hurst, count=100, n=2**16, amplitudes="fixed"):
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0)
    return [
        spectrum.line(n, np.random.SeedSequence(1, spawn_key=(i,)), amplitudes)
        for i in range(count)
    ]


def stiffness_of(bodies, forces):
    return np.array([rl.press(body, E_star=1.0, forces=forces).stiffness for body in bodies])


def standard_error(interval):
    return (interval[1] - interval[0]) / (2 * 1.96)


@pytest.mark.parametrize("hurst", HURST)
def test_exponents_and_prefactors_of_the_reduced_model(hurst):
    stiffness = stiffness_of(lines(hurst), FORCES)
    for window, (exponent, prefactor) in zip(WINDOWS, EXPONENT_PREFACTOR[hurst], strict=True):
        law = rl.fit_power_law(FORCES, stiffness, window)
        error = np.sqrt(2) * standard_error(law.exponent_interval)
        assert abs(law.exponent - exponent) < STANDARD_ERRORS * error + 5e-4
        error = np.sqrt(2) * standard_error(law.prefactor_interval)
        assert abs(law.prefactor - prefactor) < STANDARD_ERRORS * error + 5e-3


@pytest.mark.parametrize(("hurst", "n", "count"), [(0.8, 128, 8), *((h, 256, 20) for h in HURST)])
def test_exponents_of_the_full_model(hurst, n, count):
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0)
    forces = 10 ** (np.arange(-12, -5) / 6)
    seeds = [np.random.SeedSequence(3, spawn_key=(i,)) for i in range(count)]
    surfaces = [spectrum.surface(n, seed) for seed in seeds]
    law = rl.fit_power_law(forces, stiffness_of(surfaces, forces), (1e-2, 1e-1))
    error = np.sqrt(2) * standard_error(law.exponent_interval)
    assert abs(law.exponent - EXPONENT_FULL[hurst]) < STANDARD_ERRORS * error
    assert abs(law.exponent - linear_exponent(3 - hurst)) < 0.05 + 2 * error


@pytest.mark.parametrize(
    ("hurst", "n", "count", "punch"),
    [(0.8, 64, 10, 1.146), (0.8, 128, 30, 1.149), (0.5, 128, 30, 1.149)],
)
def test_the_raw_stiffness_of_both_models_agrees_and_differs_near_saturation(
    hurst, n, count, punch
):
    """Full contact is that with the flat punch of a grid, and lines have no such limit."""
    forces = np.array([0.01, 0.03, 0.1, 0.3, 30.0])
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0)
    seeds = [np.random.SeedSequence(3, spawn_key=(i,)) for i in range(count)]
    full = stiffness_of([spectrum.surface(n, seed) for seed in seeds], forces)
    reduced = stiffness_of(lines(hurst, 10 * count // 3, n**2 * 4), forces)
    ratio = full.mean(axis=0) / reduced.mean(axis=0)
    error = ratio * np.hypot(
        *(k.std(axis=0) / k.mean(axis=0) / len(k) ** 0.5 for k in (full, reduced))
    )
    assert (np.abs(ratio - 1) < 0.1 + 3 * error)[:4].all()
    assert ratio[4] == pytest.approx(punch, abs=0.003)


@pytest.mark.parametrize(
    ("hurst", "n", "scatter"), [(1.0, 2**14, 0.28), (0.0, 2**12, 0.127), (0.0, 2**18, 0.06)]
)
def test_scatter_of_the_stiffness_between_realisations(hurst, n, scatter):
    """For H = 0 it keeps falling with the grid: more and more modes share the variance."""
    stiffness = stiffness_of(lines(hurst, 200, n), [0.01])[:, 0]
    # the relative error of a standard deviation from 200 draws is 1 / sqrt(400) = 5 %
    assert stiffness.std() / stiffness.mean() == pytest.approx(scatter, rel=0.25)


@pytest.mark.parametrize(("count", "n"), [(100, 2**12), (400, 2**14)])
def test_gaussian_amplitudes_change_the_exponent_by_about_a_hundredth(count, n):
    laws = [
        rl.fit_power_law(FORCES, stiffness_of(lines(0.8, count, n, kind), FORCES), (1e-3, 1e-1))
        for kind in ("fixed", "gaussian")
    ]
    assert abs(laws[0].exponent - laws[1].exponent) < 0.03


def test_the_exponent_depends_on_how_realisations_are_averaged():
    """At fixed force alpha is 0.54 for H = 0.8; at fixed level (height above the mean) 0.71."""
    level = np.linspace(1.5, 2.6, 12)
    force, stiffness = np.zeros((2, level.size))
    for line in lines(0.8):
        springs = Springs.under(line.heights, line.spacing, 1.0)
        depth = np.maximum(line.heights.max() - level, 0.0)
        touching = springs.at_depths(depth)
        force += touching.force_at(depth)
        stiffness += touching.stiffness
    at_level = np.polyfit(np.log(force), np.log(stiffness), 1)[0]
    at_force = rl.fit_power_law(FORCES, stiffness_of(lines(0.8), FORCES), WINDOWS[0]).exponent
    assert at_force == pytest.approx(0.54, abs=0.03)
    assert at_level - at_force > 0.1


@pytest.mark.parametrize("hurst", [0.2, 0.8])
def test_with_a_roll_off_the_reduced_model_forgets_the_hurst_exponent(hurst):
    """F̄ = phi(u) - u Q(u), k̄ = Q(u), with the Gaussian density and tail."""
    expected = {1e-3: 0.00329, 1e-2: 0.02629, 1e-1: 0.18344, 1.0: 0.8158}
    u = np.linspace(-6, 6, 200_001)
    force = np.exp(-(u**2) / 2) / np.sqrt(2 * np.pi) - u * ndtr(-u)
    for force_bar, stiffness in expected.items():
        found = np.interp(-np.log(force_bar), -np.log(force), ndtr(-u))
        assert found == pytest.approx(stiffness, abs=6e-5 if stiffness > 0.1 else 6e-6)
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0, q_roll=2 * np.pi * 512)
    bodies = [spectrum.line(2**16, i) for i in range(40)]
    mean = stiffness_of(bodies, list(expected)).mean(axis=0)
    assert mean == pytest.approx(list(expected.values()), rel=0.03)
