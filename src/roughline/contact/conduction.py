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
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.halfspace.elasticity.half_space import HalfSpace

if TYPE_CHECKING:  # compiled loops load slowly
    from roughline.halfspace.elasticity.smooth_kernel import SmoothKernel
    from roughline.halfspace.operators.convolution import Convolution
    from roughline.halfspace.operators.grid_nodes import GridNodes

_RTOL = 1e-8  # of potentials; the current, an energy, is known far better
_MOST_STEPS = 1000


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

    @property
    def is_pushed_everywhere(self) -> bool:  # type: ignore[override]
        """Whether the surface is free: no place has the other sign of potential then."""
        return not self.periodic

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
        from roughline.halfspace.elasticity.kernel import love

        x, y = first + np.arange(rows.shape[0]), np.arange(rows.shape[1])
        love(x, y, *spacing, 1 / self.E_star, rows)
        if self.thickness:
            h = self.thickness[0]
            rest = _beside_top_layer(self.in_units(self.E_star, h))
            rest.add(x, y, (spacing[0] / h, spacing[1] / h), h / self.E_star, rows)

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

    It is zero where none touch, and infinite where all of a periodic surface do.

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
    from roughline.halfspace.operators.grid_nodes import GridNodes

    if not contact.any():
        return 0.0
    if periodic and contact.all():
        return math.inf
    nx, ny = contact.shape
    operator = _on_grid(bodies, periodic, (nx, ny), (sizes[0] / nx, sizes[1] / ny))
    found = _current(operator, GridNodes.of(np.flatnonzero(contact), operator.shape))
    operator.workspace.give_up()
    return found


def _current(operator: Convolution, nodes: GridNodes) -> float:
    """Current from points of unit potential, by conjugate gradients; NaN if they do not get there.

    They begin with even currents.
    """
    potential = np.ones(nodes.indices.size)
    current = potential / np.abs(operator.displacement(potential, nodes, nodes)).max()
    residual = potential - operator.displacement(current, nodes, nodes)
    step, squares = residual.copy(), float(residual @ residual)
    for _ in range(_MOST_STEPS):
        if squares <= _RTOL**2 * potential.size:
            return float(current.sum()) * operator.cell_area
        moved = operator.displacement(step, nodes, nodes)
        length = squares / float(step @ moved)
        current += length * step
        residual -= length * moved
        before, squares = squares, float(residual @ residual)
        step = residual + squares / before * step
    return math.nan


@lru_cache(maxsize=2)  # of electricity and heat, by which several loads are conducted through
def _on_grid(
    bodies: Resistances, periodic: bool, shape: tuple[int, int], spacing: tuple[float, float]
) -> Convolution:
    # here because compiled loops load slowly
    from roughline.halfspace.operators.discretisation import on_grid

    each = [LayeredConductor(*body, periodic) for body in bodies]
    return on_grid(functools.reduce(of.add, each), shape, spacing)


@lru_cache
def _beside_top_layer(body: LayeredConductor) -> SmoothKernel:
    """Tabulate the potential beside that of the top layer's material, in units of that."""
    # here because compiled loops load slowly
    from roughline.halfspace.elasticity.smooth_kernel import SmoothKernel

    top = body.resistivity[0]
    contrast = max(body.resistivity) / min(body.resistivity)
    longest = sum(body.thickness) * contrast
    return SmoothKernel.of(lambda q: q * body.spectrum(q) / top - 1, float(longest))
