"""The flow through a gap that repeats: a mean fall of the pressure, and a periodic part.

Each cell is moved by whole periods so that the pressure falls by one period where the fluid is
throttled most. What such faces would let through under a period alone flows into the cells beside
them; the periodic part of the pressure follows by nested dissection, once for both directions.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.fluid.network import Network
from roughline.fluid.winding import Gauge, Windings

_PRESSURE_ROUNDING = 64 * np.finfo(float).eps  # of pressures
_FLOW_AGREEMENT = 1e-10  # within which what flows through all rows of faces agrees
_MOST_CORRECTIONS = 4  # that flows are corrected

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
    sections : ndarray, shape (2,)
        Flow along either side under a fall along it, as far from that as through any row of faces.
    """

    rates: _Pair
    conductances: _Pair
    pressures: Real
    crossing: Real
    sections: Real

    def turned(self) -> CellFlow:
        """Return the flow with x and y exchanged."""
        of_x, of_y = (each[::-1].swapaxes(1, 2) for each in self.rates)
        faces_x, faces_y = (each.T for each in self.conductances)
        return CellFlow(
            (of_y, of_x),
            (faces_y, faces_x),
            self.pressures[::-1].swapaxes(1, 2),
            self.crossing[::-1, ::-1],
            self.sections[::-1],
        )


def cell_flow(network: Network, found: Windings) -> CellFlow:
    """Let a fluid through a network whose open cells all wind."""
    conductances = network.conductances()
    faces = conductances[0][:-1], conductances[1][:, :-1]
    if not found.through.any():
        nothing = np.zeros((2, *conductances[0].shape)), np.zeros((2, *conductances[1].shape))
        unknown = np.full((2, *network.cells.shape), np.nan)
        return CellFlow(nothing, conductances, unknown, np.zeros((2, 2)), np.zeros(2))
    gauge = Gauge.of(*faces)
    periods = gauge.periods(*faces)
    grounds, parts = _grounds(network, faces, periods, gauge, found)
    rates = [face * period for face, period in zip(faces, periods, strict=True)]
    pressures, summed = np.zeros((2, 2, *network.cells.shape))
    for _ in range(_MOST_CORRECTIONS):
        x, y = (rate - np.roll(rate, -1, axis) for axis, rate in enumerate(rates, 1))
        increase, decrease = network.response(x + y, grounds, parts)
        change = increase - decrease
        pressures += change
        summed += np.abs(increase) + decrease
        for axis, (rate, face) in enumerate(zip(rates, faces, strict=True), 1):
            rate += face * (np.roll(change, 1, axis) - change)
        crossing = sum(
            np.einsum("kij,lij->kl", period, rate)
            for period, rate in zip(periods, rates, strict=True)
        )
        sections = _sections(rates, faces, summed, crossing)
        if (sections - crossing.diagonal() <= _FLOW_AGREEMENT * crossing.diagonal()).all():
            break
    of_x, of_y = (
        np.concatenate([rate, np.take(rate, [0], axis)], axis) for axis, rate in enumerate(rates, 1)
    )
    of_map = _map_pressures(pressures + np.moveaxis(gauge.shift, 2, 0), found)
    return CellFlow((of_x, of_y), conductances, of_map, crossing, sections)


def _sections(rates: list[Real], faces: _Pair, summed: Real, crossing: Real) -> Real:
    """Flow along either side through that row of faces where it differs most from all that flows.

    Within a wide place between narrow ones, pressures differ by less than they are rounded by; what
    that may do to a sum is no difference.
    """
    found = np.zeros(2)
    for k, (rate, face) in enumerate(zip(rates, faces, strict=True)):
        sums = rate[k].sum(axis=1 - k)
        beside = summed[k] + np.roll(summed[k], 1, k)
        rounding = _PRESSURE_ROUNDING * (face * beside).sum(axis=1 - k)
        excess = np.maximum(np.abs(sums - crossing[k, k]) - rounding, 0.0)
        found[k] = crossing[k, k] + excess.max()
    return found


def _map_pressures(pressures: Real, found: Windings) -> Real:
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
    periods: tuple[Indices, Indices],
    gauge: Gauge,
    found: Windings,
) -> tuple[tuple[Indices, Indices], Indices]:
    """Numbers of one face in each core, on the border of a rectangle, and their parts."""
    cores = gauge.cores
    fits = np.stack(
        [
            border & (face > 0) & ~period.any(axis=0) & (np.roll(cores, 1, axis) == cores)
            for axis, (border, face, period) in enumerate(
                zip(network.borders(), faces, periods, strict=True)
            )
        ]
    )
    candidates = np.flatnonzero(fits & (cores >= 0))
    chosen = candidates[np.unique(cores.ravel()[candidates % cores.size], return_index=True)[1]]
    numbers = np.full(fits.shape, -1)
    numbers.ravel()[chosen] = np.arange(chosen.size)
    return (numbers[0], numbers[1]), found.parts.ravel()[chosen % cores.size]
