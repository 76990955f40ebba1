"""Compare estimated grid errors with grids four times finer: ``make grid-error``.

Surfaces are made as workshops make them (benchmarks/made_surfaces.py), and maps of them hold means
of four by four points or every fourth one; self-affine surfaces are made on two grids with one seed
as well. Loads F / (E* h L) go from 0.003 to 1, as far as they are below half the hardness. Bodies
are elastic, or yield at a hardness of 0.03 to 1 times E* and the rms slope of the finer grid; their
last load is unloaded to three tenths. Measured files given as arguments are cut into quarters: each
is the finer grid, and its means of four by four points are the map.

Cases are appended to a file and not computed again. ``--part 2/8`` computes the second of every
eight.
"""

import argparse
import json
import math
import sys
from pathlib import Path

import numpy as np
from made_surfaces import (
    GAUSSIAN,
    KINDS,
    Make,
    parent_of,
    piece_of,
    pixel_means,
    points_of_rougher,
)

import roughline as rl

LOADS = np.geomspace(0.003, 1.0, 6)  # F / (E* h L)
HARDNESSES = np.geomspace(0.03, 1.0, 11)  # H / (E* times the rms slope of the finer grid)
HURSTS = (0.2, 0.4, 0.6, 0.8, 1.0)
CELLS = (0.0, 4.0, 8.0, 16.0)  # points of the finer grid to the shortest wave
SAMPLINGS = {"means": pixel_means, "points": points_of_rougher}
ON_TWO_GRIDS = {  # cutoffs count in cells of the coarser grid
    "one seed, rough down to the grid": lambda n: {},
    "one seed, roll-off at L / 6": lambda n: {"q_roll": 12 * math.pi},
    "one seed, roll-off at L / 6, cutoff at 4 cells": lambda n: {
        "q_roll": 12 * math.pi,
        "q_high": math.tau * n / 4,
    },
    "one seed, cutoff at 2.2 cells": lambda n: {"q_high": math.tau * n / 2.2},
    "one seed, cutoff at 8 cells": lambda n: {"q_high": math.tau * n / 8},
}
QUANTITIES = {  # symbol: quantity, its error
    "k_u": ("unloading_stiffness", "unloading_stiffness_error"),
    "k": ("stiffness", "stiffness_error"),
    "A": ("area_fraction_corrected", "area_fraction_error"),
}
E_STAR = 1.0


def made(kind, seed, points=None):
    """A kind's maps, each with its finer grid: a Hurst exponent and cutoff for each seed."""
    rng = np.random.default_rng([seed, *kind.encode()])
    hurst, cells = HURSTS[seed % 5], CELLS[seed % 4]
    n = points or (128 if seed % 6 == 5 else 64)
    if kind in ON_TWO_GRIDS:
        spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0, **ON_TWO_GRIDS[kind](n))
        return {"one seed": spectrum.surface(n, seed)}, spectrum.surface(4 * n, seed)
    make = Make(points=4 * n, maps=2, hurst=hurst, waves=float(rng.uniform(3, 12)), cells=cells)
    finer = piece_of(parent_of(kind, make, rng), make, rng)
    return {
        name: rl.Surface(sampled(finer.heights, 4, rng), finer.sizes, unit="m")
        for name, sampled in SAMPLINGS.items()
    }, finer


