"""Measure both models on this machine and print a Markdown table: ``make benchmark``.

Times of one run belong together; on another machine, or with other work beside, they differ. The
ratios to a plain zero-padded convolution and to a plain inverse FFT of the same run travel better.
"""

import platform
import statistics
import subprocess
import sys
import time

import ducc0.fft
import numpy as np

import roughline as rl
from roughline import fft
from roughline.halfspace import operator as operators
from roughline.reduction import Springs


def seconds(function, repeats=5):
    """Return the median wall time of a call, after one that is not counted."""
    function()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        function()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def plain_convolution(n, spectrum):
    """Convolve on twice the grid with no pruning and no blocking."""
    cores = fft.available_cores()
    padded = np.zeros((2 * n, 2 * n))
    padded[:n, :n] = 1.0
    modes = ducc0.fft.r2c(padded, axes=(0, 1), nthreads=cores)
    modes *= spectrum
    return ducc0.fft.c2r(modes, axes=(0, 1), lastsize=2 * n, forward=False, nthreads=cores)


def full_model(n, hurst, n_loads=30):
    """Time a surface from first touch to saturation, stiffness included."""
    surface = rl.SelfAffine(hurst=hurst, rms_height=1.0).surface(n, 7)
    spectrum = np.ones((2 * n, n + 1))
    convolution = seconds(lambda: plain_convolution(n, spectrum))
    operator = operators.free((n, n), (1 / n, 1 / n), 1.0)
    pruned = seconds(lambda: operator.displacement(surface.heights))
    rl.press(surface, E_star=1.0, forces=[0.01])  # compiles
    start = time.perf_counter()
    curve = rl.press(surface, E_star=1.0, n_loads=n_loads)
    wall = time.perf_counter() - start
    per_load = wall / n_loads
    return (
        f"| full, {n}², H = {hurst} | {n_loads} loads | {wall:.1f} s | {per_load * 1e3:.0f} ms | "
        f"{per_load / convolution:.0f} plain convolutions ({convolution * 1e3:.1f} ms; pruned "
        f"{pruned * 1e3:.1f} ms) | {curve.residual.max():.0e} |"
    )


def reduced_model(exponent, n_loads=200):
    """Time a line: generate, and evaluate the whole curve."""
    n = 2**exponent
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1.0)
    modes = np.ones(n // 2 + 1, dtype=complex)
    transform = seconds(
        lambda: ducc0.fft.c2r(modes, lastsize=n, forward=False, nthreads=fft.available_cores())
    )
    generate = seconds(lambda: spectrum.line(n, 7))
    line = spectrum.line(n, 7)
    whole_curve = seconds(lambda: Springs.under(line.heights, line.spacing, 1.0).under_forces(forces))
    pressing = seconds(lambda: rl.press(line, E_star=1.0, n_loads=n_loads))
    total = generate + pressing
    return (
        f"| reduced, 2^{exponent} | {n_loads} loads | {total * 1e3:.0f} ms | generate "
        f"{generate * 1e3:.0f} ms, whole curve {whole_curve * 1e3:.0f} ms, press "
        f"{pressing * 1e3:.0f} ms | {total / transform:.0f} inverse FFTs "
        f"({transform * 1e3:.0f} ms) | exact |"
    )


def start_up(*arguments):
    """Time a whole process."""
    return seconds(lambda: subprocess.run([sys.executable, *arguments], check=True), repeats=5)


def main():
    """Print the table."""
    print(
        f"roughline {rl.__version__}, {fft.available_cores()} cores, {platform.machine()}, "
        f"Python {platform.python_version()}, NumPy {np.__version__}\n"
    )
    print("| model | loads | wall | per load | in units of this run | residual |")
    print("|---|---|---|---|---|---|")
    for n in (128, 256, 512):
        for hurst in (0.2, 0.8):
            print(full_model(n, hurst), flush=True)
    print(full_model(1024, 0.8), flush=True)
    for exponent in (16, 20):
        print(reduced_model(exponent), flush=True)
    empty = start_up("-c", "pass")
    ours = start_up("-c", "import roughline")
    print(f"\n`import roughline`: {1e3 * (ours - empty):.0f} ms above an empty interpreter")


if __name__ == "__main__":
    main()
