"""Studies of intervals: trials that are made once, and how often their intervals hold."""

from __future__ import annotations

import math
import sys
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from zlib import crc32

import numpy as np
import pandas as pd
from made_surfaces import INSTRUMENTS, Make
from scipy.special import erfinv

import roughline as rl

E_STAR = 200e9 / (1 - 0.3**2) / 2
WANTED = (0.003, 0.03, 0.3)  # contact area fractions, about
SHORTEST = (2.0, 4.0, 8.0, 16.0)  # points to the shortest wave: half a pixel to four pixels
MADE = {
    # pixels along a map, points along a pixel, maps along the surface, roll-off waves along a map
    "grid": (64, 4, 1, (4, 12), SHORTEST),
    "larger": (128, 2, 4, (4, 12), SHORTEST),
    "part": (96, 2, 5, (4, 12), SHORTEST),
    "mine": (64, 1, 5, (3, 12), ()),
    "seal": (64, 1, 3, (4, 12), (4.0, 8.0)),
    "leak": (96, 1, 4, (3, 12), SHORTEST),
    "scan": (256, 1, 2, (20, 60), ()),
    "fit": (128, 4, 2, (4, 12), ()),
}
KEY = ["study", "kind", "option", "seed"]
COLUMNS = ("held", "silent", "half width", "too wide")


@dataclass(frozen=True)
class Study:
    """What is asked, of which surfaces, and how its rows are told apart in tables."""

    rows_of: Callable  # of a kind, an option and a seed
    heading: str
    asked: str
    kinds: tuple
    options: tuple = ("elastic",)
    seeds: int | dict = 2  # how many, or how many of each kind and option
    groups: tuple = ("kind",)
    columns: tuple = COLUMNS

    def trials(self, name, kinds, first, share):
        """Its trials, those of each kind and option spread evenly over the whole."""
        seeds = self.seeds
        if isinstance(seeds, int):
            seeds = {(kind, option): seeds for kind in kinds for option in self.options}
        found = [
            (i / many, (name, *which, first + i))
            for which, many in seeds.items()
            for i in range(max(1, round(share * many)))
        ]
        return [trial for _, trial in sorted(found, key=lambda each: each[0])]


def row(quantity, load, truth, value, low, high, said="", **more):
    ends = {"truth": truth, "value": value, "low": low, "high": high}
    told = {name: math.nan if each is None else float(each) for name, each in ends.items()}
    return {"quantity": quantity, "load": load, **told, "said": said, **more}


def make_of(study, kind, seed):
    """How a parent of a study is made, its exponent, roll-off and shortest wave at random."""
    rng = np.random.default_rng([crc32(f"{study} {kind}".encode()), seed])
    pixels, finer, maps, waves, shortest = MADE[study]
    hurst, waves = float(rng.uniform(0.2, 0.95)), float(rng.uniform(*waves))
    return Make(pixels * finer, maps, hurst, waves, rng.choice(shortest) if shortest else 4.0), rng


def as_surface(heights, like):
    """A cut-out map with these heights on the sides of another."""
    return rl.Surface(np.ascontiguousarray(heights), like.sizes, unit="m", is_cut_out=True)


def seen(study, piece, instrument, rng):
    """A piece as an instrument sees it."""
    return as_surface(INSTRUMENTS[instrument](piece.heights, MADE[study][1], rng), piece)


def hardness_of(surface, bar):
    """Hardness of a body, a multiple of E* and the rms slope, as a keyword; none if elastic."""
    return {} if bar is None else {"hardness": bar * E_STAR * surface.rms_slope}


def pressures_of(surface, bar=None, wanted=WANTED):
    """Mean pressures at which about the wanted shares touch (Persson 2001)."""
    pressure = surface.rms_slope * E_STAR * erfinv(wanted) / math.sqrt(2)
    if bar is None:
        return pressure
    return 1 / (1 / pressure + 1 / (bar * E_STAR * surface.rms_slope * np.array(wanted)))


