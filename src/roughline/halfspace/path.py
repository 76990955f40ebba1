"""A path of rising loads: each contact starts from the one before, led by its tangent."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from roughline.halfspace.active_set import solve
from roughline.halfspace.cascade import first_guess
from roughline.halfspace.operator import Operator, Places
from roughline.halfspace.patch import merged
from roughline.halfspace.preconditioner import Approximation
from roughline.halfspace.state import Contact, Field, Load, Method, Outcome, Start, Vector
from roughline.halfspace.tangent import Tangent, tangent

# New contact relieves its surroundings, which the tangent cannot know: nodes that it would overlap
# after this part of the rise are taken to come into contact.
_BELIEVED = 0.5


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
    approximation = Approximation.of(operator)
    before: tuple[Contact, Tangent] | None = None
    for value in values.tolist():
        load = Load(depth=value) if control == "depths" else Load(force=value)
        if before is None:
            start = first_guess(operator, separation, rms_height, load)
        else:
            start = _predicted(operator, separation, load, *before)
        contact = solve(operator, approximation, separation, rms_height, load, start, method)
        if contact.outcome is not Outcome.CONVERGED:
            before = None
            yield contact, None
            continue
        guess = None if before is None else _carried(before[0], before[1], contact)
        stiffness = tangent(operator, approximation, contact, guess, method)
        before = (contact, stiffness) if stiffness.converged else None
        yield contact, stiffness


def _predicted(
    operator: Operator, separation: Field, load: Load, contact: Contact, stiffness: Tangent
) -> Start:
    """Follow the tangent: p + dF w, and the nodes that press or overlap then."""
    if load.force is not None:
        rise = load.force - contact.force
    else:
        assert load.depth is not None
        rise = stiffness.stiffness * (load.depth - contact.depth)
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


def _carried(before: Contact, stiffness: Tangent, contact: Contact) -> Vector:
    """Return dp/dF of the load before on the nodes that are still in contact, zero on others."""
    carried = np.zeros(contact.nodes.size)
    where = np.searchsorted(before.nodes, contact.nodes)
    where[where == before.nodes.size] = 0
    still = before.nodes[where] == contact.nodes
    carried[still] = stiffness.pressure_per_force[where[still]]
    return carried
