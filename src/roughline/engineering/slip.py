"""Partial slip of bodies that are pressed together: in closed form, and as they are sheared."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.contact.curve import SurfaceCurve
from roughline.contact.selection import loads_with_fields
from roughline.contact.sliding import SlidingCurve, SlidingFields

COUPLED_FROM = 0.05
"""Size of Dundurs' beta from which on the closed form is said to be off. [1]"""

# Points that slip less in a cycle than this part of the largest slip never slip; and over the
# way between turns, to what slip is known, as where bodies but stick.
_STICKS, _KNOWN_TO = 1e-3, 1e-6
_ROUNDED_TO = 1e-9  # of the slide at which all slips: full contact that is repeated holds all

# By how much bodies move further than the closed form says, at 0.95 of what friction bears, over
# the size of beta over the coefficient of friction: of a rough contact of 499 points (H = 0.8), by
# the full model, at Poisson's ratios of 0 and 0.3.
_EXCESS_OVER = (0.0, 0.286, 0.333, 0.952, 1.667, 2.857)
_EXCESS = (0.0, 0.010, 0.014, 0.105, 0.229, 0.298)


def excess_of_coupled(beta: float, friction: float) -> float:
    """Return about what share coupled bodies move beyond the closed form, before they slide. [1]

    Beyond the last of what was compared it is that of the last.
    """
    return float(np.interp(abs(beta) / friction, _EXCESS_OVER, _EXCESS))


@dataclass(frozen=True, eq=False)
class PartialSlip:
    """Tangential loading at the largest normal load, from no load to full sliding."""

    friction: float  # coefficient [1]
    displacement: Real  # [m]
    force: Real  # [N]


@dataclass(frozen=True, eq=False)
class ShearLoop:
    """A loop of shear force and slide, of bodies whose shear goes to and fro."""

    displacement: float  # at the largest force, from none [m]
    energy: float  # that a cycle dissipates [J]


def _loop_in_closed_form(depth: Real, force: Real, ratio: float, friction: float) -> ShearLoop:
    """Return the loop of Jäger's closed form, by Masing's rule.

    Depths [m] and forces [N] are of a curve without shear, at an odd number of even forces from
    the normal force to that of the stick area; `ratio` is E* / G*.
    """
    from scipy.integrate import simpson  # here because it loads slowly

    slide = friction * ratio * (depth[0] - depth)
    shear = friction * (force[0] - force)
    below = float(simpson(slide, x=shear))
    return ShearLoop(float(slide[-1]), 4 * float(slide[-1] * shear[-1]) - 8 * below)


