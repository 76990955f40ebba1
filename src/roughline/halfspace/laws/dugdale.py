"""Elastic bodies that pull each other evenly across small gaps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors.public import public_making
from roughline.halfspace.laws.adhesive import Adhesive
from roughline.halfspace.laws.pulling_zone import refuse_end_within_a_cell


@public_making
@dataclass(frozen=True)
class Dugdale(Adhesive):
    """Elastic bodies that pull each other with a pressure w / h_0 up to a range h_0 [1]_ [2]_.

    Where the bodies touch, the pressure is above -w / h_0; where the gap is between zero and h_0,
    it is -w / h_0; beyond, it is zero. The order of loads matters: bodies that come nearer jump
    together, and bodies that go apart hold each other where they did not pull before.

    On a grid the pull ends over a ramp about h_0, across which the share of a cell within reach
    falls from one to zero. Half of it is what the gap changes across half a cell, or, where that is
    more, what the pull on a cell displaces it. So the edge of the reach moves through cells, and
    does not jump from one to the next. The work of adhesion is that of the law.

    Attributes
    ----------
    work_of_adhesion : float
        Work to separate a unit of area, w. [pressure * length]
    range : float
        Largest gap across which bodies pull, h_0. [length]

    Raises
    ------
    InputError
        If work or range are not positive and finite, or where the grid does not resolve the range.

    References
    ----------
    .. [1] D. S. Dugdale, "Yielding of steel sheets containing slits", J. Mech. Phys. Solids 8,
       100-104 (1960).
    .. [2] D. Maugis, "Adhesion of spheres: the JKR-DMT transition using a Dugdale model", J.
       Colloid Interface Sci. 150, 243-269 (1992).

    Examples
    --------
    >>> import numpy as np
    >>> import roughline as rl
    >>> x = np.linspace(-1.7, 1.7, 64)
    >>> sphere = rl.Surface(-(x[:, None] ** 2 + x**2) / 2, sizes=(3.4, 3.4))
    >>> law = rl.Dugdale(work_of_adhesion=1 / np.pi, range=2 / np.pi)
    >>> curve = rl.press(sphere, E_star=0.75, law=law, depths=[0.5, 0.0, -0.5, -0.7])
    >>> print(curve.force.round(2))
    [-0.84 -1.36 -1.55 -1.5 ]
    """

    assumption: ClassVar[str] = (
        "linear elastic, and pull each other evenly across gaps up to the range"
    )

    @property
    def cutoff(self) -> float:  # type: ignore[override]
        """The range. [length]"""
        return self.range

    def share_at(self, gap: Real) -> Real:
        """Return one."""
        return np.ones_like(gap)

    def gap_at(self, share: Real) -> Real:
        """Return the range, up to which all of the pull is borne."""
        return np.full_like(share, self.range)

    def work_beyond(self, gap: Real) -> Real:
        """Return the part of the range that is left to open."""
        return self.range - gap

    def refuse_grid(self, compliance: float) -> None:
        """Refuse cells that the pull displaces so far that it would end within one of them."""
        refuse_end_within_a_cell(self, compliance)
