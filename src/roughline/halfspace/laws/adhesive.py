"""Elastic bodies that pull each other across gaps, up to a work of adhesion."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar, Literal

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.errors import InputError
from roughline.halfspace.laws.law import ContactLaw, Solved
from roughline.halfspace.laws.unilateral import Unilateral, refuse_beyond_full_contact

# Shares are extrapolated from so many rounds where they change by less than the first number. Where
# a change is so large a part of the one before, no end is near: bodies slide to a jump, and shares
# go up to so many times as far.
_NEAR, _ROUNDS, _NEARER, _FASTEST = 0.1, 6, 0.9, 8.0
_LEAST_PULL = 1e-3  # of the largest pull, with which pressures are compared at least
_IS_POORLY = 2.0  # cells of the pulling zone, with which a pull-off is resolved at least


@dataclass(frozen=True, eq=False)
class Adhesive(ContactLaw):
    """Elastic bodies that pull each other across gaps.

    Where the bodies touch, the pressure is above the largest pull -w / h_0; across a gap it is the
    share of that pull which the gap leaves. Shares and gaps are led to each other in rounds, from
    those of the load before. At a given depth more pull closes more gap, so these rounds go one
    way: to where bodies come that are moved slowly. So bodies that come nearer jump together, and
    bodies that go apart hold each other where they did not pull before.

    Attributes
    ----------
    work_of_adhesion : float
        Work to separate a unit of area, w. [pressure * length]
    range : float
        h_0, so that the largest pull is w / h_0. [length]
    share : ndarray, shape (nx, ny), or float
        Share of the largest pull that each node bears at least.
    resolved_zone : float
        Cells across the zone that pulls, from which on a grid resolves it. [1]
    """

    work_of_adhesion: float
    range: float
    share: Real | float = 0.0
    rounds: tuple[tuple[Real, Real], ...] = ()  # last shares, and those that followed from gaps
    near: float = _NEAR  # change of the shares below which they are extrapolated
    plain: Real | float = 0.0  # shares that followed from the last gap
    factor: float = 1.0  # by which the shares went further than these
    change: float = 0.0  # of the shares by the last round, and what they moved by
    moved: Real | float = 0.0
    misfit: float = 0.0
    memory: ClassVar[Literal["none", "dents", "path"]] = "path"
    only_pushes: ClassVar[bool] = False
    follows_gaps: ClassVar[bool] = True
    resolved_zone: ClassVar[float] = 4.0

    def __post_init__(self) -> None:
        for name, what in (("work_of_adhesion", "work of an area"), ("range", "length")):
            if not 0 < getattr(self, name) < math.inf:
                raise InputError(
                    f"is {getattr(self, name)!r}; a positive, finite {what} is needed: bodies that "
                    "do not stick are rl.Unilateral()",
                    name,
                )

    @abstractmethod
    def share_at(self, gap: Real) -> Real:
        """Return the share of the largest pull across gaps."""

    @abstractmethod
    def gap_between(self, share: Real, other: Real | float) -> Real:
        """Return the difference of the gaps that go with shares. [length]"""

    @abstractmethod
    def work_beyond(self, gap: Real) -> Real:
        """Return the work to separate nodes from a gap on, over w. [1]"""

    @property
    @abstractmethod
    def reach(self) -> float:
        """Gap beyond which nothing is pulled. [length]"""

    @property
    def largest_pull(self) -> float:
        """Tension of nodes that all but touch, w / h_0. [pressure]"""
        return self.work_of_adhesion / self.range

    @property
    def settings(self) -> dict[str, str | float]:
        """Its name, the work of adhesion and the range."""
        numbers = {"work_of_adhesion": self.work_of_adhesion, "range": self.range}
        return {**super().settings, **numbers}

    @property
    def resolution(self) -> dict[str, float]:
        """Cells across the zone that pulls about a contact."""
        return {"pulling_zone_cells": self.zone}

    def bounds(self, nodes: Indices | None) -> tuple[Real | float, Real | float]:
        """Return the share of the pull that nodes bear, and that they may bear any pressure."""
        low = -self.largest_pull * self.share
        if isinstance(low, np.ndarray):
            low = low.ravel() if nodes is None else low.ravel()[nodes]
        return low, math.inf

    def scaled(self, pressure: float, length: float) -> Adhesive:
        """Return the law in other units."""
        work, reach = self.work_of_adhesion / (pressure * length), self.range / length
        return replace(self, work_of_adhesion=work, range=reach)

    def on(self, take: Callable[[Real], Real]) -> Adhesive:
        """Return the law on another grid."""
        return replace(self, share=take(self.share) if isinstance(self.share, np.ndarray) else 0.0)

    def between(
        self, separation: Real, compliance: float, repeats: tuple[bool, bool]
    ) -> ContactLaw:
        """Return the law itself, or, where the pull moves less than rounding, one without it."""
        moved = self.largest_pull * compliance * separation.size
        return Unilateral() if moved < np.finfo(float).eps * separation.max() else self

    def refuse(
        self, control: str, values: Real, heights: Real, area: float, mean_is_free: bool
    ) -> None:
        """Refuse depths beyond full contact where that is rigid."""
        refuse_beyond_full_contact(control, values, heights, mean_is_free)

    def start(self, value: float, last: float | None, largest: float | None) -> Adhesive:
        """Forget the rounds of the load before, but not its shares."""
        return replace(self, rounds=(), near=_NEAR, factor=1.0, change=0.0, plain=0.0, moved=0.0)

    def then(self, contact: Solved) -> Adhesive:
        """Take the shares of the gap, or others on the way to where rounds end."""
        share = self.share_at(contact.gap)
        moved = share - self.share
        change, misfit = float(np.abs(moved).max()), self.gap_between(share, self.share)
        plain = replace(
            self, share=share, rounds=(), misfit=float(misfit.max()), change=change, moved=moved
        )
        onwards = float(np.vdot(moved, self.moved + np.zeros_like(moved))) > 0
        if self.factor > 1 and not onwards:  # shares went beyond an end
            return replace(plain, share=self.plain, factor=1.0, change=0.0)
        if change >= self.near:
            factor = min(self.factor, 1.0)
            if change > _NEARER * self.change > 0:  # as fast as before: shares slide, or swing
                factor = min(2 * self.factor, _FASTEST) if onwards else factor / 2
            there = np.clip(self.share + factor * moved, 0.0, 1.0)
            near = _NEAR if change > _NEAR else self.near
            return replace(plain, share=there, plain=share, factor=factor, near=near)
        if len(self.rounds) > 1:
            taken, followed = self.rounds[-1]
            before = float(np.abs(followed - taken).max())
            if change > _NEARER * before:
                return replace(plain, share=followed, near=before / 3, change=0.0)
        rounds = (*self.rounds, (self.share + np.zeros_like(share), share))[-_ROUNDS:]
        return replace(plain, share=_extrapolated(rounds), rounds=rounds, factor=1.0)

    def energy(self, contact: Solved) -> float:
        """Return minus the work that is left to separate the nodes."""
        return -self.work_of_adhesion * float(self.work_beyond(contact.gap).mean())

    def scales(self, pressure: Real, displacement: Real) -> tuple[float, float]:
        """Compare gaps with the range, as bodies that pull may displace each other by nothing.

        Nor need they bear anything: where they touch under no load and nothing else is within
        reach, pressures are compared with a part of the largest pull.
        """
        return max(float(np.abs(pressure).mean()), _LEAST_PULL * self.largest_pull), self.range

    @property
    def zone(self) -> float:
        """Width of the zone that pulls about a contact, in units of E*: w / (pi sigma_0²)."""
        return self.range / (math.pi * self.largest_pull) if self.largest_pull else math.inf

    def remarks(self, separation: Real) -> tuple[str, ...]:
        """Say where the grid does not resolve the pull, and where all of the bodies is pulled."""
        found = []
        if self.zone < self.resolved_zone:
            wider = math.ceil(100 * math.sqrt(self.resolved_zone / self.zone)) / 100
            cells = f"{self.zone:.2g}"
            if float(cells) >= self.resolved_zone:
                cells = f"{math.floor(100 * self.zone) / 100:g}"
            found.append(
                f"the zone that pulls about a contact, E* w / (pi sigma_0²), is {cells} "
                f"cells wide, and {self.resolved_zone:.0f} are needed: "
                + ("no pull-off is given; " if self.zone < _IS_POORLY else "")
                + f"give a range {wider:.3g} times as large, or a finer grid"
            )
        if self.range >= separation.max():
            found.append(
                "the range of the pull is larger than all heights: bodies in contact are pulled "
                "everywhere"
            )
        return tuple(found)

    @property
    def resolves_pull_off(self) -> bool:
        """Whether the zone that pulls has cells enough, in units of E* and of a cell."""
        return self.zone >= _IS_POORLY


def _extrapolated(rounds: tuple[tuple[Real, Real], ...]) -> Real:
    """Return the shares at which those taken and those that follow would be the same (Anderson)."""
    share = rounds[-1][1].copy()
    if len(rounds) < 2:
        return share
    moving = np.zeros(share.shape, bool)
    for taken, following in rounds:
        moving |= taken != following
    changes = np.array([(following - taken)[moving] for taken, following in rounds])
    values = np.array([following[moving] for _, following in rounds])
    steps, *_ = np.linalg.lstsq(np.diff(changes, axis=0).T, changes[-1], rcond=1e-10)
    share[moving] = np.clip(values[-1] - steps @ np.diff(values, axis=0), 0.0, 1.0)
    return share
