"""The nodes of a region that carry pressure, by their places in it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar, cast

import numpy as np

from roughline.computing.arrays import Indices, InRegion, Mask, Real, among
from roughline.halfspace.laws.bounds import Bounds

_Places = TypeVar("_Places", bound=Indices)


@dataclass(frozen=True, eq=False)
class Carriers:
    """Nodes that carry pressure, by their ascending places in a region, and the pressures."""

    places: InRegion
    pressure: Real

    def without(self, leaving: Mask) -> Carriers:
        """Return the carriers without some of them."""
        if not leaving.any():
            return self
        return Carriers(among(self.places, ~leaving), self.pressure[~leaving])

    def joined_by(self, others: InRegion, pressure: Real | float = 0.0) -> Carriers:
        """Return the carriers with other nodes as well, on which there is a pressure."""
        if not others.size:
            return self
        places, order = merged(self.places, others)
        joining = np.broadcast_to(pressure, others.shape)
        return Carriers(places, np.append(self.pressure, joining)[order])

    def can_carry(self, total: float | None, bounds: Bounds) -> bool:
        """Whether there are carriers, and the pressures on them can sum to more than a total."""
        if total is None or not self.places.size:
            return self.places.size > 0
        most = np.broadcast_to(np.asarray(bounds.at(self.places).high), self.places.shape)
        return float(most.sum()) > total

    def able_to_carry(self, total: float | None, bounds: Bounds, gap: Real) -> Carriers:
        """Return the carriers, joined by nodes of smallest gap if they cannot bear the load.

        Pressures have to sum to a total, if it is not None. The gaps are those of all nodes of the
        region, from any datum.
        """
        if self.can_carry(total, bounds) or self.places.size == gap.size:
            return self
        high = np.broadcast_to(np.asarray(bounds.high), gap.shape)
        lacking = (total or 0.0) - float(high[self.places].sum())
        gaps = gap.copy()
        gaps[self.places] = np.inf
        nearest = np.argsort(gaps, kind="stable")[: gap.size - self.places.size]
        more = 1 + int(np.searchsorted(np.cumsum(high[nearest]), lacking, side="right"))
        return self.joined_by(InRegion(np.sort(nearest[:more])))


def merged(places: _Places, others: _Places) -> tuple[_Places, Indices]:
    """Merge two ascending lists without common entries.

    Return with the list where each of its entries stood in the chain of the two.
    """
    chain = np.concatenate([places, others])
    order = np.argsort(chain, kind="stable")
    return cast("_Places", chain[order]), order
