"""A first guess of the contact: solved roughly on ever finer grids, each from the coarser one.

The coarsest of them starts from the pressures that would flatten the bodies, as far as they push,
or from the rigid shift.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from dataclasses import replace
from functools import lru_cache

import numpy as np

from roughline.computing.arrays import InGrid, Real, among
from roughline.computing.compiled import compiled
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.search.problem import ContactSet, Load, Method, Problem
from roughline.halfspace.search.pull import Shares
from roughline.halfspace.search.small_grid import MOST_FACTORED_NODES
from roughline.halfspace.search.window import GridWindow

_COARSEST_POINTS = 16  # points along the longer side of the grid that starts from the rigid shift
_FLATTENED_POINTS = 64  # and of that which starts from the pressures that flatten the bodies
_FEW_NODES = 120  # of a rigid shift on a small grid, which a coarser one guesses no faster
_ROUGH_TOTAL = 0.01  # part by which the pressures of a guess may miss their sum
# A guess whose pressures exceed an upper bound so many times leaves no doubt that nodes yield, on
# grids of more points along a side.
_CERTAIN_YIELD, _CERTAIN_FROM = 3.0, 64
_ROUGH_METHOD = Method(rtol=1e-2, max_iterations=200, precision="float32")


def first_guess(problem: Problem, load: Load) -> tuple[ContactSet, Problem]:
    """Guess which nodes come into contact, and the pressures on them up to a factor.

    Return with them the bodies, which yield where pressures on the next coarser grid foresee it.
    """
    start = _from_coarser(problem, load)
    is_fine = max(problem.separation.shape) > _CERTAIN_FROM
    if is_fine and start and problem.exceeds(start.nodes, start.pressure, _CERTAIN_YIELD):
        problem = replace(problem, is_elastic=False)
        start = _from_coarser(problem, load)
    return start or _rigid_guess(problem, load), problem


def _from_coarser(problem: Problem, load: Load) -> ContactSet | None:
    """Solve roughly on a coarser grid; None where that is too coarse to touch, or no faster.

    The coarse grid sees the mean separation of two by two nodes, and its pressures are the same on
    all four. Where bodies are flattened, no coarser grid is needed.
    """
    separation = problem.separation
    if max(separation.shape) <= _COARSEST_POINTS:
        return None
    if problem.operator.small_grid and _shifted(problem, load, _FEW_NODES):
        return None
    if flattened := _flattened(problem, load):
        return flattened
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
    nx, ny = field.shape
    means = np.empty((-(-nx // 2), -(-ny // 2)))
    _fill_means(field, means)
    return means


@compiled
def _fill_means(field: Real, means: Real) -> None:
    """Average over two by two nodes, along y first; over fewer at the end of an odd side."""
    for i in range(means.shape[0]):
        last_x = min(2 * i + 1, field.shape[0] - 1)
        for j in range(means.shape[1]):
            last_y = min(2 * j + 1, field.shape[1] - 1)
            above = (field[2 * i, 2 * j] + field[last_x, 2 * j]) / 2
            below = (field[2 * i, last_y] + field[last_x, last_y]) / 2
            means[i, j] = (above + below) / 2


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


def _flattened(problem: Problem, load: Load) -> ContactSet | None:
    """Start from the pressures that would flatten the bodies, as far as they push.

    The depth is that at which those that push carry the force. Among few such nodes the pressures
    that flatten them alone are taken once more. None on a large grid, under a given depth, and
    where bodies pull, yield all over, or are no half-space that the inverse convolution inverts.
    """
    grid, force, separation = problem.grid, load.force, problem.separation
    if max(grid.shape) > _FLATTENED_POINTS or force is None or not problem.law.only_pushes:
        return None
    if not problem.operator.small_grid or problem.inverse.solves_blocks:
        return None
    above = (separation - separation.mean()).reshape(-1)
    nodes = InGrid(np.arange(above.size))
    for _ in range(2):
        flat, even = problem.inverse.flattening(nodes, above[nodes])
        level = _level_of_pushes(flat, even, force / grid.cell_area)
        pressure = flat + level * even
        pushes = pressure > 0
        nodes, pressure = among(nodes, pushes), pressure[pushes]
        if not problem.bounds.largest_force(nodes.size * grid.cell_area) > force:
            return None
        if nodes.size > MOST_FACTORED_NODES:
            break
    return ContactSet(nodes, pressure)


@compiled
def _level_of_pushes(flat: Real, even: Real, total: float) -> float:
    """Return the multiple of a field with which, added to another one, pushes have a total.

    NaN if none is found. The sum of pushes is convex in it, so that Newton's method falls to it.
    """
    level = (total - flat.sum()) / even.sum()
    for _ in range(100):
        found = slope = 0.0
        for i in range(flat.size):
            value = flat[i] + level * even[i]
            if value > 0:
                found += value
                slope += even[i]
        if abs(found - total) <= _ROUGH_TOTAL * total:
            return level
        level += (total - found) / slope
    return math.nan


def _rigid_guess(problem: Problem, load: Load) -> ContactSet:
    """Start from every node that the rigid shift would overlap, with its overlap as pressure.

    A force shifts the body to the depth at which one disc of as many nodes would carry it,
    its stiffness times (d - mean separation).
    """
    size = problem.separation.size
    start = _shifted(problem, load, min(_FEW_NODES, size)) or _shifted(problem, load, size)
    assert start is not None
    return start


def _shifted(problem: Problem, load: Load, most: int) -> ContactSet | None:
    """Return that start; None if it has more than so many nodes."""
    separation, depth = problem.separation, load.depth
    if depth is None:
        depth = _rigid_depth(problem, load.value, most)
    if depth is None:
        return None
    nodes = InGrid(np.flatnonzero(separation < depth))
    if nodes.size > most:
        return None
    return ContactSet(nodes, depth - separation.reshape(-1)[nodes], load.depth)


def _rigid_depth(problem: Problem, force: float, most: int) -> float | None:
    """Return the depth of the rigid shift; None if it overlaps more than so many nodes."""
    separation, grid = problem.separation, problem.grid
    if most < separation.size:
        lowest = np.partition(separation, most, axis=None)[: most + 1]
        lowest.sort()
    else:
        lowest = np.append(np.sort(separation, axis=None), np.inf)
    sums = np.cumsum(lowest[:-1])

    def disc_depth(count: int) -> float:
        radius = math.sqrt(count * grid.cell_area / math.pi)
        return force / _disc_stiffness(grid.half_space, radius) + float(sums[count - 1]) / count

    counts = range(1, sums.size + 1)
    reached = bisect_left(counts, True, key=lambda count: disc_depth(count) <= lowest[count])
    if reached == len(counts):
        return None
    depth = disc_depth(counts[reached])
    fewest = force / problem.bounds.largest_force(grid.cell_area)
    if fewest > most:
        return None
    at_least = int(min(fewest, sums.size - 1)) if fewest > 0 else 0
    return max(depth, float(lowest[at_least]))


def _disc_stiffness(half_space: HalfSpace, radius: float) -> float:
    """Return about how stiff a half-space is under a disc.

    Where that is no closed form, it is interpolated between powers of two, which are kept.
    """
    if type(half_space).disc_stiffness is not HalfSpace.disc_stiffness:
        return half_space.disc_stiffness(radius)
    octave = math.floor(math.log2(radius))
    low, high = (_stiffness_of_octave(half_space, each) for each in (octave, octave + 1))
    return float(low * (high / low) ** (math.log2(radius) - octave))


def _stiffness_of_octave(half_space: HalfSpace, octave: int) -> float:
    try:
        return _kept_stiffness(half_space, octave)
    except TypeError:  # one that holds an array has no hash
        return half_space.disc_stiffness(2.0**octave)


@lru_cache(maxsize=256)
def _kept_stiffness(half_space: HalfSpace, octave: int) -> float:
    return half_space.disc_stiffness(2.0**octave)
