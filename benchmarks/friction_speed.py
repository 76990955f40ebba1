"""What a load with friction costs, as a ratio to the same load without it.

Both are warm: they start from the load before. Times are those of the processor, each the least of
two runs in turns, so that other programs count little.

    python benchmarks/friction_speed.py --points 512 1024
"""

import argparse
import os
import time

import numpy as np
from page import Page, machine

import roughline as rl
from roughline.halfspace.friction import slide_step
from roughline.halfspace.friction.slid import ShearLoad
from roughline.halfspace.friction.slip_path import SlidePath
from roughline.halfspace.inverse.cache import working_memory
from roughline.halfspace.laws.unilateral import Unilateral
from roughline.halfspace.search.path import LoadPath
from roughline.halfspace.search.problem import Grid, Load, Method, Problem

FORCE, FRICTION, POISSON, BETA = 0.02, 0.3, 0.3, 2 / 7
RUNS, CYCLE = 2, 32
PARTS = (  # name, its shear over the largest, and what it may cost
    ("press to the load, no shear", 0.0, ""),
    ("a step, Q = .3 μF", 0.3, "1.0"),
    ("a step, Q = .4 μF", 0.4, "1.0"),
    ("reversal, back to Q = .3 μF", 0.3, "1.3"),
)


def bodies(points, beta):
    """A rough body over a half-space, and how it is pressed."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0)
    surface = spectrum.surface(points, rng=7)
    half_space = rl.Homogeneous(1.0, poisson=POISSON, beta=beta)
    grid = Grid(half_space, surface.shape, tuple(np.divide(surface.sizes, surface.shape)))
    separation, method = surface.heights.max() - surface.heights, Method(1e-6, 1000)
    resolution = method.resolution(grid)
    return Problem(grid, separation, surface.rms_height, resolution, Unilateral()), method


def timed(function, *given):
    """What a call gives, and its processor time. [s]"""
    start = time.process_time()
    return function(*given), time.process_time() - start


class Timed:
    """A function that counts its processor time."""

    def __init__(self, function):
        self.function, self.seconds = function, 0.0

    def __call__(self, *given):
        found, seconds = timed(self.function, *given)
        self.seconds += seconds
        return found


def normal(problem, method):
    """The time of the last of three loads without friction."""
    path, seconds = LoadPath(problem, method), 0.0
    for part in (0.94, 0.97, 1.0):
        _, seconds = timed(path.under, Load(force=part * FORCE))
    return seconds


def path_of(problem, method):
    """The friction path up to the load before the last."""
    path = SlidePath(problem, rl.Friction(FRICTION), method)
    for part in (0.94, 0.97):
        path.under(Load(force=part * FORCE), ShearLoad(force=(0.0, 0.0)))
    return path


def stepped(problem, method, tangents):
    """The time of each part, without its tangents, and that of these."""
    path, times = path_of(problem, method), []
    for _, share, _ in PARTS:
        tangents.seconds = 0.0
        shear = ShearLoad(force=(share * FRICTION * FORCE, 0.0))
        slid, seconds = timed(path.under, Load(force=FORCE), shear)
        assert slid.residual <= method.rtol
        times.append((seconds - tangents.seconds, tangents.seconds))
    return times


def cycled(problem, method):
    """The time of a cycle of steps, with all tangents, after the first quarter."""
    path, amplitude = path_of(problem, method), 0.5 * FRICTION * FORCE
    shares = np.sin(2 * np.pi * np.arange(CYCLE // 4 + CYCLE + 1) / CYCLE)
    seconds = 0.0
    for i, share in enumerate(shares):
        shear = ShearLoad(force=(amplitude * share, 0.0))
        _, spent = timed(path.under, Load(force=FORCE), shear)
        seconds += spent if i > CYCLE // 4 else 0.0
    return seconds


def measure(page, points, beta, cycle):
    """Rows of one grid."""
    name = "shear_tangents" if beta == 0 else "coupled_tangents"
    tangents = Timed(getattr(slide_step, name))
    setattr(slide_step, name, tangents)
    plain, rows = [], []
    for _ in range(RUNS):
        problem, method = bodies(points, 0.0)
        plain += [normal(problem, method), normal(problem, method)]
        rows.append(stepped(*bodies(points, beta), tangents))
    least = min(plain)
    kind = "coupled" if beta else "uncoupled"
    for i, (part, _, aim) in enumerate(PARTS):
        step, both = (min(row[i][kind] for row in rows) / least for kind in (0, 1))
        aimed = "4" if beta else aim
        page.row(f"{points}²", kind, part, f"{step:.1f}", aimed, f"{both:.1f}", "0.5")
    if cycle:
        spent = cycled(*bodies(points, beta)) / least
        page.row(
            f"{points}²", kind, f"a cycle of {CYCLE} steps", f"{spent:.0f}", "20", "within", ""
        )
    setattr(slide_step, name, tangents.function)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--points", type=int, nargs="+", default=[512, 1024])
    given = parser.parse_args()
    load = f"{os.getloadavg()[0]:.0f} processes waited for the cores"
    page = Page("friction-speed", "measured.md", "friction-speed", f"{machine()}; {load}")
    page.table("grid", "bodies", "load", "over a normal load", "aim", "both tangents", "aim")
    with working_memory():
        for points in given.points:
            for beta in (0.0, BETA):
                measure(page, points, beta, cycle=beta == 0)
    page.save()


if __name__ == "__main__":
    main()
