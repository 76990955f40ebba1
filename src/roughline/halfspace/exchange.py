"""The exchange of nodes between contact and gap, and the rule that keeps it from cycling.

References
----------
.. [1] J. J. Júdice and F. M. Pires, "A block principal pivoting algorithm for large-scale strictly
   monotone linear complementarity problems", Comput. Oper. Res. 21, 587-596 (1994).
"""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.halfspace.conditions import Violations
from roughline.halfspace.contact_set import ContactSet

# After more rounds than this without a new minimum of wrong nodes, the equations are solved to the
# tolerance before nodes are exchanged. After twice as many, nodes are exchanged one by one.
_PATIENCE = 8
# Nodes whose gap is below so many times the error on contact may come into contact.
_WATCHED = 2.0


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
        self, contact_set: ContactSet, watched: Indices, wrong: Violations, separation: Real
    ) -> ContactSet:
        """Return the contact set after the exchange of wrong nodes.

        Parameters
        ----------
        contact_set : ContactSet
            Nodes and pressures before.
        watched : ndarray of int
            Nodes off the contact at which overlap was looked for.
        wrong : Violations
            Nodes of the set that pull, and watched nodes that overlap.
        separation : ndarray, shape (nx, ny)
            Distance of the bodies at first touch, zero at the highest point. [length]
        """
        leaving, joining = wrong.pulling, wrong.overlapping
        if self.one_by_one:
            leaving, joining = _last_alone(contact_set.nodes, leaving, watched, joining)
        self.wrong = wrong.count
        self._rounds = 0 if self.wrong < self._fewest else self._rounds + 1
        self._fewest = min(self.wrong, self._fewest)
        return exchanged(contact_set, leaving, watched[joining], separation)


def exchanged(
    contact_set: ContactSet, leaving: Mask, joining: Indices, separation: Real
) -> ContactSet:
    """Return a contact set without some of its nodes and with others.

    The highest point of the body remains in contact if no other node does.
    """
    contact_set = contact_set.without(leaving).joined_by(joining)
    if contact_set.nodes.size:
        return contact_set
    return ContactSet(np.array([separation.argmin()]), np.zeros(1))


def _last_alone(nodes: Indices, leaving: Mask, others: Indices, joining: Mask) -> tuple[Mask, Mask]:
    """Leave only the wrong node of highest index, among those in contact and others."""
    last_leaving = nodes[leaving].max(initial=-1)
    last_joining = others[joining].max(initial=-1)
    return (
        leaving & (nodes == last_leaving) & (last_leaving > last_joining),
        joining & (others == last_joining) & (last_joining > last_leaving),
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
