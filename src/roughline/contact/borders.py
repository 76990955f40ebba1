"""The border of a surface that was cut out of a larger one: what it carries of the force.

Such a surface ends where the larger one continues. Where its outer frame carries much of the force,
the part beyond it is missed.
"""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Real
from roughline.facts.fact import Fact
from roughline.halfspace.search.problem import Contact
from roughline.topography.body import Surface

_FRAME = 0.05  # width along the border, over the sides
_LARGEST_SHARE = 0.05  # of the force that is too much on it
_DECISIVE_SHARE = 0.5  # share from which on answers are those of the frame


def share_at_border(contact: Contact) -> float:
    """Share of the force that is carried near the borders at which the surface ends. [1]"""
    shape, repeats = contact.separation.shape, contact.problem.grid.half_space.repeats
    if not contact.nodes.size:
        return 0.0
    in_frame = np.zeros(shape, dtype=bool)
    for axis, (n, repeated) in enumerate(zip(shape, repeats, strict=True)):
        if not repeated:
            place = np.arange(n)
            at_border = np.minimum(place, n - 1 - place) < _FRAME * n
            in_frame |= np.expand_dims(at_border, 1 - axis)
    pressure = np.abs(contact.pressure)
    return float(pressure[in_frame.reshape(-1)[contact.nodes]].sum() / pressure.sum())


def border_warnings(surface: Surface, force: Real, shares: Real) -> tuple[Fact, ...]:
    """Say under which forces the border of a surface that was cut out carries too large a share.

    Shares are NaN where a load was not solved.
    """
    heavy = np.flatnonzero(shares > _LARGEST_SHARE)
    if not surface.is_cut_out or not heavy.size:
        return ()
    least, most = float(force[heavy].min()), float(force[heavy].max())
    share, unit = float(shares[heavy].max()), "N" if surface.unit == "m" else None
    ends = {"least": least if least < most else None, "most": most}
    fact = Fact("border_carries", **ends, share=share, unit=unit, frame=_FRAME)
    return (fact.grave(share > _DECISIVE_SHARE),)
