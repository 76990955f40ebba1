"""Measure the peak memory of presses beside its estimate: ``make memory``.

Each press has a process of its own. All of them take some ten minutes and 3 GB, and write
a part of ``docs/measured.md``; ``python benchmarks/memory.py 16384 free 0.3`` prints a row for a
grid, a boundary and reduced forces. With ``--hardness 3`` the bodies yield where the pressure is a
third of the mean contact pressure of elastic ones, half of E* times the rms slope.
"""

import argparse
import itertools

import numpy as np
from page import Page, elsewhere, once, peak, resident

import roughline as rl
from roughline.contact.estimates import bytes_at_a_point, expected_area_fraction
from roughline.contact.loads import Loads

SEVERAL = (0.03, 0.3, 3.0)
HISTORY = (0.1, 0.2, 0.5, 1.0, 0.5, 0.2, 0.1, 0.5, 1.0, 0.5)
FREE = ((0.03,), (3.0,), SEVERAL, (10.0,), (30.0,), (100.0,))
PERIODIC = (*FREE[:-1], (60.0,))
ELASTIC = (
    *((n, "free", forces) for n in (1024, 2048) for forces in FREE),
    *((1024, "periodic", forces) for forces in PERIODIC),
    *((4096, "free", (force,)) for force in (0.03, 0.3, 3.0, 30.0)),
    *((4096, "periodic", (force,)) for force in (0.03, 3.0)),
)
YIELDING = tuple(itertools.product((1024,), ("free", "periodic"), (HISTORY,), (1.0, 3.0, 6.0)))


def estimated(surface, forces, hardness, *, periodic):
    """Return what is estimated for a press, the heights included. [bytes/point]"""
    loads = Loads("forces", np.array(forces))
    several, yielding = len(forces) > 1, hardness is not None
    law = rl.Yielding(hardness) if yielding else rl.Unilateral()
    share = expected_area_fraction(surface, rl.Homogeneous(1.0, periodic), loads, law)
    held = bytes_at_a_point(surface.shape, periodic, share, yielding=yielding, several=several)
    return round(held) + surface.heights.itemsize


def cells(n, boundary, forces, pressure_over_hardness=None):
    """Press a surface; return the cells of its row."""
    periodic = boundary == "periodic"
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0)
    small = spectrum.surface(320, 0)  # above the grids that have a search of their own
    for law in (rl.Yielding(30.0), rl.Unilateral()):  # compiles, whatever the contact needs
        half_space = rl.Homogeneous(1.0, periodic)
        rl.press(small, half_space=half_space, law=law, forces=[0.01, 1.0, 20.0])
    interpreter = resident()
    surface = spectrum.surface(n, 7)
    hardness = None
    if pressure_over_hardness:
        hardness = surface.rms_slope / 2 / pressure_over_hardness
    given = {"E_star": 1.0, "forces": forces, "periodic": periodic, "hardness": hardness}
    curve, wall = once(lambda: rl.press(surface, **given))
    held = (peak() - interpreter) / n**2
    told = estimated(surface, forces, hardness, periodic=periodic)
    asked = ["rising and falling" if forces == HISTORY else ", ".join(f"{f:g}" for f in forces)]
    if pressure_over_hardness:
        asked.insert(0, f"{pressure_over_hardness:g}")
    return [
        *(f"{n}²", boundary, *asked, f"{curve.area_fraction.max():.2%}"),
        *(f"{held:.0f}", f"{told:.0f}", f"{told / held - 1:+.0%}"),
        *(f"{peak() / 1e9:.2f} GB", f"{wall / len(forces):.1f} s", f"{curve.residual.max():.0e}"),
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("points", type=int, nargs="?")
    parser.add_argument("boundary", choices=["free", "periodic"], default="free", nargs="?")
    parser.add_argument("forces", type=float, nargs="*")
    parser.add_argument("--hardness", type=float, metavar="RATIO", help="p_c / H")
    asked = parser.parse_args()
    if asked.points:
        forces = tuple(asked.forces) or SEVERAL
        print(" | ".join(cells(asked.points, asked.boundary, forces, asked.hardness)))
        return
    page = Page("memory", "measured.md", "memory")
    page.say(
        "Bytes a point are those above the interpreter, the generation of the surface included; "
        "the estimate is that of a press with the contact that the loads are expected to bring "
        "about, and the 8 bytes of the heights; `rl.estimate` adds a margin, and the interpreter "
        "with its libraries. H = 0.8, a process for each row. Seconds are those of a load, where "
        "other programs may have run beside."
    )
    held = ("bytes a point", "estimated", "estimate over it", "peak")
    measures = ("in contact", *held, "a load", "residual")
    page.table("grid", "half-space", "F̄", *measures, at_most=6)
    for row in ELASTIC:
        page.row(*elsewhere(cells, *row))
    page.heading("Memory of bodies that yield")
    page.say(
        "$p_c$ is the mean contact pressure of the elastic bodies, half of $E^*$ times the rms "
        f"slope. Loads rise and fall: F̄ = {', '.join(f'{f:g}' for f in HISTORY)}."
    )
    page.table("grid", "half-space", "$p_c/H$", "F̄", *measures, at_most=3)
    for row in YIELDING:
        page.row(*elsewhere(cells, *row))
    page.save()


if __name__ == "__main__":
    main()
