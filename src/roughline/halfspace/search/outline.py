"""How far whole cells overstate a contact area along its outline."""

from __future__ import annotations

import math

import numpy as np

from roughline.computing.arrays import Indices, InGrid, Mask
from roughline.computing.compiled import compiled
from roughline.halfspace.search.problem import Contact

# Gap beyond the outline over (pressure within it times spacing over E*). On a summit it is of order
# one: 4/3 s^(3/2) / (1 - s)^(1/2) if the edge of the contact is at the share s of the way between
# the two nodes. At the edge of a plateau, where the body itself falls away, it has no bound.
_STEEP_GAP = 2.0
_STEEP_GAP_ALONE = 20.0  # where the contact is one cell wide, so that there is no inner pressure


def overstated_cells(
    contact: Contact, spacing: tuple[float, float], repeats: tuple[bool, bool]
) -> tuple[float, float]:
    """Cells by which the count of cells in contact exceeds the area, at most and as estimated.

    Under a summit a cell on the outline counts as a whole where it touches in part, which
    overstates the area by (pi - 1 + ln 2) / 24 cells for each pair of neighbours of which one
    touches [1]_. On a plateau the outline is that of the body. Cells overstate it as often as they
    understate it, and the count is right. There the pressure rises towards the outline, and the gap
    beyond it is steep. Where both are so, a pair has 2 p spacing / (E* gap) of the correction.

    The contact is in units in which E* is 1, and opposite sides are neighbours where it repeats.
    The first of the two counts is as if all of the outline were under summits.

    References
    ----------
    .. [1] V. A. Yastrebov, G. Anciaux and J.-F. Molinari, "On the accurate computation of the true
       contact-area in mechanical contact of random rough surfaces", Tribol. Int. 114, 161-171
       (2017).
    """
    above = contact.pressure - contact.problem.bounds_at(contact.nodes).low
    pairs, along_x = _pairs(contact.nodes, ~contact.pulling, contact.separation.shape, repeats)
    at, outside, within = pairs
    gap, edge = contact.gap_at(InGrid(outside)), above[at]
    loaded_too = within >= 0
    rising = contact.plastic[at]  # the body is cut off there, as at the edge of a plateau
    rising |= loaded_too & (edge > above[within] * (1 + 1e-6))
    smooth = edge * np.where(loaded_too, _STEEP_GAP, _STEEP_GAP_ALONE)
    smooth[:along_x] *= spacing[0]
    smooth[along_x:] *= spacing[1]
    steep = (rising | ~loaded_too) & (gap > smooth)
    summits = edge.size - float((1 - smooth[steep] / gap[steep]).sum())
    of_pair = (math.pi - 1 + math.log(2)) / 24
    return of_pair * edge.size, of_pair * summits


@compiled
def _pairs(
    nodes: Indices, touching: Mask, shape: tuple[int, int], repeats: tuple[bool, bool]
) -> tuple[Indices, int]:
    """List the pairs of neighbours of which one touches: those along x, then those along y.

    Ascending nodes are given, and which of them touch. For each pair: the place of the node that
    touches among the nodes, the other one as a flat index, and the place of the one beyond the
    first if that touches, too, or -1, shape (3, pairs). Return with them how many are along x.
    """
    nx, ny = shape
    place = np.full((nx, ny), -1, dtype=np.int32)
    flat = place.reshape(-1)
    for i in range(nodes.size):
        if touching[i]:
            flat[nodes[i]] = i
    inside = touching.sum()  # each node has four neighbours
    pairs = np.empty((3, 4 * min(inside, nx * ny - inside)), dtype=np.intp)
    found = along_x = 0
    for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        x = out_x = in_x = -1
        for i in range(nodes.size):
            if not touching[i]:
                continue
            if nodes[i] >= (x + 1) * ny:
                x = nodes[i] // ny
                out_x, in_x = _beside(x + dx, nx, repeats[0]), _beside(x - dx, nx, repeats[0])
            y = nodes[i] - x * ny
            out_y, in_y = _beside(y + dy, ny, repeats[1]), _beside(y - dy, ny, repeats[1])
            if out_x < 0 or out_y < 0 or place[out_x, out_y] >= 0:
                continue
            pairs[0, found] = i
            pairs[1, found] = out_x * ny + out_y
            pairs[2, found] = place[in_x, in_y] if in_x >= 0 and in_y >= 0 else -1
            found += 1
        if dx == -1:
            along_x = found
    return pairs[:, :found], along_x


@compiled
def _beside(place: int, n: int, repeated: bool) -> int:
    """Return a place along a side, on the other end where it repeats; -1 where it is outside."""
    if 0 <= place < n:
        return place
    return place % n if repeated else -1
