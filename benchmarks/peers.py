"""Time roughline and the other programs that are installed.

``make peers`` runs all of it, in two or three hours on two cores: the part of docs/measured.md on
grids up to 256², and that on larger ones. ``--sizes 64 128 256`` does the former, in ten minutes.
Rows are kept in ``out/`` as they are measured, and are not measured again until
``--fresh`` is given. The machine must do nothing else: threads that wait for each other lose most
where a core is taken away.
"""

import argparse
import json
import os
import platform
from functools import partial
from pathlib import Path

import numpy as np
import peer_table
from measure import our_convolution, plain_convolution
from page import vector_units
from peer_programs import (
    ENGINES_OF_ASPHER,
    SMALL,
    WARM_UP,
    entrants,
    path_of_aspher,
    path_of_roughline,
    press_aspher,
    program_of,
    timed,
    versions,
)

from roughline.computing.cores import available_cores, processor_name

SIZES = (64, 128, 256, 512, 1024, 2048)
OUT = Path(__file__).parents[1] / "out"  # where measured rows are kept
SHORT = 2.0  # what takes less is run again, and never stopped for the sake of another engine [s]
LOADS = (0.8, 0.2), (0.03, 0.1, 0.4, 1.2)  # H, and F / (E* h L)
SMALL_LOADS = (0.8,), (0.001, 0.03, 0.3, 1.0, 10.0)  # on small grids
LARGE = 2048  # points along a side, from which only every k-th load of a path is solved by others
KEY = ("kind", "n", "hurst", "force_bar", "n_loads", "load")


class Rows:
    """The measured rows, kept in a file of one line of JSON each."""

    def __init__(self, part, *, fresh, disturbed):
        OUT.mkdir(exist_ok=True)
        self.file = OUT / f"{part}.jsonl"
        if fresh:
            self.file.unlink(missing_ok=True)
        text = self.file.read_text() if self.file.exists() else ""
        self.rows = {self.key(row): row for row in map(json.loads, text.splitlines())}
        if disturbed:
            self.rows = {key: row for key, row in self.rows.items() if not was_disturbed(row)}

    @staticmethod
    def key(row):
        """Return what tells a row from the others."""
        return tuple(row.get(name) for name in KEY)

    def measure(self, function, **key):
        """Return the row of this key; when there is none, measure it."""
        if self.key(key) not in self.rows:
            text = json.dumps({**key, **function()}, ensure_ascii=False)
            with self.file.open("a") as file:
                file.write(text + "\n")
            print(text[:240], flush=True)
            self.rows[self.key(key)] = json.loads(text)
        return self.rows[self.key(key)]


def was_disturbed(row):
    """Whether other work had more than a tenth of the cores while the programs of a row ran."""
    runs = peer_table.ended(row)
    return bool(runs) and peer_table.part_of_others(runs) > 0.1