def quarter(file, which):
    """A quarter of a measured map, and its means of four by four points."""
    whole = rl.prepared(rl.read(file))
    sides = [[(0, n // 2), (n // 2, n)] for n in whole.shape]
    finer = whole.cropped(sides[0][which // 2], sides[1][which % 2])
    finer = finer.cropped(*((0, n - n % 16) for n in finer.shape))
    return {"means": finer.coarsened().coarsened()}, finer


def judged(surface, finer, over_slope):
    """Logarithms of the true and the claimed factors of each load, by quantity."""
    forces = LOADS * E_STAR * finer.rms_height * finer.length
    hardness = None
    if over_slope is not None:
        hardness = over_slope * E_STAR * finer.rms_slope
        forces = forces[forces < hardness * finer.area / 2]
        if not forces.size:
            return {}
        forces = np.append(forces, 0.3 * forces[-1])
    curve, truth = (
        rl.press(
            each,
            E_star=E_STAR,
            forces=forces,
            hardness=hardness,
            grid_error=each is surface,
            throw=False,
        )
        for each in (surface, finer)
    )
    found = {}
    for symbol, (name, error) in QUANTITIES.items():
        with np.errstate(invalid="ignore", divide="ignore"):  # no k where all of the contact yields
            off = np.abs(np.log(getattr(truth, name) / getattr(curve, name)))
            claimed = np.log1p(getattr(curve, error) / getattr(curve, name))
        known = curve.resolved & np.isfinite(off)
        found[symbol] = off[known].tolist(), np.nan_to_num(claimed[known], nan=np.inf).tolist()
    return found


def cases(arguments):
    """Names of the cases and how each one is judged."""
    for seed in range(arguments.first_seed, arguments.first_seed + arguments.seeds):
        for kind in [*KINDS, *ON_TWO_GRIDS]:
            order = np.random.default_rng(seed).permutation(HARDNESSES)
            yield (
                kind,
                seed,
                [None, *order[: arguments.hardnesses]],
                lambda k=kind, s=seed: made(k, s),
            )
    for file in arguments.files:
        for which in range(4):
            name = f"quarters of {Path(file).name}"
            yield name, which, [None, *HARDNESSES[2::3]], lambda f=file, w=which: quarter(f, w)


def rows_of(arguments):
    """Compute what the file of rows lacks, and return all its rows."""
    path, (part, parts) = Path(arguments.rows), map(int, arguments.part.split("/"))
    rows = [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []
    done = {(row["kind"], row["seed"]) for row in rows}
    for count, (kind, seed, hardnesses, make) in enumerate(cases(arguments)):
        if count % parts != part - 1 or (kind, seed) in done:
            continue
        maps, finer = make()
        row = {"kind": kind, "seed": seed, "found": []}
        for sampling, surface in maps.items():
            for over_slope in hardnesses:
                found = judged(surface, finer, over_slope)
                row["found"].append([sampling, over_slope and round(over_slope, 3), found])
        rows.append(row)
        with path.open("a") as file:
            file.write(json.dumps(row) + "\n")
        print(".", end="", file=sys.stderr, flush=True)
    return rows


def table(rows, title, group, symbols):
    """Print shares that held, and widths over those that just hold 95 %, by group."""
    pooled = {}
    for row in rows:
        for sampling, over_slope, found in row["found"]:
            if (key := group(row["kind"], sampling, over_slope)) is None:
                continue
            for symbol, pair in found.items():
                pooled.setdefault(key, {}).setdefault(symbol, []).append(np.array(pair))
    print(
        f"\n| {title} | loads |"
        + "".join(f" {s}: held | off by | claimed | width |" for s in symbols)
    )
    print("|---" * (2 + 4 * len(symbols)) + "|")
    for key in sorted(pooled, key=str):
        cells, size = [], 0
        for symbol in symbols:
            pairs = pooled[key].get(symbol)
            off, claimed = np.hstack(pairs) if pairs else np.empty((2, 0))
            if not off.size:
                cells += [""] * 4
                continue
            size = max(size, off.size)
            width = 1 / np.quantile(off / np.maximum(claimed, 1e-300), 0.95)
            factors = [f"{np.exp(np.median(each)):.3f}" for each in (off, claimed)]
            cells += [f"{np.mean(off <= claimed):.0%}", *factors, f"{width:.2f}"]
        print(f"| {key} | {size} | {' | '.join(cells)} |")


def group_of(kind):
    """Measured maps each, and whether the models of intervals are exact for a made kind."""
    if kind.startswith("quarters"):
        return kind
    return "Gaussian" if kind in GAUSSIAN or kind in ON_TWO_GRIDS else "others"


def main():
    """Compute and print the tables."""
    parser = argparse.ArgumentParser()
    parser.add_argument("files", nargs="*")
    parser.add_argument("--seeds", type=int, default=12)
    parser.add_argument("--first-seed", type=int, default=1000)
    parser.add_argument("--hardnesses", type=int, default=3, help="of each surface, drawn by seed")
    parser.add_argument("--part", default="1/1")
    parser.add_argument("--rows", default="grid-error-rows.jsonl")
    arguments = parser.parse_args()
    rows = rows_of(arguments)
    print(f"\nroughline {rl.__version__}, loads F / (E* h L) = 0.003 to 1")
    table(
        rows,
        "H over E*∇h",
        lambda kind, sampling, hard: f"{hard:.3f}" if isinstance(hard, float) else None,
        [*QUANTITIES],
    )
    table(
        rows,
        "surfaces",
        lambda kind, sampling, hard: (
            f"{group_of(kind)}, {sampling}, {'elastic' if hard is None else 'yielding'}"
        ),
        [*QUANTITIES],
    )


if __name__ == "__main__":
    main()
