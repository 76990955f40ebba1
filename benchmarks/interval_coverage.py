"""Count how often intervals of fits hold the truth: ``make coverage``.

Each trial adds its rows to a file at once, and is not done again when the program is started again.
"""

import argparse
import math
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
from pieces import Q_LOW, cropped, cut_out, of_parent, rms_of_piece, tilted

import roughline as rl

HURST_WINDOWS = ((0.1, 0.4), (0.4, 0.7), (0.7, 0.95))
ROLL_OFFS = (4, 16)
CUTOFFS = (0.35, 0.8)  # of the Nyquist wavenumber
MAPS = {128: 400, 256: 400, 512: 200, 1024: 40}  # points along a side, and how many
CUTS = {256: 200, 1024: 200, 4096: 200}
MAP_OF, CUT_OF = 4, 8  # length of the parent

FIT_KEY = ["kind", "points", "number"]
FITTED = {"hurst": "H", "roll": "roll-off", "cut": "cutoff", "rms": "rms"}


def fit_trial(kind, points, number):
    """Fit one map or one line scan."""
    rng = np.random.default_rng([kind == "map", points, number])
    hurst = rng.uniform(*HURST_WINDOWS[number % 3])
    roll = rng.choice([0.0, rng.uniform(*ROLL_OFFS)])
    cut = points / 2 * rng.choice([1.0, rng.uniform(*CUTOFFS)])
    if kind == "map":
        parent = of_parent(hurst, roll, cut, MAP_OF)
        piece = cropped(parent, points, rng, ("fixed", "gaussian")[number // 3 % 2])
        spectrum = rl.isotropic_spectrum(replace(piece, heights=tilted(piece.heights, rng)))
    else:
        parent = of_parent(hurst, roll, cut, CUT_OF)
        heights = tilted(cut_out(parent, points, rng), rng)
        spectrum = rl.profile_spectrum(rl.Line(heights, 1.0, kind="profile"))
    start = time.perf_counter()
    fit = rl.fit_self_affine(spectrum)
    row = {"seconds": time.perf_counter() - start}
    cut = min(cut, fit.q_last / Q_LOW)  # no fit sees beyond
    for name, true, value, interval in (
        ("hurst", hurst, fit.hurst, fit.hurst_interval),
        ("roll", parent.q_roll, fit.q_roll or 0.0, fit.q_roll_interval),
        ("cut", Q_LOW * cut, fit.q_high or fit.q_last, fit.q_high_interval),
        ("rms", rms_of_piece(parent), fit.rms_height, fit.rms_interval),
    ):
        row |= {name: true, f"{name}_fitted": value}
        row |= dict(zip((f"{name}_low", f"{name}_high"), interval, strict=True))
    yield row


def recorded(file, key, trials, rows_of):
    """Do the trials that a file lacks, and return all that it has."""
    there = set()
    if file.exists():
        there = set(pd.read_csv(file)[key].itertuples(index=False, name=None))
    left = [trial for trial in trials if trial not in there]
    start = time.perf_counter()
    for done, trial in enumerate(left, 1):
        rows = pd.DataFrame(dict(zip(key, trial, strict=True)) | row for row in rows_of(*trial))
        rows.to_csv(file, mode="a", header=not file.exists(), index=False)
        minutes = (time.perf_counter() - start) / 60 * (len(left) - done) / done
        line = f"\r{file.stem}: {done} of {len(left)} trials, {minutes:.0f} min left   "
        print(line, end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return pd.read_csv(file)


def evenly(counts):
    """Trials of all kinds, each kind's spread evenly over the whole; the numbers come last."""
    trials = [(i / count, (*kind, i)) for kind, count in counts.items() for i in range(count)]
    return [trial for _, trial in sorted(trials, key=lambda each: each[0])]


def held(rows, name):
    """Share of intervals that hold the truth."""
    inside = (rows[f"{name}_low"] <= rows[name] * (1 + 1e-9)) & (
        rows[name] <= rows[f"{name}_high"] * (1 + 1e-9)
    )
    return f"{inside.mean():.1%}"


def width(rows, name):
    """Median of the upper end over the lower one."""
    with np.errstate(divide="ignore"):
        return f"{np.median(rows[f'{name}_high'] / rows[f'{name}_low']):.2f}"


def fit_cells(rows):
    """What a table says of some fits."""
    rolled = rows[rows.roll > Q_LOW]
    ended = rows[rows.cut < rows.groupby(["kind", "points"]).cut.transform("max")]
    return [
        len(rows),
        *(held(rows, name) for name in FITTED),
        f"{(rows.hurst_fitted - rows.hurst).mean():+.3f}",
        f"{(rows.hurst_high - rows.hurst_low).median():.2f}",
        width(rolled, "roll"),
        width(ended, "cut"),
        width(rows, "rms"),
    ]


def fit_tables(rows):
    """By size, and by exponent."""
    columns = ["pieces", *(f"{name} held" for name in FITTED.values()), "mean error of H"]
    columns += ["width: H", "roll-off", "cutoff", "rms"]
    sizes = {"map": "{0} x {0}", "scan": "{0} points"}
    table(["piece", *columns])
    for (kind, points), some in rows.groupby(["kind", "points"]):
        cells(f"{kind}, {sizes[kind].format(points)}", *fit_cells(some))
    table(["piece", "H", *columns])
    for kind in ("map", "scan"):
        for low, high in HURST_WINDOWS:
            some = rows[(rows.kind == kind) & rows.hurst.between(low, high)]
            if len(some):
                cells(kind, f"{low} to {high}", *fit_cells(some))


def table(columns):
    """Print the head of a table."""
    print()
    cells(*columns)
    cells(*("---" for _ in columns))


def cells(*values):
    """Print a row."""
    print(f"| {' | '.join(str(value) for value in values)} |")


def main():
    """Run the study, and print its tables."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--part", type=float, default=1.0, help="of all trials")
    parser.add_argument("--folder", type=Path, default=Path("out/coverage"))
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    print(f"roughline {rl.__version__}")
    pieces = [("map", MAPS), ("scan", CUTS)]
    counts = {(kind, points): n for kind, sizes in pieces for points, n in sizes.items()}
    trials = evenly({kind: math.ceil(n * arguments.part) for kind, n in counts.items()})
    fit_tables(recorded(arguments.folder / "fits.csv", FIT_KEY, trials, fit_trial))


if __name__ == "__main__":
    main()
