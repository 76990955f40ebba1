"""A first guess of the contact: solved roughly on ever finer grids, each led by the coarser."""

from __future__ import annotations

import numpy as np

from roughline.halfspace import operator as operators
from roughline.halfspace.active_set import solve
from roughline.halfspace.operator import Operator, Places
from roughline.halfspace.state import Field, Load, Method, Problem, Start

_COARSEST = 256  # points along the longer side of the grid that starts from the rigid shift
_ROUGHLY = Method(rtol=1e-2, max_iterations=200, precision="float32")


def first_guess(problem: Problem, load: Load) -> Start:
    """Guess which nodes come into contact, and the pressures on them.

    The coarse grid sees the mean separation of two by two nodes. Its pressures, the same on all
    four, leave gaps on the finer grid, which one step of relaxation turns into pressures.

    Parameters
    ----------
    problem : Problem
        The body and the half-space.
    load : Load
        What is prescribed.
    """
    operator, separation = problem.operator, problem.separation
    if max(separation.shape) <= _COARSEST:
        return _rigid_guess(operator, separation, load)
    coarse_separation = _halved(separation)
    if load.depth is not None and load.depth <= coarse_separation.min():
        return _rigid_guess(operator, separation, load)
    coarse_operator = _coarsened(operator, coarse_separation.shape)
    coarse = Problem.of(coarse_operator, coarse_separation, problem.rms_height)
    contact = solve(coarse, load, first_guess(coarse, load), _ROUGHLY)
    pressure = np.zeros(coarse_separation.shape)
    pressure.flat[contact.nodes] = contact.pressure
    for axis, n in enumerate(separation.shape):
        # at the end of an odd side one node takes the force of two
        share = coarse_operator.spacing[axis] / operator.spacing[axis] / _widths(n, axis)
        pressure = np.repeat(pressure * share, min(n, 2), axis=axis).take(range(n), axis=axis)
    pressed = np.flatnonzero(pressure)
    places = Places.of(pressed, operator.shape)
    gap = operator.convolve(pressure.flat[pressed], places, None, "float32")
    gap += separation
    gap -= contact.depth
    gap /= problem.approximation.own
    pressure -= gap
    nodes = np.flatnonzero(pressure > 0)
    return (
        Start(nodes, pressure.flat[nodes]) if nodes.size else Start(pressed, np.ones(pressed.size))
    )


def _coarsened(operator: Operator, shape: tuple[int, ...]) -> Operator:
    """Return the same half-space on half as many points a side, for E* = 1."""
    (nx, ny), (dx, dy) = operator.shape, operator.spacing
    mx, my = shape
    if operator.is_periodic:
        return operators.periodic((mx, my), (dx * nx / mx, dy * ny / my), 1.0)
    return operators.free((mx, my), (dx * min(nx, 2), dy * min(ny, 2)), 1.0)


def _halved(field: Field) -> Field:
    """Means over two by two nodes; fewer at the end of an odd side."""
    for axis, n in enumerate(field.shape):
        field = np.add.reduceat(field, np.arange(0, n, 2), axis=axis) / _widths(n, axis)
    return field


def _widths(n: int, axis: int) -> Field:
    """Nodes that each coarse one stands for, to be broadcast along an axis."""
    widths = np.diff(np.append(np.arange(0.0, n, 2), n))
    return widths[:, np.newaxis] if axis == 0 else widths


def _rigid_guess(operator: Operator, separation: Field, load: Load) -> Start:
    """Start from every node that the rigid shift would overlap, pressed as much as it overlaps.

    For a force, the shift at which one disc of that many nodes, 2 a (d - mean separation), would
    carry it.
    """
    depth = load.depth
    if depth is None:
        assert load.force is not None
        separations = np.sort(separation, axis=None)
        count = np.arange(1, separations.size + 1)
        stiffness = 2 * np.sqrt(count * operator.cell_area / np.pi)
        depths = load.force / stiffness + np.cumsum(separations) / count
        reached = depths <= np.append(separations[1:], np.inf)
        depth = float(depths[reached.argmax()])
    nodes = np.flatnonzero(separation < depth)
    return Start(nodes, depth - separation.flat[nodes])
