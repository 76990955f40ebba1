"""A contact problem restricted to the nodes near the contact, with an approximate operator."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Indices, Real
from roughline.halfspace.operators.operator import GridNodes, Precision
from roughline.halfspace.operators.restricted import RestrictedOperator
from roughline.halfspace.search.contact_set import ContactSet, merged
from roughline.halfspace.search.exchange import able_to_carry
from roughline.halfspace.search.separation import Separation
from roughline.halfspace.search.state import Load, Problem
from roughline.halfspace.search.trial import Trial

# Nodes of a gap below so many times the error on contact may come into contact.
REACH = 2.0
_LARGEST = 0.4  # part of the grid on which a problem is looked at
_AROUND = 4  # nodes that can touch, for each node in contact, about
_NODES_AT_A_TIME = 2**15  # whose separations a thread looks at


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

    def trial(self, load: Load, contact_set: ContactSet, *, rescale: bool = False) -> Trial:
        """Return a set of sites with its pressures as a trial."""
        out = np.empty_like(self.moved)
        return Trial.of(self, load, contact_set, "float32", out, rescale=rescale)


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
    places = np.flatnonzero(order < contact_set.nodes.size)
    moved = trial.gap.flat[sites]
    moved[places[~problem.conditions.elastic(contact_set.pressure)]] -= trial.overlap
    moved += trial.approach
    moved -= problem.separation.flat[sites] - problem.touch
    return _looked_at(problem, sites, moved, ContactSet(places, contact_set.pressure))


def within_reach(
    problem: Problem, load: Load, start: ContactSet, precision: Precision
) -> tuple[Nearby, float] | None:
    """Look at a problem wherever the bodies can touch; return it with the largest residual.

    Pressure pushes a free half-space away everywhere. So a node can only touch where the bodies
    are nearer to each other, before the load, than they approach. Returns None where the gap on
    the whole grid takes no more time, and for periodic bodies, whose grid is always transformed.

    Parameters
    ----------
    problem, load : Problem, Load
        The problem, and what is prescribed.
    start : ContactSet
        Nodes in contact, and pressures on them up to a factor.
    precision : {"float64", "float32"}
        Precision of the displacements.
    """
    operator = problem.operator
    start = able_to_carry(start, problem.fewest_nodes(load), problem.separation)
    nodes, pressure = start.nodes, start.pressure
    if not operator.sums_are_cheap(nodes.size, _AROUND * nodes.size):
        return None
    if load.force is not None:
        pressure = problem.conditions.with_total(pressure, load.force / operator.cell_area)
    sources = problem.grid_nodes(nodes)
    moved = operator.displacement(pressure, sources, sources, precision)
    depth = load.depth
    if depth is None:  # where the pressures put the nodes under them, by the work that they do
        depth = float(pressure @ (moved + problem.separation.flat[nodes])) / float(pressure.sum())
    others = np.setdiff1d(_nearer(problem.separation, depth), nodes, assume_unique=True)
    if not operator.sums_are_cheap(nodes.size, others.size):
        return None
    beside = operator.displacement(pressure, sources, problem.grid_nodes(others), precision)
    sites, order = merged(nodes, others)
    contact_set = ContactSet(np.flatnonzero(order < nodes.size), pressure)
    around = _looked_at(problem, sites, np.concatenate([moved, beside])[order], contact_set)
    if around is None:
        return None
    trial = around.problem.trial(load, contact_set, rescale=True)
    near = nearby(around.problem, trial)
    return None if near is None else (near, trial.residuals.worst)


def _nearer(separation: Real | Separation, distance: float) -> Indices:
    """Return the nodes at which the bodies are nearer to each other than a distance."""
    nx, ny = separation.shape
    found: list[Indices] = [np.empty(0, dtype=np.intp)] * nx

    def look(first: int, last: int) -> None:
        found[first] = first * ny + np.flatnonzero(separation[first:last] < distance)

    fft.share_out_blocks(look, nx, 1 + _NODES_AT_A_TIME // ny)
    return np.concatenate(found)


def _looked_at(
    problem: Problem, sites: Indices, moved: Real, contact_set: ContactSet
) -> Nearby | None:
    """Look at a problem on some nodes; None where the exact operator is cheaper.

    Parameters
    ----------
    problem : Problem
        The problem.
    sites : ndarray of int
        The nodes, ascending.
    moved : ndarray, shape (sites,)
        Displacements of them. [length]
    contact_set : ContactSet
        Sites in contact, and the pressures under which they moved.
    """
    nodes = problem.grid_nodes(sites)
    operator = problem.inverse.restricted.on(nodes)
    if operator is None:
        return None
    before = np.zeros(sites.size)
    before[contact_set.nodes] = contact_set.pressure
    near = NearbyProblem(
        problem.half_space,
        problem.inverse,
        problem.separation.flat[sites],
        problem.rms_height,
        problem.resolution,
        problem.conditions,
        problem.touch,
        operator,
        nodes,
        before,
        moved,
    )
    return Nearby(near, contact_set)


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
