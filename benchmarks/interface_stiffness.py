"""Compare the interface stiffness of pieces with that of the surface behind them.

``make interface-stiffness``. Each parent is a periodic surface. Pieces of it, without their tilt,
are pressed into a free and into a periodic half-space under the mean pressures of the parent, and
their stiffness per area is divided by its. Rows go to a file as they are made; what is there is not
made again. Of instrument files given as arguments the whole map is the parent, and its quarters are
the pieces. With ``--hardness-bar BAR`` the bodies yield at BAR times the rms slope of the parent,
and the stiffness is that of unloading.
"""

import argparse
import csv
import math
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.special import erfinv

import roughline as rl
from roughline.assessment.larger_surface import roll_offs_along_a_side
from roughline.assessment.pieces import AREA_OF_ONE, STIFFNESS_OF_ONE, share_of_the_whole
from roughline.engineering.answers import saturated_stiffness
from roughline.engineering.formulas import interface_stiffness

# wanted contact area fractions of the parent, about
WANTED = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.33, 0.5, 0.65, 0.8, 0.9, 0.95)
NUMBERS = ("wanted", "touching", "resolved", "free", "periodic", "roll_offs", "area")
FIELDS = ("kind", "n", "m", "cells", "hurst", "waves", "seed", *NUMBERS)
SHOWN = (0.01, 0.05, 0.2, 0.33, 0.5, 0.65, 0.8, 0.9)


def cases():
    """Kind; points of parent and piece, cells to the shortest wave, H, roll-offs a side, seed."""
    for seed in range(3):
        for waves in (0.25, 1, 4, 16, 2, 8, 0.5):
            for hurst in (0.8, 0.2, 1.0, 0.5):
                cells = 4 if seed % 2 or waves == 16 else 8
                yield "chosen on", 512, 128, cells, hurst, waves, seed
    for seed in (20, 21):
        for waves in (0.35, 0.7, 1.5, 3, 6, 12):
            for hurst in (0.35, 0.65, 0.9):
                yield ("other" if seed == 20 else "half as wide"), 448, 112, 4, hurst, waves, seed
    for waves in (3, 6, 12):
        for hurst in (0.3, 0.8):
            yield "worn", 512, 128, 4, hurst, waves, 30
    for waves in (2, 8):
        for hurst in (0.5, 0.8):
            yield "larger", 1024, 256, 8, hurst, waves, 10


def parent_and_pieces(kind, n, m, cells, hurst, waves, seed):
    """A surface, and pieces on its diagonal."""
    roll = {} if waves * n <= m else {"q_roll": math.tau * waves * n / m}
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1e-2, q_high=math.tau * n / cells, **roll)
    whole = spectrum.surface(n, 1000 + seed)
    if kind == "worn":  # summits above the rms height are pressed flat to a tenth
        h = whole.heights
        whole = replace(whole, heights=np.where(h > 1e-2, 1e-2 + (h - 1e-2) / 10, h))
    width = m // 2 if kind == "half as wide" else m
    return whole, [whole.cropped((i, i + m), (i, i + width)) for i in range(0, n, m)]


