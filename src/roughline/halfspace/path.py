"""A path of rising loads: each contact starts from the one before, led by its tangent."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import zip_longest

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.halfspace.active_set import solve
from roughline.halfspace.cascade import first_guess
from roughline.halfspace.contact_set import ContactSet
from roughline.halfspace.operator import GridNodes
from roughline.halfspace.state import Contact, Load, Method, Outcome, Problem
from roughline.halfspace.tangent import Tangent, tangent

# New contact relieves its surroundings, which the tangent does not take into account. Nodes that it
# would overlap after this part of the rise are taken to come into contact.
_PART_OF_RISE = 0.5
# Where the force rises by more than this, over the force so far, coarser grids guess better than
# the tangent.
_LARGEST_RISE = 1.0


def solve_path(
    problem: Problem, loads: Sequence[Load], method: Method
) -> Iterator[tuple[Contact, Tangent | None]]:
    """Solve the contact under each load in turn.

    Parameters
    ----------
    problem : Problem
        The body and the half-space.
    loads : sequence of Load
        Rising loads.
    method : Method
        Tolerance, bound on the convolutions and precision.

    Yields
    ------
    tuple of Contact and Tangent
        For each load; without a tangent where the contact was not certified.
    """
    start: ContactSet | None = None
    last: tuple[Indices, Real] | None = None  # nodes of the last tangent, and dp/dF on them
    for load, next_load in zip_longest(loads, loads[1:]):
        if start is None:
            start = first_guess(problem, load)
        contact = solve(problem, load, start, method)
        start = None
        if contact.outcome is not Outcome.CONVERGED:
            last = None
            yield contact, None
            continue
        # each load meets the surfaces that the last one left
        problem = replace(problem, separation=contact.separation)
        guess = None if last is None else _transferred(*last, contact.nodes)
        response = tangent(problem, contact, guess, method)
        last = None
        if response.converged and next_load is not None:
            last = contact.nodes, response.pressure_per_force
            rise = _rise(contact, response, next_load)
            if rise < _LARGEST_RISE * contact.force:
                start = _predicted(problem, rise, contact, response)
        yield contact, response
        del contact, response  # the fields of one load are enough to hold


def _rise(contact: Contact, response: Tangent, load: Load) -> float:
    """Return the rise of the force to a load; along the tangent, where the depth is given."""
    if load.force is not None:
        return load.force - contact.force
    assert load.depth is not None
    return response.stiffness * (load.depth - contact.depth)


def _predicted(problem: Problem, rise: float, contact: Contact, response: Tangent) -> ContactSet:
    """Follow the tangent to p + dF dp/dF, and find the nodes that are in contact then."""
    operator = problem.operator
    sources = GridNodes.of(contact.nodes, operator.shape)
    gap = operator.displacement(response.pressure_per_force, sources, None, "float32")
    gap -= 1 / response.stiffness
    gap *= _PART_OF_RISE * rise
    gap += contact.gap
    gap.flat[contact.nodes] = 0.0
    overlapping = np.flatnonzero(gap < 0)
    pressure = contact.pressure + rise * response.pressure_per_force
    pressure = problem.conditions.projected(pressure)
    loaded = pressure > 0
    return ContactSet(contact.nodes[loaded], pressure[loaded]).joined_by(overlapping)


def _transferred(nodes: Indices, values: Real, new_nodes: Indices) -> Real:
    """Return the values on new nodes, zero on those that had none before."""
    transferred = np.zeros(new_nodes.size)
    where = np.searchsorted(nodes, new_nodes)
    where[where == nodes.size] = 0
    known = nodes[where] == new_nodes
    transferred[known] = values[where[known]]
    return transferred
