"""How soon a command answers, against the bare import of SurfaceTopography: ``make start-up``.

Each command describes or presses one surface of 256 x 256 points, and runs in a process of its own;
commands and bare imports take turns, so that whatever else the machine does falls on all of them.
The work itself is what the same command takes in a process that has run it before.
"""

import contextlib
import io
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import replace

import numpy as np

import roughline as rl
from roughline import cli

ROUNDS = 7
SIDES = ("--unit", "um", "--size", "1 mm")
LOAD = ("--modulus", "110 GPa", "--load", "1 N")
COMMANDS = {
    "info, array": ("info", "map.npy", *SIDES),
    "info, our file": ("info", "map.nc"),
    "info, text": ("info", "map.txt", *SIDES),
    "press, array": ("press", "map.npy", *SIDES, *LOAD),
    "press, our file": ("press", "map.nc", *LOAD),
    "press, text": ("press", "map.txt", *SIDES, *LOAD),
}
LIBRARY = [sys.executable, "-W", "ignore", "-c", "import SurfaceTopography"]


def main():
    """Time the commands and print the table."""
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        write_surface()
        ours = [sys.executable, "-m", "roughline"]
        calls = {name: [*ours, *arguments] for name, arguments in COMMANDS.items()}
        calls["the import"] = LIBRARY
        times = {name: [] for name in calls}
        for _ in range(ROUNDS):
            for name, call in calls.items():
                times[name].append(seconds(call))
        work = {name: seconds_of_work(arguments) for name, arguments in COMMANDS.items()}
    bare = statistics.median(times.pop("the import"))
    print(f"import SurfaceTopography: {bare:.2f} s, the median of {ROUNDS} as all below")
    print(f"{'command':16} {'seconds':>8} {'its work':>9} {'over import':>12} {'without work':>13}")
    for name, each in times.items():
        whole = statistics.median(each)
        print(
            f"{name:16} {whole:8.2f} {work[name]:9.2f} {whole / bare:12.2f} "
            f"{(whole - work[name]) / bare:13.2f}"
        )


def write_surface():
    """Write a surface as an array, as a file of our own, and as a text."""
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6)
    surface = replace(spectrum.surface(256, 7), unit="m")
    np.save("map.npy", surface.heights * 1e6)
    np.savetxt("map.txt", surface.heights * 1e6)
    rl.write(surface, "map.nc")


def seconds(command):
    """Return the wall time of a command. [s]"""
    start = time.perf_counter()
    subprocess.run(command, check=True, capture_output=True)
    return time.perf_counter() - start


def seconds_of_work(arguments):
    """Return the least time of a command among calls in this process. [s]"""
    times = []
    for _ in range(4):
        start = time.perf_counter()
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            sys.argv = ["roughline", *arguments]
            with contextlib.suppress(SystemExit):
                cli.main()
        times.append(time.perf_counter() - start)
    return min(times)


if __name__ == "__main__":
    main()
