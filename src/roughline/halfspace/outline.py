"""How far whole cells overstate a contact area along its outline."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from roughline.halfspace.state import Contact

Field = NDArray[np.float64]
Nodes = NDArray[np.intp]

_A_PAIR = (math.pi - 1 + math.log(2)) / 24  # cells for a pair of neighbours, one of them in contact

# Gap beyond the outline over (pressure within it times spacing over E*). On a summit it is of order
# one, 4/3 s^(3/2) / (1 - s)^(1/2) for an edge at the share s of the way. On a plateau, where the
# body falls away and not the contact, it has no bound.
_STEEP = 2.0
_STEEP_ALONE = 20.0  # where the contact is one cell wide and no inner pressure tells


def overstated_cells(
    contact: Contact, spacing: tuple[float, float], periodic: bool
) -> tuple[float, float]:
    """Cells by which the count of cells in contact exceeds the area, at most and as estimated.

    Under a summit a cell on the outline counts as a whole where it touches in part, which
    overstates the area by (pi - 1 + ln 2) / 24 cells for each pair of neighbours of which one
    touches [1]_. On a plateau the outline is that of the body: points hit as much of it as they
    miss, and the count is right. There the pressure rises towards the outline, and the gap beyond
    is steep. A pair of which both hold counts with 2 p spacing / (E* gap) of the correction.

    Parameters
    ----------
    contact : Contact
        In units in which E* is 1.
    spacing : tuple of float
        Cell sizes. [length]
    periodic : bool
        Whether opposite sides are neighbours.

    Returns
    -------
    most, estimate : float
        With all of the outline under summits, and with plateaus told apart. [1]

    References
    ----------
    .. [1] V. A. Yastrebov, G. Anciaux and J.-F. Molinari, "On the accurate computation of the true
       contact-area in mechanical contact of random rough surfaces", Tribol. Int. 114, 161-171
       (2017).
    """
    pressing = contact.pressure > 0
    nodes, pressure = contact.nodes[pressing], contact.pressure[pressing]
    touching = np.zeros(contact.gap.size, dtype=bool)
    touching[nodes] = True
    pairs, summits = 0, 0.0
    for axis in (0, 1):
        for step in (1, -1):
            beyond, there = _neighbours(nodes, contact.gap.shape, axis, step, periodic)
            outer = there & ~touching[beyond]
            edge, gap = pressure[outer], contact.gap.flat[beyond[outer]]
            within, there = _neighbours(nodes[outer], contact.gap.shape, axis, -step, periodic)
            there &= touching[within]
            rising = np.zeros(edge.size, dtype=bool)
            inner = np.searchsorted(nodes, within[there])
            rising[there] = edge[there] > pressure[inner]
            smooth = edge * spacing[axis] * np.where(there, _STEEP, _STEEP_ALONE)
            steep = (rising | ~there) & (gap > smooth)
            pairs += edge.size
            summits += edge.size - float((1 - smooth[steep] / gap[steep]).sum())
    return _A_PAIR * pairs, _A_PAIR * summits


def _neighbours(
    nodes: Nodes, shape: tuple[int, ...], axis: int, step: int, periodic: bool
) -> tuple[Nodes, NDArray[np.bool_]]:
    """Flat indices of the neighbours along an axis, and whether there are any."""
    at = list(np.divmod(nodes, shape[1]))
    at[axis] = at[axis] + step
    there = np.ones(nodes.size, dtype=bool)
    if not periodic:
        there = (at[axis] >= 0) & (at[axis] < shape[axis])
    at[axis] %= shape[axis]
    return at[0] * shape[1] + at[1], there
