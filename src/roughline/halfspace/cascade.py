"""A first guess of the contact: solved roughly on ever finer grids, each led by the coarser."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from roughline.computing.arrays import Real
from roughline.halfspace.contact_set import ContactSet
from roughline.halfspace.correction import guessed
from roughline.halfspace.lending import lent
from roughline.halfspace.state import Load, Method, Problem

_COARSEST = 64  # points along the longer side of the grid that starts from the rigid shift
_ROUGH = Method(rtol=1e-2, max_iterations=200, precision="float32")


def first_guess(problem: Problem, load: Load) -> tuple[ContactSet, float]:
    """Guess which nodes come into contact, and the pressures on them.

    The coarse grid sees the mean separation of two by two nodes, and its pressures are the same on
    all four.

    Parameters
    ----------
    problem : Problem
        The body and the half-space.
    load : Load
        What is prescribed.

    Returns
    -------
    start : ContactSet
        The nodes, and pressures on them up to a factor.
    pressure : float
        Largest pressure on the next coarser grid; zero if none was solved. [pressure]
    """
    operator, separation = problem.operator, problem.separation
    if max(separation.shape) <= _COARSEST:
        return _rigid_guess(problem, load), 0.0
    coarse_separation = _halved(np.asarray(separation))
    if load.depth is not None and load.depth <= coarse_separation.min():
        return _rigid_guess(problem, load), 0.0
    shape, spacing = problem.half_space.coarser_grid(operator.shape, operator.spacing)
    with lent(problem.half_space, shape, spacing) as inverse:
        coarse = replace(problem, inverse=inverse, separation=coarse_separation)
        contact = guessed(coarse, load, first_guess(coarse, load)[0], _ROUGH)
    del coarse, inverse
    largest = float(contact.pressure.max())
    pressure = np.zeros(shape)
    pressure.flat[contact.nodes] = contact.pressure
    for axis, n in enumerate(separation.shape):
        # at the end of an odd side one node takes the force of two
        share = spacing[axis] / operator.spacing[axis] / _widths(n, axis)
        pressure = np.repeat(pressure * share, min(n, 2), axis=axis).take(range(n), axis=axis)
    pressure = problem.conditions.projected(pressure)
    nodes = np.flatnonzero(pressure > 0)
    if nodes.size:
        return ContactSet(nodes, pressure.flat[nodes]), largest
    return _rigid_guess(problem, load), largest


def _halved(field: Real) -> Real:
    """Means over two by two nodes; fewer at the end of an odd side."""
    for axis, n in enumerate(field.shape):
        along = np.moveaxis(field, axis, 0)
        halves = along[::2].copy()
        halves[: n // 2] += along[1::2]
        halves[: n // 2] /= 2
        field = np.moveaxis(halves, 0, axis)
    return np.ascontiguousarray(field)


def _widths(n: int, axis: int) -> Real:
    """Nodes that each coarse one stands for, to be broadcast along an axis."""
    widths = np.diff(np.append(np.arange(0.0, n, 2), n))
    return widths[:, np.newaxis] if axis == 0 else widths


def _rigid_guess(problem: Problem, load: Load) -> ContactSet:
    """Start from every node that the rigid shift would overlap, with its overlap as pressure.

    A force shifts the body to the depth at which one disc of as many nodes would carry it, with
    2 E* a (d - mean separation).
    """
    separation, depth = np.asarray(problem.separation), load.depth
    if depth is None:
        assert load.force is not None
        separations = np.sort(separation, axis=None)
        count = np.arange(1, separations.size + 1)
        stiffness = (
            2 * problem.half_space.E_star * np.sqrt(count * problem.operator.cell_area / np.pi)
        )
        depths = load.force / stiffness + np.cumsum(separations) / count
        reached = depths <= np.append(separations[1:], np.inf)
        depth = float(depths[reached.argmax()])
        needed = min(problem.fewest_nodes(load), separations.size)
        depth = max(depth, float(separations[needed - 1]))
    nodes = np.flatnonzero(separation < depth)
    return ContactSet(nodes, depth - separation.flat[nodes])
