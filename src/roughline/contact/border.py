"""What the border of a surface does that was cut out of a larger one: its load, its jump."""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Real
from roughline.halfspace.search.problem import Contact
from roughline.topography.body import Surface
from roughline.topography.repetition import border_jump

# A surface that was cut out of a larger one ends where the larger one continues. Where the outer
# frame of this width carries more than this share of the force, the part beyond it is missed.
_BORDER_WIDTH = 0.05
_BORDER_SHARE = 0.05


def border_share(contact: Contact) -> float:
    """Share of the force that the outer frame carries. [1]"""
    if not contact.nodes.size:
        return 0.0
    nx, ny = contact.separation.shape
    x, y = np.divmod(contact.nodes, ny)
    within = np.minimum(np.minimum(x, nx - 1 - x) / nx, np.minimum(y, ny - 1 - y) / ny)
    borne = np.abs(contact.pressure)
    return float(borne[within < _BORDER_WIDTH].sum() / borne.sum())


def border_warnings(surface: Surface, force: Real, shares: Real) -> tuple[str, ...]:
    """Say under which forces the border of a surface that was cut out carries too large a share.

    Shares are NaN where a load was not solved.
    """
    beyond = np.flatnonzero(shares > _BORDER_SHARE)
    if not surface.is_cut_out or not beyond.size:
        return ()
    ends = [f"{end:.3g}" for end in (force[beyond].min(), force[beyond].max())]
    unit = " N" if surface.unit == "m" else ""
    at = f"a force of {ends[0]}" if beyond.size == 1 else f"forces of {ends[0]} to {ends[1]}"
    return (
        f"at {at}{unit}, up to {shares[beyond].max():.0%} of the force is carried within "
        f"{_BORDER_WIDTH:.0%} of the border, where this surface was cut out of a larger one: the "
        "surface beyond it would carry a part of the load, so depth, stiffness and area are those "
        "of the piece alone, a punch with this outline. Take a larger piece, lower loads, or the "
        "periodic half-space",
    )


def jump_warnings(surface: Surface) -> tuple[str, ...]:
    """Say how far a piece of a larger surface jumps at its borders where it is repeated."""
    if not surface.is_cut_out or surface.rms_height == 0:
        return ()
    return (border_jump(surface).in_words(surface.unit),)
