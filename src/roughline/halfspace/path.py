"""A path of rising loads: each contact starts from the one before, led by its tangent."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import zip_longest
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from roughline.halfspace.active_set import solve
from roughline.halfspace.cascade import first_guess
from roughline.halfspace.operator import Operator, Places
from roughline.halfspace.patch import merged
from roughline.halfspace.state import (
    Contact,
    Field,
    Load,
    Method,
    Nodes,
    Outcome,
    Problem,
    Start,
    Vector,
)
from roughline.halfspace.tangent import Tangent, tangent

# New contact relieves its surroundings, which the tangent cannot know: nodes that it would overlap
# after this part of the rise are taken to come into contact.
_BELIEVED = 0.5
# Beyond such a rise over the force that is there, coarser grids guess better than the tangent.
_FARTHEST = 1.0


def follow(
    operator: Operator,
    separation: Field,
    rms_height: float,
    control: Literal["depths", "forces"],
    values: NDArray[np.float64],
    method: Method,
) -> Iterator[tuple[Contact, Tangent | None]]:
    """Solve the contact under each load in turn, for E* = 1.

    Parameters
    ----------
    operator : Operator
        The half-space.
    separation : ndarray, shape (nx, ny)
        Distance of the bodies at first touch, zero at the highest point. [length]
    rms_height : float
        Gaps are compared with this, or with the depth where that is smaller. [length]
    control : {"depths", "forces"}
        What is prescribed.
    values : ndarray, shape (loads,)
        Rising depths [length] or forces [force].
    method : Method
        Tolerance, bound on the convolutions and precision.

    Yields
    ------
    tuple of Contact and Tangent
        For each load; without a tangent where the contact was not certified.
    """
    problem = Problem.of(operator, separation, rms_height)
    start: Start | None = None
    guess: tuple[Nodes, Vector] | None = None
    loads = [Load(**{control.removesuffix("s"): value}) for value in values.tolist()]
    for load, next_load in zip_longest(loads, loads[1:]):
        if start is None:
            start = first_guess(problem, load)
        contact = solve(problem, load, start, method)
        start = None
        if contact.outcome is not Outcome.CONVERGED:
            guess = None
            yield contact, None
            continue
        carried = None if guess is None else _carried(*guess, contact.nodes)
        stiffness = tangent(problem, contact, carried, method)
        guess = None
        if stiffness.converged and next_load is not None:
            guess = contact.nodes, stiffness.pressure_per_force
            rise = _rise(contact, stiffness, next_load)
            if rise < _FARTHEST * contact.force:
                start = _predicted(operator, rise, contact, stiffness)
        yield contact, stiffness
        del contact, stiffness  # the fields of one load are enough to hold


def _rise(contact: Contact, stiffness: Tangent, load: Load) -> float:
    """Return the rise of the force to a load; along the tangent, where the depth is given."""
    if load.force is not None:
        return load.force - contact.force
    assert load.depth is not None
    return stiffness.stiffness * (load.depth - contact.depth)


def _predicted(operator: Operator, rise: float, contact: Contact, stiffness: Tangent) -> Start:
    """Follow the tangent: p + dF w, and the nodes that press or overlap then."""
    places = Places.of(contact.nodes, operator.shape)
    gap = operator.convolve(stiffness.pressure_per_force, places, None, "float32")
    gap -= 1 / stiffness.stiffness
    gap *= _BELIEVED * rise
    gap += contact.gap
    gap.flat[contact.nodes] = 0.0
    overlapping = np.flatnonzero(gap < 0)
    pressure = contact.pressure + rise * stiffness.pressure_per_force
    pressing = pressure > 0
    nodes, order = merged(contact.nodes[pressing], overlapping)
    pressure = np.append(pressure[pressing], np.zeros(overlapping.size))[order]
    return Start(nodes, pressure)


def _carried(before: Nodes, values: Vector, nodes: Nodes) -> Vector:
    """Return values on the nodes that were there before, zero on the others."""
    carried = np.zeros(nodes.size)
    where = np.searchsorted(before, nodes)
    where[where == before.size] = 0
    still = before[where] == nodes
    carried[still] = values[where[still]]
    return carried
