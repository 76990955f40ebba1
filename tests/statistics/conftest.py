"""Ensembles that several tests of statistics share."""

import numpy as np
import pytest


@pytest.fixture
def ensemble():
    """Return 40 realisations at five loads, with log-normal scatter."""
    return np.exp(np.random.default_rng(1).normal(0, 0.3, (40, 5)) + np.arange(5))


@pytest.fixture
def law_with_scatter():
    """Return a function that draws realisations around a power law."""
    return _law_with_scatter


def _law_with_scatter(bend, realisations=60, loads=31, seed=3):
    """Realisations around ζ F^α, bent ever more above F = 1, with scatter that loads share."""
    rng = np.random.default_rng(seed)
    force = np.geomspace(1e-3, 1e3, loads)
    mean = 0.8 * force**0.6 * np.exp(-0.05 * bend * np.log(np.maximum(force, 1)) ** 2)
    common = np.exp(rng.normal(0, 0.2, (realisations, 1)))
    tilt = rng.normal(0, 0.01, (realisations, 1)) * np.log(force)
    return force, mean * common * np.exp(tilt + rng.normal(0, 0.02, (realisations, loads)))