def machine(cores):
    return {
        "processor": processor_name(),
        "cores": cores,
        "vectors": vector_units(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "programs": versions(),
    }


def convolution(n):
    """Time a plain convolution, and ours in double and in single precision. [s]"""
    double, single = (our_convolution(n, precision) for precision in ("float64", "float32"))
    return {"plain": plain_convolution(n), "double": double, "single": single}


def race(presses, n, hurst, limit, repeats):
    """Run all in turns, those that are short again; return the runs of each.

    A program's engine is stopped once it has taken longer than another of its engines.
    """
    runs, fastest = {label: [] for label in presses}, {}
    for turn in range(repeats):
        for label, press in presses.items():
            if turn and not runs[label][0].get("seconds", SHORT) < SHORT:
                continue
            program = program_of(label)
            patience = min(limit, max(SHORT, fastest.get(program, limit)))
            run = timed(press, n, hurst, None if program == "roughline" else patience)
            runs[label].append(run)
            if run.get("converged"):
                fastest[program] = min(run["seconds"], fastest.get(program, limit))
    return {"runs": runs}


def cold_loads(rows, sizes, wanted):
    programs = versions()
    for n in sizes:
        slow = () if n in wanted.slow_sizes else ("Tamaas", "ContactMechanics")
        taking_part = [program for program in programs if program not in slow]
        hursts, forces = SMALL_LOADS if n <= SMALL else LOADS
        for hurst in wanted.hurst or hursts:
            for force in wanted.forces or forces:
                presses = entrants(taking_part, force)
                measure = partial(race, presses, n, hurst, wanted.limit, wanted.repeats)
                rows.measure(measure, kind="cold", n=n, hurst=hurst, force_bar=force)


def path(n, hurst, n_loads, limit):
    """Time a path of roughline, and ASPHER's warm loads of the same forces."""
    plain = plain_convolution(n)
    runs = {"roughline": [timed(partial(path_of_roughline, n_loads=n_loads), n, hurst, None)]}
    if "ASPHER" in versions():
        press = partial(path_of_aspher, forces=runs["roughline"][0]["forces"])
        runs["ASPHER, FFT"] = [timed(press, n, hurst, limit)]
    return {"plain": plain, "runs": runs}


def paths(rows, sizes, wanted):
    """Time paths of roughline, and ASPHER's cold loads along them."""
    for n in sizes:
        for hurst in wanted.path_hurst:
            key = {"n": n, "hurst": hurst, "n_loads": wanted.loads}
            measure = partial(path, n, hurst, wanted.loads, wanted.limit)
            (ours,) = rows.measure(measure, kind="path", **key)["runs"]["roughline"]
            if "ASPHER" not in versions():
                continue
            every = wanted.every if n >= LARGE else 1
            engines = list(ENGINES_OF_ASPHER)
            # from the middle of the first k loads, rather a lighter one
            for load in range((every - 1) // 2, wanted.loads, every):
                presses = {
                    f"ASPHER, {engine}": partial(
                        press_aspher, force=ours["forces"][load], engine=engine
                    )
                    for engine in engines
                }
                measure = partial(race, presses, n, hurst, wanted.limit, 1)
                row = rows.measure(measure, kind="load", load=load, **key)
                # the engine that won begins at the next load, and others are stopped sooner
                winner = peer_table.best(row, "ASPHER")[0].partition(", ")[2]
                engines.sort(key=lambda engine, winner=winner: engine != winner)


def measure_part(wanted, part, sizes, here):
    """Measure the rows of one part of the page."""
    rows = Rows(part, fresh=wanted.fresh, disturbed=wanted.disturbed)
    before = rows.measure(lambda: here, kind="machine")
    if before != {"kind": "machine", **here}:
        raise SystemExit(f"{rows.file} is of another machine or other programs: give --fresh")
    large = [n for n in sizes if n > SMALL]
    for n in large:
        rows.measure(partial(convolution, n), kind="convolution", n=n)
    cold_loads(rows, sizes, wanted)
    paths(rows, large, wanted)
    peer_table.write(rows.rows.values(), part)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    add = parser.add_argument
    add("--sizes", type=int, nargs="+", default=SIZES, help="points along a side")
    add("--hurst", type=float, nargs="+", help="of the cold loads")
    add("--forces", type=float, nargs="+", help="of the cold loads, F / (E* h L)")
    add("--path-hurst", type=float, nargs="*", default=[0.2, 0.5, 0.8], help="of the paths")
    add("--loads", type=int, default=20, help="loads of a path")
    add("--every", type=int, default=4, help=f"solve every k-th of them by ASPHER from {LARGE}² on")
    add("--slow-sizes", type=int, nargs="*", default=SIZES[:4], help="Tamaas', ContactMechanics'")
    add("--repeats", type=int, default=3, help=f"runs of what takes less than {SHORT:.0f} s")
    add("--limit", type=float, default=600.0, help="seconds after which a run is stopped")
    add("--fresh", action="store_true", help="forget the rows measured before")
    add("--disturbed", action="store_true", help="measure rows again that other work disturbed")
    wanted = parser.parse_args()
    if any(SMALL < n <= max(WARM_UP.values()) for n in wanted.sizes):
        parser.error(f"sizes are {SMALL} at most, or above {max(WARM_UP.values())}, which warms up")
    cores = available_cores()
    for library in ("OMP", "OPENBLAS", "MKL"):  # of the processes that are timed
        os.environ[f"{library}_NUM_THREADS"] = str(cores)
    here = machine(cores)
    small, large = [n for n in wanted.sizes if n <= SMALL], [n for n in wanted.sizes if n > SMALL]
    if small:
        measure_part(wanted, "small-peers", small, here)
    if large:
        measure_part(wanted, "peers", large, here)


if __name__ == "__main__":
    main()
