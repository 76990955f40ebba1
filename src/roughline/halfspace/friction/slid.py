"""The state of a contact with friction under one load."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.halfspace.friction.rates import Going
from roughline.halfspace.friction.unit_ways import ShearTangents
from roughline.halfspace.search.problem import Contact, Outcome

_SAME_HEIGHT = 1e-9  # of the approach, up to which nodes are as high as the highest


@dataclass(frozen=True)
class ShearLoad:
    """One load along the surface, by its force or by the slide; the other is None."""

    force: tuple[float, float] | None = None  # total shear force [force]
    slide: tuple[float, float] | None = None  # of the indenter [length]


@dataclass(frozen=True, eq=False)
class Slid:
    """State of a contact with friction under one load."""

    contact: Contact
    outcome: Outcome
    shear: Real  # on the contact nodes, shape (nodes, 2), on the half-space [pressure]
    displacement: Real  # there, along the surface [length]
    slide: Real  # of the indenter, shape (2,) [length]
    force: Real  # shape (2,)
    slip: Real  # since the last load, shape (nodes, 2) [length]
    sticks: Mask  # where nodes do not slip on
    limit: float  # largest shear force that friction bears [force]
    residual: float  # over its scale [1]
    convolutions: int
    load: ShearLoad | None = None
    went: Going | None = None  # how loads went to it
    tangents: ShearTangents | None = None

    @property
    def contact_as_solved(self) -> Contact:
        """The contact, with how far friction is from its conditions, and without what is lost."""
        contact, solved = self.contact, self.outcome is Outcome.CONVERGED
        residuals = replace(contact.residuals, slip=self.residual if self.shear.size else 0.0)
        return replace(
            contact,
            outcome=self.outcome,
            residuals=residuals,
            convolutions=self.convolutions,
            response=contact.response if solved else None,
        )

    @property
    def again(self) -> Slid:
        """The same under the same loads, after which nothing has slipped further."""
        contact, nothing = replace(self.contact, convolutions=0), np.zeros_like(self.slip)
        return replace(self, contact=contact, slip=nothing, convolutions=0)

    @property
    def dissipated(self) -> float:
        """Energy that the slip since the last load has dissipated. [force length]"""
        area = self.contact.problem.grid.cell_area
        return area * float(np.vdot(self.shear, self.slip))


def unknown(contact: Contact, outcome: Outcome) -> Slid:
    """Return a load that was not solved."""
    nothing = np.full((contact.nodes.size, 2), math.nan)
    nowhere = np.full(2, math.nan)
    sticks = np.zeros(contact.nodes.size, dtype=bool)
    parts = contact, outcome, nothing, nothing, nowhere, nowhere, nothing, sticks
    return Slid(*parts, math.nan, math.nan, contact.convolutions)


def apart(contact: Contact, shear: ShearLoad, last: Slid | None) -> Slid:
    """Return bodies that are apart: nothing is sheared.

    With no shear force they come off where the highest nodes, which are the last in contact and
    stick till then, bear no shear any more.
    """
    slide = np.zeros(2) if last is None else last.slide
    if last is not None and last.contact.nodes.size:
        separation = last.contact.separation.ravel()[last.contact.nodes]
        above = separation - separation.min()
        highest = above <= _SAME_HEIGHT * (last.contact.depth - separation.min())
        slide = slide - last.displacement[highest].mean(axis=0)
    if shear.slide is not None:
        slide = np.array(shear.slide)
    nothing = np.zeros((contact.nodes.size, 2))
    sticks = np.zeros(contact.nodes.size, dtype=bool)
    parts = contact, Outcome.CONVERGED, nothing, nothing, slide, np.zeros(2), nothing, sticks
    return Slid(*parts, 0.0, 0.0, contact.convolutions)
