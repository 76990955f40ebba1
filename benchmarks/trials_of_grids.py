"""How often the error of the grid covers grids four times finer."""

import math
from pathlib import Path

import numpy as np
from made_surfaces import GAUSSIAN, INSTRUMENTS, KINDS, Make, parent_of, piece_of
from trials import (
    E_STAR,
    WANTED,
    Study,
    as_surface,
    hardness_of,
    make_of,
    pressures_of,
    row,
    seen,
)

import roughline as rl

HARDNESS_BARS = (None, 0.5, 0.15, 0.05)  # over E* and the rms slope; None: elastic
SAMPLINGS = ("pixel means", "points of a rougher surface")
LOADS = np.geomspace(0.003, 1.0, 6)  # F / (E* h L)
HARDNESSES = np.geomspace(0.03, 1.0, 11)  # H / (E* times the rms slope of the finer grid)
DRAWN = 3  # of them, for each surface
HURSTS = (0.2, 0.4, 0.6, 0.8, 1.0)
CELLS = (0.0, 4.0, 8.0, 16.0)  # points of the finer grid to the shortest wave
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
MEASURES = {"u_m": rl.MEAN_GAP, "u_h": rl.hydraulic_aperture("x")}
QUANTITIES = {"k": "stiffness", "k_u": "unloading_stiffness", "A": "area_fraction_corrected"}


def rows_beside(finer, coarse, forces, loads, **given):
    """Intervals of a map for the error of its grid, and what the finer grid gives."""
    given |= {"forces": forces, "throw": False}
    given |= {} if "half_space" in given else {"E_star": E_STAR}
    truth, curve = rl.press(finer, **given), rl.press(coarse, grid_error=True, **given)
    for symbol, name in QUANTITIES.items():
        error_of = name.replace("_corrected", "") + "_error"
        v, e, true = getattr(curve, name), getattr(curve, error_of), getattr(truth, name)
        with np.errstate(divide="ignore", invalid="ignore"):  # no k where all of the contact yields
            known = curve.resolved & np.isfinite(np.log(true / v))
        for i in np.flatnonzero(known):
            ends = (0.0, math.inf) if math.isnan(e[i]) else (v[i] / (1 + e[i] / v[i]), v[i] + e[i])
            yield row(symbol, loads[i], true[i], v[i], *ends)
    for symbol, measure in MEASURES.items() if curve.measured else ():
        true, measured = truth.measured[measure.name].values, curve.measured[measure.name]
        for i in np.flatnonzero(curve.resolved & np.isfinite(true)):
            yield row(symbol, loads[i], true[i], *measured.rows[:, i])


def grid_rows(kind, option, seed):
    """A map of 64 x 64 pixels, and the piece on four times as many that the instrument saw."""
    instrument, bar = option.split(", H ")
    bar = None if bar == "none" else float(bar)
    make, rng = make_of("grid", kind, seed)
    fine = parent_of(kind, make, rng).detrended()
    fine = as_surface(fine.heights, fine)
    coarse, forces = seen("grid", fine, instrument, rng), pressures_of(fine, bar) * fine.area
    given = {"measures": [*MEASURES.values()], **hardness_of(fine, bar)}
    return rows_beside(fine, coarse, forces, WANTED, **given)


def finer_rows(kind, option, seed):
    """Maps, each with its finer grid, elastic and with some hardnesses, under rising loads."""
    for maps, finer, hardnesses in _finer_grids(kind, seed):
        for sampling, surface in maps.items():
            for bar in (None, *hardnesses):
                forces, hardness = LOADS * E_STAR * finer.rms_height * finer.length, {}
                if bar is not None:
                    hardness = hardness_of(finer, bar)
                    forces = forces[forces < hardness["hardness"] * finer.area / 2]
                    forces = np.append(forces, 0.3 * forces[-1:])  # the last one is unloaded
                group = kind if kind.startswith("quarters") else "others"
                if kind in GAUSSIAN or kind in ON_TWO_GRIDS:
                    group = "Gaussian"
                told = {
                    "bodies": f"{group}, {sampling}, {'elastic' if bar is None else 'yielding'}",
                    "hardness": None if bar is None else f"H / (E*∇h) = {bar:.3f}",
                }
                if forces.size:
                    for each in rows_beside(finer, surface, forces, forces, **hardness):
                        yield each | told


def _finer_grids(kind, seed):
    """A kind's maps by what they sample, their finer grid, and hardnesses that are tried."""
    drawn = np.random.default_rng(seed).permutation(HARDNESSES)[:DRAWN]
    hurst, cells, n = HURSTS[seed % 5], CELLS[seed % 4], 128 if seed % 6 == 5 else 64
    if kind.startswith("quarters"):
        whole = rl.prepared(rl.read(Path(kind.removeprefix("quarters of "))))
        sides = [[(0, n // 2), (n // 2, n)] for n in whole.shape]
        for x in sides[0]:
            for y in sides[1]:
                finer = whole.cropped(x, y)
                finer = finer.cropped(*((0, n - n % 16) for n in finer.shape))
                yield {"means": finer.coarsened().coarsened()}, finer, HARDNESSES[2::3]
    elif kind in ON_TWO_GRIDS:
        spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0, **ON_TWO_GRIDS[kind](n))
        yield {"one seed": spectrum.surface(n, seed)}, spectrum.surface(4 * n, seed), drawn
    else:
        rng = np.random.default_rng([seed, *kind.encode()])
        make = Make(4 * n, 2, hurst, float(rng.uniform(3, 12)), cells)
        finer = piece_of(parent_of(kind, make, rng), make, rng)
        heights = {each: INSTRUMENTS[each](finer.heights, 4, rng) for each in SAMPLINGS}
        yield (
            {each: rl.Surface(pixels, finer.sizes, unit="m") for each, pixels in heights.items()},
            finer,
            drawn,
        )


GRID = Study(
    grid_rows,
    "The grid",
    "A map of 64 x 64 pixels is pressed with `grid_error=True`, free, at contact area fractions of "
    "about 0.003, 0.03 and 0.3. The truth is the surface on 256 x 256 points that the instrument "
    "saw. H: hardness over E* and the rms slope of that surface.",
    tuple(KINDS),
    tuple(f"{each}, H {bar or 'none'}" for each in SAMPLINGS for bar in HARDNESS_BARS),
    groups=("kind", "option"),
)
FINER = Study(
    finer_rows,
    "Grids four times finer",
    "Loads F / (E* h L) go from 0.003 to 1, as far as they are below half the hardness; the last "
    "one of bodies that yield is unloaded to three tenths.",
    (*KINDS, *ON_TWO_GRIDS),
    seeds=12,
    groups=("bodies", "hardness"),
    columns=("held", "off by", "half width", "too wide"),
)
