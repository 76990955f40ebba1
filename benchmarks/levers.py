"""What each lever of the full model is worth: presses with one of them taken away, in turns.

``python benchmarks/levers.py --rows "cold free 1024" "path of 20 512"`` takes rows of ``turns.py``,
on one thread. The numbers are times of the core without a lever over that with all, the shortest
of all rounds; convolutions follow where they change.
"""

import argparse
import re
from contextlib import ExitStack
from unittest import mock

import numpy as np
import turns

import roughline as rl
from roughline.halfspace.inverse import approximate_inverse, cache
from roughline.halfspace.operators import convolution
from roughline.halfspace.operators.restricted import RestrictedOperators
from roughline.halfspace.search import cascade, path, tangent
from roughline.halfspace.search.problem import Method


class StencilAlone(approximate_inverse._TwoLevels):
    """The approximate inverse without its blocks."""

    def __init__(self, inverse, nodes):
        super().__init__(inverse, nodes)
        self._per_node[:] = 0
        self._even = np.zeros_like


LEVERS = {
    # what is taken away: the places and what comes there
    "nothing": (),
    "blocks beside the stencil": ((approximate_inverse, "_TwoLevels", StencilAlone),),
    "direct solution of few nodes": ((approximate_inverse, "_MOST_DIRECT_NODES", 0),),
    "restricted steps": ((RestrictedOperators, "on", lambda self, nodes: None),),
    "sums over pairs": ((convolution, "_PAIRS_PER_MODE", 0.0),),
    "odd and even halves": ((convolution.Convolution, "_parts", lambda self, precision: 1),),
    "kept operators": ((cache, "_MOST_CACHED_BYTES", 0),),
    "coarser grids": ((cascade, "_COARSEST_POINTS", 10**6),),
    "start along the tangent": ((path, "_predicted", lambda *given: None),),
    "single precision of the steps": ((Method, "steps", property(lambda self: "float64")),),
    "energy of the tangent's error": ((tangent, "_ENERGY_MARGIN", 1e-6),),
}


def measured(row, lever):
    """Return time of the core and convolutions of a row without a lever."""
    turns.forget()
    with ExitStack() as replaced:
        for part in LEVERS[lever]:
            replaced.enter_context(mock.patch.object(*part))
        if row.startswith("warm"):
            turns.press(*turns.rows()[row])
        _, cores, _, convolutions = turns.measured(row)
    turns.forget()
    return cores, convolutions


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rows", nargs="+", default=["cold free 1024", "path of 20 512"])
    parser.add_argument("--without", nargs="+", default=[""], help="what names of levers contain")
    parser.add_argument("--rounds", type=int, default=3)
    wanted = parser.parse_args()
    names = [name for name in LEVERS if any(each in name for each in wanted.without)]
    names = ["nothing", *(name for name in names if name != "nothing")]
    rl.set_threads(1)
    turns.compile_loops()
    print(f"| row | {' | '.join(names)} |\n|{'---|' * (len(names) + 1)}")
    for row in turns.rows():
        if not any(re.search(each, row) for each in wanted.rows):
            continue
        runs = {name: [] for name in names}
        for turn in range(wanted.rounds):
            for name in names if turn % 2 == 0 else reversed(names):
                runs[name].append(measured(row, name))
        best = {name: min(cores for cores, _ in each) for name, each in runs.items()}
        cells = [f"{best['nothing']:.3f} s, {runs['nothing'][0][1]}"]
        for name in names[1:]:
            count = runs[name][0][1]
            more = "" if count == runs["nothing"][0][1] else f", {count}"
            cells.append(f"{best[name] / best['nothing']:.2f}{more}")
        print(f"| {row} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
