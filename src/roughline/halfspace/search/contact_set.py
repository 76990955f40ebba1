"""The nodes in contact and the pressures on them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real


@dataclass(frozen=True, eq=False)
class ContactSet:
    """Nodes in contact and the pressures on them.

    Attributes
    ----------
    nodes : ndarray of int
        Ascending flat indices in the grid.
    pressure : ndarray, shape (nodes,)
        Pressures on them. [pressure]
    """

    nodes: Indices
    pressure: Real

    def without(self, leaving: Mask) -> ContactSet:
        """Return the set without some of its nodes."""
        if not leaving.any():
            return self
        return ContactSet(self.nodes[~leaving], self.pressure[~leaving])

    def joined_by(self, others: Indices) -> ContactSet:
        """Return the set with other nodes as well, on which there is no pressure yet."""
        if not others.size:
            return self
        nodes, order = merged(self.nodes, others)
        return ContactSet(nodes, np.append(self.pressure, np.zeros(others.size))[order])


def merged(nodes: Indices, others: Indices) -> tuple[Indices, Indices]:
    """Merge two ascending lists without common entries.

    Returns
    -------
    merged, order : ndarray of int
        The ascending list, and where each of its entries stood in the chain of the two lists.
    """
    chain = np.concatenate([nodes, others])
    order = np.argsort(chain, kind="stable")
    return chain[order], order