def map_and_quarters(file):
    """A measured map on at most 600 points a side, and its quarters."""
    whole = rl.prepared(rl.read(file))
    while min(whole.shape) > 600:
        whole = whole.cropped(*((0, n - n % 2) for n in whole.shape)).coarsened()
    halves = [[(0, n // 2), (n // 2, n)] for n in whole.shape]
    return whole, [whole.cropped(x, y) for x in halves[0] for y in halves[1]]


def rows(whole, pieces, hardness_bar):
    """Ratios of pieces to their parent, at each load."""
    # erf(sqrt(2) p / (E* slope)) of an elastic surface is in contact, or about so (Persson 2001)
    pressure = whole.rms_slope * erfinv(WANTED) / math.sqrt(2)
    given, name = {"E_star": 1.0, "throw": False}, "stiffness"
    if hardness_bar is not None:
        given["hardness"], name = hardness_bar * whole.rms_slope, "unloading_stiffness"
        pressure = 1 / (1 / pressure + 1 / (given["hardness"] * np.array(WANTED)))
    truth = rl.press(whole, forces=pressure * whole.area, periodic=True, **given)
    stiffness = getattr(truth, name) / whole.area
    for piece in (each.detrended() for each in pieces):
        free, periodic = (
            rl.press(piece, forces=pressure * piece.area, periodic=each, **given)
            for each in (False, True)
        )
        own = interface_stiffness(getattr(free, name), saturated_stiffness(piece, 1.0))
        ratio = getattr(periodic, name) / piece.area / stiffness
        roll_offs = roll_offs_along_a_side(piece)
        for i, wanted in enumerate(WANTED):
            yield (
                wanted,
                periodic.area_fraction_corrected[i],
                float(periodic.resolved[i] and np.isfinite(ratio[i])),
                own[i] / piece.area / stiffness[i],
                ratio[i],
                roll_offs or math.nan,
                periodic.area_fraction_corrected[i] / truth.area_fraction_corrected[i],
            )


def measured(file, files, hardness_bar):
    """Make the rows that the file lacks, and read all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    if not file.exists():
        file.write_text(",".join(FIELDS) + "\n")
    with file.open() as stream:
        there = {tuple(row[:7]) for row in csv.reader(stream)}
    todo = [(case, parent_and_pieces) for case in cases()]
    todo += [((f"quarters of {each.name}", *"000000"), each) for each in files]
    for case, make in todo:
        if tuple(map(str, case)) in there:
            continue
        found = map_and_quarters(make) if isinstance(make, Path) else make(*case)
        made = rows(*found, hardness_bar)
        lines = [[*case, *(f"{number:.5g}" for number in row)] for row in made]
        with file.open("a", newline="") as stream:
            csv.writer(stream).writerows(lines)
        print(".", end="", file=sys.stderr, flush=True)
    table = np.genfromtxt(file, delimiter=",", names=True, dtype=None, encoding="utf-8")
    return table[table["resolved"] == 1]


def print_ratios(table):
    """Print medians, and between what 90 of 100 lie."""
    print("| roll-offs a side | half-space | " + " | ".join(f"{each:.0%}" for each in SHOWN) + " |")
    print("|---" * (2 + len(SHOWN)) + "|")
    for waves in np.unique(table["waves"]):
        for boundary in ("free", "periodic"):
            cells = []
            for wanted in SHOWN:
                here = (table["waves"] == waves) & (table["wanted"] == wanted)
                low, middle, high = np.quantile(table[boundary][here], (0.05, 0.5, 0.95))
                cells.append(f"{middle:.2f} ({low:.2f}–{high:.2f})")
            print(f"| {waves:g} | {boundary} | {' | '.join(cells)} |")


def shares(here, of):
    """Both ends of the whole over its pieces, (loads, 2)."""
    return np.array(
        [
            share_of_the_whole(share, None if np.isnan(roll_offs) else roll_offs, of)
            for share, roll_offs in zip(here["touching"], here["roll_offs"], strict=True)
        ]
    )


def held(ends, truth):
    """Share of intervals that hold the truth."""
    return np.mean((ends[:, 0] <= truth) & (truth <= ends[:, 1]))


def print_coverage(table):
    """Print how often the interval holds the parent, and how wide it is."""
    print(
        "\n| pieces | roll-offs a side | loads | none seen | covered | from | to | area covered |"
    )
    print("|---|---|---|---|---|---|---|---|")
    for kind in dict.fromkeys(table["kind"]):
        for waves in np.unique(table["waves"][table["kind"] == kind]):
            here = table[(table["kind"] == kind) & (table["waves"] == waves)]
            ends = shares(here, STIFFNESS_OF_ONE)
            covered = held(ends, 1 / here["periodic"])
            area = held(shares(here, AREA_OF_ONE), 1 / here["area"])
            usual = (here["touching"] > 0.02) & (here["touching"] < 0.7)
            low, high = np.median(ends[usual], axis=0)
            none = np.mean(np.isnan(here["roll_offs"]))
            print(
                f"| {kind} | {waves:g} | {here.size} | {none:.0%} | {covered:.1%} | "
                f"{low:.2f} | {high:.2f} | {area:.1%} |"
            )


def main():
    """Measure, and print both tables."""
    parser = argparse.ArgumentParser()
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--hardness-bar", type=float)
    parser.add_argument("--rows", type=Path, default=Path("out/interface_stiffness.csv"))
    arguments = parser.parse_args()
    table = measured(arguments.rows, arguments.files, arguments.hardness_bar)
    print(f"\nroughline {rl.__version__}\n")
    print_ratios(table[table["kind"] == "chosen on"])
    print_coverage(table)


if __name__ == "__main__":
    main()
