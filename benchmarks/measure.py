"""Measure both models on this machine and write a part of docs/measured.md: ``make benchmark``.

Times of one run belong together; on another machine, or with other work beside, they differ. The
ratios to a plain zero-padded convolution and to a plain inverse FFT of the same run travel better.
"""

import argparse
import multiprocessing
import os
import statistics
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import ducc0.fft
import numpy as np
from page import Page, once

import roughline as rl
from roughline.computing.cores import available_cores
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.operators.discretisation import on_grid
from roughline.halfspace.operators.grid_nodes import GridNodes

CORES = available_cores()


def seconds(function, repeats=5):
    """Return the median wall time of a call, after one that is not counted."""
    function()
    return statistics.median(once(function)[1] for _ in range(repeats))


def plain_convolution(n):
    """Time a convolution on twice the grid with no pruning and no blocking."""
    spectrum, padded = np.ones((2 * n, n + 1)), np.zeros((2 * n, 2 * n))

    def convolve():
        padded[n:, :] = 0
        padded[:n, n:] = 0
        modes = ducc0.fft.r2c(padded, axes=(0, 1), nthreads=CORES)
        modes *= spectrum
        return ducc0.fft.c2r(modes, axes=(0, 1), lastsize=2 * n, forward=False, nthreads=CORES)

    return seconds(convolve)


def our_convolution(n, precision):
    """Time our convolution, a tenth of the nodes in contact."""
    operator = on_grid(Homogeneous(E_star=1.0), (n, n), (1 / n, 1 / n))
    nodes = np.flatnonzero(np.random.default_rng(0).random((n, n)) < 0.1)
    loaded, pressure = GridNodes.of(nodes, (n, n)), np.ones(nodes.size)
    return seconds(lambda: operator.displacement(pressure, loaded, loaded, precision))


def convolutions(page):
    page.heading("One convolution")
    page.table("grid", "plain, zero-padded", "ours, double", "ours, single", at_most=3)
    for n in (512, 1024, 2048):
        plain = plain_convolution(n)
        ours = (our_convolution(n, precision) for precision in ("float64", "float32"))
        told = (f"{each * 1e3:.1f} ms, 1/{plain / each:.1f}" for each in ours)
        page.row(f"{n}²", f"{plain * 1e3:.1f} ms", *told)


def paths(page, n_loads=20):
    """Time whole paths from first touch to saturation, stiffness included, and cold loads."""
    page.heading(f"Full model: {n_loads} loads from first touch to saturation")
    counts = ("plain convolutions", "own convolutions")
    page.table("grid", "H", "per load", *counts, "last k", "residual")
    for n in (512, 1024, 2048):
        for hurst in (0.2, 0.5, 0.8):
            surface = rl.SelfAffine(hurst=hurst, rms_height=1.0).surface(n, 7)
            plain = plain_convolution(n)
            curve, wall = once(lambda s=surface: rl.press(s, E_star=1.0, n_loads=n_loads))
            plain = (plain + plain_convolution(n)) / 2  # as fast as the machine was meanwhile
            times = (f"{wall / n_loads:.2f} s", f"{wall / n_loads / plain:.0f}")
            own = f"{curve.convolutions.mean():.0f}, at most {curve.convolutions.max()}"
            last = (f"{curve.stiffness_bar[-1]:.2f}", f"{curve.residual.max():.0e}")
            page.row(f"{n}²", hurst, *times, own, *last)
    page.heading("Full model: one cold load, H = 0.8")
    page.table("grid", "contact", "time", "plain convolutions")
    for n in (512, 1024, 2048):
        plain = plain_convolution(n)
        surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(n, 7)
        curve, wall = once(lambda s=surface: rl.press(s, E_star=1.0, forces=[0.38]))
        page.row(f"{n}²", f"{curve.area_fraction[0]:.1%}", f"{wall:.2f} s", f"{wall / plain:.0f}")


