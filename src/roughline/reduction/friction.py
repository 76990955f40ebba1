"""Springs with Coulomb friction under any history of normal and shear loads along one line.

A spring is told by the depth z at which it comes into contact. It bears E* (d - z) and, as long as
it sticks, G* times the slide since it came into contact; sideways at most mu times what it bears
[1]_. Under loads that rise together at a slope dQ/dF of at most mu nothing slips, and the spring z
has slid by u - u(z). Whatever the history, springs bear what such a rise would leave [2]_: a line
from rest to the load, in the plane of F and Q and in that of d and u alike, with slopes of at most
mu. A new load keeps of it what lies in the load's cone of friction; springs beyond slip, and the
side of the cone takes their place. So all follows from the body under normal loads alone, and
nothing is discretised.

References
----------
.. [1] V. L. Popov and M. Heß, *Method of Dimensionality Reduction in Contact Mechanics and
   Friction*, Springer (2015), §5.3 to 5.5.
.. [2] J. Jäger, "Axi-symmetric bodies of equal material in contact under torsion or shift", Arch.
   Appl. Mech. 65, 478-487 (1995).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from roughline.computing.arrays import Real
from roughline.reduction.revolution import Revolution
from roughline.reduction.springs import Springs

_SAME_DEPTH = 1e-10  # of the largest: corners that are closer are one
_DEPTH, _FORCE, _SLIDE, _SHEAR = range(4)  # rows of a rise; slides are times G* / E*


def _at_rest() -> Real:
    return np.zeros((4, 1))


class NormalSprings(Protocol):
    """Springs under normal loads alone."""

    def pressed(self, depth: float) -> tuple[float, float]:
        """Force at a depth, and its work up to there. [force], [energy]"""
        ...

    def depth_under(self, force: float) -> float:
        """Depth under a force. [length]"""
        ...

    def stiffness(self, depth: float) -> float:
        """Stiffness of the springs that touch at a depth. [force / length]"""
        ...


@dataclass(frozen=True, eq=False)
class SpringsOfRevolution:
    """Those of a body of revolution, which does not stick."""

    body: Revolution

    def pressed(self, depth: float) -> tuple[float, float]:
        """Force at a depth, and its work up to there. [force], [energy]"""
        a = self._radius(depth)
        return (self.body.force(a, depth), self.body.stored(a, depth)) if a > 0 else (0.0, 0.0)

    def depth_under(self, force: float) -> float:
        """Depth under a force. [length]"""
        radius = self.body.moved("forces", 0.0, force).radius
        return self.body.depth(radius, force) if radius else 0.0

    def stiffness(self, depth: float) -> float:
        """Stiffness of the springs that touch at a depth. [force / length]"""
        return 2 * self.body.E_star * self._radius(depth)

    def _radius(self, depth: float) -> float:
        return self.body.moved("depths", 0.0, depth).radius


@dataclass(frozen=True, eq=False)
class SpringsOfLine:
    """Those of a rough line, one under each point."""

    springs: Springs

    @cached_property
    def _sums(self) -> tuple[Real, Real, Real]:
        """Separations, rising, and the sums of those before each, and of their squares."""
        rising: Real = np.sort(self.springs.separations)
        first: Real = np.append(0.0, np.cumsum(rising))
        second: Real = np.append(0.0, np.cumsum(rising * rising))
        return rising, first, second

    def pressed(self, depth: float) -> tuple[float, float]:
        """Force at a depth, and its work up to there. [force], [energy]"""
        z, first, second = self._sums
        n, k = int(np.searchsorted(z, depth)), self.springs.spring_stiffness
        force = k * (n * depth - first[n])
        return force, k * (n * depth**2 - 2 * depth * first[n] + second[n]) / 2

    def depth_under(self, force: float) -> float:
        """Depth under a force. [length]"""
        return float(self.springs.under_forces(np.array([force])).depth_under(np.array([force]))[0])

    def stiffness(self, depth: float) -> float:
        """Stiffness of the springs that touch at a depth. [force / length]"""
        return self.springs.spring_stiffness * int(np.searchsorted(self._sums[0], depth))


@dataclass(frozen=True, eq=False)
class ShearedSprings:
    """A body on springs that bear shear, as its loads so far have left it."""

    springs: NormalSprings
    friction: float  # mu [1]
    ratio: float  # G* / E* [1]
    rise: Real = field(default_factory=_at_rest)  # corners of the line from rest to the load
    stick_depth: float = 0.0  # springs that touch before stick where shear goes on. [length]
    dissipated: float = 0.0  # by the last load [energy]
    known: dict[float, tuple[float, float]] = field(default_factory=dict)  # by depth: pressed

    @property
    def slide(self) -> float:
        """Slide of the body since its first touch. [length]"""
        return float(self.rise[_SLIDE, -1]) / self.ratio

    @property
    def shear_force(self) -> float:
        """Shear force. [force]"""
        return float(self.rise[_SHEAR, -1])

    @property
    def stick_stiffness(self) -> float:
        """Normal stiffness of what sticks where shear goes on as it did last. [force / length]"""
        return self.springs.stiffness(self.stick_depth)

    def under(self, depth: float, force: float, shear_force: float) -> ShearedSprings:
        """Lead the body to a normal load and a shear force of less than mu F."""
        return self._led(np.array([depth, force, np.nan, shear_force]), _FORCE, _SHEAR)

    def at(self, depth: float, force: float, slide: float) -> ShearedSprings:
        """Lead the body to a normal load and a slide."""
        return self._led(np.array([depth, force, self.ratio * slide, np.nan]), _DEPTH, _SLIDE)

    def _led(self, load: Real, across: int, up: int) -> ShearedSprings:
        """Lead the body to a load that is given in the plane of two rows."""
        rise = self._until(load)
        sign = 1.0 if load[up] >= rise[up, -1] else -1.0
        slope, stick_depth = sign * self.friction, min(self.stick_depth, load[_DEPTH])
        beyond = sign * (load[up] - rise[up]) - self.friction * (load[across] - rise[across])
        outside = int(np.count_nonzero(beyond <= 0))  # first corner outside the cone
        if outside == 0:  # the body slides
            rise = np.array([[0.0], [0.0], [load[_SLIDE] - slope * load[_DEPTH]], [0.0]])
            stick_depth = 0.0
        elif outside < beyond.size:
            inside, outer = rise[across, outside - 1 : outside + 1]
            share = beyond[outside - 1] / (beyond[outside - 1] - beyond[outside])
            at = self._normal(inside + share * (outer - inside), across)
            rise, stick_depth = np.column_stack([rise[:, :outside], _on(rise, *at)]), at[0]
        elif load[across] > rise[across, -1]:  # no spring slips
            slope = (load[up] - rise[up, -1]) / (load[across] - rise[across, -1])
            stick_depth = load[_DEPTH]
        normal, shear = [_DEPTH, _FORCE], [_SLIDE, _SHEAR]
        load[shear] = rise[shear, -1] + slope * (load[normal] - rise[normal, -1])
        dissipated = self._dissipated(load[_DEPTH], load[_SLIDE])
        rise = np.column_stack([rise, load])
        return replace(self, rise=rise, stick_depth=stick_depth, dissipated=dissipated)

    def _until(self, load: Real) -> Real:
        """The rise as far as its springs are in contact still."""
        depth, force = load[[_DEPTH, _FORCE]]
        if depth >= self.rise[_DEPTH, -1]:
            return self.rise
        nearer = self.rise[:, self.rise[_DEPTH] < depth]
        return np.column_stack([nearer, _on(self.rise, depth, force)])

    def _normal(self, value: float, row: int) -> tuple[float, float]:
        """Depth and force of a normal load, of which either is given."""
        if row == _DEPTH:
            return value, self._pressed(value)[0]
        return self.springs.depth_under(value), value

    def _pressed(self, depth: float) -> tuple[float, float]:
        """Normal force at a depth, and its work up to there; corners are asked for again."""
        if depth not in self.known:
            self.known[depth] = self.springs.pressed(depth)
        return self.known[depth]

    def _dissipated(self, depth: float, slide: float) -> float:
        """Energy that a way straight in depth and slide dissipates. [energy]

        A spring dissipates its slip times the mean of what it bears as it slips. Over z that is of
        second degree between corners, so sums by parts with the normal force and its work are
        exact.
        """
        z = np.unique(np.append(self.rise[_DEPTH], depth))
        for which in (0, 1):  # where springs end at rest, and where slip begins
            values = self._slips(z, depth, slide)[which]
            turns = np.flatnonzero(values[:-1] * values[1:] < 0)
            left, right = values[turns], values[turns + 1]
            z = np.union1d(z, z[turns] + np.diff(z)[turns] * left / (left - right))
        z = z[np.diff(z, append=np.inf) > _SAME_DEPTH * z[-1]]
        width, middle = np.diff(z), (z[1:] + z[:-1]) / 2
        lost, between = (self._slips(each, depth, slide)[2] for each in (z, middle))
        if not lost.any() and not between.any():
            return 0.0
        force, work = np.transpose([self._pressed(each) for each in z.tolist()])
        first = (4 * between - 3 * lost[:-1] - lost[1:]) / width  # slopes at the ends of pieces
        last = (3 * lost[1:] + lost[:-1] - 4 * between) / width
        parts = first * np.diff(force) + (last - first) * (force[1:] - np.diff(work) / width)
        return -float(parts.sum()) / self.ratio

    def _slips(self, z: Real, depth: float, slide: float) -> tuple[Real, Real, Real]:
        """What springs would bear if they stuck, by how much that is too much, and what is lost.

        All are over E*, and what is lost is over E*² / G*. A spring that comes off ends at none.
        """
        before, moved = self.rise[_DEPTH, -1], slide - self.rise[_SLIDE, -1]
        nearer, farther = max(before, depth), min(before, depth)
        share = np.clip((nearer - z) / (nearer - farther), 0, 1) if nearer > farther else 1.0
        bore = self.rise[_SLIDE, -1] - np.interp(z, self.rise[_DEPTH], self.rise[_SLIDE])
        most_before, most = (self.friction * np.maximum(each - z, 0) for each in (before, depth))
        tried = bore + share * moved
        excess = np.abs(tried) - most
        room = np.maximum(most_before - np.sign(tried) * bore, 0.0)
        slip = np.maximum(excess, 0.0)
        begins = most_before + (most - most_before) * room / np.where(slip > 0, slip + room, 1.0)
        return tried, excess, slip * (begins + most) / 2


def _on(rise: Real, depth: float, force: float) -> Real:
    """The point of a rise at a normal load."""
    slide = np.interp(depth, rise[_DEPTH], rise[_SLIDE])
    return np.array([depth, force, slide, np.interp(force, rise[_FORCE], rise[_SHEAR])])
