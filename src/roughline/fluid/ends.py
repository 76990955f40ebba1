"""The flow through a gap that ends at an inlet and an outlet, where the pressure is 1 and 0."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.fluid.gap import Gap
from roughline.fluid.network import Network
from roughline.fluid.winding import joined_to_ends


@dataclass(frozen=True, eq=False)
class EndedFlow:
    """Flow along x between two ends.

    Attributes
    ----------
    rates, conductances : tuple of ndarray, shapes (nx + 1, ny) and (nx, ny + 1)
        Flow through the faces along x and along y, and their conductances.
    pressure : ndarray, shape (nx, ny)
        Of the cells; NaN where they are joined to no end.
    """

    rates: tuple[Real, Real]
    conductances: tuple[Real, Real]
    pressure: Real

    def turned(self) -> EndedFlow:
        """Return the flow with x and y exchanged."""
        (of_x, of_y), (faces_x, faces_y) = self.rates, self.conductances
        return EndedFlow((of_y.T, of_x.T), (faces_y.T, faces_x.T), self.pressure.T)


def ended_flow(gap: Gap) -> EndedFlow:
    """Let a fluid through a gap along x, along which it does not repeat."""
    from_inlet, from_outlet = joined_to_ends(gap.distances > 0, gap.repeats("y"))
    through = from_inlet & from_outlet
    network = Network(gap.conducting(through), 1 / gap.ratio, gap.ratio, False, gap.repeats("y"))
    pressures = network.pressures() if through.any() else np.zeros((2, *through.shape))
    conductances = network.conductances()
    pressure = np.where(through, pressures[0], np.where(from_inlet, 1.0, np.nan))
    pressure[from_outlet & ~through] = 0.0
    return EndedFlow(_rates(conductances, pressures), conductances, pressure)


def _rates(conductances: tuple[Real, Real], pressures: Real) -> tuple[Real, Real]:
    """Flow through the faces along and across, from pressures that are 1 at either end.

    Where one of them is small, its differences are accurate, and it is used.
    """
    down, up = pressures
    nx, ny = down.shape
    along = np.empty((nx + 1, ny))
    along[0], along[-1] = up[0], down[-1]
    along[1:-1] = _falls(down[:-1], down[1:], up[:-1], up[1:])
    across = np.empty((nx, ny + 1))
    across[:, 1:] = _falls(down, np.roll(down, -1, axis=1), up, np.roll(up, -1, axis=1))
    across[:, 0] = across[:, -1]
    return along * conductances[0], across * conductances[1]


def _falls(down: Real, down_next: Real, up: Real, up_next: Real) -> Real:
    """Fall of the pressure from cells to their neighbours."""
    return np.where(down + down_next < up + up_next, down - down_next, up_next - up)
