"""Compare estimated grid errors with grids four times finer: ``make grid-error``.

Files given as arguments are pressed as well: the whole map is the finer grid, and its means of
four by four points are the grid whose error is estimated. With ``--hardness-bar BAR`` the bodies
yield at BAR times the rms slope of the finer grid, and loads end at half the hardness.
"""

import argparse
import math
import sys

import numpy as np

import roughline as rl

LOADS = np.geomspace(0.003, 1.0, 6)  # F / (E* h L)
SPECTRA = {
    "rough down to the grid": lambda n: {},
    "roll-off at L / 6, rough down to the grid": lambda n: {"q_roll": 12 * math.pi},
    "cutoff at 2.2 cells": lambda n: {"q_high": math.tau * n / 2.2},
    "cutoff at 4 cells": lambda n: {"q_high": math.tau * n / 4},
    "cutoff at 8 cells": lambda n: {"q_high": math.tau * n / 8},
}
BEARINGS = (0.1, 0.3, 0.6)  # share of the area of which the top is cut flat
NOISE = (0.03, 0.3)  # rms of white noise of the finest points, over the rms height
ELASTIC = {  # symbol: quantity, its error
    "k": ("stiffness", "stiffness_error"),
    "A": ("area_fraction_corrected", "area_fraction_error"),
}
YIELDING = {"k_u": ("unloading_stiffness", "unloading_stiffness_error")} | ELASTIC


def factors(surface, finer, hardness_bar):
    """Logarithms of the true and the claimed factors, by quantity."""
    forces = LOADS * finer.rms_height * finer.length
    hardness = None
    if hardness_bar is not None:
        hardness = hardness_bar * finer.rms_slope
        forces = forces[forces < hardness * finer.area / 2]
    curve, truth = (
        rl.press(
            each,
            E_star=1.0,
            forces=forces,
            hardness=hardness,
            grid_error=each is surface,
            throw=False,
        )
        for each in (surface, finer)
    )
    found = {}
    for symbol, (name, error) in (ELASTIC if hardness is None else YIELDING).items():
        value, true = getattr(curve, name), getattr(truth, name)
        missed = np.abs(np.log(true / value))
        claimed = np.log1p(getattr(curve, error) / value)
        found[symbol] = missed[curve.resolved], claimed[curve.resolved]
    return found


def coarsened(surface):
    """Means of four by four points, of the largest part that has them sixteen times."""
    nx, ny = (n - n % 16 for n in surface.shape)
    whole = surface.cropped((0, nx), (0, ny))
    return whole.coarsened().coarsened(), whole


def cases(files, seeds):
    """Kinds of surfaces, each with its grid and the finer one."""
    for n, count in ((64, seeds), (128, seeds // 2)):
        for hurst in (0.2, 0.4, 0.6, 0.8, 1.0):
            for seed in range(count):
                for kind, more in SPECTRA.items():
                    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0, **more(n))
                    yield (
                        kind,
                        spectrum.surface(n, 1000 + seed),
                        spectrum.surface(4 * n, 1000 + seed),
                    )
    for n in (64, 128):
        for hurst in (0.3, 0.5, 0.8):
            for seed in range(max(1, seeds // 3)):
                spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0, q_high=math.tau * n / 8)
                rough = spectrum.surface(4 * n, 1000 + seed)
                for bearing in BEARINGS:
                    honed = np.minimum(rough.heights, np.quantile(rough.heights, 1 - bearing))
                    yield (
                        "tops cut flat",
                        rl.Surface(honed[::4, ::4], rough.sizes),
                        rl.Surface(honed, rough.sizes),
                    )
    for share in NOISE:
        for seed in range(seeds):
            rough = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(512, 1000 + seed)
            noise = share * np.random.default_rng(seed).standard_normal(rough.shape)
            grids = coarsened(rl.Surface(rough.heights + noise, rough.sizes))
            yield f"white noise, {share:g} of the rms height", *grids
    for file in files:
        whole = rl.prepared(rl.read(file))
        sides = [[(0, n // 2), (n // 2, n)] for n in whole.shape]
        for rows in sides[0]:
            for columns in sides[1]:
                yield (
                    f"quarters of {file.rsplit('/')[-1]}",
                    *coarsened(whole.cropped(rows, columns)),
                )


def main():
    """Print a table by kind of surface."""
    parser = argparse.ArgumentParser()
    parser.add_argument("files", nargs="*")
    parser.add_argument("--seeds", type=int, default=6)
    parser.add_argument("--hardness-bar", type=float)
    arguments = parser.parse_args()
    found = {}
    for kind, surface, finer in cases(arguments.files, arguments.seeds):
        found.setdefault(kind, []).append(factors(surface, finer, arguments.hardness_bar))
        print(".", end="", file=sys.stderr, flush=True)
    shown = ELASTIC if arguments.hardness_bar is None else YIELDING
    header = "".join(f" {symbol}: covered | off by | claimed |" for symbol in shown)
    print(f"\nroughline {rl.__version__}, loads F / (E* h L) = 0.003 to 1\n")
    print(f"| surfaces | loads |{header}")
    print("|---" * (2 + 3 * len(shown)) + "|")
    for kind, rows in found.items():
        cells = []
        for symbol in shown:
            missed, claimed = (np.concatenate([row[symbol][i] for row in rows]) for i in (0, 1))
            cells.append(f"{np.mean(missed <= claimed):.0%}")
            cells += [f"{np.exp(np.median(each)):.3f}" for each in (missed, claimed)]
        print(f"| {kind} | {missed.size} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
