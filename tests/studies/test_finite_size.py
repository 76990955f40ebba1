"""The study of finite size: laws that are known come back from samples that were made of them."""

import math

import numpy as np
import pytest

from studies.finite_size.crossover import (
    EXPONENT_TOLERANCE,
    cross_over,
    local_exponents,
    scaling_exponent_of,
)

ASYMPTOTE, ONSET, SHARPNESS, FULL = 0.47, 0.3, 1.0, 1000.0
FORCES = 10 ** (np.arange(-12, 11) / 4)
TRIALS = 200
ENOUGH = 0.95 * TRIALS - math.sqrt(0.95 * 0.05 * TRIALS)
"""95 % of the trials, less the standard error of that count."""


def law(force, hurst):
    """Stiffness whose local exponent goes from 1 / (1 + H) to 1, and beyond near full contact."""
    missing = 1 - scaling_exponent_of(hurst)
    rough = force / ASYMPTOTE * (1 + (ONSET / force) ** SHARPNESS) ** (missing / SHARPNESS)
    return rough * (1 + (force / FULL) ** 2)


def exponents(hurst):
    """Local exponents of that law, from each load to the next but one."""
    logs, steps = np.log(law(FORCES, hurst)), np.log(FORCES)
    return (logs[2:] - logs[:-2]) / (steps[2:] - steps[:-2])


def load_of(value, hurst):
    """Load at which the local exponent of that law has a value, far from full contact."""
    missing = 1 - scaling_exponent_of(hurst)
    return ONSET * (missing / (1 - value) - 1) ** (1 / SHARPNESS)


def gamma(hurst):
    """Largest F / k of that law."""
    return (FORCES / law(FORCES, hurst)).max()


def surfaces(hurst, count, rng):
    """Stiffness that scatters as that of surfaces does: less under heavy loads."""
    steps = rng.standard_normal((count, FORCES.size))
    alike = math.exp(-np.log(FORCES[1] / FORCES[0]) / 1.5)
    for i in range(1, FORCES.size):
        steps[:, i] = alike * steps[:, i - 1] + math.sqrt(1 - alike**2) * steps[:, i]
    scatter = 0.35 / (1 + FORCES / ONSET) ** 0.5
    return law(FORCES, hurst) * np.exp(scatter * steps - scatter**2 / 2)


@pytest.mark.slow
@pytest.mark.parametrize(("hurst", "count"), [(0.8, 20), (0.5, 60)])
def test_known_laws_come_back_within_their_intervals(hurst, count):
    """Exponents at single loads, the loads where they pass, and gamma, in 95 % of 200 trials."""
    rng = np.random.default_rng(17)
    leaves = load_of(scaling_exponent_of(hurst) + EXPONENT_TOLERANCE, hurst)
    reaches = load_of(1 - EXPONENT_TOLERANCE, hurst)
    hits = {"gamma": 0, "leaves": 0, "reaches": 0, "exponents": 0.0}
    for _ in range(TRIALS):
        sample = surfaces(hurst, count, rng)
        found = cross_over(FORCES, sample, hurst)
        local = local_exponents(FORCES, sample)
        true = exponents(hurst)
        hits["exponents"] += np.mean((local.low <= true) & (true <= local.high))
        hits["gamma"] += found.gamma.low <= gamma(hurst) <= found.gamma.high
        for name, load in (("leaves", leaves), ("reaches", reaches)):
            force = getattr(found, name).force
            hits[name] += not (force.low > load or force.high < load)  # an end may be open
    assert min(hits.values()) >= ENOUGH, hits


def test_estimates_of_many_surfaces_are_those_of_the_law():
    for hurst in (0.8, 0.5, 0.2):
        found = cross_over(FORCES, surfaces(hurst, 3000, np.random.default_rng(1)), hurst)
        assert found.gamma.value == pytest.approx(gamma(hurst), rel=0.01)
        for passed, value in (
            (found.leaves, scaling_exponent_of(hurst) + EXPONENT_TOLERANCE),
            (found.reaches, 1 - EXPONENT_TOLERANCE),
        ):
            assert passed.force.value == pytest.approx(load_of(value, hurst), rel=0.3)


def test_half_of_the_surfaces_widen_intervals_by_the_square_root_of_two():
    ratios = []
    for seed in range(10):
        sample = surfaces(0.5, 160, np.random.default_rng(seed))
        whole, half = (local_exponents(FORCES, each) for each in (sample, sample[:80]))
        ratios.append((half.high - half.low) / (whole.high - whole.low))
    assert np.mean(ratios) == pytest.approx(math.sqrt(2), rel=0.05)


def test_gamma_is_not_told_where_heavier_loads_may_show_more():
    sample = surfaces(0.5, 100, np.random.default_rng(2))
    light = FORCES < 3
    found = cross_over(FORCES[light], sample[:, light], 0.5).gamma
    assert math.isnan(found.value)
    assert math.isnan(found.high)
    assert found.low == pytest.approx((FORCES / sample.mean(axis=0))[light][-1], rel=0.1)
