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

GAMMA, ONSET, SHARPNESS = 0.47, 0.3, 1.0
FORCES = 10 ** (np.arange(-12, 11) / 4)
TRIALS = 200
ENOUGH = 0.95 * TRIALS - math.sqrt(0.95 * 0.05 * TRIALS)
"""95 % of the trials, less the standard error of that count."""


def law(force, hurst):
    """Stiffness whose local exponent goes from 1 / (1 + H) to 1, and that ends as F / gamma."""
    missing = 1 - scaling_exponent_of(hurst)
    return force / GAMMA * (1 + (ONSET / force) ** SHARPNESS) ** (missing / SHARPNESS)


def exponent(force, hurst):
    """Local exponent of that law."""
    missing = 1 - scaling_exponent_of(hurst)
    return 1 - missing / (1 + (force / ONSET) ** SHARPNESS)


def load_of(value, hurst):
    """Load at which the local exponent of that law has a value."""
    missing = 1 - scaling_exponent_of(hurst)
    return ONSET * (missing / (1 - value) - 1) ** (1 / SHARPNESS)


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
        true = exponent(local.force, hurst)
        hits["exponents"] += np.mean((local.low <= true) & (true <= local.high))
        hits["gamma"] += found.gamma.low <= GAMMA <= found.gamma.high
        for name, load in (("leaves", leaves), ("reaches", reaches)):
            force = getattr(found, name).force
            hits[name] += not (force.low > load or force.high < load)  # an end may be open
    assert min(hits.values()) >= ENOUGH, hits


def test_estimates_of_many_surfaces_are_those_of_the_law():
    for hurst in (0.8, 0.5, 0.2):
        found = cross_over(FORCES, surfaces(hurst, 3000, np.random.default_rng(1)), hurst)
        assert found.gamma.value == pytest.approx(GAMMA, rel=0.01)
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
