"""Count how often intervals hold on surfaces as they are made and measured: ``make intervals``.

Every kind of surface of made_surfaces.py is asked what users ask. The truth is the full model's
answer for the parent, or for the finer surface that an instrument saw. An interval that is not
printed counts as silent. Rows go to a file as they are made; what is there is not made again.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
import warnings
from dataclasses import replace
from pathlib import Path
from zlib import crc32

import numpy as np
import pandas as pd
from made_surfaces import GAUSSIAN, INSTRUMENTS, KINDS, Make, measured, parent_of, piece_of
from page import Page
from scipy.special import erfinv

import roughline as rl

MATERIALS = "E=200 GPa nu=0.3 resistivity=1e-7 ohm m, E=200 GPa nu=0.3 resistivity=1e-7 ohm m"
E_STAR = 200e9 / (1 - 0.3**2) / 2
WANTED = (0.003, 0.03, 0.3)  # contact area fractions, about
HARDNESS_BARS = (None, 0.5, 0.15, 0.05)  # over E* and the rms slope; None: elastic
HURSTS = (0.3, 0.6, 0.9)
COUNTS = (2, 3, 5, 10)
DRAWS = 12
SCANS = 4  # of each piece
SIZES = {  # pixels along a map, points of the surface along a pixel, maps along the surface
    "grid": (64, 4, 1),
    "larger": (128, 2, 4),
    "part": (96, 2, 5),
    "scan": (256, 1, 2),
    "fit": (128, 4, 2),
}
ACROSS = {"turned": 0}  # axis across the lay of a kind, along which it is scanned; else 1
SHORTEST = (2, 4, 8, 16)  # points to the shortest wave, which is half a pixel to four pixels long
KEY = ["study", "kind", "option", "seed"]


def make_of(study, kind, seed):
    """How a parent of a study is made, its exponent, roll-off and shortest wave at random."""
    rng = np.random.default_rng([crc32(f"{study} {kind}".encode()), seed])
    pixels, finer, maps = SIZES[study]
    hurst = float(rng.uniform(0.2, 0.95))
    waves = float(rng.uniform(*((20, 60) if study == "scan" else (4, 12))))
    cells = float(rng.choice(SHORTEST)) if study in ("grid", "larger", "part") else 4.0
    return Make(pixels * finer, maps, hurst, waves, cells), rng


def seen(study, piece, instrument, rng):
    """A piece as an instrument sees it."""
    return as_surface(measured(piece, instrument, SIZES[study][1], rng), piece)


def pressures_of(surface, hardness_bar=None):
    """Mean pressures at which about the wanted shares touch (Persson 2001)."""
    pressure = surface.rms_slope * E_STAR * erfinv(WANTED) / math.sqrt(2)
    if hardness_bar is None:
        return pressure
    hardness = hardness_bar * E_STAR * surface.rms_slope
    return 1 / (1 / pressure + 1 / (hardness * np.array(WANTED)))


def hardness_of(surface, hardness_bar):
    """Hardness of a body, as a keyword of a press or a question."""
    return {} if hardness_bar is None else {"hardness": hardness_bar * E_STAR * surface.rms_slope}


def as_surface(heights, like):
    """A cut-out map with these heights on the sides of another."""
    return rl.Surface(np.ascontiguousarray(heights), like.sizes, unit="m", is_cut_out=True)


def row(quantity, load, truth, value, low, high, said=""):
    """One interval and its truth."""
    names = ("quantity", "load", "truth", "value", "low", "high", "said")
    return dict(zip(names, (quantity, load, truth, value, low, high, said), strict=True))


def ends_of(answer, i):
    """Both ends of an answer at one load; NaN where it has none."""
    return [math.nan if end is None else float(end[i]) for end in (answer.low, answer.high)]


def grid_rows(kind, option, seed):
    """A map of 64 x 64 pixels, and the piece on four times as many that the instrument saw."""
    instrument, bar = option.split(", H ")
    bar = None if bar == "none" else float(bar)
    make, rng = make_of("grid", kind, seed)
    fine = parent_of(kind, make, rng).detrended()
    fine = as_surface(fine.heights, fine)
    coarse = seen("grid", fine, instrument, rng)
    forces = pressures_of(fine, bar) * fine.area
    given = {"E_star": E_STAR, "forces": forces, "throw": False} | hardness_of(fine, bar)
    truth, curve = rl.press(fine, **given), rl.press(coarse, grid_error=True, **given)
    names = {"k": "stiffness", "k_u": "unloading_stiffness", "A": "area_fraction_corrected"}
    for symbol, name in names.items():
        error_of = name.replace("_corrected", "") + "_error"
        values, errors = getattr(curve, name), getattr(curve, error_of)
        for i in np.flatnonzero(curve.resolved):
            v, e = float(values[i]), float(errors[i])
            yield row(symbol, WANTED[i], float(getattr(truth, name)[i]), v, v / (1 + e / v), v + e)


def larger_rows(kind, option, seed):
    """Maps of a part, asked for its joint, and the whole part in the full model."""
    bar = None if option == "elastic" else 0.2
    make, rng = make_of("larger", kind, seed)
    parent = parent_of(kind, make, rng)
    pressures, given = pressures_of(parent, bar), hardness_of(parent, bar)
    forces = pressures * parent.area
    truth = rl.press(parent, E_star=E_STAR, forces=forces, periodic=True, throw=False, **given)
    truths = {
        "interface_stiffness": truth.unloading_stiffness,
        "contact_area_fraction": truth.area_fraction_corrected,
    }
    loads = [f"{each:.9g} Pa" for each in pressures]
    for _ in range(3):
        piece = piece_of(parent, make, rng)
        question = rl.Question(
            seen("larger", piece, "pixel means", rng),
            MATERIALS,
            joint_area=parent.area,
            loads=loads,
            fields=False,
            elastic=bar is None,
            **given,
        )
        result = rl.assess(question)
        said = result.warnings[0] if result.warnings else ""
        for key, true in truths.items():
            answer = result.answers[key]
            for i, wanted in enumerate(WANTED):
                ends = ends_of(answer, i)
                yield row(key, wanted, float(true[i]), float(answer.values[i]), *ends, said)


def part_rows(kind, option, seed):
    """Some maps of a part: of the joint the whole part, of maps alone the mean over all places."""
    make, rng = make_of("part", kind, seed)
    parent = parent_of(kind, make, rng)
    pressures = pressures_of(parent)
    whole = rl.press(
        parent, E_star=E_STAR, forces=pressures * parent.area, periodic=True, throw=False
    )
    side, count = make.points, make.maps
    places = [(i * side, j * side) for i in range(count) for j in range(count)]
    one = piece_of(parent, make, rng)
    pieces = [as_surface(parent.heights[i : i + side, j : j + side], one) for i, j in places]
    given = {"E_star": E_STAR, "forces": pressures * one.area, "throw": False}
    alone = [rl.press(each, **given) for each in pieces]
    truths = {
        "interface_stiffness": whole.unloading_stiffness,
        "contact_stiffness": np.exp(np.mean([np.log(each.stiffness) for each in alone], axis=0)),
    }
    maps = [seen("part", each, "pixel means", rng) for each in pieces]
    loads = [f"{each:.9g} Pa" for each in pressures]
    for joint, (key, truth) in zip((parent.area, None), truths.items(), strict=True):
        questions = [
            rl.Question(each, MATERIALS, joint_area=joint, loads=loads, fields=False, elastic=True)
            for each in maps
        ]
        stored = {id(question): rl.assess(question) for question in questions}
        for n in COUNTS:
            for _ in range(DRAWS):
                some = [questions[i] for i in rng.permutation(len(questions))[:n]]
                part = rl.assess_part(some, answer=lambda question: stored[id(question)])  # noqa: B023
                answer = part.answers[key]
                for i, wanted in enumerate(WANTED):
                    ends = float(answer.low[i]), float(answer.high[i])
                    said = part.warnings[0] if part.warnings else ""
                    name = f"{'joint' if joint else 'map'} of {n}"
                    yield row(name, wanted, float(truth[i]), float(answer.mean[i]), *ends, said)


def scan_of(surface, kind, rng):
    """A line scan of a map, at a random place, across its lay if it has one."""
    heights = surface.heights.T if ACROSS.get(kind, 1) == 0 else surface.heights
    place = int(rng.integers(heights.shape[0]))
    return rl.Line(heights[place].copy(), surface.sizes[0], unit="m", kind="profile")


def scan_rows(kind, option, seed):
    """Line scans of a piece, and the piece in the full model."""
    make, rng = make_of("scan", kind, seed)
    parent = parent_of(kind, make, rng)
    for _ in range(2):
        piece = piece_of(parent, make, rng).detrended()
        force_of_one = E_STAR * piece.rms_height * piece.sizes[0]
        forces = np.array([0.01, 0.1, 1.0]) * force_of_one
        truth = rl.press(piece, E_star=E_STAR, forces=forces, throw=False).stiffness
        for _ in range(SCANS):
            scan = scan_of(piece, kind, rng).detrended()
            pressed = rl.press_scan(scan, E_star=E_STAR, forces=forces)
            for i, force in enumerate(forces):
                ends = float(pressed.low[i]), float(pressed.high[i])
                value = float(pressed.curve.stiffness[i])
                said = pressed.curve.warnings[0] if pressed.curve.warnings else ""
                load = round(float(force / force_of_one), 3)
                yield row("k of a scan", load, float(truth[i]), value, *ends, said)


def fit_rows(kind, option, seed):
    """The exponent of a map, and of a scan of it, that an instrument saw."""
    make, rng = make_of("fit", kind, seed)
    make = replace(make, hurst=HURSTS[seed % 3])
    piece = piece_of(parent_of(kind, make, rng), make, rng)
    map_seen = seen("fit", piece, option, rng)
    scan = scan_of(map_seen, kind, rng)
    for name, body in (("H of a map", map_seen.detrended()), ("H of a scan", scan.detrended())):
        found = rl.roughness(body)
        ends = (math.nan, math.nan) if found.fit is None else found.fit.hurst_interval
        value = math.nan if found.fit is None else found.fit.hurst
        said = found.remarks[0] if found.remarks else ""
        yield row(name, 0.0, make.hurst, value, *ends, said)


SELF_AFFINE = (*GAUSSIAN, "lognormal summits", "ground, 3", "ground, 9", "ground, 30")
INSTRUMENTS_OF_FITS = tuple(each for each in INSTRUMENTS if each != "missing points")
STUDIES = {
    # function, kinds, options, seeds
    "grid": (
        grid_rows,
        tuple(KINDS),
        tuple(
            f"{instrument}, H {bar or 'none'}"
            for instrument in ("pixel means", "points of a rougher surface")
            for bar in HARDNESS_BARS
        ),
        2,
    ),
    "larger": (larger_rows, tuple(KINDS), ("elastic", "yielding"), 2),
    "part": (part_rows, tuple(KINDS), ("elastic",), 2),
    "scan": (scan_rows, tuple(KINDS), ("elastic",), 6),
    "fit": (fit_rows, SELF_AFFINE, INSTRUMENTS_OF_FITS, 6),
}


def measured_rows(folder, studies, first, share):
    """Make the rows that the folder lacks, and read all."""
    for study in studies:
        rows_of, kinds, options, seeds = STUDIES[study]
        file = folder / f"{study}.csv"
        there = set()
        if file.exists():
            there = set(pd.read_csv(file)[KEY].itertuples(index=False, name=None))
        seeds = range(first, first + max(1, round(share * seeds)))
        trials = [
            (study, kind, option, seed) for seed in seeds for kind in kinds for option in options
        ]
        left = [trial for trial in trials if trial not in there]
        start = time.perf_counter()
        for done, (_, kind, option, seed) in enumerate(left, 1):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", rl.PreparationWarning)
                rows = [
                    dict(zip(KEY, (study, kind, option, seed), strict=True)) | each
                    for each in rows_of(kind, option, seed)
                ]
            pd.DataFrame(rows).to_csv(file, mode="a", header=not file.exists(), index=False)
            minutes = (time.perf_counter() - start) / 60 * (len(left) - done) / done
            line = f"\r{study}: {done} of {len(left)} trials, {minutes:.0f} min left   "
            print(line, end="", file=sys.stderr, flush=True)
        print(file=sys.stderr)
    files = [folder / f"{study}.csv" for study in studies]
    return pd.concat([pd.read_csv(file) for file in files if file.exists()], ignore_index=True)


def summary(rows):
    """Share held of what is printed, share that is silent, width, and width over that needed.

    The width needed is that at which the same intervals, all scaled alike about their values in
    logarithms, would just hold 95 of 100.
    """
    rows = rows[np.isfinite(rows.truth)]
    printed = rows[np.isfinite(rows.low) & ~np.isnan(rows.high)]
    if not len(printed):
        return "–", f"{1:.0%}", "–", "–"
    held = (printed.low <= printed.truth) & (printed.truth <= printed.high)
    silent = 1 - len(printed) / len(rows)
    if printed.quantity.iloc[0].startswith("H of"):
        below, above = printed.value - printed.low, printed.high - printed.value
        off, width = printed.truth - printed.value, (printed.high - printed.low) / 2
    else:
        with np.errstate(divide="ignore"):
            below, above = (
                np.log(printed.value / printed.low),
                np.log(printed.high / printed.value),
            )
            off = np.log(printed.truth / printed.value)
            width = np.sqrt(printed.high / printed.low)
    with np.errstate(divide="ignore", invalid="ignore"):
        used = np.where(off < 0, -off / below, off / above)
    needed = np.nanquantile(np.where(np.isnan(used), 0, used), 0.95)
    return (
        f"{held.mean():.0%}",
        f"{silent:.0%}",
        f"{width.median():.2f}",
        f"{1 / needed:.1f}" if needed else "–",
    )


ASKED = {
    "grid": (
        "The grid",
        "A map of 64 x 64 pixels is pressed with `grid_error=True`, free, at contact area "
        "fractions of about 0.003, 0.03 and 0.3. The truth is the surface on 256 x 256 points that "
        "the instrument saw. H: hardness over E* and the rms slope of that surface.",
    ),
    "larger": (
        "The larger surface behind one map",
        "A map of 128 x 128 pixels that are means, with its own tilt, is asked for a joint of "
        "4 x 4 maps. The truth is the whole joint on 1024 x 1024 points.",
    ),
    "part": (
        "A part, from several maps",
        "Maps of 96 x 96 pixels that are means, drawn from the 25 of a part. The truth of a joint "
        "is the whole part on 960 x 960 points, that of a map's own stiffness is the mean over "
        "all 25 places, on 192 x 192 points each.",
    ),
    "scan": (
        "A line scan",
        "Line scans of maps of 256 x 256 points, across the lay where there is one, with 20 to 60 "
        "roll-off wavelengths a side, "
        "are pressed; the truth is the map in the full model.",
    ),
    "fit": (
        "The Hurst exponent",
        "Maps of 128 x 128 pixels, and scans of 128, seen by an instrument on surfaces of four "
        "times as many points. Half widths are those of H itself.",
    ),
}
"""What each study asks: its heading, and what is counted."""


def written(rows, page):
    """Write a table for each study: quantities and kinds down, what is counted across."""
    for study, of_study in rows.groupby("study", sort=False):
        heading, asked = ASKED[study]
        page.say(f"\n## {heading}\n\n{asked}\n")
        page.table("surfaces", "quantity", "intervals", "held", "silent", "half width", "too wide")
        groups = ["kind", "option"] if study in ("grid", "fit") else ["kind"]
        for quantity, some in of_study.groupby("quantity", sort=False):
            page.row("all", quantity, len(some), *summary(some))
            for group in groups:
                for name, here in some.groupby(group, sort=False):
                    page.row(name, quantity, len(here), *summary(here))


def misses(rows):
    """Kinds and quantities of which fewer than nine in ten printed intervals hold."""
    found = []
    for (_, quantity, kind), some in rows.groupby(["study", "quantity", "kind"], sort=False):
        held, *_ = summary(some)
        if held != "–" and float(held.rstrip("%")) < 90:
            found.append(f"{quantity} of {kind} ({held})")
    return found


def main():
    """Run the studies, and print their tables."""
    parser = argparse.ArgumentParser()
    parser.add_argument("studies", nargs="*", default=[*STUDIES])
    parser.add_argument("--folder", type=Path, default=Path("out/intervals"))
    parser.add_argument("--share", type=float, default=1.0, help="of all seeds")
    parser.add_argument("--seed", type=int, default=0, help="the first one")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    page = Page("intervals-table.md", "Intervals on surfaces as they are measured", "intervals")
    page.say(
        "Held: share of the printed intervals that hold the truth. Silent: share for which no "
        "interval is printed, because the data break an assumption. Half width: median factor from "
        "the middle to the ends. Too wide: by how much the logarithms of all intervals of a row "
        "could be divided so that 95 of 100 still hold."
    )
    rows = measured_rows(arguments.folder, arguments.studies, arguments.seed, arguments.share)
    few = ", ".join(misses(rows))
    beside = "A map or a scan does not show what lies beside it."
    page.say(f"\nFewer than nine in ten hold for: {few}. {beside}")
    written(rows, page)
    if (set(arguments.studies), arguments.share) == (set(STUDIES), 1.0):
        page.save()


if __name__ == "__main__":
    main()
