"""How far whole cells overstate a contact area along its outline."""

from __future__ import annotations

import math

import numpy as np

from roughline.computing.arrays import InGrid, InPatch, Mask
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
    shape = contact.separation.shape
    touching = np.zeros(shape, dtype=bool)
    touching.flat[contact.nodes[~contact.pulling]] = True
    above = contact.pressure - contact.problem.bounds_at(contact.nodes).low
    pairs, summits = 0, 0.0
    for axis in (0, 1):
        for step in (1, -1):
            outer = touching & ~np.roll(touching, -step, axis)
            if not repeats[axis]:
                np.moveaxis(outer, axis, 0)[-1 if step > 0 else 0] = False
            outline = InGrid(np.flatnonzero(outer))
            outside, _ = _neighbours(outline, shape, axis, step, repeats[axis])
            within, loaded_too = _neighbours(outline, shape, axis, -step, repeats[axis])
            at = InPatch(np.searchsorted(contact.nodes, outline))
            gap = contact.gap_at(outside)
            edge = above[at]
            loaded_too &= touching.flat[within]
            rising = np.zeros(edge.size, dtype=bool)
            inner = InPatch(np.searchsorted(contact.nodes, within[loaded_too]))
            rising[loaded_too] = edge[loaded_too] > above[inner] * (1 + 1e-6)
            rising |= contact.plastic[at]  # the body is cut off there, as at the edge of a plateau
            smooth = edge * spacing[axis] * np.where(loaded_too, _STEEP_GAP, _STEEP_GAP_ALONE)
            steep = (rising | ~loaded_too) & (gap > smooth)
            pairs += edge.size
            summits += edge.size - float((1 - smooth[steep] / gap[steep]).sum())
    of_pair = (math.pi - 1 + math.log(2)) / 24
    return of_pair * pairs, of_pair * summits


def _neighbours(
    nodes: InGrid, shape: tuple[int, ...], axis: int, step: int, repeated: bool
) -> tuple[InGrid, Mask]:
    """Flat indices of the neighbours along an axis, and whether there are any."""
    position = list(np.divmod(nodes, shape[1]))
    position[axis] = position[axis] + step
    exist = np.ones(nodes.size, dtype=bool)
    if not repeated:
        exist = (position[axis] >= 0) & (position[axis] < shape[axis])
    position[axis] %= shape[axis]
    return InGrid(position[0] * shape[1] + position[1]), exist
