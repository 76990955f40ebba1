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
X = np.linspace(-1, 1, FORCE.size)


def curves(rng, count, scatter):
    """Realisations of 0.8 F^0.6, with scatter that loads share, and their true mean."""
    factor, tilt = rng.normal(0, scatter, (count, 1)), rng.normal(0, 0.3 * scatter, (count, 1))
    logs = factor + tilt * X + rng.normal(0, 0.1 * scatter, (count, X.size))
    variance = scatter**2 * (1 + (0.3 * X) ** 2 + 0.1**2)
    law = 0.8 * FORCE**0.6
    return law * np.exp(logs - variance / 2), law


def trial(rng, count, scatter):
    """Whether each interval holds its truth."""
    values, law = curves(rng, count, scatter)
    others, _ = curves(rng, LINES, scatter)
    average = rl.average(values)
    fit = rl.fit_power_law(FORCE, values, WINDOW)
    _, low, high = relative_difference(values, others, paired=False)
    resampled = bootstrap.means(values)
    logs = np.log(resampled.values)
    weights = np.polyfit(np.log(FORCE), np.eye(FORCE.size), 1)[0]
    apart = np.log(bootstrap.means(values).values / bootstrap.means(others, 1).values)[:, LOAD]
    ends = np.quantile(apart, [0.025, 0.975])
    percentiles = [np.quantile(each, [0.025, 0.975]) for each in (logs[:, LOAD], logs @ weights)]
    return (
        average.low[LOAD] <= law[LOAD] <= average.high[LOAD],
        fit.exponent_interval[0] <= 0.6 <= fit.exponent_interval[1],
        fit.prefactor_interval[0] <= 0.8 <= fit.prefactor_interval[1],
        low[LOAD] <= 0 <= high[LOAD],
        percentiles[0][0] <= np.log(law[LOAD]) <= percentiles[0][1],
        percentiles[1][0] <= 0.6 <= percentiles[1][1],
        ends[0] <= 0 <= ends[1],
    )


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--trials", type=int, default=2000)
    trials = parser.parse_args().trials
    page = Page("", "Bootstrap intervals", "bootstrap-coverage")  # printed alone
    page.say(f"{trials} ensembles a row.\n")
    others = f"over {LINES} others"
    measures = ("mean", "α", "ζ", others, "percentiles: mean", "α", others)
    page.table("realisations", "scatter", *measures)
    for count in COUNTS:
        for scatter in SCATTERS:
            rng = np.random.default_rng([count, round(10 * scatter)])
            held = np.mean([trial(rng, count, scatter) for _ in range(trials)], axis=0)
            page.row(count, f"{scatter:g}", *(f"{share:.1%}" for share in held))


if __name__ == "__main__":
    main()
