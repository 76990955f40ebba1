"""Bodies of revolution on a layered half-space, by one Fredholm equation.

Forces phi(x) of the springs of the reduction method give the pressure, whatever lies below the
surface. A half-space of the compliance 2 (1 + T(q)) / (E* q) makes springs act on each other,

    phi(x) + (1 / pi) int_0^a phi(t) (K(x - t) + K(x + t)) dt = E* (d - g(x)),

with K(s) = int_0^inf T(q) cos(q s) dq and the line g of the body. The force is twice the integral
of phi from 0 to a.

References
----------
.. [1] N. N. Lebedev and Ia. S. Ufliand, "Axisymmetric contact problem for an elastic layer", J.
   Appl. Math. Mech. 22, 442-450 (1958).
.. [2] W. C. Hayes, L. M. Keer, G. Herrmann and L. F. Mockros, "A mathematical analysis for
   indentation tests of articular cartilage", J. Biomech. 5, 541-551 (1972).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np

from roughline.exact._checks import Real, positive
from roughline.exact.layers import BondedLayer

_FEWEST_SPRINGS, _SPRINGS_PER_THICKNESS = 64, 5  # more for each thickness in the radius
_PANEL_COUNT, _NODES_PER_PANEL = 200, 8  # of the waves
_LARGEST_WAVENUMBER = 24.0  # times h


@dataclass(frozen=True)
class LayeredContact:
    """A contact of a given radius on a bonded layer.

    Attributes
    ----------
    layer : BondedLayer
        The half-space.
    radius : float
        Contact radius a. [length]

    Raises
    ------
    ValueError
        If the radius is not positive.
    """

    layer: BondedLayer
    radius: float

    def __post_init__(self) -> None:
        positive(radius=self.radius)

    @property
    def E_star(self) -> float:
        """Contact modulus of the layer. [pressure]"""
        return self.layer.young / (1 - self.layer.poisson**2)

    def _solved(self, line: Callable[[Real], Real]) -> tuple[Real, Real]:
        """Return forces over a of springs displaced by a line, at the edge and in total."""
        count = _FEWEST_SPRINGS + int(_SPRINGS_PER_THICKNESS * self.radius / self.layer.thickness)
        nodes, weights = np.polynomial.legendre.leggauss(count)
        x, w = self.radius * (1 + nodes) / 2, self.radius * weights / 2
        both = np.append(x, self.radius)
        edges = (
            np.concatenate([[0.0], np.geomspace(1e-8, _LARGEST_WAVENUMBER, _PANEL_COUNT + 1)])
            / self.layer.thickness
        )
        edges = np.union1d(edges, np.arange(0, edges[-1], pi / self.radius))
        points, shares = np.polynomial.legendre.leggauss(_NODES_PER_PANEL)
        half = np.diff(edges)[:, np.newaxis] / 2
        q = (edges[:-1, np.newaxis] + half * (1 + points)).ravel()
        beside = (half * shares).ravel() * (self.E_star * q / 2 * self.layer.compliance(q) - 1)
        # K(x - t) + K(x + t) = 2 int T cos(q x) cos(q t) dq
        rows = 2 / pi * (np.cos(np.outer(both, q)) * beside) @ np.cos(np.outer(q, x)) * w
        forces = np.linalg.solve(np.eye(count) + rows[:-1], self.E_star * line(x))
        edge = self.E_star * line(np.array([self.radius])) - rows[-1] @ forces
        return edge, 2 * w @ forces

    @property
    def stiffness(self) -> float:
        """Force per approach of a flat punch of this radius [2]_. [force / length]"""
        return float(self._solved(np.ones_like)[1])

    def sphere(self, radius_of_curvature: float) -> tuple[float, float]:
        """Return depth and force of a sphere that touches up to this radius.

        Parameters
        ----------
        radius_of_curvature : float
            R. [length]

        Returns
        -------
        tuple of float
            Depth and force. [length] and [force]

        Raises
        ------
        ValueError
            If R is not positive.
        """
        positive(radius_of_curvature=radius_of_curvature)
        edge, even = self._solved(np.ones_like)
        edge_of_line, force = self._solved(lambda x: x**2 / radius_of_curvature)
        depth = float(edge_of_line[0] / edge[0])  # at which the spring at the edge bears nothing
        return depth, float(depth * even - force)
