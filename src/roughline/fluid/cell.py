"""The flow through a gap that repeats: a mean fall of the pressure, and a periodic part.

Each cell is moved by whole periods so that the pressure falls by one period where the fluid is
throttled most. What such faces would let through under a period alone flows into the cells beside
them; the periodic part of the pressure follows by nested dissection, once for both directions.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Integers, Real
from roughline.fluid.network import Network
from roughline.fluid.winding import Gauge, Windings

_SECTIONS = 1e-10  # within which what flows through all rows of faces agrees
_MOST_TIMES = 3  # that flows are corrected

_Pair = tuple[Real, Real]
"""Of the faces before cells, along x and along y."""


@dataclass(frozen=True, eq=False)
class CellFlow:
    """Flow through a gap that repeats, where the pressure falls by one each period.

    Attributes
    ----------
    rates : tuple of ndarray, shapes (2, nx + 1, ny) and (2, nx, ny + 1)
        Flow through the faces along x and along y, for a fall along either side.
    conductances : tuple of ndarray, shapes (nx + 1, ny) and (nx, ny + 1)
        Of the same faces.
    pressures : ndarray, shape (2, nx, ny)
        Pressure of the cells, in each part 1 before the map and 0 behind it in the mean; NaN where
        nothing flows.
    crossing : ndarray, shape (2, 2)
        Flow along a side, the rows, under a fall along a side, the columns, through the faces where
        it is throttled most.
    """

    rates: _Pair
    conductances: _Pair
    pressures: Real
    crossing: Real

    def turned(self) -> CellFlow:
        """The same with x and y exchanged."""
        of_x, of_y = (each[::-1].swapaxes(1, 2) for each in self.rates)
        faces_x, faces_y = (each.T for each in self.conductances)
        pressures = self.pressures[::-1].swapaxes(1, 2)
        return CellFlow((of_y, of_x), (faces_y, faces_x), pressures, self.crossing[::-1, ::-1])


def cell_flow(network: Network, found: Windings) -> CellFlow:
    """Let a fluid through a network whose open cells all wind."""
    conductances = network.conductances()
    faces = conductances[0][:-1], conductances[1][:, :-1]
    if not found.through.any():
        nothing = np.zeros((2, *conductances[0].shape)), np.zeros((2, *conductances[1].shape))
        unknown = np.full((2, *network.cells.shape), np.nan)
        return CellFlow(nothing, conductances, unknown, np.zeros((2, 2)))
    gauge = Gauge.of(*faces)
    periods = gauge.periods(*faces)
    grounds, parts = _grounds(network, faces, periods, gauge, found)
    rates = [face * period for face, period in zip(faces, periods, strict=True)]
    pressures = np.zeros((2, *network.cells.shape))
    for _ in range(_MOST_TIMES):
        into = sum(rate - np.roll(rate, -1, axis) for axis, rate in enumerate(rates, 1))
        change = network.response(into, grounds, parts)
        pressures += change
        for axis, (rate, face) in enumerate(zip(rates, faces, strict=True), 1):
            rate += face * (np.roll(change, 1, axis) - change)
        crossing = sum(
            np.einsum("kij,lij->kl", period, rate)
            for period, rate in zip(periods, rates, strict=True)
        )
        if _unequal(rates, crossing) <= _SECTIONS:
            break
    of_x, of_y = (
        np.concatenate([rate, np.take(rate, [0], axis)], axis) for axis, rate in enumerate(rates, 1)
    )
    of_map = _of_map(pressures + np.moveaxis(gauge.shift, 2, 0), found)
    return CellFlow((of_x, of_y), conductances, of_map, crossing)


def _unequal(rates: list[Real], crossing: Real) -> float:
    """How far what flows through a row of faces is from what flows in all, over that."""
    return max(
        float(np.abs(rate[k].sum(axis=1 - k) - crossing[k, k]).max() / (crossing[k, k] or 1.0))
        for k, rate in enumerate(rates)
    )


def _of_map(pressures: Real, found: Windings) -> Real:
    """Pressures with 1 before the map and 0 behind it, in the mean of each part."""
    parts, falls = found.parts, np.empty_like(pressures)
    for k, n in enumerate(parts.shape):
        even = 1 - (np.arange(n) + 0.5) / n
        falls[k] = even[:, None] if k == 0 else even
    where = found.through
    number, cells = parts[where], np.bincount(parts[where])
    of_map = np.full_like(pressures, np.nan)
    for k in (0, 1):
        off = np.bincount(number, (pressures[k] - falls[k])[where]) / np.maximum(cells, 1)
        of_map[k, where] = pressures[k, where] - off[number]
    return of_map


def _grounds(
    network: Network,
    faces: _Pair,
    periods: tuple[Integers, Integers],
    gauge: Gauge,
    found: Windings,
) -> tuple[tuple[Integers, Integers], Integers]:
    """Numbers of one face in each place that winds, on the border of a rectangle, and their parts."""
    fits = np.stack(
        [
            border
            & (face > 0)
            & ~period.any(axis=0)
            & (np.roll(gauge.places, 1, axis) == gauge.places)
            for axis, (border, face, period) in enumerate(
                zip(network.borders(), faces, periods, strict=True)
            )
        ]
    )
    candidates = np.flatnonzero(fits)
    places = np.broadcast_to(gauge.places, fits.shape).ravel()[candidates]
    chosen = candidates[np.unique(places, return_index=True)[1]]
    numbers = np.full(fits.shape, -1)
    numbers.ravel()[chosen] = np.arange(chosen.size)
    parts = np.broadcast_to(found.parts, fits.shape).ravel()[chosen]
    return (numbers[0], numbers[1]), parts
