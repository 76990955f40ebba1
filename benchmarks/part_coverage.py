"""Count how often the interval of a part, from some maps of it, holds its truth.

``make part-coverage``. Each part is a periodic surface. It is cut into 64 maps, which lose their
tilt and are assessed one by one, as a user would: alone, and for a joint as large as the part. The
truth has the same waves on twice as many points a side: of a joint it is the whole part, of maps
alone the mean over all of them. Then some of the maps are drawn many times, and their interval is
compared with the truth. Rows go to a file as they are made; what is there is not made again.
"""

import argparse
import csv
import math
import sys
from pathlib import Path

import numpy as np
import pandas as pd
from scipy.special import erfinv

import roughline as rl
from roughline.statistics.places import average_of_places

POINTS, MAP, FINER = 512, 64, 2
CELLS = 4  # to the shortest wave
HURSTS = (0.4, 0.9)
WAVES = (0.35, 0.75, 1.5, 3, 6)  # roll-off wavelengths along a side of a map
SEEDS = (1, 2)
WANTED = (0.01, 0.1, 0.4)  # contact area fractions, about
COUNTS = (1, 2, 3, 4, 5, 7, 10)
DRAWS = 400
OF_JOINT = ("stiffness_per_area", "contact_area_fraction")
OF_MAP = "contact_stiffness"
KEY = ["hurst", "waves", "seed"]
ENDS = ["low", "high", "shared_low", "shared_high"]
MATERIALS = "E=200 GPa nu=0.3 resistivity=1e-7 ohm m, E=200 GPa nu=0.3 resistivity=1e-7 ohm m"


def part(hurst, waves, seed, finer=1):
    """A part of 8 mm a side."""
    side = 8e-3
    q_map = math.tau * POINTS / MAP / side
    roll = {} if waves * POINTS <= MAP else {"q_roll": waves * q_map}
    spectrum = rl.SelfAffine(
        hurst=hurst, length=side, rms_height=1e-6, q_high=math.tau * POINTS / CELLS / side, **roll
    )
    return spectrum.surface(finer * POINTS, rng=100 * seed + round(10 * hurst))


def maps_of(surface):
    """All maps of a part, without their tilt."""
    step = surface.shape[0] * MAP // POINTS
    places = range(0, surface.shape[0], step)
    return [
        surface.cropped((i, i + step), (j, j + step)).detrended() for i in places for j in places
    ]


def rows(hurst, waves, seed):
    """Each map's values and ends, and the truth of the part."""
    surface, fine = (part(hurst, waves, seed, finer) for finer in (1, FINER))
    E_star = rl.Question(surface, MATERIALS).modulus
    pressures = surface.rms_slope * E_star * erfinv(WANTED) / math.sqrt(2)
    whole = rl.press(fine, E_star=E_star, forces=pressures * fine.area, periodic=True)
    truths = dict(
        zip(OF_JOINT, (whole.stiffness / fine.area, whole.area_fraction_corrected), strict=True)
    )
    alone = [
        rl.press(each, E_star=E_star, forces=pressures * each.area).stiffness
        for each in maps_of(fine)
    ]
    truths[OF_MAP] = np.exp(np.mean(np.log(alone), axis=0))
    asked = {"loads": [f"{pressure:.9g} Pa" for pressure in pressures], "grid_error": True}
    for number, each in enumerate(maps_of(surface)):
        found = {}
        for joint in (None, surface.area):
            question = rl.Question(each, MATERIALS, joint_area=joint, fields=False, **asked)
            found |= rl.assess(question).answers
        for key, truth in truths.items():
            answer = found[key]
            ends = (answer.low, answer.high)
            for i, wanted in enumerate(WANTED):
                four = (end[i] for end in (*ends, *(answer.shared or ends)))
                yield number, wanted, key, truth[i], answer.values[i], *four


def measured(file):
    """Make the rows that the file lacks, and read all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    columns = [*KEY, "number", "wanted", "key", "truth", "value", *ENDS]
    if not file.exists():
        file.write_text(",".join(columns) + "\n")
    there = set(pd.read_csv(file)[KEY].itertuples(index=False, name=None))
    for seed in SEEDS:
        for waves in WAVES:
            for hurst in HURSTS:
                if (hurst, waves, seed) in there:
                    continue
                made = [(hurst, waves, seed, *row) for row in rows(hurst, waves, seed)]
                with file.open("a", newline="") as stream:
                    csv.writer(stream).writerows(made)
                print(".", end="", file=sys.stderr, flush=True)
    return pd.read_csv(file)


def held(table, count, rng):
    """Share of intervals that hold the truth, and their median half width as a factor."""
    inside, widths = [], []
    for _, one in table.groupby([*KEY, "wanted"]):
        values = one["value"].to_numpy()
        low, high, shared_low, shared_high = (one[name].to_numpy() for name in ENDS)
        picked = np.array([rng.permutation(values.size)[:count] for _ in range(DRAWS)]).T
        if count == 1:  # the map's own
            ends = low[picked[0]], high[picked[0]]
        else:
            found = average_of_places(values[picked], shared_low[picked], shared_high[picked])
            ends = found.low, found.high
        truth = one["truth"].iloc[0]
        inside.append((ends[0] <= truth) & (truth <= ends[1]))
        widths.append(np.sqrt(ends[1] / ends[0]))
    return np.mean(inside), np.median(widths)


def print_coverage(table):
    """Print a row for each quantity and roll-off, and a column for each count of maps."""
    rng = np.random.default_rng(0)
    heads = "".join(f" {count} |" for count in COUNTS)
    print(f"| quantity | roll-offs a side |{heads}")
    print("|---" * (2 + len(COUNTS)) + "|")
    for key in (*OF_JOINT, OF_MAP):
        for waves in (*WAVES, None):
            here = table[(table["key"] == key) & ((table["waves"] == waves) | (waves is None))]
            cells = []
            for count in COUNTS:
                share, width = held(here, count, rng)
                cells.append(f"{share:.0%}, {width:.2f}")
            print(f"| {key} | {'all' if waves is None else waves} | {' | '.join(cells)} |")


def print_kinds():
    """Print how much the rms heights of the maps of one part differ."""
    print("\n| roll-offs a side | largest over smallest rms height of ten maps |")
    print("|---|---|")
    rng = np.random.default_rng(1)
    for waves in WAVES:
        ratios = []
        for hurst in HURSTS:
            for seed in SEEDS:
                rms = np.array([each.rms_height for each in maps_of(part(hurst, waves, seed))])
                for _ in range(100):
                    ten = rng.choice(rms, 10, replace=False)
                    ratios.append(ten.max() / ten.min())
        middle, most = np.quantile(ratios, (0.5, 0.95))
        print(f"| {waves:g} | {middle:.2f} (95 % below {most:.2f}) |")


def main():
    """Measure, and print the tables."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--rows", type=Path, default=Path("out/part_coverage.csv"))
    arguments = parser.parse_args()
    table = measured(arguments.rows)
    print(f"\nroughline {rl.__version__}\n")
    print_coverage(table)
    print_kinds()


if __name__ == "__main__":
    main()