def growth(page, n_loads=6):
    """Fit how time and convolutions per load grow with the number of points."""
    page.heading(f"Full model: growth with the grid, H = 0.8, {n_loads} loads to saturation")
    page.table("grid", "per load", "convolutions per load", at_most=3)
    sizes, times, counts = [256, 512, 1024, 2048, 4096], [], []
    forces = np.geomspace(0.1, 3.0, n_loads)
    for n in sizes:
        surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(n, 7)
        curve, wall = once(lambda s=surface: rl.press(s, E_star=1.0, forces=forces))
        times.append(wall / n_loads)
        counts.append(curve.convolutions.mean())
        page.row(f"{n}²", f"{times[-1]:.3f} s", f"{counts[-1]:.0f}")
    points = np.log(np.square(sizes))
    exponents = [np.polyfit(points, np.log(values), 1)[0] for values in (times, counts)]
    page.say(
        f"Time per load grows like N^{exponents[0]:.2f} with the number of points N, "
        f"convolutions per load like N^{exponents[1]:.2f}."
    )


def press_lines(task):
    """Generate and press some lines of 2^20 points on 200 loads; one worker's work."""
    hurst, seeds = task
    spectrum, forces = rl.SelfAffine(hurst=hurst, rms_height=1.0), np.geomspace(1e-5, 10, 200)
    for seed in seeds:
        rl.press(spectrum.line(2**20, seed), E_star=1.0, forces=forces)
    return len(seeds)


def reduced_model(page, n_lines=500):
    """Time lines: one, and the paper's ensemble for six fractal dimensions."""
    page.heading("Reduced model: lines of 2^20 points, 200 loads")
    n, forces = 2**20, np.geomspace(1e-5, 10, 200)
    spectrum, modes = rl.SelfAffine(hurst=0.8, rms_height=1.0), np.ones(2**19 + 1, dtype=complex)
    numpys = seconds(lambda: np.fft.irfft(modes), 15)
    duccs = seconds(lambda: ducc0.fft.c2r(modes, lastsize=n, forward=False, nthreads=1), 15)
    generate = seconds(lambda: spectrum.line(n, 7), 15)
    line = spectrum.line(n, 7)
    press = seconds(lambda: rl.press(line, E_star=1.0, forces=forces), 15)
    total = generate + press
    page.say(
        f"One line: generated in {generate * 1e3:.1f} ms and pressed in {press * 1e3:.1f} ms, "
        f"together {total / duccs:.1f} times its inverse real FFT by ducc0 on one thread "
        f"({duccs * 1e3:.1f} ms), {total / numpys:.1f} times NumPy's ({numpys * 1e3:.1f} ms)."
    )
    tasks = [
        (hurst, range(start, start + 50))
        for hurst in (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)
        for start in range(0, n_lines, 50)
    ]
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(CORES, context) as pool:
        done, wall = once(lambda: sum(pool.map(press_lines, tasks)))
    page.say(
        f"{n_lines} lines for each of six fractal dimensions: {wall:.0f} s on {CORES} cores, "
        f"{wall / done * 1e3:.1f} ms a line."
    )


def start_up(page):
    page.heading("Start-up")
    empty, ours, usage = (
        seconds(lambda a=a: subprocess.run(a, check=True, stdout=subprocess.DEVNULL))
        for a in (
            [sys.executable, "-c", "pass"],
            [sys.executable, "-c", "import roughline"],
            [str(Path(sys.executable).with_name("roughline")), "--help"],
        )
    )
    page.say(
        f"`import roughline`: {1e3 * (ours - empty):.0f} ms above an empty interpreter; "
        f"`roughline --help`: {usage:.2f} s as a whole."
    )


def main():
    parts = (convolutions, paths, growth, reduced_model, start_up)
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=[part.__name__ for part in parts])
    only = parser.parse_args().only
    warm = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(512, 7)
    rl.press(warm, E_star=1.0, forces=[0.01, 0.02, 0.3])  # compiles
    page = Page("speed", "measured.md", "benchmark")
    for part in parts:
        if only in (None, part.__name__):
            part(page)
    if only is None:
        page.save()


if __name__ == "__main__":
    # the threads of the linear algebra would spin beside the transforms that are timed
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    main()