@dataclass(frozen=True, eq=False)
class ShearCycles:
    """A shear force that goes to and fro on pressed bodies: its path, and what follows from it.

    All is of the bodies as they were pressed, for forces along x. The path presses them, rises to
    the largest force, and goes on in cycles that end there.
    """

    curve: SlidingCurve
    friction: float  # coefficient [1]
    pressed: int  # number of the load that presses, without shear
    per_cycle: int  # loads in a cycle
    cycles: int
    plain: SurfaceCurve | None = None  # the forces of Jäger's stick areas, without shear
    ratio: float | None = None  # E* / G*; None of coated bodies
    others: Mapping[str, ShearCycles | None] = field(default_factory=dict)
    """The same followed otherwise, by the causes that leave it open; None if that is not known."""

    times: float = 1.0  # of its distance from another of which it tells, that this may be off
    by_micro_slip: bool = False  # and what follows from slip at least by that of the micro-slip

    @property
    def is_bounded(self) -> bool:
        """Whether it is known how far each cause leaves it open, if any does."""
        return bool(self.others) and all(self.others.values())

    def by(self, cause: str) -> ShearCycles:
        """The same, as one cause alone leaves it open."""
        known = {cause: self.others[cause]} if cause in self.others else {}
        return replace(self, others=known)

    @property
    def amplitude(self) -> float:
        """The largest shear force. [N]"""
        return float(self.curve.shear_force[-1, 0])

    @property
    def limit(self) -> float:
        """The force at which the last spot slides. [N]"""
        return float(self.curve.shear_limit[-1])

    @property
    def _turning(self) -> int:
        """Number of the load that first has the largest shear force."""
        return self.curve.status.size - 1 - self.cycles * self.per_cycle

    @property
    def displacement(self) -> float:
        """Along the force, as it is first reached, from none. [m]"""
        return float(self.curve.slide[self._turning, 0] - self.curve.slide[self.pressed, 0])

    @property
    def stiffness_before(self) -> float:
        """Without shear, when all of the contact sticks. [N / m]"""
        return _along(self.curve.shear_stiffness_back[self.pressed])

    @property
    def stiffness_on(self) -> float:
        """At the largest force, as it is first reached, on more of it. [N / m]"""
        return _along(self.curve.shear_stiffness[self._turning])

    @property
    def stiffness_back(self) -> float:
        """There, on less of it. [N / m]"""
        return _along(self.curve.shear_stiffness_back[self._turning])

    @property
    def one_point_of_stick(self) -> float:
        """By what share one point more that sticks, at the largest force, makes it stiffer. [1]"""
        curve, turn = self.curve, self._turning
        contact = float(curve.area_fraction[turn]) * math.prod(curve.surface.shape)
        return 0.5 / max(float(curve.stick_fraction[turn]) * contact, 1.0)

    @property
    def micro_slip(self) -> float:
        """What slip adds to the displacement of bodies whose contact sticks. [m]"""
        slip = self.displacement - self.amplitude / self.stiffness_before
        return slip if abs(slip) > _KNOWN_TO * self.displacement else 0.0

    @property
    def energies(self) -> Real:
        """What each cycle dissipates, shape (cycles,). [J]"""
        of_loads = self.curve.dissipated[self._turning + 1 :]
        energies: Real = of_loads.reshape(self.cycles, self.per_cycle).sum(axis=1)
        known_to = _KNOWN_TO * self.amplitude * 4 * self.displacement
        return np.where(energies > known_to, energies, 0.0)

    @property
    def energy(self) -> float:
        """What the last cycle dissipates. [J]"""
        return float(self.energies[-1])

    @property
    def loss_factor(self) -> float:
        """Energy of the last cycle over 2 pi times Q u / 2, u half of the way between turns. [1]"""
        slides = self.curve.slide[[-1, -1 - self.per_cycle // 2], 0]
        way = float(slides[0] - slides[1]) / 2
        return self.energy / (math.pi * self.amplitude * way) if way else 0.0

    @property
    def fields(self) -> SlidingFields | None:
        """At the largest force, after the last cycle."""
        kept = [each for _, each in loads_with_fields(self.curve)]
        return kept[-1] if kept and isinstance(kept[-1], SlidingFields) else None

    @cached_property
    def slip(self) -> Real | None:
        """Way that each point slips in the last cycle, shape (nx, ny). [m]"""
        first, last = (each for _, each in loads_with_fields(self.curve))
        if not (isinstance(first, SlidingFields) and isinstance(last, SlidingFields)):
            return None
        slip: Real = last.slip_total - first.slip_total
        return np.where(slip > _KNOWN_TO * 4 * self.displacement, slip, 0.0)

    @property
    def never_slips(self) -> Mask | None:
        """Points in contact that slip in no load of the last cycle, shape (nx, ny)."""
        slip, fields = self.slip, self.fields
        if slip is None or fields is None:
            return None
        return fields.contact & (slip <= _STICKS * slip.max())

    @property
    def sticking_share(self) -> float | None:
        """Share of the contact that never slips in the last cycle. [1]"""
        never, fields = self.never_slips, self.fields
        return None if never is None or fields is None else never.sum() / fields.contact.sum()

    @property
    def fretting(self) -> float | None:
        """Largest shear times slip of a point over the last cycle. [J / m²]"""
        slip, fields = self.slip, self.fields
        if slip is None or fields is None:
            return None
        return float((self.friction * fields.pressure * slip).max())

    @property
    def settling(self) -> float | None:
        """By what share the last cycle dissipates less than the one before; None of one. [1]"""
        if self.cycles < 2 or self.energies[-2] == 0:
            return None
        return float(abs(1 - self.energies[-1] / self.energies[-2]))

    @property
    def closed_form(self) -> ShearLoop | None:
        """The same by Jäger's closed form; None where it is not known, or where nothing slips."""
        plain = self.plain
        if plain is None or self.ratio is None or not plain.converged.all():
            return None
        loop = _loop_in_closed_form(plain.depth, plain.force, self.ratio, self.friction)
        sliding = self.friction * self.ratio * float(plain.depth[0])  # beyond it all slips
        slips = loop.energy > _KNOWN_TO * self.amplitude * self.displacement
        return loop if slips and loop.displacement > _ROUNDED_TO * sliding else None


def _along(stiffness: Real) -> float:
    """Return the stiffness along x of bodies that are free to slide across it. [N / m]

    Where nothing resists a slide across, or nothing lets it be, it is that of x alone.
    """
    (xx, xy), (yx, yy) = stiffness.tolist()
    return xx - xy * yx / yy if yy else xx
