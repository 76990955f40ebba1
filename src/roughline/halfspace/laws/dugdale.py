"""Elastic bodies that pull each other evenly across small gaps."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar, Literal

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.errors import InputError
from roughline.halfspace.laws.law import ContactLaw, Solved

_SETTLED = 1e-6  # change of the shares of the pull, from which on they are those of the gap
_PAST, _NEAR = 6, 0.1
_WIDTH = 1.8  # of half the ramp, over what the pull on a cell displaces it: then ramps are stable


@dataclass(frozen=True, eq=False)
class Dugdale(ContactLaw):
    """Elastic bodies that pull each other with a pressure w / h_0 up to a range h_0 [1]_ [2]_.

    Where the bodies touch, the pressure is above -w / h_0; where the gap is between zero and h_0,
    it is -w / h_0; beyond, it is zero. The order of loads matters: bodies that come nearer jump
    together, and hold each other where they did not pull before.

    On a grid the pull ends over a ramp about h_0, across which the share of a cell within reach
    falls from one to zero. Half of it is what the gap changes across half a cell, or, where that is
    more, a cell's displacement by the pull on it. So the edge of the reach moves through cells, and
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
        If work or range are not positive and finite.

    References
    ----------
    .. [1] D. S. Dugdale, "Yielding of steel sheets containing slits", J. Mech. Phys. Solids 8,
       100-104 (1960).
    .. [2] D. Maugis, "Adhesion of spheres: the JKR-DMT transition using a Dugdale model", J. Colloid
       Interface Sci. 150, 243-269 (1992).
    """

    work_of_adhesion: float
    range: float
    ramp: Real | float = 0.0
    share: Real | float = 0.0
    doubt: float = 0.0
    past: tuple[tuple[Real, Real], ...] = ()
    memory: ClassVar[Literal["none", "dents", "path"]] = "path"
    only_pushes: ClassVar[bool] = False

    def __post_init__(self) -> None:
        for name, what in (("work_of_adhesion", "work of an area"), ("range", "length")):
            if not 0 < getattr(self, name) < math.inf:
                raise InputError(
                    f"{name} is {getattr(self, name)!r}; a positive, finite {what} is needed: "
                    "bodies that do not stick are rl.Unilateral()"
                )

    @property
    def pull(self) -> float:
        """Tension within the range, w / h_0. [pressure]"""
        return self.work_of_adhesion / self.range

    def bounds(self, nodes: Indices | None) -> tuple[Real | float, Real | float]:
        """Return the share of the pull that nodes bear, and that they may bear any pressure."""
        low = -self.pull * self.share
        if isinstance(low, np.ndarray):
            low = low.ravel() if nodes is None else low.ravel()[nodes]
        return low, math.inf

    def scaled(self, pressure: float, length: float) -> Dugdale:
        """Return the law in other units."""
        work, reach = self.work_of_adhesion / (pressure * length), self.range / length
        return replace(self, work_of_adhesion=work, range=reach, ramp=self.ramp / length)

    def on(self, take: Callable[[Real], Real]) -> Dugdale:
        """Return the law on another grid."""
        fields = {
            name: take(value)
            for name in ("ramp", "share")
            if isinstance(value := getattr(self, name), np.ndarray)
        }
        return replace(self, **fields)

    def between(self, separation: Real, compliance: float) -> Dugdale:
        """Return the law for bodies: their ramps are those of the slopes and of the grid."""
        steepness = sum(np.abs(np.gradient(separation, axis=axis)) for axis in (0, 1)) / 2
        ramp = np.maximum(steepness, _WIDTH * self.pull * compliance)
        return replace(self, ramp=np.minimum(ramp, self.range))

    def refuse(
        self, control: str, values: Real, heights: Real, area: float, mean_is_free: bool
    ) -> None:
        """Refuse forces, under which bodies that stick have two depths or none."""
        if control == "forces":
            raise InputError(
                "forces do not say where bodies that stick are: under a pull they have two depths, "
                "or none; give depths"
            )

    def then(self, contact: Solved) -> Dugdale | None:
        """Move the shares of the pull to those of the gap, until they no longer change."""
        share = np.clip((self.range + self.ramp - contact.gap) / (2 * self.ramp), 0.0, 1.0)
        doubt = float(np.abs(share - self.share).max())
        if doubt <= _SETTLED:
            return None
        past = (*self.past, (self.share + np.zeros_like(share), share))[-_PAST:]
        if doubt < _NEAR and len(past) > 1:
            share = _extrapolated(past)
        return replace(self, share=share, doubt=doubt, past=past if doubt < _NEAR else ())

    def start(self, value: float, last: float | None, largest: float | None) -> Dugdale:
        """Forget how the law was found under the load before."""
        return replace(self, past=(), doubt=0.3)

    def beyond_doubt(self) -> Dugdale:
        """Return the law without doubt."""
        return replace(self, doubt=0.0)

    def scales(self, pressure: Real, displacement: Real) -> tuple[float, float]:
        """Compare gaps with the range, as bodies that pull may displace each other by nothing."""
        return float(np.abs(pressure).mean()), self.range


def _extrapolated(past: tuple[tuple[Real, Real], ...]) -> Real:
    """Return the shares at which those taken and those that follow would be the same (Anderson)."""
    moving = np.zeros(past[0][0].shape, bool)
    for taken, following in past:
        moving |= taken != following
    changes = np.array([(following - taken)[moving] for taken, following in past])
    values = np.array([following[moving] for _, following in past])
    steps, *_ = np.linalg.lstsq(np.diff(changes, axis=0).T, changes[-1], rcond=1e-10)
    share = past[-1][1].copy()
    share[moving] = np.clip(values[-1] - steps @ np.diff(values, axis=0), 0.0, 1.0)
    return share
