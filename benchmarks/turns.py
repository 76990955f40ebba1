"""Time two states of the package in turns: ``python benchmarks/turns.py OLD/src NEW/src``.

Each state has a process of its own, and one of the two runs at a time, so that what disturbs the
machine disturbs both alike. ``--rows "cold .* 1024" "path"`` chooses rows by regular expressions,
``--list`` prints them. A cold load makes the tables of its grids; a warm one finds those kept that
the package keeps. Ratios are new over old: medians of all rounds, and that of the shortest times of
the cores, which other work on the machine disturbs least.
"""

import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import time
from functools import cache
from pathlib import Path

import numpy as np

import roughline as rl

FORCES = (0.003, 0.03, 0.1, 0.3, 1.0, 3.0)  # F / (E* h L)
TWELVE = np.geomspace(0.01, 1.0, 12)
SHORT = 0.5  # as many presses as fit into this make one turn, of which the best counts [s]
NEARLY = (1e-1, 1e-3, 1e-5)  # below the depth of full contact, over it


def rows():
    """Give all rows by name: points along a side, and options of the press."""
    found = {}
    for boundary in ("free", "periodic"):
        for n in (512, 1024, 2048):
            for force in FORCES:
                loads = {"forces": [force], "periodic": boundary == "periodic"}
                found[f"cold {boundary} {n}² {force}"] = n, loads
                if n < 2048:
                    found[f"warm {boundary} {n}² {force}"] = n, loads
    for n in (512, 1024):
        found[f"path of 20 {n}²"] = n, {"n_loads": 20}
        found[f"yielding path of 12 {n}²"] = n, {"forces": TWELVE, "hardness": True}
        for below in NEARLY:
            found[f"nearly full {n}² {below}"] = n, {"depths": below, "periodic": True}
    found["path of 33 128²"] = 128, {"n_loads": 33}
    return found


@cache
def surface(n):
    return rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(n, 7)


def press(n, loads):
    """Press a surface; the curve, wall time and time of all cores. [s]"""
    body, loads = surface(n), dict(loads)
    if "hardness" in loads:
        loads["hardness"] = body.rms_slope / 6  # a third of the mean pressure of elastic contact
    if "depths" in loads:
        loads["depths"] = [(1 - loads["depths"]) * float(body.heights.max() - body.heights.mean())]
    wall, cores = time.perf_counter(), time.process_time()
    curve = rl.press(body, E_star=1.0, throw=False, **loads)
    return curve, time.perf_counter() - wall, time.process_time() - cores


def forget():
    """Empty what the package keeps of grids from one press to the next."""
    for name, module in list(sys.modules.items()):
        if name.startswith("roughline.halfspace"):
            getattr(module, "_cache", {}).clear()


def compile_loops():
    press(512, {"forces": [0.01, 0.3], "hardness": True})
    press(512, {"forces": [0.01, 0.3], "periodic": True})


def measured(name):
    """Press a row; return wall and cores' time, loads that failed, convolutions."""
    n, loads = rows()[name]
    surface(n)
    best, spent = [np.inf, np.inf], 0.0
    while spent < SHORT:
        if not name.startswith("warm"):
            forget()
        curve, *times = press(n, loads)
        best, spent = list(map(min, best, times)), spent + times[0]
    return [*best, int(np.count_nonzero(~curve.converged)), int(curve.convolutions.sum())]


def work(threads):
    """Press the rows whose names come in, line by line."""
    rl.set_threads(threads)
    compile_loops()
    for line in sys.stdin:
        print(json.dumps(measured(line.strip())), flush=True)


class State:
    """A process that presses with the package of a folder."""

    def __init__(self, source, threads):
        environment = {**os.environ, "PYTHONPATH": str(source), "OPENBLAS_NUM_THREADS": "1"}
        self._process = subprocess.Popen(
            [sys.executable, __file__, "--work", "--threads", str(threads)],
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def measure(self, name):
        """Press a row; wall and cores' time, loads that failed, convolutions."""
        self._process.stdin.write(name + "\n")
        self._process.stdin.flush()
        return json.loads(self._process.stdout.readline())


def compare(states, names, rounds):
    print("| row | old | new | wall | cores | best | convolutions |\n|---|---|---|---|---|---|---|")
    ratios = {}
    for name in names:
        runs = ([], [])
        if name.startswith("warm"):
            for state in states:
                state.measure(name)
        for turn in range(rounds):
            for which in (0, 1) if turn % 2 == 0 else (1, 0):
                runs[which].append(states[which].measure(name))
        old, new = (np.array(each) for each in runs)
        best = new[:, 1].min() / old[:, 1].min()
        ratios[name] = (*np.median(new[:, :2] / old[:, :2], axis=0), best)
        shown = " | ".join(f"{each:.3f}" for each in ratios[name])
        times = " | ".join(f"{np.median(each[:, 0]):.3f} s" for each in (old, new))
        failed = "".join(f", {each[0, 2]:.0f} failed" if each[0, 2] else "" for each in (old, new))
        counts = f"{old[0, 3]:.0f}, {new[0, 3]:.0f}{failed}"
        print(f"| {name} | {times} | {shown} | {counts} |", flush=True)
    for i, kind in enumerate(("wall", "cores", "best")):
        means = statistics.geometric_mean(float(each[i]) for each in ratios.values())
        worst = max(ratios, key=lambda name, i=i: ratios[name][i])
        print(f"\n{kind}: geometric mean {means:.3f}, worst {ratios[worst][i]:.3f} ({worst})")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sources", nargs="*", metavar="SOURCE", help="folders that hold roughline")
    parser.add_argument("--rows", nargs="+", default=[""], help="what their names contain")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--list", action="store_true", help="print the names of the rows")
    parser.add_argument("--work", action="store_true", help=argparse.SUPPRESS)
    wanted = parser.parse_args()
    names = [name for name in rows() if any(re.search(each, name) for each in wanted.rows)]
    if wanted.work:
        work(wanted.threads)
    elif wanted.list:
        print("\n".join(names))
    elif len(wanted.sources) != 2:
        parser.error("give two folders, such as ../old/src and src")
    else:
        states = [State(Path(each).resolve(), wanted.threads) for each in wanted.sources]
        compare(states, names, wanted.rounds)


if __name__ == "__main__":
    main()
