"""Follow random paths with friction, and compare each state with a solution node by node.

``make friction-paths`` writes a part of ``docs/measured.md``. Every path that was followed is a row
of a file, from which it goes on.
"""

import argparse
import csv
import sys
from pathlib import Path

import numpy as np
from numba import set_num_threads
from page import Page

import roughline as rl

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from halfspace.friction.dense_friction import DensePath, dense_matrix

PATHS, LOADS = 1000, 8
BETAS = 0.0, 2 / 7, -2 / 7, 0.5
LEGS = "presses", "shears", "turns", "unloads", "reverses"
COLUMNS = "path", "side", "boundary", "beta", "nodes", "legs", "off", "status"
RTOL, SAME = 1e-10, 1e-8  # the largest difference that counts as none, of the largest pressure


def random_path(number):
    """Return a body, its friction, and depths and slides along legs of a random path."""
    rng = np.random.default_rng([72, number])
    shape = tuple(int(each) for each in rng.integers(8, 13, size=2))
    spacing = (1.0, float(rng.choice([1.0, rng.uniform(0.5, 2.0)])))
    periodic, beta = bool(number % 2), BETAS[number // 2 % 4]
    poisson = rng.uniform(0.0, 0.5) if beta == 0 else {2 / 7: 0.3, 0.5: 0.0}[abs(beta)]
    sizes = shape[0] * spacing[0], shape[1] * spacing[1]
    surface = rl.Surface(rng.uniform(0.02, 0.2) * rng.normal(size=shape), sizes=sizes)
    separation = surface.heights.max() - surface.heights
    deepest = separation.mean() * (0.85 if periodic else 4.0)
    depth, slide = deepest * rng.uniform(0.2, 0.8), np.zeros(2)
    step, legs, depths, slides = np.zeros(2), [], [], []
    for _ in range(LOADS):
        leg = rng.choice(LEGS) if depths else "presses"
        size = deepest * rng.exponential(0.15)
        if leg == "presses":
            depth = min(deepest, depth + rng.uniform(0.0, 0.4) * deepest) if depths else depth
            step = step * rng.uniform(0.0, 1.0)
        elif leg == "unloads":
            depth = max(0.02 * deepest, depth * rng.uniform(0.4, 1.0))
        elif leg == "reverses":
            step = -step * rng.uniform(0.2, 1.5)
        else:
            angle = rng.uniform(0.0, 2 * np.pi)
            if leg == "shears":
                depth = depth * rng.choice([1.0, rng.uniform(0.9, 1.1)])
            step = size * np.array([np.cos(angle), np.sin(angle)])
        slide = slide + step
        legs.append(leg[0])
        depths.append(float(depth))
        slides.append(slide)
    body = rl.Homogeneous(1.0, periodic, poisson=float(poisson), beta=beta)
    return surface, spacing, body, rng.uniform(0.1, 0.8), depths, slides, "".join(legs)


def followed(number):
    """Return how far the states of a path are from those node by node, as a row of the file."""
    surface, spacing, body, mu, depths, slides, legs = random_path(number)
    curve = rl.press(
        surface,
        half_space=body,
        friction=rl.Friction(mu),
        depths=depths,
        slides=slides,
        fields=True,
        throw=False,
        rtol=RTOL,
        solver=rl.Solver(precision="float64"),
    )
    n, shape = body.poisson / (1 - body.poisson), surface.shape
    matrix = dense_matrix(shape, spacing, n=n, beta=body.beta, periodic=all(body.repeats))
    path = DensePath(matrix, surface.heights.max() - surface.heights, mu)
    off, nodes = 0.0, 0
    for depth, slide, fields in zip(depths, slides, curve.fields, strict=True):
        if fields is None:
            break
        x, y, pressure = path.to(depth, slide).traction
        found = fields.shear.reshape(-1, 2).T
        parts = found - (x, y), fields.pressure.ravel() - pressure
        off = max(off, *(float(np.abs(each).max()) / pressure.max() for each in parts))
        nodes = max(nodes, int(np.count_nonzero(pressure)))
    ended = sorted({rl.Status(each).name.lower() for each in curve.status} - {"converged"})
    shown = f"{shape[0]}x{shape[1]}", body.boundary, f"{body.beta:.4g}", nodes, legs, f"{off:.3g}"
    return number, *shown, " ".join(ended) or "converged"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("file", type=Path, help="rows of the paths so far, which are kept")
    parser.add_argument("--paths", type=int, default=PATHS)
    asked = parser.parse_args()
    set_num_threads(1)
    done = set()
    if asked.file.exists():
        with asked.file.open(newline="") as file:
            done = {int(row["path"]) for row in csv.DictReader(file)}
    else:
        asked.file.write_text(",".join(COLUMNS) + "\n")
    for number in sorted(set(range(asked.paths)) - done):
        with asked.file.open("a", newline="") as file:
            csv.writer(file).writerow(followed(number))
    with asked.file.open(newline="") as file:
        rows = [row for row in csv.DictReader(file) if int(row["path"]) < asked.paths]
    page = Page("friction-paths", "measured.md", "friction-paths", f"roughline {rl.__version__}")
    page.say(f"{len(rows)} paths of {LOADS} loads each.")
    page.table("boundary", "beta", "paths", "certified", "worst difference", "median")
    for boundary in ("free", "periodic"):
        for beta in map("{:.4g}".format, BETAS):
            here = [row for row in rows if (row["boundary"], row["beta"]) == (boundary, beta)]
            off = [float(row["off"]) for row in here if row["status"] == "converged"]
            page.row(
                boundary, beta, len(here), len(off), f"{max(off):.1e}", f"{np.median(off):.1e}"
            )
    page.save()
    wrong = [row for row in rows if row["status"] != "converged" or float(row["off"]) > SAME]
    print(*(wrong or ["all are the same"]), sep="\n")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
