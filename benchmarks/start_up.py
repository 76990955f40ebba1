"""How soon a command answers, against the bare import of SurfaceTopography.

Each command describes or presses one surface of 256 x 256 points, or the map of an instrument, and
runs in a process of its own; commands and bare imports take turns, so that whatever else the
machine does falls on all of them. The work itself is what the same command takes in a process that
has run it before. ``make start-up MAPS=...`` writes a part of ``docs/measured.md``, with the
measured maps that are named.
"""

import contextlib
import statistics
import subprocess
import sys
import tempfile
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
from page import Page, once
from recorded_runs import run

import roughline as rl

ROUNDS = 7
SIDES = ("--unit", "um", "--size", "1 mm")
LOAD = ("--modulus", "110 GPa", "--load", "1 N")
MATERIALS = ("--materials", "steel,copper", "--load", "10 MPa")
GAS = ("--fluid", "helium", "--inlet", "1 bar", "--outlet", "0 bar", "--seal", "10 mm .. 12 mm")
COMMANDS = {
    "`info`, an array": ("info", "map.npy", *SIDES),
    "`info`, our own file": ("info", "map.nc"),
    "`info`, a text": ("info", "map.txt", *SIDES),
    "`press`, an array": ("press", "map.npy", *SIDES, *LOAD),
    "`press`, our own file": ("press", "map.nc", *LOAD),
    "`press`, a text": ("press", "map.txt", *SIDES, *LOAD),
    "`press`, an array of 128 x 128 points": ("press", "small.npy", *SIDES, *LOAD),
    "`press`, two materials": ("press", "map.nc", *MATERIALS),
    "`press`, two materials and a gas": ("press", "map.nc", *MATERIALS, *GAS),
}
LIBRARY = [sys.executable, "-W", "ignore", "-c", "import SurfaceTopography"]


def commands(maps):
    """All commands by name, with those on measured maps."""
    found = dict(COMMANDS)
    for path in maps:
        two = "press", str(path), *MATERIALS
        found[f"`info`, {path.name}"] = "info", str(path)
        found[f"`press`, two materials, {path.name}"] = two
        found[f"`press`, two materials and a gas, {path.name}"] = *two, *GAS
    return found


def main():
    asked = commands([Path(each).resolve() for each in sys.argv[1:]])
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        write_surface()
        ours = [sys.executable, "-m", "roughline"]
        calls = {name: [*ours, *arguments] for name, arguments in asked.items()}
        calls["the import"] = LIBRARY
        times = {name: [] for name in calls}
        for _ in range(ROUNDS):
            for name, call in calls.items():
                ran = partial(subprocess.run, call, check=True, capture_output=True)
                times[name].append(once(ran)[1])
        work = {name: seconds_of_work(arguments) for name, arguments in asked.items()}
    bare = statistics.median(times.pop("the import"))
    page = Page("start-up", "measured.md", "start-up")
    page.say(f"`import SurfaceTopography` takes {bare:.2f} s, the median of {ROUNDS}, as below.")
    page.table("command", "time", "its work", "time over the import", "without its work")
    for name, each in times.items():
        whole = statistics.median(each)
        ratios = (f"{part / bare:.2f}" for part in (whole, whole - work[name]))
        page.row(name, f"{whole:.2f} s", f"{work[name]:.2f} s", *ratios)
    page.save()


def write_surface():
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6)
    surface = replace(spectrum.surface(256, 7), unit="m")
    np.save("map.npy", surface.heights * 1e6)
    np.save("small.npy", surface.coarsened().heights * 1e6)
    np.savetxt("map.txt", surface.heights * 1e6)
    rl.write(surface, "map.nc")


def seconds_of_work(arguments):
    """Return the least time of a command among calls in this process. [s]"""
    return min(once(lambda: run(arguments))[1] for _ in range(4))


if __name__ == "__main__":
    main()
