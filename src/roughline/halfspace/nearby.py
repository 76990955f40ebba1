"""A contact problem looked at near the contact only, with an approximate operator."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.halfspace.contact_set import ContactSet, merged
from roughline.halfspace.operator import GridNodes, Precision
from roughline.halfspace.restricted import RestrictedOperator
from roughline.halfspace.state import Load, Problem
from roughline.halfspace.trial import Trial

# Nodes of a gap below so many times the error on contact may come into contact.
REACH = 2.0
_LARGEST = 0.4  # part of the grid on which a problem is looked at


@dataclass(frozen=True, eq=False)
class NearbyProblem(Problem):
    """The problem on some nodes, its sites, which are numbered in their order.

    Displacements are those of a trial, computed with the exact operator, and what the restricted
    operator adds for a change of its pressures.

    Attributes
    ----------
    touched : float
        Depth at which the surfaces touch anywhere on the grid. [length]
    approximate : RestrictedOperator
        Approximate operator.
    sites : GridNodes
        The nodes.
    before : ndarray, shape (sites,)
        Pressures of the trial. [pressure]
    moved : ndarray, shape (sites,)
        Displacements under them. [length]
    """

    touched: float
    approximate: RestrictedOperator
    sites: GridNodes
    before: Real
    moved: Real

    @cached_property
    def touch(self) -> float:
        """Depth at which the surfaces touch, here or elsewhere. [length]"""
        return self.touched

    @property
    def steps(self) -> RestrictedOperator:
        """The approximate operator."""
        return self.approximate

    def grid_nodes(self, nodes: Indices) -> GridNodes:
        """Return some sites as nodes of the grid."""
        return GridNodes.of(self.sites.indices[nodes], self.operator.shape)

    def displacement(self, pressure: Real, nodes: Indices, precision: Precision, out: Real) -> Real:
        """Return the displacement of all sites under the pressure on some of them."""
        change = -self.before
        change[nodes] += pressure
        if not change.any():
            out[:] = self.moved
            return out
        self.steps.displacement(change, self.sites, self.sites, precision, out)
        out += self.moved
        return out

    def recentred(self, contact_set: ContactSet, precision: Precision) -> NearbyProblem:
        """Return the problem with other pressures, whose displacements are computed exactly."""
        before = np.zeros_like(self.before)
        before[contact_set.nodes] = contact_set.pressure
        sources = self.grid_nodes(contact_set.nodes)
        moved = self.operator.displacement(contact_set.pressure, sources, self.sites, precision)
        return replace(self, before=before, moved=moved)

    def trial(self, load: Load, contact_set: ContactSet) -> Trial:
        """Return a set of sites with its pressures as a trial."""
        return Trial.of(self, load, contact_set, "float32", np.empty_like(self.moved))


@dataclass
class Nearby:
    """A problem near the contact, and the contact set that is looked at.

    Attributes
    ----------
    problem : NearbyProblem
        The problem.
    contact_set : ContactSet
        Sites in contact and the pressures on them.
    """

    problem: NearbyProblem
    contact_set: ContactSet

    @property
    def on_grid(self) -> ContactSet:
        """The contact set as one of nodes of the grid."""
        nodes = self.problem.sites.indices[self.contact_set.nodes]
        return ContactSet(nodes, self.contact_set.pressure)


def nearby(problem: Problem, trial: Trial, reach: float = REACH) -> Nearby | None:
    """Look at a problem near the contact of a trial; None where the exact operator is cheaper.

    Parameters
    ----------
    problem, trial : Problem, Trial
        The problem, and the trial with its gap.
    reach : float
        Nodes off the contact are looked at whose gap is below so many times the error.
    """
    contact_set = trial.contact_set
    nx, ny = problem.operator.shape
    most = max(0, int(_LARGEST * nx * ny) - contact_set.nodes.size)
    close = _close_nodes(trial.gap, contact_set.nodes, reach, most)
    sites, order = merged(contact_set.nodes, close)
    nodes = problem.grid_nodes(sites)
    operator = problem.inverse.restricted.on(nodes)
    if operator is None:
        return None
    places = np.flatnonzero(order < contact_set.nodes.size)
    separation = problem.separation.flat[sites]
    moved = trial.gap.flat[sites]
    moved[places[~problem.conditions.elastic(contact_set.pressure)]] -= trial.overlap
    moved += trial.approach
    moved -= separation - problem.touch
    before = np.zeros(sites.size)
    before[places] = contact_set.pressure
    near = NearbyProblem(
        problem.half_space,
        problem.inverse,
        separation,
        problem.rms_height,
        problem.conditions,
        problem.touch,
        operator,
        nodes,
        before,
        moved,
    )
    return Nearby(near, ContactSet(places, contact_set.pressure))


def _close_nodes(gap: Real, nodes: Indices, reach: float, most: int) -> Indices:
    """Return the nodes off the contact whose gap is small, at most so many."""
    reach *= float(np.sqrt(np.mean(gap.flat[nodes] ** 2)))
    close = gap.ravel() < reach
    close[nodes] = False
    others = np.flatnonzero(close)
    if others.size <= most:
        return others
    gaps = gap.flat[others]
    return others[np.sort(np.argpartition(gaps, most)[:most])]