def recorded(file, trials, rows_of):
    """Do the trials that a file lacks, each written to it at once, and return all that it has."""
    file.parent.mkdir(parents=True, exist_ok=True)
    there = set()
    if file.exists():
        there = set(read(file)[KEY].itertuples(index=False, name=None))
    left, start = [trial for trial in trials if trial not in there], time.perf_counter()
    for done, trial in enumerate(left, 1):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", rl.PreparationWarning)
            rows = [dict(zip(KEY, trial, strict=True)) | each for each in rows_of(*trial[1:])]
        if rows:
            pd.DataFrame(rows).to_csv(file, mode="a", header=not file.exists(), index=False)
        minutes = (time.perf_counter() - start) / 60 * (len(left) - done) / done
        line = f"\r{file.stem}: {done} of {len(left)} trials, {minutes:.0f} min left   "
        print(line, end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    return read(file)


def read(file):
    return pd.read_csv(file, dtype={"option": str})


def summary(rows):
    """What tables say of some intervals of one quantity, by column.

    Lengths are factors, those of H differences. "Too wide" is by how much all of them could be
    divided, about their values, so that 95 of 100 still hold.
    """
    known = rows[np.isfinite(rows.truth)]
    printed = known[np.isfinite(known.low) & ~np.isnan(known.high)]
    told = dict.fromkeys((*COLUMNS, "off by", "mean error"), "–") | {"intervals": len(rows)}
    told["disagree"] = f"{rows.said.astype(str).str.contains('do not agree').mean():.0%}"
    if not len(printed):
        return told | {"silent": f"{1:.0%}"}
    is_linear = rows.quantity.iloc[0].startswith("H of")
    ends = printed[["truth", "value", "low", "high"]]
    with np.errstate(divide="ignore", invalid="ignore"):
        truth, value, low, high = (ends if is_linear else np.log(ends)).to_numpy().T
        off, width = (np.where(a == b, 0.0, a - b) for a, b in ((truth, value), (high, low)))
        used = np.where(off < 0, -off / (value - low), off / (high - value))
        needed = np.nan_to_num(np.quantile(np.nan_to_num(used, posinf=np.inf), 0.95), nan=np.inf)
    shown = (lambda each: each) if is_linear else np.exp
    held = (printed.low <= printed.truth) & (printed.truth <= printed.high)
    return told | {
        "held": f"{held.mean():.0%}",
        "silent": f"{1 - len(printed) / len(known):.0%}",
        "half width": f"{np.median(shown(width / 2)):.2f}",
        "too wide": f"{1 / needed:.1f}" if needed else "–",
        "off by": f"{np.median(shown(abs(off))):.3f}",
        "mean error": f"{off.mean():+.3f}" if is_linear else "–",
    }


def written(rows, studies, page):
    """Write a table for each study: quantities and groups down, what is counted across."""
    for name, of_study in rows.groupby("study", sort=False):
        study = studies[name]
        page.heading(study.heading)
        page.say(study.asked)
        columns = ("surfaces", "quantity", "intervals", *study.columns)
        page.table(*columns, shown=lambda row: row[0] == "all")
        for quantity, some in of_study.groupby("quantity", sort=False):
            parts = [("all", some)]
            parts += [each for group in study.groups for each in some.groupby(group, sort=False)]
            for part, here in parts:
                told = summary(here)
                page.row(part, quantity, *(told[each] for each in ("intervals", *study.columns)))


def misses(rows):
    """Kinds and quantities of which fewer than nine in ten printed intervals hold."""
    found = []
    for (_, quantity, kind), some in rows.groupby(["study", "quantity", "kind"], sort=False):
        held = summary(some)["held"]
        if held != "–" and float(held.rstrip("%")) < 90:
            found.append(f"{quantity} of {kind} ({held})")
    return found
