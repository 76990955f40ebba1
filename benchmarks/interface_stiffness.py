"""Compare the interface stiffness of pieces with that of the surface behind them.

``make interface-stiffness``. Each parent is a periodic surface; its periodic stiffness at a mean
pressure is what all of its pieces stand for. Pieces without their tilt are pressed as they are, into a
free and into a periodic half-space. Rows go to a file as they are made; what is there is not made
again.
"""

import argparse
import csv
import math
import sys
from pathlib import Path

import numpy as np
from scipy.special import erfinv

import roughline as rl
from roughline.answers import saturated_stiffness
from roughline.characterisation import roughness
from roughline.interface import interface_stiffness

SHARES = (
    0.001,
    0.002,
    0.005,
    0.01,
    0.02,
    0.05,
    0.1,
    0.2,
    0.33,
    0.5,
    0.65,
    0.8,
    0.9,
    0.95,
)  # wanted, about
FIELDS = ("parent", "piece", "cells", "hurst", "waves", "seed", "corner", "wanted", "share")
FIELDS += (
    "piece_share",
    "resolved",
    "saturation",
    "free",
    "periodic",
    "rms",
    "fit_waves",
    "fit_least",
)
FIELDS += ("fit_hurst",)


def cases():
    """Points of parent and piece, cells to the shortest wave, H, roll-offs a side, and seed."""
    for seed in range(4):
        for waves in (0.25, 1, 4, 16, 2, 8, 0.5):
            for hurst in (0.8, 0.2, 1.0, 0.5):
                yield 512, 128, (4 if seed % 2 or waves == 16 else 8), hurst, waves, seed
    for waves in (0.125, 2, 8):
        for hurst in (0.8, 0.5):
            yield 1024, 256 if waves > 1 else 128, 8, hurst, waves, 10


def rows(n, m, cells, hurst, waves, seed):
    """Ratios of pieces to their parent, at each load."""
    roll = {} if waves * n <= m else {"q_roll": math.tau * waves * n / m}
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1e-2, q_high=math.tau * n / cells, **roll)
    whole = spectrum.surface(n, 1000 + seed)
    # erf(sqrt(2) p / (E* slope)) of the surface is touched, or about so (Persson 2001)
    pressure = whole.rms_slope * erfinv(SHARES) / math.sqrt(2)
    truth = rl.press(whole, E_star=1.0, forces=pressure * whole.area, periodic=True, throw=False)
    stiffness = truth.stiffness / whole.area
    for corner in range(0, n, n // 4):
        piece = whole.cropped((corner, corner + m), (corner, corner + m)).detrended()
        free, periodic = (
            rl.press(piece, E_star=1.0, forces=pressure * piece.area, periodic=each, throw=False)
            for each in (False, True)
        )
        saturated = saturated_stiffness(piece, 1.0)
        own = interface_stiffness(free.stiffness, saturated) / piece.area / stiffness
        ratio = periodic.stiffness / piece.area / stiffness
        fit = roughness(piece).fit
        longest = math.tau / piece.length
        for i, wanted in enumerate(SHARES):
            numbers = (
                truth.area_fraction_corrected[i],
                periodic.area_fraction_corrected[i],
                periodic.resolved[i],
                free.stiffness[i] / saturated,
                own[i],
                ratio[i],
                piece.rms_height / whole.rms_height,
                (fit.q_roll or 0) / longest,
                fit.q_roll_interval[0] / longest,
                fit.hurst,
            )
            yield [n, m, cells, hurst, waves, seed, corner, wanted, *(f"{x:.5g}" for x in numbers)]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("file", type=Path, nargs="?", default=Path("out/interface_stiffness.csv"))
    arguments = parser.parse_args()
    arguments.file.parent.mkdir(parents=True, exist_ok=True)
    there = set()
    if arguments.file.exists():
        with arguments.file.open() as file:
            there = {tuple(map(float, row[:6])) for row in list(csv.reader(file))[1:]}
    for case in cases():
        if tuple(map(float, case)) in there:
            continue
        made = list(rows(*case))
        with arguments.file.open("a", newline="") as file:
            writer = csv.writer(file)
            if file.tell() == 0:
                writer.writerow(FIELDS)
            writer.writerows(made)
        print(".", end="", file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
