"""A first guess of the contact: solved roughly on ever finer grids, each from the coarser one."""

from __future__ import annotations

import math
from bisect import bisect_left
from dataclasses import replace

import numpy as np

from roughline.computing.arrays import InGrid, Real
from roughline.halfspace.search.problem import ContactSet, Load, Method, Problem
from roughline.halfspace.search.pull import Shares
from roughline.halfspace.search.window import GridWindow

_COARSEST_POINTS = 64  # points along the longer side of the grid that starts from the rigid shift
# A guess whose pressures exceed an upper bound so many times leaves no doubt that nodes yield.
_CERTAIN_YIELD = 3.0
_ROUGH_METHOD = Method(rtol=1e-2, max_iterations=200, precision="float32")


def first_guess(problem: Problem, load: Load) -> tuple[ContactSet, Problem]:
    """Guess which nodes come into contact, and the pressures on them up to a factor.

    Return with them the bodies, which yield where pressures on the next coarser grid foresee it.
    """
    start = _from_coarser(problem, load)
    if start is not None and problem.exceeds(start.nodes, start.pressure, _CERTAIN_YIELD):
        problem = replace(problem, is_elastic=False)
        start = _from_coarser(problem, load)
    return start or _rigid_guess(problem, load), problem


def _from_coarser(problem: Problem, load: Load) -> ContactSet | None:
    """Solve roughly on a coarser grid; return None where that is too coarse to touch.

    The coarse grid sees the mean separation of two by two nodes, and its pressures are the same on
    all four.
    """
    separation = problem.separation
    if max(separation.shape) <= _COARSEST_POINTS:
        return None
    coarse_separation = _halved(separation)
    if problem.operator.mean_is_free:  # depths count from mean planes, odd sides end in half blocks
        coarse_separation += separation.mean() - coarse_separation.mean()
    if load.depth is not None and load.depth <= coarse_separation.min():
        return None
    coarse = replace(
        problem,
        grid=problem.grid.coarser,
        separation=coarse_separation,
        law=problem.law.on(_halved),
        shares=_halved_shares(problem.shares, separation.shape),
    )
    start = _from_coarser(coarse, load) or _rigid_guess(coarse, load)
    window = GridWindow.of(coarse, load, start)
    found = window.guess(window.turns(load, start, _ROUGH_METHOD))
    return _spread(found, coarse_separation.shape[1], separation.shape)


def _halved(field: Real) -> Real:
    """Means over two by two nodes; fewer at the end of an odd side."""
    for axis, n in enumerate(field.shape):
        along = np.moveaxis(field, axis, 0)
        means = along[::2].astype(np.float64)
        means[: n // 2] += along[1::2]
        means[: n // 2] /= 2
        field = np.moveaxis(means, 0, axis)
    return np.ascontiguousarray(field)


def _halved_shares(shares: Shares, shape: tuple[int, int]) -> Shares:
    """Means over two by two nodes of what is zero on all others."""
    if not shares.nodes.size:
        return shares
    halved = _halved(shares.field(math.prod(shape)).reshape(shape)).ravel()
    nodes = InGrid(np.flatnonzero(halved))
    return Shares(nodes, halved[nodes])


def _spread(coarse: ContactSet, width: int, shape: tuple[int, int]) -> ContactSet | None:
    """Put the pressures on nodes of a coarse grid of some width on the nodes that each stands for.

    Return None where none of them pushes.
    """
    loaded = coarse.pressure > 0
    rows, columns = np.divmod(coarse.nodes[loaded], width)
    x = 2 * rows[:, np.newaxis] + [0, 0, 1, 1]
    y = 2 * columns[:, np.newaxis] + [0, 1, 0, 1]
    inside = (x < shape[0]) & (y < shape[1])
    nodes = (x * shape[1] + y)[inside]
    order = np.argsort(nodes)
    count = inside.sum(axis=1)  # at the end of an odd side one node takes the force of two
    pressure = np.repeat(coarse.pressure[loaded] * (4 / count), count)[order]
    return ContactSet(InGrid(nodes[order]), pressure, coarse.depth) if loaded.any() else None


def _rigid_guess(problem: Problem, load: Load) -> ContactSet:
    """Start from every node that the rigid shift would overlap, with its overlap as pressure.

    A force shifts the body to the depth at which one disc of as many nodes would carry it,
    its stiffness times (d - mean separation).
    """
    separation, depth, force = problem.separation, load.depth, load.force
    if depth is None:
        assert force is not None
        separations = np.sort(separation, axis=None)
        sums, next_separations = np.cumsum(separations), np.append(separations[1:], np.inf)

        def disc_depth(count: int) -> float:
            radius = math.sqrt(count * problem.grid.cell_area / math.pi)
            shift = force / problem.grid.half_space.disc_stiffness(radius)
            return shift + float(sums[count - 1]) / count

        counts = range(1, separations.size + 1)
        reached = bisect_left(
            counts, True, key=lambda count: disc_depth(count) <= next_separations[count - 1]
        )
        depth = disc_depth(counts[reached])
        fewest = np.nan_to_num(force / problem.bounds.largest_force(problem.grid.cell_area))
        depth = max(depth, float(separations[min(int(fewest), separations.size - 1)]))
    nodes = InGrid(np.flatnonzero(separation < depth))
    return ContactSet(nodes, depth - separation.flat[nodes], load.depth)
