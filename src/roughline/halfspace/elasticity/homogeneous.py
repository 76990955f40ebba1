"""The elastic half-space: its elasticity and its boundary."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from roughline.errors import InputError
from roughline.halfspace.operators import convolution
from roughline.halfspace.operators.operator import Operator


@dataclass(frozen=True)
class HalfSpace:
    """An elastic half-space, before it is divided into cells.

    Attributes
    ----------
    E_star : float
        Contact modulus E*. [pressure]
    periodic : bool
        Whether pressures repeat periodically beyond the grid. If not, the surface is free there.

    Raises
    ------
    InputError
        If the modulus is not positive and finite.
    """

    E_star: float
    periodic: bool = False

    def __post_init__(self) -> None:
        if not 0 < self.E_star < math.inf:
            raise InputError(
                f"E_star is {self.E_star!r}; a positive, finite contact modulus is needed"
            )

    def scaled(self, pressure: float, length: float) -> HalfSpace:
        """Return the same half-space in other units.

        Parameters
        ----------
        pressure, length : float
            The new units, in the old ones. A homogeneous half-space has no length of its own to
            be scaled. [pressure] and [length]
        """
        return replace(self, E_star=self.E_star / pressure)

    def operator(self, shape: tuple[int, int], spacing: tuple[float, float]) -> Operator:
        """Return the map from pressures to displacements on a grid.

        Parameters
        ----------
        shape : tuple of int
            Points of the grid, (nx, ny).
        spacing : tuple of float
            Sides of a cell, (dx, dy). [length]
        """
        make = convolution.periodic if self.periodic else convolution.free
        return make(shape, spacing, self.E_star)

    def coarser_grid(
        self, shape: tuple[int, int], spacing: tuple[float, float]
    ) -> tuple[tuple[int, int], tuple[float, float]]:
        """Return shape and spacing of a grid with half as many points a side, rounded up.

        A free grid takes cells of double size, of which the last may reach beyond an odd side. A
        periodic grid keeps its sides, which are its periods.

        Parameters
        ----------
        shape, spacing
            Those of the finer grid, as for :meth:`operator`.
        """
        (nx, ny), (dx, dy) = shape, spacing
        mx, my = -(-nx // 2), -(-ny // 2)
        if self.periodic:
            return (mx, my), (dx * nx / mx, dy * ny / my)
        return (mx, my), (dx * min(nx, 2), dy * min(ny, 2))
