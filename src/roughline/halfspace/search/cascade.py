"""A first guess of the contact: solved roughly on ever finer grids, each from the coarser one."""

from __future__ import annotations

import math
from bisect import bisect_left
from dataclasses import replace

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Real
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.search.problem import ContactSet, Load, Method, Problem
from roughline.halfspace.search.turns import Turns
from roughline.halfspace.search.window import Window

_COARSEST = 64  # points along the longer side of the grid that starts from the rigid shift
_NODES_AT_A_TIME = 2**15  # whose means a thread computes, so many fit into a cache
_ROUGH = Method(rtol=1e-2, max_iterations=200, precision="float32")


def first_guess(problem: Problem, load: Load) -> tuple[ContactSet, ContactLaw]:
    """Guess which nodes come into contact, and the pressures on them.

    The coarse grid sees the mean separation of two by two nodes, and its pressures are the same on
    all four.

    Parameters
    ----------
    problem : Problem
        The bodies.
    load : Load
        What is prescribed.

    Returns
    -------
    start : ContactSet
        The nodes, and pressures on them up to a factor.
    law : ContactLaw
        The law to start with, as pressures on the next coarser grid foresee it.
    """
    grid, separation, law = problem.grid, problem.separation, problem.law
    if max(separation.shape) <= _COARSEST:
        return _rigid_guess(problem, load), law
    coarse_separation = _halved(separation)
    if problem.operator.mean_is_free:  # depths count from mean planes, odd sides end in half blocks
        coarse_separation += separation.mean() - coarse_separation.mean()
    if load.depth is not None and load.depth <= coarse_separation.min():
        return _rigid_guess(problem, load), law
    coarse = replace(problem, grid=grid.coarser, separation=coarse_separation, law=law.on(_halved))
    found, _ = first_guess(coarse, load)
    window = Window.of(coarse, load, found)
    found = Turns(window.bodies, load, window.inside(found), _ROUGH).guess()
    found = replace(found, nodes=window.on_grid(found.nodes))
    # at the end of an odd side one node takes the force of two
    shares = [
        coarse.grid.spacing[axis] / grid.spacing[axis] / _widths(n)
        for axis, n in enumerate(grid.shape)
    ]
    start = _spread(found, grid.shape, shares)
    law = law.foreseen(start.nodes, start.pressure)
    pressure = Bounds.of(law, start.nodes).nearest(start.pressure)
    loaded = pressure > 0
    start = ContactSet(start.nodes[loaded], pressure[loaded], found.depth)
    return (start if loaded.any() else _rigid_guess(problem, load)), law


def _halved(field: Real) -> Real:
    """Means over two by two nodes; fewer at the end of an odd side."""
    nx, ny = field.shape
    result = np.empty((-(-nx // 2), -(-ny // 2)))

    def halve(first: int, last: int) -> None:
        part = np.asarray(field[2 * first : 2 * last], dtype=np.float64)
        for axis, n in enumerate(part.shape):
            along = np.moveaxis(part, axis, 0)
            halves = along[::2].copy()
            halves[: n // 2] += along[1::2]
            halves[: n // 2] /= 2
            part = np.moveaxis(halves, 0, axis)
        result[first:last] = part

    fft.share_out_blocks(halve, len(result), 1 + _NODES_AT_A_TIME // ny)
    return result


def _widths(n: int) -> Real:
    """Nodes along a side that each coarse one stands for."""
    return np.diff(np.append(np.arange(0.0, n, 2), n))


def _spread(coarse: ContactSet, shape: tuple[int, int], shares: list[Real]) -> ContactSet:
    """Spread the pressures on coarse nodes over the nodes of a grid that each stands for.

    Parameters
    ----------
    coarse : ContactSet
        The coarse nodes.
    shape : tuple of int
        Points of the grid, (nx, ny).
    shares : list of ndarray
        Pressure over that of the coarse node, by its row and by its column.
    """
    rows, columns = np.divmod(coarse.nodes, shares[1].size)
    pressure = coarse.pressure * shares[0][rows] * shares[1][columns]
    x = 2 * rows[:, np.newaxis] + [0, 0, 1, 1]
    y = 2 * columns[:, np.newaxis] + [0, 1, 0, 1]
    inside = (x < shape[0]) & (y < shape[1])
    nodes = (x * shape[1] + y)[inside]
    order = np.argsort(nodes)
    return ContactSet(nodes[order], np.repeat(pressure, inside.sum(axis=1))[order], coarse.depth)


def _rigid_guess(problem: Problem, load: Load) -> ContactSet:
    """Start from every node that the rigid shift would overlap, with its overlap as pressure.

    A force shifts the body to the depth at which one disc of as many nodes would carry it,
    its stiffness times (d - mean separation).
    """
    separation, depth, force = problem.separation, load.depth, load.force
    if depth is None:
        assert force is not None
        separations = np.sort(separation, axis=None)
        sums, beyond = np.cumsum(separations), np.append(separations[1:], np.inf)

        def depth_of(count: int) -> float:
            radius = math.sqrt(count * problem.grid.cell_area / math.pi)
            shift = force / problem.grid.half_space.disc_stiffness(radius)
            return shift + float(sums[count - 1]) / count

        counts = range(1, separations.size + 1)
        reached = bisect_left(counts, True, key=lambda count: depth_of(count) <= beyond[count - 1])
        depth = depth_of(counts[reached])
        fewest = np.nan_to_num(force / problem.law.largest_force(problem.grid.cell_area))
        depth = max(depth, float(separations[min(int(fewest), separations.size - 1)]))
    nodes = np.flatnonzero(separation < depth)
    return ContactSet(nodes, depth - separation.flat[nodes], load.depth)
