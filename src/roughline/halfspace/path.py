"""A path of rising loads: each contact starts from the one before, led by its tangent."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from roughline.halfspace.active_set import Contact, Load, Outcome, solve
from roughline.halfspace.operator import Operator
from roughline.halfspace.preconditioner import Stencil
from roughline.halfspace.tangent import Tangent, tangent

Field = NDArray[np.float64]
Start = tuple[float, NDArray[np.intp], NDArray[np.float64]]


def follow(
    operator: Operator,
    separation: Field,
    rms_height: float,
    control: Literal["depths", "forces"],
    values: NDArray[np.float64],
    rtol: float,
    max_iterations: int,
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
    rtol : float
        Bound on every residual.
    max_iterations : int
        Bound on the convolutions of one load.

    Yields
    ------
    tuple of Contact and Tangent
        For each load; without a tangent where the contact was not certified.
    """
    stencil = Stencil.of(operator)
    before: tuple[Contact, Tangent] | None = None
    for value in values.tolist():
        load = Load(depth=value) if control == "depths" else Load(force=value)
        if before is None:
            start, tangent_start = _first_guess(operator, separation, load), None
        else:
            start, tangent_start = _predicted(operator, separation, load, *before)
        contact = solve(
            operator, stencil, separation, rms_height, load, start, rtol, max_iterations
        )
        if contact.outcome is not Outcome.CONVERGED:
            before = None
            yield contact, None
            continue
        if tangent_start is not None:
            tangent_start = tangent_start[contact.patch.nodes]
        stiffness = tangent(operator, contact, tangent_start)
        before = (contact, stiffness) if stiffness.converged else None
        yield contact, stiffness


def _first_guess(operator: Operator, separation: Field, load: Load) -> Start:
    """Start from every node that the rigid shift would overlap.

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
    return depth, nodes, np.zeros(nodes.size)


def _predicted(
    operator: Operator, separation: Field, load: Load, contact: Contact, tangent: Tangent
) -> tuple[Start, NDArray[np.float64]]:
    """Follow the tangent: p + dF w, and the nodes that press or overlap then."""
    if load.force is not None:
        rise = load.force - contact.force
        depth = contact.depth + rise / tangent.stiffness
    else:
        assert load.depth is not None
        depth = load.depth
        rise = tangent.stiffness * (depth - contact.depth)
    per_force = contact.patch.displacement_everywhere(tangent.pressure_per_force)
    gap = contact.gap + rise * (per_force - 1 / tangent.stiffness)
    pressure = np.zeros(separation.size)
    pressure[contact.patch.nodes] = contact.pressure + rise * tangent.pressure_per_force
    field_per_force = np.zeros(separation.size)
    field_per_force[contact.patch.nodes] = tangent.pressure_per_force
    candidates = gap.ravel() < 0
    candidates[contact.patch.nodes] = False
    candidates |= pressure > 0
    nodes = np.flatnonzero(candidates)
    return (depth, nodes, pressure[nodes]), field_per_force
