"""Compare metals that yield with elastic bodies, in time and in memory: ``make yielding``.

The hardness is a third of the mean elastic contact pressure of the (last) load. Times are the best
of several, elastic and yielding in turn; memory is that of processes of their own.
"""

import argparse
import multiprocessing
import resource
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor

import numpy as np

import roughline as rl

FORCES = {"one load": [0.4], "12 loads": np.geomspace(0.01, 1.0, 12)}  # F / (E* h L)


def problem(n, hurst, loads):
    """A surface, its loads, and a third of the elastic contact pressure of the last."""
    surface = rl.SelfAffine(hurst=hurst, rms_height=1.0).surface(n, 7)
    last = rl.press(surface, E_star=1.0, forces=FORCES[loads][-1:])
    return surface, float(last.force[0] / (last.area_fraction[0] * surface.area)) / 3


def timed(surface, forces, hardness):
    """A curve, and its wall time. [s]"""
    start = time.perf_counter()
    curve = rl.press(surface, E_star=1.0, forces=forces, hardness=hardness)
    return curve, time.perf_counter() - start


def print_times(repeats):
    """Print the table of times and convolutions."""
    timed(rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(512, 7), [0.4], 10.0)  # compiles
    print(
        "\n| loads | grid | H | yield | elastic | with yield | ratio | convolutions | with yield |"
    )
    print("|---" * 9 + "|")
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
                print(
                    f"| {loads} | {n}² | {hurst} | {yielding.plastic_fraction[-1]:.0%} "
                    f"| {best[None]:.2f} s | {best[hardness]:.2f} s "
                    f"| {best[hardness] / best[None]:.2f} "
                    f"| {elastic.convolutions.sum()} | {yielding.convolutions.sum()} |",
                    flush=True,
                )


def peak(n, hardness):
    """Bytes that this process came to hold over those before, the generation included."""
    unit = 1 if sys.platform == "darwin" else 1024
    timed(rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(64, 0), [0.01], 1.0)  # compiles
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    timed(rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(n, 7), FORCES["12 loads"], hardness)
    return (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * unit


def print_memory():
    """Print the table of memory; processes count what the one that starts them holds."""
    print("| loads | grid | H | elastic | with yield | ratio |")
    print("|---" * 6 + "|")
    for n in (1024, 2048):
        with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as elsewhere:
            _, hardness = elsewhere.submit(problem, n, 0.8, "12 loads").result()
        elastic, yielding = (
            int(subprocess.check_output([sys.executable, __file__, "--peak", str(n), str(each)]))
            for each in (np.inf, hardness)
        )
        print(
            f"| 12 loads | {n}² | 0.8 | {elastic / n**2:.0f} B a point | "
            f"{yielding / n**2:.0f} B a point | {yielding / elastic:.2f} |",
            flush=True,
        )


def main():
    """Print both tables, or the memory of one case."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--peak", nargs=2, metavar=("POINTS", "HARDNESS"), help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.peak:
        print(peak(int(arguments.peak[0]), float(arguments.peak[1])))
        return
    print(f"roughline {rl.__version__}\n")
    print_memory()
    print_times(arguments.repeats)


if __name__ == "__main__":
    main()
