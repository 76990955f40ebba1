"""How far whole cells overstate a contact area along its outline."""

from __future__ import annotations

import math

import numpy as np

from roughline.computing.arrays import Indices, InGrid, Mask, among
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
    on, touching = np.zeros(contact.separation.shape, dtype=np.bool_), ~contact.pulling
    on.flat[contact.nodes[touching]] = True
    above = contact.pressure - contact.problem.bounds_at(contact.nodes).low
    pairs, along_x = _pairs(among(contact.nodes, touching), on, repeats)
    outline, outside, within = pairs
    at = np.searchsorted(contact.nodes, outline)
    gap, edge = contact.gap_at(InGrid(outside)), above[at]
    loaded_too = within >= 0
    rising = contact.plastic[at]  # the body is cut off there, as at the edge of a plateau
    inner = np.searchsorted(contact.nodes, within[loaded_too])
    rising[loaded_too] |= edge[loaded_too] > above[inner] * (1 + 1e-6)
    smooth = edge * np.where(loaded_too, _STEEP_GAP, _STEEP_GAP_ALONE)
    smooth[:along_x] *= spacing[0]
    smooth[along_x:] *= spacing[1]
    steep = (rising | ~loaded_too) & (gap > smooth)
    summits = edge.size - float((1 - smooth[steep] / gap[steep]).sum())
    of_pair = (math.pi - 1 + math.log(2)) / 24
    return of_pair * edge.size, of_pair * summits


@compiled
def _pairs(nodes: Indices, on: Mask, repeats: tuple[bool, bool]) -> tuple[Indices, int]:
    """List the pairs of neighbours of which one touches: those along x, then those along y.

    The nodes that touch are given, and marked in a field.

    For each: the node that touches, the other one, and the one beyond the first if that touches,
    too, or -1, shape (3, pairs); all as flat indices. Return with them how many are along x.
    """
    ny = on.shape[1]
    pairs = np.empty((3, 4 * nodes.size), dtype=np.intp)
    found = along_x = 0
    for axis in range(2):
        n = on.shape[axis]
        for step in (1, -1):
            for node in nodes:
                x, y = node // ny, node % ny
                place = y if axis else x
                out, inner = place + step, place - step
                if not repeats[axis] and (out < 0 or out >= n):
                    continue
                out %= n
                if on[x, out] if axis else on[out, y]:
                    continue
                exists = repeats[axis] or 0 <= inner < n
                inner %= n
                loaded = exists and (on[x, inner] if axis else on[inner, y])
                pairs[0, found] = node
                pairs[1, found] = x * ny + out if axis else out * ny + y
                pairs[2, found] = -1
                if loaded:
                    pairs[2, found] = x * ny + inner if axis else inner * ny + y
                found += 1
        if axis == 0:
            along_x = found
    return pairs[:, :found], along_x
