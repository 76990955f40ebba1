"""Elastic bodies that pull each other evenly across small gaps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.errors.public import public_making
from roughline.halfspace.laws.adhesive import Adhesive
from roughline.halfspace.laws.law import ContactLaw

# Half of the ramp over what the pull on a cell displaces it: so a cell at the edge of the reach has
# one place, and a circle on cells pulls as a circle does (benchmarks/pull_off.py).
_WIDTH = 4.0


@public_making
@dataclass(frozen=True, eq=False)
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
    ramp : ndarray, shape (nx, ny), or float
        Half of the width over which the pull ends at each node. [length]
    share : ndarray, shape (nx, ny), or float
        Share of the pull that each node bears at least.

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

    ramp: Real | float = 0.0
    assumption: ClassVar[str] = (
        "linear elastic, and pull each other evenly across gaps up to the range"
    )

    def scaled(self, pressure: float, length: float) -> Dugdale:
        """Return the law in other units."""
        scaled = super().scaled(pressure, length)
        assert isinstance(scaled, Dugdale)
        return replace(scaled, ramp=self.ramp / length)

    def on(self, take: Callable[[Real], Real]) -> Dugdale:
        """Return the law on another grid."""
        taken = super().on(take)
        assert isinstance(taken, Dugdale)
        return replace(taken, ramp=take(self.ramp) if isinstance(self.ramp, np.ndarray) else 0.0)

    def between(
        self, separation: Real, compliance: float, repeats: tuple[bool, bool]
    ) -> ContactLaw:
        """Return the law for bodies: their ramps are those of the slopes and of the grid."""
        law = super().between(separation, compliance, repeats)
        if not isinstance(law, Dugdale):
            return law
        least = _WIDTH * self.largest_pull * compliance
        if least > self.range:
            enough = 1.01 * np.sqrt(least / self.range)  # rounded to three digits, too
            raise InputError(
                "is too short for the grid: the pull w / h_0 would end within a cell. Give at "
                f"least {enough:.3g} times as much, with the same work, or a finer grid",
                "range",
            )
        steps = (_step(separation, axis, repeats[axis]) for axis in (0, 1))
        return replace(self, ramp=np.clip(sum(steps) / 2, least, self.range))

    @property
    def reach(self) -> float:
        """Twice the range, which no ramp goes beyond. [length]"""
        return 2 * self.range

    def share_at(self, gap: Real) -> Real:
        """Return one up to the ramp, and zero beyond it."""
        return np.clip((self.range + self.ramp - gap) / (2 * self.ramp), 0.0, 1.0)

    def gap_between(self, share: Real, other: Real | float) -> Real:
        """Return the part of the ramp between them."""
        return 2 * self.ramp * np.abs(share - other)

    def work_beyond(self, gap: Real) -> Real:
        """Return the part of the range that is left to open, over the range."""
        gap = np.maximum(gap, 0.0)
        open_ = np.minimum(gap, self.range - self.ramp) / self.range
        return 1 - open_ - (1 - self.share_at(gap) ** 2) * self.ramp / self.range


def _step(separation: Real, axis: int, repeats: bool) -> Real:
    """Return what the separation changes by from cell to cell along an axis. [length]"""
    if separation.shape[axis] == 1:
        return np.zeros_like(separation)
    if repeats:
        around = np.roll(separation, -1, axis) - np.roll(separation, 1, axis)
        return np.abs(around) / 2
    return np.abs(np.gradient(separation, axis=axis))
