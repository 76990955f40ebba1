"""The exchange of nodes between contact and gap, and the rule that keeps it from cycling.

References
----------
.. [1] J. J. Júdice and F. M. Pires, "A block principal pivoting algorithm for large-scale strictly
   monotone linear complementarity problems", Comput. Oper. Res. 21, 587-596 (1994).
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.halfspace.laws.conditions import Violations
from roughline.halfspace.search.contact_set import ContactSet
from roughline.halfspace.search.separation import Separation
from roughline.halfspace.search.state import Problem

# After more rounds than this without a new minimum of wrong nodes, the equations are solved to the
# tolerance before nodes are exchanged. After twice as many, nodes are exchanged one by one.
_PATIENCE = 8
# Nodes whose gap is below so many times the error on contact may come into contact.
_WATCHED = 2.0
# A node that lifts is relieved of this part of the hardness at most.
_RELIEF = 1e-3


class ExchangeRule:
    """How many of the wrong nodes are exchanged at a time.

    As long as their number falls, all of them are exchanged. Where it has not fallen for many
    rounds, only the wrong node of highest index is, which cannot cycle [1]_.

    Parameters
    ----------
    points : int
        Points of the grid.

    Attributes
    ----------
    wrong : int
        Number of wrong nodes in the last round.
    """

    def __init__(self, points: int) -> None:
        self.wrong = points
        self._fewest = points + 1
        self._rounds = 0  # since the last new minimum of wrong nodes

    @property
    def to_tolerance(self) -> bool:
        """Whether the equations are solved to the tolerance before nodes are exchanged."""
        return self._rounds > _PATIENCE

    @property
    def one_by_one(self) -> bool:
        """Whether only one node is exchanged at a time."""
        return self._rounds > 2 * _PATIENCE

    def applied(
        self, problem: Problem, contact_set: ContactSet, watched: Indices, wrong: Violations
    ) -> ContactSet:
        """Return the contact set after the exchange of wrong nodes.

        Parameters
        ----------
        problem : Problem
            The bodies; nodes that yield are set to the most that they bear.
        contact_set : ContactSet
            Nodes and pressures before.
        watched : ndarray of int
            Nodes off the contact at which overlap was looked for.
        wrong : Violations
            Nodes of the set that pull, yield or lift, and watched nodes that overlap.
        """
        self.wrong = wrong.count
        if self.one_by_one:
            wrong = _last_alone(contact_set.nodes, watched, wrong)
        self._rounds = 0 if self.wrong < self._fewest else self._rounds + 1
        self._fewest = min(self.wrong, self._fewest)
        return exchanged(problem, contact_set, watched, wrong)


def exchanged(
    problem: Problem, contact_set: ContactSet, watched: Indices, wrong: Violations
) -> ContactSet:
    """Return a contact set after wrong nodes have changed sides; see :class:`ExchangeRule`."""
    if wrong.yielding.any() or wrong.lifting.any():
        most = problem.conditions.largest_pressure
        pressure = np.where(wrong.yielding, most, contact_set.pressure)
        # of the pressure that its own gap takes to close, but little: its neighbours lift as well
        relieved = most - wrong.lift / problem.inverse.diagonal
        pressure[wrong.lifting] = np.maximum(relieved, (1 - _RELIEF) * most)
        contact_set = ContactSet(contact_set.nodes, pressure)
    return contact_set.without(wrong.pulling).joined_by(watched[wrong.overlapping])


def able_to_carry(contact_set: ContactSet, fewest: int, gap: Real | Separation) -> ContactSet:
    """Return a contact set, joined by the nodes of smallest gap if it has fewer than are needed.

    Parameters
    ----------
    contact_set : ContactSet
        Nodes and pressures.
    fewest : int
        Nodes that the load needs.
    gap : ndarray, shape (nx, ny)
        Gap on the whole grid, from any datum. [length]
    """
    lacking = min(fewest, math.prod(gap.shape)) - contact_set.nodes.size
    if lacking <= 0:
        return contact_set
    gaps = np.array(gap).ravel()
    gaps[contact_set.nodes] = np.inf
    return contact_set.joined_by(np.sort(np.argpartition(gaps, lacking - 1)[:lacking]))


def _last_alone(nodes: Indices, others: Indices, wrong: Violations) -> Violations:
    """Leave only the wrong node of highest index, among those in contact and others."""
    in_contact = wrong.pulling | wrong.yielding | wrong.lifting
    last = max(nodes[in_contact].max(initial=-1), others[wrong.overlapping].max(initial=-1))
    alone = nodes == last
    return replace(
        wrong,
        pulling=wrong.pulling & alone,
        yielding=wrong.yielding & alone,
        lifting=wrong.lifting & alone,
        lift=wrong.lift[alone[wrong.lifting]],
        overlapping=wrong.overlapping & (others == last),
    )


def watched_nodes(gap: Real, nodes: Indices, *, every: bool) -> Indices:
    """Return the nodes off the contact that may come into contact.

    Parameters
    ----------
    gap : ndarray, shape (nx, ny)
        Gap on the whole grid. [length]
    nodes : ndarray of int
        Nodes in contact.
    every : bool
        Whether to return all nodes off the contact. If not, these are nodes of small gap, about as
        many as there are in contact at most.
    """
    reach = np.inf if every else _WATCHED * float(np.sqrt(np.mean(gap.flat[nodes] ** 2)))
    near = gap.ravel() < reach
    near[nodes] = False
    others = np.flatnonzero(near)
    if every or others.size <= nodes.size:
        return others
    gaps = gap.flat[others]
    return others[gaps <= np.partition(gaps, nodes.size)[nodes.size]]
