"""Time flows through gaps beside other solvers of the same equations: ``make flow-benchmark``.

Each row has a process of its own. SuperLU comes with SciPy; PyAMG and reynoldsflow 0.1.3 take part
where they are installed. All of them solve the same equations: the permeances of reynoldsflow and
of roughline are those of one discretisation. Writes a part of ``docs/measured.md``; with numbers,
such as ``python benchmarks/flow.py 512 1024``, it prints the rows of these grids alone.
"""

import argparse
import importlib.util
import sys

import numpy as np
from page import Page, elsewhere, once, peak
from scipy import ndimage, sparse
from scipy.sparse import linalg

import roughline as rl
from roughline.fluid.network import Network

OPEN, HALF, NEAR = "open", "a fifth closed", "last channel"
LARGEST_OF_OTHERS = 1024  # grid of the others, which need longer than anybody waits


def gap(n, kind):
    """A periodic surface with a plane above it, or cut by one."""
    heights = -rl.SelfAffine(hurst=0.8, rms_height=1.0, q_roll=25.0).surface(n, 7).heights
    if kind == OPEN:
        return heights - heights.min() + 1.0
    share = 0.2 if kind == HALF else last_open(heights)
    return np.maximum(heights - np.quantile(heights, share), 0.0)


def last_open(heights):
    """Largest share that may be closed while a path is open, to one part in a thousand."""
    low, high = 0.2, 0.9
    while high - low > 1e-3:
        middle = (low + high) / 2
        parts, _ = ndimage.label(heights > np.quantile(heights, middle))
        is_open = np.intersect1d(parts[0][parts[0] > 0], parts[-1]).size > 0
        low, high = (middle, high) if is_open else (low, middle)
    return low


def ours(given):
    flow = rl.flow(given, (1.0, 1.0), sides="y")
    return flow.permeance, flow.imbalance


def equations(given):
    """The equations for the pressures of the open cells, scaled to a diagonal of ones."""
    through = ~np.isnan(rl.flow(given, (1.0, 1.0), sides="y").pressure)
    cells = np.where(through, given**3, 0.0)
    along, across = Network(cells, 1.0, 1.0, False, True).conductances()
    number = np.cumsum(through.ravel()).reshape(through.shape) - 1
    first = [number[:-1], number]
    second = [number[1:], np.roll(number, -1, axis=1)]
    joined = [along[1:-1], across[:, 1:]]
    i, j, g = (
        np.concatenate([each[held > 0] for each, held in zip(parts, joined, strict=True)])
        for parts in (first, second, joined)
    )
    inflow = np.zeros(through.shape)
    inflow[0] = along[0]
    diagonal = along[:-1] + along[1:] + across[:, :-1] + across[:, 1:]
    scale = 1 / np.sqrt(diagonal[through])
    off = sparse.coo_matrix((-g * scale[i] * scale[j], (i, j)), shape=(scale.size,) * 2)
    return sparse.csc_matrix(off + off.T + sparse.eye(scale.size)), inflow[through] * scale, scale


def balance(given, solve):
    """Permeance, from the outflow, and imbalance of a pressure that a solver of equations finds."""
    matrix, right, scale = equations(given)
    pressure = np.zeros(given.shape)
    through = ~np.isnan(rl.flow(given, (1.0, 1.0), sides="y").pressure)
    pressure[through] = solve(matrix, right) * scale
    inflow = float((2 * given[0] ** 3 * (1 - pressure[0]))[through[0]].sum())
    outflow = float((2 * given[-1] ** 3 * pressure[-1]).sum())
    return outflow, abs(inflow - outflow) / abs(outflow)


def superlu(given):
    options = {"SymmetricMode": True, "DiagPivotThresh": 0.0}
    return balance(
        given,
        lambda matrix, right: linalg.splu(matrix, "MMD_AT_PLUS_A", options=options).solve(right),
    )


def pyamg(given):
    import pyamg as library

    def solve(matrix, right):
        solver = library.smoothed_aggregation_solver(matrix.tocsr())
        return solver.solve(right, tol=1e-10, accel="cg", maxiter=300)

    return balance(given, solve)


def reynoldsflow(given):
    from reynoldsflow import transport

    gaps, _, flux = transport.solve_fluid_problem(given)
    total, error = transport.compute_total_flux(gaps, flux, len(given))
    return float(total), float(error)


SOLVERS = {"roughline": ours, "SuperLU": superlu, "PyAMG": pyamg, "reynoldsflow": reynoldsflow}


def measured(n, kind, name):
    """Permeance, imbalance, time [s] and memory [bytes] of one flow."""
    SOLVERS[name](gap(32, HALF))  # compiles
    given = gap(n, kind)
    before = peak()
    (permeance, imbalance), wall = once(lambda: SOLVERS[name](given))
    return permeance, imbalance, wall, peak() - before


def rows(page, grids):
    installed = [name for name in ("pyamg", "reynoldsflow") if importlib.util.find_spec(name)]
    names = [
        name for name in SOLVERS if name in ("roughline", "SuperLU") or name.lower() in installed
    ]
    columns = ("s", "GB", "permeance over ours, less 1", "imbalance")
    page.table("cells", "gap", "solver", *columns, at_most=8)
    for n in grids:
        for kind in (OPEN, HALF, NEAR):
            reference = None
            for name in names if n <= LARGEST_OF_OTHERS else names[:1]:
                permeance, imbalance, wall, memory = elsewhere(measured, n, kind, name)
                reference = permeance if reference is None else reference
                page.row(
                    f"{n}²",
                    kind,
                    name,
                    f"{wall:.2g}" if wall < 10 else f"{wall:.0f}",
                    f"{memory / 1e9:.2g}",
                    f"{permeance / reference - 1:.0e}" if name != "roughline" else "",
                    f"{imbalance:.0e}",
                )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("grids", nargs="*", type=int)
    asked = parser.parse_args().grids
    page = Page("flow", "measured.md", "flow-benchmark")
    rows(page, asked or (512, 1024, 2048))
    if not asked:
        page.save()
    sys.exit()
