"""Compare metals that yield with elastic bodies, in time and in memory.

The hardness is a third of the mean elastic contact pressure of the (last) load. Times are the best
of several, elastic and yielding in turn; memory is that of processes of their own.
``make yielding`` writes a part of ``docs/measured.md``.
"""

import argparse

import numpy as np
from page import Page, elsewhere, once, peak, resident

import roughline as rl

FORCES = {"one load": [0.4], "12 loads": np.geomspace(0.01, 1.0, 12)}  # F / (E* h L)


def problem(n, hurst, loads):
    """A surface, its loads, and a third of the elastic contact pressure of the last."""
    surface = rl.SelfAffine(hurst=hurst, rms_height=1.0).surface(n, 7)
    last = rl.press(surface, E_star=1.0, forces=FORCES[loads][-1:])
    return surface, float(last.force[0] / (last.area_fraction[0] * surface.area)) / 3


def timed(surface, forces, hardness):
    return once(lambda: rl.press(surface, E_star=1.0, forces=forces, hardness=hardness))


def add_times(page, repeats):
    timed(rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(512, 7), [0.4], 10.0)  # compiles
    page.heading(f"Time, the best of {repeats}")
    case = ("loads", "grid", "H", "of the contact yields")
    measures = ("elastic", "with yield", "ratio", "convolutions", "its convolutions")
    page.table(*case, *measures, at_most=4)
    for loads, forces in FORCES.items():
        for n in (512, 1024):
            for hurst in (0.2, 0.8):
                surface, hardness = problem(n, hurst, loads)
                best, curves = {}, {}
                for _ in range(repeats):
                    for given in (None, hardness):
                        curves[given], wall = timed(surface, forces, given)
                        best[given] = min(wall, best.get(given, wall))
                elastic, yielding = curves.values()
                share = f"{yielding.plastic_fraction[-1]:.0%}"
                times = (f"{best[None]:.2f} s", f"{best[hardness]:.2f} s")
                ratio = f"{best[hardness] / best[None]:.2f}"
                counts = (elastic.convolutions.sum(), yielding.convolutions.sum())
                page.row(loads, f"{n}²", hurst, share, *times, ratio, *counts)


def held(n, hardness):
    """Bytes that this process came to hold over those before, the generation included."""
    timed(rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(320, 0), [0.01], 1.0)  # compiles
    before = resident()
    timed(rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(n, 7), FORCES["12 loads"], hardness)
    return peak() - before


def add_memory(page):
    """Add the table of memory; processes count what the one that starts them holds."""
    page.heading("Memory over the interpreter, the generation included")
    page.table("loads", "grid", "H", "elastic", "with yield", "ratio", at_most=3)
    for n in (1024, 2048):
        _, hardness = elsewhere(problem, n, 0.8, "12 loads")
        elastic, yielding = (elsewhere(held, n, each) for each in (np.inf, hardness))
        bytes_a_point = (f"{each / n**2:.0f} bytes a point" for each in (elastic, yielding))
        page.row("12 loads", f"{n}²", 0.8, *bytes_a_point, f"{yielding / elastic:.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=5)
    repeats = parser.parse_args().repeats
    page = Page("yielding", "measured.md", "yielding")
    add_memory(page)
    add_times(page, repeats)
    page.save()


if __name__ == "__main__":
    main()
