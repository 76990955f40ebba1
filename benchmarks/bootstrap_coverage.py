"""How often 95 % intervals hold the truth, and how often percentiles: ``make bootstrap-coverage``.

The ensembles are curves of log-normal stiffness over load whose realisations differ by a factor, a
tilt and a little noise, so that loads are correlated as those of rough surfaces are; their true
means, exponent and prefactor are known in closed form.
"""

import argparse

import numpy as np
from page import Page

import roughline as rl
from roughline.statistics import bootstrap
from roughline.statistics.averages import relative_difference

COUNTS = (10, 20, 60)
SCATTERS = (0.1, 0.3, 0.6)
LINES = 200  # of the other model, in the difference
FORCE = np.geomspace(1e-2, 1e-1, 9)
WINDOW = (1e-2, 1e-1)
LOAD = 2  # whose mean is judged
EXPONENT, PREFACTOR = 0.6, 0.8
ENDS = (0.025, 0.975)
_OTHERS = f"over {LINES} others"
MEASURES = ["mean", "α", "ζ", f"over {LINES} others"]
STUDENTISED = len(MEASURES)
MEASURES += [f"percentiles: {each}" for each in MEASURES if each != "ζ"]
X = np.linspace(-1, 1, FORCE.size)


def curves(rng, count, scatter):
    """Realisations of 0.8 F^0.6, with scatter that loads share, and their true mean."""
    factor, tilt = rng.normal(0, scatter, (count, 1)), rng.normal(0, 0.3 * scatter, (count, 1))
    logs = factor + tilt * X + rng.normal(0, 0.1 * scatter, (count, X.size))
    variance = scatter**2 * (1 + (0.3 * X) ** 2 + 0.1**2)
    law = PREFACTOR * FORCE**EXPONENT
    return law * np.exp(logs - variance / 2), law


def intervals(rng, count, scatter):
    """Quantities of some curves: names, true values, values and ends."""
    values, law = curves(rng, count, scatter)
    others, _ = curves(rng, LINES, scatter)
    average = rl.average(values)
    fit = rl.fit_power_law(FORCE, values, WINDOW)
    apart = relative_difference(values, others, paired=False)
    resampled = bootstrap.means(values)
    of_others = np.log(resampled.values / bootstrap.means(others, 1).values)[:, LOAD]
    logs = np.log(resampled.values)
    weights = np.polyfit(np.log(FORCE), np.eye(FORCE.size), 1)[0]
    mean, over = (each[LOAD] for each in (average.mean, apart[0]))
    yield MEASURES[0], law[LOAD], mean, average.low[LOAD], average.high[LOAD]
    yield MEASURES[1], EXPONENT, fit.exponent, *fit.exponent_interval
    yield MEASURES[2], PREFACTOR, fit.prefactor, *fit.prefactor_interval
    yield MEASURES[3], 1.0, 1 + over, 1 + apart[1][LOAD], 1 + apart[2][LOAD]
    yield MEASURES[4], law[LOAD], mean, *np.exp(np.quantile(logs[:, LOAD], ENDS))
    yield MEASURES[5], EXPONENT, fit.exponent, *np.quantile(logs @ weights, ENDS)
    yield MEASURES[6], 1.0, 1 + over, *np.exp(np.quantile(of_others, ENDS))


def held_of(rng, count, scatter):
    """Whether each interval holds its truth."""
    return [low <= truth <= high for _, truth, _, low, high in intervals(rng, count, scatter)]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--trials", type=int, default=2000)
    trials = parser.parse_args().trials
    page = Page("", "Bootstrap intervals", "bootstrap-coverage")  # printed alone
    page.say(f"{trials} ensembles a row, over {LINES} others.\n")
    page.table("realisations", "scatter", *MEASURES)
    for count in COUNTS:
        for scatter in SCATTERS:
            rng = np.random.default_rng([count, round(10 * scatter)])
            held = np.mean([held_of(rng, count, scatter) for _ in range(trials)], axis=0)
            page.row(count, f"{scatter:g}", *(f"{share:.1%}" for share in held))


if __name__ == "__main__":
    main()
