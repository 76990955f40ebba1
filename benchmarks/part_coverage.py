"""Count how often the interval of a part, from some maps of it, holds its truth.

``make part-coverage``. Each part is a made surface of five by five maps. All of its maps are
assessed, as a user would, for a joint as large as the part; the truth is the whole part. Then some
of the maps are drawn several times, and what they say together is compared with it. Rows go to a
file as they are made; what is there is not made again.
"""

import argparse
import math
import sys
import warnings
from pathlib import Path
from zlib import crc32

import numpy as np
import pandas as pd
from made_surfaces import KINDS, SIDE, Make, parent_of
from scipy.special import erfinv

import roughline as rl

POINTS, MAPS = 64, 5
SEEDS = (1, 2)
WANTED = (0.003, 0.03, 0.3)  # contact area fractions, about
COUNTS = (2, 3, 5, 10)
DRAWS = 12
KEYS = ("interface_stiffness", "contact_area_fraction")
MATERIALS = "E=200 GPa nu=0.3 resistivity=1e-7 ohm m, E=200 GPa nu=0.3 resistivity=1e-7 ohm m"


def rows(kind, seed):
    """What draws of maps say, and the truth of the part."""
    rng = np.random.default_rng([crc32(f"mine {kind}".encode()), seed])
    make = Make(POINTS, MAPS, float(rng.uniform(0.2, 0.95)), float(rng.uniform(3, 12)))
    part = parent_of(kind, make, rng)
    E_star = rl.Question(part, MATERIALS).modulus
    pressures = part.rms_slope * E_star * erfinv(WANTED) / math.sqrt(2)
    whole = rl.press(part, E_star=E_star, forces=pressures * part.area, periodic=True, throw=False)
    truths = dict(zip(KEYS, (whole.stiffness, whole.area_fraction_corrected), strict=True))
    asked = {"loads": [f"{each:.9g} Pa" for each in pressures], "joint_area": part.area}
    starts = range(0, make.n, POINTS)
    questions = [
        rl.Question(
            rl.Surface(
                part.heights[i : i + POINTS, j : j + POINTS].copy(),
                (SIDE, SIDE),
                unit="m",
                is_cut_out=True,
            ),
            MATERIALS,
            elastic=True,
            grid_error=True,
            fields=False,
            **asked,
        )
        for i in starts
        for j in starts
    ]
    stored = {id(each): rl.assess(each) for each in questions}
    for count in COUNTS:
        for _ in range(DRAWS):
            some = [questions[i] for i in rng.permutation(len(questions))[:count]]
            found = rl.assess_part(some, answer=lambda question: stored[id(question)])
            agree = not any("do not agree" in each for each in found.warnings)
            for key, truth in truths.items():
                answer = found.answers[key]
                for i, wanted in enumerate(WANTED):
                    ends = answer.low[i], answer.high[i]
                    yield kind, seed, count, key, wanted, truth[i], answer.mean[i], *ends, agree


def measured(file):
    """Make the rows that the file lacks, and read all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    columns = ["kind", "seed", "count", "key", "wanted", "truth", "mean", "low", "high", "agree"]
    there = set()
    if file.exists():
        there = set(pd.read_csv(file)[["kind", "seed"]].itertuples(index=False, name=None))
    for seed in SEEDS:
        for kind in KINDS:
            if (kind, seed) in there:
                continue
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", rl.PreparationWarning)
                made = pd.DataFrame(rows(kind, seed), columns=columns)
            made.to_csv(file, mode="a", header=not file.exists(), index=False)
            print(".", end="", file=sys.stderr, flush=True)
    return pd.read_csv(file)


def cell(some):
    """Share held, share silent, and median half width as a factor."""
    told = some[some["low"].notna()]
    silent = 1 - len(told) / len(some)
    if not len(told):
        return "silent"
    held = ((told["low"] <= told["truth"]) & (told["truth"] <= told["high"])).mean()
    width = np.sqrt(told["high"] / told["low"]).median()
    return f"{held:.0%}, {width:.2f}" + (f", silent {silent:.0%}" if silent else "")


def print_coverage(table):
    """Print a row for each quantity and kind, and a column for each count of maps."""
    print("| quantity | surface |" + "".join(f" {count} |" for count in COUNTS) + " disagree |")
    print("|---" * (3 + len(COUNTS)) + "|")
    for key in KEYS:
        for kind in ("all", *KINDS):
            here = table[(table["key"] == key) & ((table["kind"] == kind) | (kind == "all"))]
            cells = [cell(here[here["count"] == count]) for count in COUNTS]
            most = here[here["count"] == COUNTS[-1]]
            print(f"| {key} | {kind} | {' | '.join(cells)} | {1 - most['agree'].mean():.0%} |")


def main():
    """Measure, and print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--rows", type=Path, default=Path("out/part_coverage.csv"))
    arguments = parser.parse_args()
    table = measured(arguments.rows)
    print(f"\nroughline {rl.__version__}\n")
    print_coverage(table)


if __name__ == "__main__":
    main()
