"""What the border of a piece does to the flow through it, from above and from below.

A map that is cut out of a larger surface is let through as if it repeated. What is beyond its
border is not known. With the pressure held even along a cut across the flow, more flows than
through the cell, whatever the channels are; with the flow through the cut given, less does [1]. It
is given as flat plates as far apart would share it.

References
----------
.. [1] Huet, C. Application of variational concepts to size effects in elastic heterogeneous bodies.
   J. Mech. Phys. Solids 38, 813-841 (1990).
"""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Indices
from roughline.fluid.gap import Along, Gap
from roughline.fluid.network import Network
from roughline.fluid.winding import joined_to_ends, windings


def permeances_of_border(gap: Gap, along: Along) -> tuple[float, float]:
    """Permeance with the flow given along the border across it, and with the pressure. [length³]

    The borders along the flow stay as they are.
    """
    if along == "y":
        return permeances_of_border(gap.turned(), "x")
    across = gap.repeats("y")
    from_inlet, from_outlet = joined_to_ends(gap.distances > 0, across)
    through = from_inlet & from_outlet
    if not through.any():
        return 0.0, 0.0
    cells = gap.conducting(through)
    ended = Network(cells, 1 / gap.ratio, gap.ratio, False, across)
    of_pressure = float((ended.conductances()[0][0] * ended.pressures()[1, 0]).sum())
    closed = np.zeros((1, cells.shape[1]))  # behind the last row, and before the first
    between = Network(np.concatenate([cells, closed]), 1 / gap.ratio, gap.ratio, True, across)
    of_flow = _under_shared_flow(between, windings(through, (False, across)).parts)
    shape = gap.sizes[0] / gap.sizes[1]
    return of_flow * shape, of_pressure * shape


def _under_shared_flow(network: Network, parts: Indices) -> float:
    """Conductance of the parts side by side, where plates would share the flow at either end."""
    cells, rows = network.cells[:-1], (0, -1)
    ends = [np.bincount(parts[row][cells[row] > 0], cells[row][cells[row] > 0]) for row in rows]
    into = np.zeros((1, *network.cells.shape))
    for row, sums, sign in zip(rows, ends, (1, -1), strict=True):
        into[0, row if row == 0 else -2] += sign * cells[row] / sums[parts[row]]
    increase, decrease = network.response(into, *_grounds(network, parts))[:, 0]
    spent = into[0, :-1] * (increase - decrease)[:-1]
    is_open = cells > 0
    resistance = np.bincount(parts[is_open], spent[is_open])
    half_cells = sum(1 / (2 * network.along * sums) for sums in ends)
    return float((1 / (resistance + half_cells)).sum())


def _grounds(network: Network, parts: Indices) -> tuple[tuple[Indices, Indices], Indices]:
    """Numbers of one face in each part, on the border of a rectangle, and their parts."""
    faces = network.conductances()
    is_open = np.stack([faces[0][:-1] > 0, faces[1][:, :-1] > 0])
    candidates = np.flatnonzero(is_open & np.stack(network.borders()))
    of_candidates = parts.ravel()[candidates % network.cells.size]
    known, first = np.unique(of_candidates, return_index=True)
    numbers = np.full(is_open.shape, -1)
    numbers.ravel()[candidates[first]] = np.arange(known.size)
    return (numbers[0], numbers[1]), known
