"""How often intervals from ensembles hold laws that are known."""

import math
import sys
from itertools import islice
from pathlib import Path

import numpy as np
from bootstrap_coverage import STUDENTISED, intervals
from made_curves import (
    CROSSING_FORCES,
    DEPTH_EXPONENT,
    DEPTH_WINDOW,
    PRESSURES,
    Crossing,
    areas,
    ensemble,
    exponent_at_level,
    pressure_of,
)
from trials import Study, row

from roughline.paper.averaging import exponent_of_means

sys.path.insert(0, str(Path(__file__).parents[1]))

from studies.area.measure import log_kappa
from studies.finite_size.crossover import (
    BETWEEN_THEM,
    EXPONENT_TOLERANCE,
    cross_over,
    local_exponents,
    scaling_exponent_of,
)

LEVELS = (0.01, 0.05, 0.15)  # contact area fractions
SCATTER = 0.3
BODIES = 40


def mean_rows(kind, option, seed):
    """Means, exponents, prefactors and differences of log-normal curves, by their number."""
    count = int(option)
    rng = np.random.default_rng([count, seed])
    for name, *each in islice(intervals(rng, count, SCATTER), STUDENTISED):
        yield row(name, 0.0, *each)


def kappa_rows(kind, option, seed):
    """Kappa of areas whose power law is known, by the number of surfaces."""
    table = areas(int(option), np.random.default_rng([int(option), seed]))
    for level in LEVELS:
        found = log_kappa(table, PRESSURES, level).interval_estimate().exp()
        truth = level / pressure_of(level)
        yield row(f"κ at {level:.0%}", level, truth, found.value, found.low, found.high)


def exponent_rows(kind, option, seed):
    """Exponents between means of forty bodies at fixed force, depth or level."""
    truth = exponent_at_level() if option == "level" else DEPTH_EXPONENT
    data = ensemble(BODIES, np.random.default_rng(seed))
    found = exponent_of_means(data, DEPTH_WINDOW, option, "arithmetic")
    yield row("α", 0.0, truth, found.value, found.low, found.high)


def crossing_rows(kind, option, seed):
    """Local exponents of a law that crosses over, where they pass, and its largest F / k."""
    hurst, count = (float(each.split()[-1]) for each in option.split(", "))
    law = Crossing(hurst)
    sample = law.surfaces(int(count), np.random.default_rng([round(10 * hurst), seed]))
    found, local = (
        cross_over(CROSSING_FORCES, sample, hurst),
        local_exponents(CROSSING_FORCES, sample),
    )
    for force, *each in zip(
        np.sqrt(CROSSING_FORCES[2:] * CROSSING_FORCES[:-2]),
        law.exponents,
        local.value,
        local.low,
        local.high,
        strict=True,
    ):
        yield row("local α", force, *each)
    gamma = found.gamma
    yield row("γ", 0.0, law.gamma, gamma.value, gamma.low, gamma.high)
    for name, passed, exponent in (
        ("leaves", found.leaves, scaling_exponent_of(hurst) + EXPONENT_TOLERANCE),
        ("halfway", found.halfway, (scaling_exponent_of(hurst) + BETWEEN_THEM) / 2),
        ("reaches", found.reaches, 1 - EXPONENT_TOLERANCE),
    ):
        low, high = passed.force.low, passed.force.high
        ends = 0.0 if math.isnan(low) else low, math.inf if math.isnan(high) else high  # open
        yield row(name, 0.0, law.load_of(exponent), passed.force.value, *ends)


def _study(rows_of, heading, options, seeds):
    columns = "held", "silent", "half width"
    return Study(
        rows_of, heading, rows_of.__doc__, ("curves",), options, seeds, ("option",), columns
    )


MEANS = _study(mean_rows, "Means of curves", ("10", "20", "60"), 1000)
KAPPA = _study(kappa_rows, "Kappa", ("20", "100"), 200)
EXPONENTS = _study(exponent_rows, "Exponents of means", ("force", "depth", "level"), 200)
CROSSINGS = _study(crossing_rows, "Crossing over", ("H 0.8, of 20", "H 0.5, of 60"), 200)
