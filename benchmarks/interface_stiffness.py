"""Count how often a map tells of the larger surface behind it: ``make interface-stiffness``.

Parents of every kind of made_surfaces.py are pressed as they are, and some maps of each as parts of
a joint as large as the parent, with their tiles. With files as arguments the maps are the quarters
of a measured map, which is the truth. Both are on one grid, so that its error is left out here.
Rows go to a file as they are made; what is there is not made again.
"""

from __future__ import annotations

import argparse
import math
from functools import partial
from pathlib import Path
from zlib import crc32

import numpy as np
from interval_coverage import recorded
from made_surfaces import GAUSSIAN, KINDS, Make, parent_of, piece_of
from page import Page
from scipy.special import erfinv

import roughline as rl
from roughline.assessment.assumptions import broken
from roughline.assessment.larger_surface import larger_surface, roll_offs_along_a_side
from roughline.assessment.tiles import Beyond, coarsened, tiles_from, tiles_of

WANTED = np.array([0.002, 0.01, 0.05, 0.2, 0.5, 0.8])  # contact area fractions, about
BARS = {"elastic": None, "yielding": 0.15}  # hardness over E* and the rms slope
MAPS = 3  # of each parent
KEY = ["kind", "option", "seed"]


def make_of(kind, seed):
    """How a parent is made; every fifth one is eight maps long."""
    rng = np.random.default_rng([crc32(kind.encode()), seed])
    points, maps = (64, 8) if seed % 5 == 4 else (96 if seed % 2 else 64, 4)
    hurst, waves = rng.uniform(0.2, 1.0), rng.uniform(3, 12)
    return Make(points, maps, hurst, waves, rng.choice([2.0, 4.0, 6.0])), rng


def made(kind, option, seed):
    """A parent, some of its maps, and what is left out of them."""
    make, rng = make_of(kind, seed)
    whole = parent_of(kind, make, rng)
    return rows_of(whole, [piece_of(whole, make, rng) for _ in range(MAPS)], BARS[option])


