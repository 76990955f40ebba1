"""Count how often intervals of fits and of pressed line scans hold the truth: ``make coverage``.

Each trial adds its rows to a file at once, and is not done again when the program is started again.
"""

import argparse
import math
import sys
import time
from dataclasses import replace
from functools import cache
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
from pieces import Q_LOW, cropped, cut_out, of_parent, of_piece, rms_of_piece, tilted

import roughline as rl

HURST_WINDOWS = ((0.1, 0.4), (0.4, 0.7), (0.7, 0.95))
ROLL_OFFS = (4, 16)
CUTOFFS = (0.35, 0.8)  # of the Nyquist wavenumber
MAPS = {128: 400, 256: 400, 512: 200, 1024: 40}  # points along a side, and how many
CUTS = {256: 200, 1024: 200, 4096: 200}
MAP_OF, CUT_OF, SCAN_OF = 4, 8, 4  # length of the parent

HURSTS = (0.2, 0.5, 0.8, 1.0)
SCAN_ROLL_OFFS = (0, 2, 4, 12)  # 0: none
SCANS = {128: 80, 256: 40, 1024: 30}  # points, and how many of each law
FROM_SURFACES = 256  # points up to which scans are rows of surfaces
FULL_MODEL = 128  # points of the scans that are held against it
LOADS = np.array([0.01, 0.1, 1.0])  # F / (E* h L)
TRUE_LINES = 400
SPRINGS_A_POINT = 16

FIT_KEY = ["kind", "points", "number"]
SCAN_KEY = ["points", "hurst", "roll", "number"]
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


@cache
def true_lines(hurst, roll, points):
    """Stiffness of reduced lines of the true spectrum, over (line, load), and the forces."""
    spectrum = of_piece(of_parent(hurst, roll, points / 2, SCAN_OF))
    springs = SPRINGS_A_POINT * points
    forces = LOADS * spectrum.lattice(springs, "line").rms_height
    seed = [round(10 * hurst), roll, points]
    lines = (spectrum.line(springs, np.random.default_rng([*seed, i])) for i in range(TRUE_LINES))
    stiffness = [rl.press(line, E_star=1.0, forces=forces).stiffness for line in lines]
    return np.array(stiffness), forces


def scan_trial(points, hurst, roll, number):
    """Press one line scan, and the piece of the surface that it was cut from."""
    rng = np.random.default_rng([points, round(10 * hurst), roll, number])
    parent = of_parent(hurst, roll, points / 2, SCAN_OF)
    stiffness, forces = true_lines(hurst, roll, points)
    full = np.full(LOADS.size, math.nan)
    if points <= FROM_SURFACES:
        piece = cropped(parent, points, rng, "gaussian")
        heights = piece.heights[rng.integers(points)]
        if points == FULL_MODEL:
            full = rl.press(piece.detrended(), E_star=1.0, forces=forces, rtol=1e-4).stiffness
    else:
        heights = cut_out(parent, points, rng)
    scan = rl.Line(tilted(heights, rng), 1.0, kind="profile")
    start = time.perf_counter()
    pressed = rl.press_scan(scan, E_star=1.0, forces=forces, rng=number)
    seconds = time.perf_counter() - start
    within = (pressed.low <= stiffness) & (stiffness <= pressed.high)
    for i, load in enumerate(LOADS):
        yield {
            "load": load,
            "seconds": seconds,
            "stiffness": pressed.curve.stiffness[i],
            "low": pressed.low[i],
            "high": pressed.high[i],
            "true": np.exp(np.log(stiffness[:, i]).mean()),
            "lines_held": within[:, i].mean(),
            "full": full[i],
        }


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


def scan_cells(rows, truth):
    """Of each load: ratio of geometric means, and share of intervals that hold the truth."""
    inside = (rows.low <= rows[truth]) & (rows[truth] <= rows.high)
    ratio = np.exp(np.log(rows.stiffness / rows[truth]).groupby(rows.load).mean())
    return [
        " / ".join(f"{each:.2f}" for each in ratio),
        " / ".join(f"{each:.0%}" for each in inside.groupby(rows.load).mean()),
    ]


def scan_tables(rows):
    """By law and by number of points, against true lines and against the full model."""
    loads = "for F / (E* h L) = " + " / ".join(f"{load:g}" for load in LOADS)
    key = ["points", "hurst", "roll"]
    groups = [
        *(((points, "all", "all"), some) for points, some in rows.groupby("points")),
        *rows.groupby(key),
    ]
    print(f"\n{loads}")
    columns = ["k over true lines", "their mean held", "single lines held", "interval: factor"]
    table(["points", "H", "roll-off", "scans", *columns])
    for names, some in groups:
        lines = " / ".join(f"{each:.0%}" for each in some.groupby("load").lines_held.mean())
        widths = np.sqrt(some.high / some.low).groupby(some.load).median()
        spans = " / ".join(f"{each:.2f}" for each in widths)
        scans = len(some) // LOADS.size
        cells(*named(names), scans, *scan_cells(some, "true"), lines, spans)
    table(["points", "H", "roll-off", "scans", "k over the full model", "it is held"])
    for names, some in groups:
        solved = some[some.full.notna()]
        if len(solved):
            cells(*named(names), len(solved) // LOADS.size, *scan_cells(solved, "full"))


def named(names):
    """Return points, H and roll-off as a table has them."""
    points, hurst, roll = names
    return points, hurst, roll if roll else "none"


def table(columns):
    """Print the head of a table."""
    print()
    cells(*columns)
    cells(*("---" for _ in columns))


def cells(*values):
    """Print a row."""
    print(f"| {' | '.join(str(value) for value in values)} |")


def main():
    """Run both studies, or one, and print their tables."""
    parser = argparse.ArgumentParser()
    parser.add_argument("studies", nargs="*", default=["fits", "scans"])
    parser.add_argument("--part", type=float, default=1.0, help="of all trials")
    parser.add_argument("--folder", type=Path, default=Path("out/coverage"))
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    print(f"roughline {rl.__version__}")
    if "fits" in arguments.studies:
        pieces = [("map", MAPS), ("scan", CUTS)]
        counts = {(kind, points): n for kind, sizes in pieces for points, n in sizes.items()}
        trials = evenly({kind: math.ceil(n * arguments.part) for kind, n in counts.items()})
        fit_tables(recorded(arguments.folder / "fits.csv", FIT_KEY, trials, fit_trial))
    if "scans" in arguments.studies:
        laws = product(SCANS, HURSTS, SCAN_ROLL_OFFS)
        trials = evenly({law: math.ceil(SCANS[law[0]] * arguments.part) for law in laws})
        scan_tables(recorded(arguments.folder / "scans.csv", SCAN_KEY, trials, scan_trial))


if __name__ == "__main__":
    main()
