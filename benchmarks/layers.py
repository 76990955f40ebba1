"""The price of a layer: a press beside that of a homogeneous body, of one run: ``make layers``.

The same rough surface is pressed into both under three forces. Those on the layer are as large a
part of the pressures in full contact, so that about as much touches. Times are those of the
processors, the least of three runs that take turns, or of one that takes long. The table is of
`docs/how-to/layers.md`.
"""

import argparse
import math
import time

import numpy as np

import roughline as rl

POISSON = 0.3
YOUNG_OF_BASE = (1e-3, 0.1, 10.0, math.inf)  # over that of the layer
CELLS = (64, 16, 4, 1)  # of the layer's thickness
PARTS = np.array([0.02, 0.06, 0.2]) * 0.3  # of the rms pressure in full contact
RUNS, LONG = 3, 5.0  # [s]


def in_full_contact(surface, half_space):
    """Rms pressure of full contact."""
    (nx, ny), (dx, dy) = surface.shape, surface.spacing
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(nx, dx)[:, None], np.fft.fftfreq(ny, dy))
    waves = np.abs(np.fft.fft2(surface.heights)) / (nx * ny)
    q[0, 0], waves[0, 0] = 1.0, 0.0
    return math.sqrt(float(np.sum((waves / half_space.spectrum(q)) ** 2)))


def pressed(surface, half_space):
    forces = PARTS * in_full_contact(surface, half_space) * math.sqrt(2) * surface.area
    began = time.process_time()
    curve = rl.press(surface, half_space=half_space, forces=forces, throw=False)
    return time.process_time() - began, curve


def least(surface, plain, layer):
    """The quickest press into each, and its time."""
    runs = []
    while len(runs) < RUNS and not (runs and runs[-1][1][0] > LONG):
        runs.append([pressed(surface, each) for each in (plain, layer)])
    return [min(each, key=lambda run: run[0]) for each in zip(*runs, strict=True)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, nargs="+", default=[512, 1024])
    parser.add_argument("--bases", type=float, nargs="+", default=YOUNG_OF_BASE)
    parser.add_argument("--cells", type=float, nargs="+", default=CELLS)
    given = parser.parse_args()
    print("points  boundary  base    cells  seconds of one body  of the layer  ratio  contact")
    for points in given.points:
        spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0, length=1.0)
        surface = spectrum.surface(points, rng=7)
        for periodic in (False, True):
            plain = rl.Homogeneous(1 / (1 - POISSON**2), periodic)
            for base in given.bases:
                for cells in given.cells:
                    layer = rl.Layered(1.0, POISSON, cells / points, base, POISSON, periodic)
                    one, other = least(surface, plain, layer)
                    curve = other[1]
                    contact = " ".join(f"{100 * part:.1f}" for part in curve.area_fraction)
                    spent = " ".join(str(int(each)) for each in curve.convolutions)
                    print(
                        f"{points:6}  {'periodic' if periodic else 'free':8}  {base:6g}  {cells:5g}"
                        f"  {one[0]:19.2f}  {other[0]:12.2f}  {other[0] / one[0]:5.2f}"
                        f"  {contact} %  ({spent} convolutions)",
                        flush=True,
                    )


if __name__ == "__main__":
    main()
