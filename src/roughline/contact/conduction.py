"""What the points of a contact conduct into bodies with layers, electricity or heat.

All points that touch have one potential, as a current spreads from them into the bodies. So it is
the problem of a flat punch on these points, in a half-space whose displacement is the potential and
whose pressure is the current's density. Of one material its displacement is that of an elastic one
of E* = 2 / resistivity, which is Barber's identity.

References
----------
.. [1] J. R. Barber, "Bounds on the electrical resistance between contacting elastic rough bodies",
   Proc. R. Soc. A 459, 53-66 (2003).
.. [2] M. M. Yovanovich, J. R. Culham and P. Teertstra, "Analytical modeling of spreading resistance
   in flux tubes, half spaces, and compound disks", IEEE Trans. Compon. Packag. Manuf. Technol. A
   21, 168-176 (1998), for one layer.
"""

from __future__ import annotations

import functools
import math
import operator as of
from dataclasses import dataclass, replace

import numpy as np

from roughline.computing.arrays import InGrid, Mask, Real
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.elasticity.homogeneous import Homogeneous

_SOLVER_RTOL = 1e-8  # a hundred times that of the conductance


@dataclass(frozen=True)
class LayeredConductor(HalfSpace):
    """Layers on a base that conduct, as a half-space: the potential is its displacement.

    Parameters
    ----------
    resistivity : tuple of float
        Of each layer, from the surface on, and of the base. [resistivity]
    thickness : tuple of float
        Of each layer. [length]
    periodic : bool, optional
        Whether currents repeat themselves. Potentials count from their mean then.
    """

    resistivity: tuple[float, ...]
    thickness: tuple[float, ...]
    periodic: bool = False

    @property
    def E_star(self) -> float:  # type: ignore[override]
        """Twice the conductivity of the top layer, in the place of a contact modulus."""
        return 2 / self.resistivity[0]

    def spectrum(self, q: Real) -> Real:
        """Return the potential over the density of currents that go in waves.

        What lies below a layer of resistivity rho makes of it rho (z + t) / (1 + z t) / q, with
        t = tanh(q h), where that below has z rho / q.
        """
        *layers, base = self.resistivity
        found = np.full(np.shape(q), base, dtype=np.result_type(q, np.float64))
        for rho, h in zip(layers[::-1], self.thickness[::-1], strict=True):
            t = np.tanh(q * h)
            found = rho * (found + rho * t) / (rho + found * t)
        return found / q

    def kernel(self, first: int, spacing: tuple[float, float], rows: Real) -> None:
        """Fill rows of the table of potentials under a current of unit density into one cell."""
        # here because compiled loops load slowly
        from roughline.halfspace.elasticity.layered_kernel import layered_kernel

        # how far currents go along good layers beside bad ones
        contrast = max(self.resistivity) / min(self.resistivity)
        longest = sum(self.thickness) * math.sqrt(contrast)
        layered_kernel(self, (self.thickness[0], longest), first, spacing, rows)

    def in_units(self, pressure: float, length: float) -> LayeredConductor:
        """Return the same in other units."""
        return replace(
            self,
            resistivity=tuple(pressure * each for each in self.resistivity),
            thickness=tuple(each / length for each in self.thickness),
        )


Resistances = tuple[tuple[tuple[float, ...], tuple[float, ...]], ...]
"""Of each body: resistivities from the surface on, and the thicknesses of its layers."""


def conductance(
    contact: Mask, sizes: tuple[float, float], bodies: Resistances, periodic: bool
) -> float:
    """Current through the points that touch, over the difference of both bodies' potentials.

    It is zero where none touch, infinite where all of a periodic surface do, and NaN where the
    currents are not found.

    Parameters
    ----------
    contact : ndarray of bool, shape (nx, ny)
        Where the bodies touch.
    sizes : tuple of float
        Sides of the surface. [length]
    bodies : tuple
        What they conduct. [resistivity] and [length]
    periodic : bool
        Whether the surface is repeated.
    """
    # here because compiled loops load slowly
    from roughline.halfspace.inverse.cache import working_memory
    from roughline.halfspace.search.problem import Grid, Method
    from roughline.halfspace.search.tangent import punch_compliance

    nodes = InGrid(np.flatnonzero(contact))
    if not nodes.size:
        return 0.0
    if periodic and contact.all():
        return math.inf
    half_space = functools.reduce(of.add, [_conductor(*body, periodic) for body in bodies])
    dx, dy = (size / n for size, n in zip(sizes, contact.shape, strict=True))
    # in units in which E* is one, and dx
    grid = Grid(half_space.in_units(half_space.E_star, dx), contact.shape, (1.0, dy / dx))
    even = np.full(nodes.size, 1 / (nodes.size * grid.cell_area))
    with working_memory():
        compliance, _ = punch_compliance(grid, nodes, even, Method(_SOLVER_RTOL, max_iterations=0))
    return half_space.E_star * dx / compliance


def _conductor(
    resistivity: tuple[float, ...], thickness: tuple[float, ...], periodic: bool
) -> HalfSpace:
    """Return what a body conducts by, as a half-space."""
    if not thickness:
        return Homogeneous(2 / resistivity[0], periodic)
    return LayeredConductor(resistivity, thickness, periodic)
