"""Press thousands of random bodies: ``make robustness`` writes ``docs/robustness-table.md``."""

import argparse
import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np
from page import Page

import roughline as rl

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from random_problems import E_STAR, random_problem

PROBLEMS, SEED = 3000, 0  # of the handbook's table
SLOWEST = "slowest over median of its size"
_SLOW = 5.0  # times the median of all problems of about the same number of points


def timed(problem):
    """Press a body; return the curve, or the refusal, and the seconds."""
    start = time.perf_counter()
    try:
        outcome = rl.press(
            problem.surface, E_star=E_STAR, periodic=problem.periodic, throw=False, **problem.loads
        )
    except rl.InputError as error:
        outcome = error
    return outcome, time.perf_counter() - start


def slow_beside_others(rows, loads, size_class):
    """Return the time per load of each problem over the median of problems of about its size."""
    per_load = np.array([row[3] for row in rows]) / loads
    slowness = np.full(len(rows), np.nan)
    for size in np.unique(size_class):
        here = size_class == size
        slowness[here] = per_load[here] / np.nanmedian(per_load[here])
    return slowness


def main():
    """Solve the problems and write a table by kind."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--problems", type=int, default=PROBLEMS)
    parser.add_argument("--seed", type=int, default=SEED)
    arguments = parser.parse_args()
    rows, wrong = [], []
    timed(random_problem(np.random.default_rng(0)))  # compiles
    for i in range(arguments.problems):
        problem = random_problem(np.random.default_rng([arguments.seed, i]))
        outcome, seconds = timed(problem)
        points = problem.surface.heights.size
        if isinstance(outcome, rl.InputError):
            rows.append((problem, "refused", points, np.nan, i))
            wrong.append(f"{i}: refused: {outcome}")
            continue
        numbers = (outcome.depth, outcome.force, outcome.stiffness, outcome.area_fraction)
        sound = all(not np.isnan(number).any() for number in numbers)
        certified = outcome.converged.all() and (outcome.residual <= 1e-6).all() and sound
        rows.append((problem, "certified" if certified else "not", points, seconds, i))
        if not certified:
            wrong.append(
                f"{i}: {problem.kind}, {problem.surface.shape}, periodic {problem.periodic}, "
                f"{problem.loading}: {outcome.status}, {outcome.residual}"
            )
    loads = np.array([len(next(iter(row[0].loads.values()))) for row in rows])
    size_class = np.array([int(np.log2(row[2])) for row in rows])
    slowness = slow_beside_others(rows, loads, size_class)
    for i in np.flatnonzero(slowness > _SLOW):  # code that is loaded, or other work, came between
        problem, end, points, seconds, number = rows[i]
        rows[i] = (problem, end, points, min(seconds, timed(problem)[1]), number)
    slowness = slow_beside_others(rows, loads, size_class)
    page = Page("robustness-table.md", "Random problems, and how they ended", "robustness")
    page.say(f"{len(rows)} problems, seed {arguments.seed}.\n")
    page.table("bodies", "problems", "loads", "certified", "refused", SLOWEST)
    kinds = np.array([row[0].kind for row in rows])
    ends = np.array([row[1] for row in rows])
    for kind in [*sorted(set(kinds)), "all"]:
        here = (kinds == kind) | (kind == "all")
        count = Counter(ends[here])
        slowest = f"{np.nanmax(slowness[here]):.1f}"
        ended = (count["certified"], count["refused"])
        page.row(kind, here.sum(), loads[here].sum(), *ended, slowest)
    if (arguments.problems, arguments.seed) == (PROBLEMS, SEED):
        page.save()
    for i in np.flatnonzero(slowness > _SLOW):
        problem, _, _, seconds, number = rows[i]
        wrong.append(
            f"{number}: {slowness[i]:.1f} times the median: {problem.kind}, "
            f"{problem.surface.shape}, spacing {problem.surface.spacing}, periodic "
            f"{problem.periodic}, {problem.loading}, {seconds:.3f} s"
        )
    print("\n" + "\n".join(wrong) if wrong else "\nnothing failed, nothing was slow")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
