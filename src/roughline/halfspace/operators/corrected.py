"""The operator of a search: approximate, and exact for the pressures around which it is centred."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from roughline.computing.arrays import InGrid, InRegion, Real, among
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.operators.grid_nodes import GridNodes, Precision
from roughline.halfspace.operators.restricted import RestrictedOperator


@dataclass(frozen=True, eq=False)
class CorrectedOperator:
    """The displacements u = u_0 + R (p - p_0) of some nodes of a grid under pressures on them.

    The exact operator gives u_0 under p_0. What further changes of pressure add comes from a
    restricted operator R, or from the exact one itself, which then needs no p_0. A node is given
    by its place among these nodes.
    """

    exact: Convolution
    restricted: RestrictedOperator | Convolution | None = None  # R; None: the exact operator
    nodes: GridNodes | None = None  # None: all of the grid
    before: Real | None = None  # p_0, at the nodes; None: zero
    moved: Real | None = None  # u_0

    @property
    def linear(self) -> Convolution | RestrictedOperator:
        """R, which gives what changes of pressure add."""
        return self.restricted or self.exact

    def on_grid(self, places: InRegion) -> InGrid:
        """Return nodes as flat indices in the grid."""
        return InGrid(places) if self.nodes is None else among(self.nodes.indices, places)

    def grid_nodes(self, places: InRegion) -> GridNodes:
        """Return nodes listed row by row."""
        return GridNodes.of(self.on_grid(places), self.exact.shape)

    def displacement(self, pressure: Real, places: InRegion | None, precision: Precision) -> Real:
        """Return the displacement of all nodes under the pressure on some; None: on all."""
        if self.restricted is None:
            return self._exactly(pressure, places, precision)
        assert self.nodes is not None
        change = np.zeros(self.nodes.indices.size) if self.before is None else -self.before
        change[slice(None) if places is None else places] += pressure
        moved = self.restricted.displacement(change, self.nodes, self.nodes, precision)
        return moved if self.moved is None else np.add(moved, self.moved, out=moved)

    def recentred(
        self, pressure: Real, places: InRegion | None, precision: Precision
    ) -> CorrectedOperator:
        """Return the operator that is exact for the pressure on some nodes; None: on all."""
        moved = self._exactly(pressure, places, precision)
        before = np.zeros_like(moved)
        before[slice(None) if places is None else places] = pressure
        return replace(self, before=before, moved=moved)

    def _exactly(self, pressure: Real, places: InRegion | None, precision: Precision) -> Real:
        sources = self.nodes if places is None else self.grid_nodes(places)
        assert sources is not None
        return self.exact.displacement(pressure, sources, self.nodes, precision).ravel()