def quarters(files, name, option, seed):
    """A measured map on at most 600 points a side, and its quarters."""
    whole = rl.prepared(rl.read(files[name]))
    while min(whole.shape) > 600:
        whole = whole.cropped(*((0, n - n % 2) for n in whole.shape)).coarsened()
    halves = [[(0, n // 2), (n // 2, n)] for n in whole.shape]
    maps = [whole.cropped(x, y) for x in halves[0] for y in halves[1]]
    return rows_of(whole, maps, BARS[option])


def rows_of(whole, maps, bar):
    """Intervals of maps, each for a joint as large as the whole, and what the whole gives."""
    # erf(sqrt(2) p / (E* slope)) of an elastic surface is in contact, or about so (Persson 2001)
    pressures, hardness = whole.rms_slope * erfinv(WANTED) / math.sqrt(2), None
    if bar is not None:
        hardness = bar * whole.rms_slope
        pressures = 1 / (1 / pressures + 1 / (hardness * WANTED))

    def pressed(surface, rtol=1e-6):
        given = {"E_star": 1.0, "hardness": hardness, "periodic": True, "throw": False}
        return rl.press(surface, forces=pressures * surface.area, rtol=rtol, **given)

    truth = pressed(whole)
    true = {"k_i": truth.unloading_stiffness / whole.area, "A": truth.area_fraction_corrected}
    for number, piece in enumerate(maps):
        level = piece.detrended()
        curve = pressed(level)
        value = {"k_i": curve.unloading_stiffness / piece.area, "A": curve.area_fraction_corrected}
        beyond = Beyond.of(roll_offs_along_a_side(piece), piece.area, whole.area)
        coarse = coarsened(level)
        map_and_tiles = [[coarse], tiles_of(coarse, 2), tiles_of(coarse, 4)]
        (map_,), halves, quarters = (
            [pressed(each, rtol=1e-4) for each in some] for some in map_and_tiles
        )
        tiles = tiles_from(map_, halves, quarters, coarse.heights.size)
        k, area = curve.unloading_stiffness, curve.area_fraction_corrected
        larger = larger_surface(curve, beyond, tiles, (k, k), (area, area))
        ends = {"k_i": np.array(larger.stiffness.ends) / piece.area, "A": np.array(larger.area)}
        down = [each.assumption for each in broken("larger surface", piece)]
        for i in np.flatnonzero(curve.resolved & np.isfinite(true["k_i"])):
            for quantity in ("k_i", "A"):
                yield {
                    "map": number,
                    "maps": round(math.sqrt(whole.area / piece.area)),
                    "quantity": quantity,
                    "load": WANTED[i],
                    "truth": true[quantity][i],
                    "value": value[quantity][i],
                    "low": ends[quantity][0][i],
                    "high": ends[quantity][1][i],
                    "roll_offs": beyond.roll_offs or 0.0,
                    "broken": ", ".join(down) or "nothing",
                }


def summary(rows):
    """Count of intervals, share that is silent, that hold, median width, and how much too wide.

    The last is by how much all logarithms of these intervals could be divided so that 95 of 100
    still hold.
    """
    printed = rows[rows.broken == "nothing"]
    silent = f"{1 - len(printed) / len(rows):.0%}"
    if not len(printed):
        return len(rows), silent, "–", "–", "–"
    off = np.log(printed.truth / printed.value)
    with np.errstate(divide="ignore", invalid="ignore"):
        below, above = np.log(printed.value / printed.low), np.log(printed.high / printed.value)
        used = np.where(off < 0, -off / below, off / above)
    width = np.exp(np.median((below + above) / 2))
    needed = np.quantile(used, 0.95)
    return len(rows), silent, f"{(used <= 1).mean():.0%}", f"{width:.2f}", f"{1 / needed:.1f}"


def written(rows, page):
    """Write the tables: by kind, by load, and on Gaussian surfaces by roll-off and size."""
    columns = ("intervals", "silent", "held", "half width", "too wide")
    for quantity, some in rows.groupby("quantity", sort=False):
        page.say(f"\n## {quantity} of the larger surface\n")
        page.table("surfaces", *columns)
        page.row("all", *summary(some))
        for kind, here in some.groupby("kind", sort=False):
            page.row(kind, *summary(here))
        page.say("")
        page.table("contact", *columns)
        for load, here in some.groupby("load"):
            page.row(f"{load:.1%}", *summary(here))
        page.say("")
        page.table("Gaussian, maps along a side", "roll-off", *columns)
        for maps, of_size in some[some.kind.isin(GAUSSIAN)].groupby("maps"):
            for seen, here in of_size.groupby(of_size.roll_offs > 0):
                page.row(maps, "seen" if seen else "not seen", *summary(here))


def main():
    """Make the trials, and print the tables."""
    parser = argparse.ArgumentParser()
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--rows", type=Path, default=Path("out/interface_stiffness.csv"))
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--first", type=int, default=0, help="seed")
    parser.add_argument("--kinds", nargs="*", default=[*KINDS])
    arguments = parser.parse_args()
    arguments.rows.parent.mkdir(parents=True, exist_ok=True)
    if arguments.files:
        files = {f"quarters of {each.name}": each for each in arguments.files}
        trials = [(name, option, 0) for name in files for option in BARS]
        rows = recorded(arguments.rows, KEY, trials, partial(quarters, files))
    else:
        seeds = range(arguments.first, arguments.first + arguments.seeds)
        trials = [
            (kind, option, seed) for seed in seeds for kind in arguments.kinds for option in BARS
        ]
        rows = recorded(arguments.rows, KEY, trials, made)
    page = Page("interface-stiffness-table.md", "The larger surface", "interface-stiffness")
    written(rows, page)


if __name__ == "__main__":
    main()
