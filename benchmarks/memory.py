"""Measure the peak memory of presses beside its estimate, each in a process of its own.

``python benchmarks/memory.py 4096`` prints a row for three loads (``make memory``), and
``python benchmarks/memory.py 4096 free 3`` one for a boundary and reduced forces. With ``table``
for the boundary, rows for light loads, saturation and nearly full contact follow each other.
"""

import resource
import subprocess
import sys
import time

import numpy as np

import roughline as rl
from roughline.contact.estimates import expected_area_fraction
from roughline.contact.loads import Loads

LOADS = (0.03, 0.3, 3.0)
TABLE = {
    "free": ((0.03,), (3.0,), LOADS, (10.0,), (30.0,), (100.0,)),
    "periodic": ((0.03,), (3.0,), LOADS, (10.0,), (30.0,), (60.0,)),
}


def peak():
    """Return the largest memory that this process has held so far. [bytes]"""
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


def print_row(n, boundary, force_bars):
    """Print a row of the tables of docs/speed.md."""
    periodic = boundary == "periodic"
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0)
    rl.press(spectrum.surface(512, 0), E_star=1.0, forces=[0.01], periodic=periodic)  # compiles
    interpreter = peak()
    surface = spectrum.surface(n, 7)
    generated = peak()
    start = time.perf_counter()
    curve = rl.press(surface, E_star=1.0, forces=force_bars, periodic=periodic)
    wall = time.perf_counter() - start
    generation, held = ((each - interpreter) / n**2 for each in (generated, peak()))
    loads = Loads("forces", np.array(force_bars))
    share = expected_area_fraction(surface, 1.0, loads, None, periodic=periodic)
    told = rl.estimate(surface.shape, len(force_bars), periodic=periodic, area_fraction=share)
    estimated = told.memory / n**2 + surface.heights.itemsize
    print(
        f"| {n}² | {boundary} | {', '.join(f'{each:g}' for each in force_bars)} | "
        f"{curve.area_fraction.max():.2%} | {held:.0f} ({generation:.0f} by the generation) | "
        f"{estimated:.0f} | {estimated / held - 1:+.0%} | {peak() / 1e9:.2f} GB | "
        f"{wall / len(force_bars):.1f} s | {curve.residual.max():.0e} |",
        flush=True,
    )


def main():
    """Print one row, or many, each from a process of its own."""
    n, boundary, *forces = [*sys.argv[1:], "free"] if len(sys.argv) == 2 else sys.argv[1:]
    if boundary != "table":
        print_row(int(n), boundary, [float(each) for each in forces] or list(LOADS))
        return
    for kind, rows in TABLE.items():
        for force_bars in rows:
            row = [sys.executable, __file__, n, kind, *map(str, force_bars)]
            subprocess.run(row, check=True)


if __name__ == "__main__":
    main()
