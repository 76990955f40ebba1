"""Press thousands of random bodies: ``make robustness`` writes a part of ``docs/measured.md``."""

import argparse
import math
import sys
from pathlib import Path

import numpy as np
import pandas as pd
from page import Page, once

import roughline as rl

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from random_problems import E_STAR, random_problem

PROBLEMS, SEED = 3000, 0  # of the handbook's table
SLOWEST = "slowest over median of its size"
_SLOW = 5.0  # times the median of all problems of about the same number of points


def ended(seed, number):
    """How a problem ended, and in what time. [s]"""
    problem = random_problem(np.random.default_rng([seed, number]))
    surface, given = problem.surface, {"periodic": problem.periodic, **problem.loads}
    told = {
        "kind": problem.kind,
        "points": surface.heights.size,
        "loads": len(next(iter(problem.loads.values()))),
        "case": f"{problem.kind}, {surface.shape}, spacing {surface.spacing}, periodic "
        f"{problem.periodic}, {problem.loading}",
    }
    try:
        curve, seconds = once(lambda: rl.press(surface, E_star=E_STAR, throw=False, **given))
    except rl.InputError as error:
        return told | {"end": "refused", "seconds": math.nan, "why": f"refused: {error}"}
    numbers = (curve.depth, curve.force, curve.stiffness, curve.area_fraction)
    sound = curve.converged.all() and not any(np.isnan(each).any() for each in numbers)
    end = "certified" if sound and (curve.residual <= 1e-6).all() else "not"
    return told | {"end": end, "seconds": seconds, "why": f"{curve.status}, {curve.residual}"}


def slowness_of(rows):
    """Time per load of each problem over the median of problems of about its size."""
    per_load = rows.seconds / rows.loads
    return per_load / per_load.groupby(np.log2(rows.points).astype(int)).transform("median")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--problems", type=int, default=PROBLEMS)
    parser.add_argument("--seed", type=int, default=SEED)
    asked = parser.parse_args()
    ended(0, 0)  # compiles
    rows = pd.DataFrame([ended(asked.seed, number) for number in range(asked.problems)])
    for number in np.flatnonzero(slowness_of(rows) > _SLOW):  # other work came between
        again = ended(asked.seed, number)["seconds"]
        rows.loc[number, "seconds"] = min(rows.seconds[number], again)
    rows["slowness"] = slowness_of(rows)
    page = Page("robustness", "measured.md", "robustness")
    page.say(f"{len(rows)} problems, seed {asked.seed}.")
    page.table("bodies", "problems", "loads", "certified", "refused", SLOWEST)
    for kind in [*sorted(set(rows.kind)), "all"]:
        here = rows[(rows.kind == kind) | (kind == "all")]
        ends = ((here.end == end).sum() for end in ("certified", "refused"))
        page.row(kind, len(here), here.loads.sum(), *ends, f"{here.slowness.max():.1f}")
    if (asked.problems, asked.seed) == (PROBLEMS, SEED):
        page.save()
    wrong, slow = rows[rows.end != "certified"], rows[rows.slowness > _SLOW]
    told = [f"{each.Index}: {each.case}: {each.why}" for each in wrong.itertuples()]
    told += [
        f"{each.Index}: {each.slowness:.1f} times the median: {each.case}, {each.seconds:.3f} s"
        for each in slow.itertuples()
    ]
    print("", *(told or ["nothing failed, nothing was slow"]), sep="\n")
    return bool(told)


if __name__ == "__main__":
    sys.exit(main())
