"""A force on bodies that stick, found by a search over depths.

Under one pull such bodies have two depths or none. So the path is followed by depths, from the last
contact towards the force: nearer where that is larger, apart where it is less. The first contact
with the force is that of slow bodies under it. On the way apart the force has a least value, the
pull-off. Beyond it no contact bears the pull, and the bodies come apart.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from copy import copy
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.search.problem import Contact, Load, Outcome

_STEP_GROWTH = 2.0  # by which a step to the next depth may be longer than the one before
_MOST_TRIALS = 100
_DIP_STEPS = 8  # steps across an interval with a least force
_STEPS_APART = 8  # from a depth to first touch, at least, or as the reach of the pull tells
# A part of what nodes bear: a force that is missed by no more is then given itself, and what bears
# no more beside another state has come off.
_CLOSE_FORCE = 1e-2
# Of the scale of lengths: the first step out of full contact, and how closely the depth is found at
# which bodies come off by a jump.
_FINE_STEP = 1e-5


class Continuation(Protocol):
    """A path of loads, which goes on from a copy of itself."""

    def under(self, load: Load) -> Contact:
        """Return the contact under the next load."""

    def after_separation(self) -> Continuation:
        """Return the path of bodies that have come apart."""


@dataclass(frozen=True, eq=False)
class State:
    """A path after a depth, and the contact there."""

    path: Continuation
    contact: Contact

    @property
    def depth(self) -> float:
        """Approach since first touch. [length]"""
        return self.contact.depth

    @property
    def force(self) -> float:
        """Total force. [force]"""
        return self.contact.force

    @property
    def is_solved(self) -> bool:
        """Whether the contact and its stiffness were found."""
        response = self.contact.response
        return response is not None and response.converged

    def has_come_off(self, before: State) -> bool:
        """Whether bodies no longer touch, and hardly pull each other beside another state."""
        return (
            not self.stiffness > 0 and self.absolute_force <= _CLOSE_FORCE * before.absolute_force
        )

    @property
    def is_rigid(self) -> bool:
        """Whether the bodies are in full contact, which is rigid where the mean is free."""
        return math.isinf(self.stiffness)

    @property
    def absolute_force(self) -> float:
        """Sum of the forces on all nodes. [force]"""
        cell_area = self.contact.problem.grid.cell_area
        return cell_area * float(np.abs(self.contact.pressure).sum())

    @property
    def compared(self) -> float:
        """With what errors of the force are compared, as in the certificate. [force]"""
        pressure, problem = self.contact.pressure, self.contact.problem
        if not pressure.size:
            return 0.0
        scale, _ = problem.scales(pressure, np.zeros_like(pressure))
        return max(self.absolute_force, problem.grid.cell_area * scale)

    @property
    def stiffness(self) -> float:
        """Stiffness at a given reach of the pull, which no branch exceeds. [force / length]"""
        response = self.contact.response
        return math.nan if response is None else response.loading.stiffness


def under_forces(path: Continuation, loads: Sequence[Load], rtol: float) -> Iterator[Contact]:
    """Solve the contact under each force in turn."""
    last: State | None = None
    for load in loads:
        last = _under_force(path, last, load.value, rtol)
        path = last.path
        yield last.contact


def _under_force(path: Continuation, state: State | None, force: float, rtol: float) -> State:
    """Return the path after a force, and the contact under it.

    Where bodies that do not touch are to be pulled they are first brought to rest without a force.
    """
    search = _DepthSearch(force, rtol)
    if state is None or not state.is_solved or not state.contact.nodes.size:
        first = _DepthSearch(max(force, 0.0), rtol)
        state = first.nearer(path, None)
        search.convolutions += first.convolutions
    if state.is_solved and not search.is_at(state):
        state = search.nearer(path, state) if state.force < force else search.pull_apart(state)
    return search.with_force_error(state)


class _DepthSearch:
    """The search for a force over depths, from one side."""

    def __init__(self, force: float, rtol: float) -> None:
        self.convolutions = 0
        self._force = force
        self._rtol = rtol

    def at(self, path: Continuation, depth: float) -> State:
        """Follow a path to a depth."""
        path = copy(path)
        contact = path.under(Load(depth=depth))
        self.convolutions += contact.convolutions
        return State(path, contact)

    def is_at(self, state: State) -> bool:
        """Whether a contact bears the force."""
        return abs(state.force - self._force) <= self._rtol * state.compared

    def with_force_error(self, state: State) -> State:
        """Return a state with the convolutions of the search and the error of its force."""
        contact = replace(state.contact, convolutions=self.convolutions)
        if state.is_solved and contact.outcome is Outcome.CONVERGED:
            error = abs(state.force - self._force)
            off = error / state.compared if error else 0.0
            contact = replace(contact, residuals=replace(contact.residuals, load=off))
            if off > self._rtol:
                contact = replace(contact, outcome=Outcome.STALLED)
        if contact.outcome is not Outcome.CONVERGED:
            contact = replace(contact, response=None)
        return State(state.path, contact)

    def under_force(self, path: Continuation) -> State:
        """Follow a path to the force itself."""
        path = copy(path)
        contact = path.under(Load(force=self._force))
        self.convolutions += contact.convolutions
        return State(path, contact)

    def nearer(self, path: Continuation, state: State | None) -> State:
        """Bring bodies nearer until they bear the force.

        More pull brings them nearer under a force as at a depth, so the force itself may be given.
        Depths are for where that is not solved.
        """
        found = self.under_force(path)
        if found.is_solved:
            return found
        state = state or self.at(path, 0.0)
        before: State | None = None
        while state.is_solved and not self.is_at(state) and state.force < self._force:
            step = self._step(before, state)
            before, state = state, self.at(state.path, state.depth + step)
        if before is None or not state.is_solved or self.is_at(state):
            return state
        return self._between(before, state)

    def pull_apart(self, state: State) -> State:
        """Take bodies apart until they bear the force, or come off."""
        if state.is_rigid:
            lowest_force = self._lowest_of_full_contact(state)
            if self._force > lowest_force:
                return self.under_force(state.path)
            last = _DepthSearch(lowest_force, self._rtol)
            state = last.under_force(state.path)
            self.convolutions += last.convolutions
            if not state.is_solved or self.is_at(state):
                return state
        before, least = state, state
        lowest: _Dip | None = None  # of the force along the way
        longest = _longest_step(state)
        step = min(-self._step(None, state), longest)
        for _ in range(_MOST_TRIALS):
            trial = self.at(state.path, state.depth - step)
            if not trial.is_solved or self.is_at(trial):
                return trial
            if trial.force < self._force:
                return self._between(state, trial)
            is_least = state.force <= least.force
            if (
                is_least
                and trial.has_come_off(state)
                and step > _FINE_STEP * state.contact.length_scale
            ):
                step /= _STEP_GROWTH**3
                continue
            passed = trial.force >= state.force
            if passed and is_least and state.force < 0:
                dip = self._looked_into(_Dip(before, state, trial))
                if dip.bound <= self._force:
                    found = self._least(dip)
                    if found.is_solved and found.force <= self._force:
                        return found if self.is_at(found) else self._between(before, found)
                if dip.middle.force <= least.force:
                    least, lowest = dip.middle, dip
            # beside a push, a pull that still grows may be small
            if trial.has_come_off(least if least.force < 0 else state):
                least = self._least(lowest) if lowest else min(state, trial, key=_force)
                off = replace(least.contact, outcome=Outcome.PULLED_OFF, response=None)
                return State(trial.path.after_separation(), off)
            before, state = state, trial
            wanted = math.inf if passed else -self._step(before, state)
            step = min(max(wanted, step / _STEP_GROWTH), _STEP_GROWTH * step, longest)
        return replace(state, contact=replace(state.contact, outcome=Outcome.STALLED))

    def _lowest_of_full_contact(self, state: State) -> float:
        """Return the force of full contact whose first node pulls nearly all that it can."""
        problem, pressure = state.contact.problem, state.contact.pressure
        spare = float(pressure.min()) + (1 - self._rtol) * Bounds.of(problem.law).largest_pull
        return state.force - problem.grid.cell_area * pressure.size * spare

    def _step(self, before: State | None, state: State) -> float:
        """Return the change of depth that leads to the force, as far as the last ones tell."""
        missing = self._force - state.force
        if not state.stiffness > 0:  # nothing touches
            return math.copysign(state.contact.length_scale, missing)
        if state.is_rigid:
            return math.copysign(_FINE_STEP * state.contact.length_scale, missing)
        step = missing / state.stiffness
        if before is None or state.depth == before.depth:
            return step
        slope = (state.force - before.force) / (state.depth - before.depth)
        return missing / slope if slope > state.stiffness / 4 else 4 * step

    def _between(self, start: State, end: State) -> State:
        """Narrow an interval of depths, whose ends bear less and more, down to the force.

        Each trial starts from the end from which the bodies came.
        """
        low, high, side = start.force - self._force, end.force - self._force, 0
        for _ in range(_MOST_TRIALS):
            depth = (start.depth * high - end.depth * low) / (high - low)
            trial = self.at(start.path, depth)
            if not trial.is_solved or self.is_at(trial):
                return trial
            off = trial.force - self._force
            if (
                abs(off) <= _CLOSE_FORCE * trial.absolute_force
                and (found := self.under_force(start.path)).is_solved
            ):
                return found
            if (off < 0) == (start.force < self._force):
                start, low = trial, off
                high, side = (high / 2, 1) if side == 1 else (high, 1)
            else:
                end, high = trial, off
                low, side = (low / 2, -1) if side == -1 else (low, -1)
        return min(start, end, key=lambda each: abs(each.force - self._force))

    def _looked_into(self, dip: _Dip) -> _Dip:
        """Narrow a dip by looks in even steps: that of a rough body falls and rises many times."""
        states = [dip.nearer]
        for depth in np.linspace(dip.nearer.depth, dip.farther.depth, _DIP_STEPS + 1)[1:-1]:
            states.append(self.at(states[-1].path, float(depth)))
            if not states[-1].is_solved:
                return dip
        states.append(dip.farther)
        least = min(range(1, _DIP_STEPS), key=lambda i: states[i].force)
        return _Dip(*states[least - 1 : least + 2])

    def _least(self, dip: _Dip) -> State:
        """Narrow a dip down to its least force."""
        for _ in range(_MOST_TRIALS):
            nearer, middle, farther = dip.nearer, dip.middle, dip.farther
            depth = dip.lowest_of_parabola
            trial = self.at((nearer if depth > middle.depth else middle).path, depth)
            if not trial.is_solved:
                return middle
            gained = middle.force - trial.force
            if depth > middle.depth:
                dip = _Dip(nearer, trial, middle) if gained > 0 else _Dip(trial, middle, farther)
            else:
                dip = _Dip(middle, trial, farther) if gained > 0 else _Dip(nearer, middle, trial)
            if abs(gained) <= self._rtol * dip.middle.absolute_force:
                break
        return dip.middle


def _longest_step(state: State) -> float:
    """Return how far a step apart goes at most, as forces dip about as far as the pull reaches.

    A long way is taken in a number of steps, however short the reach is.
    """
    reach = float(state.contact.problem.law.gap_at(np.array([0.5]))[0])
    return max(reach, (abs(state.depth) + reach) / _STEPS_APART)


def _force(state: State) -> float:
    return state.force


@dataclass(frozen=True, eq=False)
class _Dip:
    """An interval of depths with a least force in it: the middle bears no more than its ends."""

    nearer: State
    middle: State
    farther: State

    @property
    def bound(self) -> float:
        """A force below which it does not fall, as no branch is stiffer than a given reach."""
        if self.nearer.is_rigid or self.middle.is_rigid:
            return -math.inf
        sides = (self.nearer, self.middle), (self.middle, self.farther)
        falls = (start.force - start.stiffness * (start.depth - end.depth) for start, end in sides)
        return min(falls)

    @property
    def lowest_of_parabola(self) -> float:
        """Depth of the least force of a parabola through the three, well within them.

        Where the parabola does not tell, it is the middle of the wider part.
        """
        nearer, middle, farther = self.nearer, self.middle, self.farther
        right, left = nearer.depth - middle.depth, middle.depth - farther.depth
        wider = middle.depth + (right / 2 if right > left else -left / 2)
        if not (right > 0 and left > 0):
            return wider
        up, down = (nearer.force - middle.force) / right, (middle.force - farther.force) / left
        bent = (up - down) / (right + left)
        least = 0.05 * (right + left)
        lowest = middle.depth + (bent * right - up) / (2 * bent) if bent > 0 else middle.depth
        if abs(lowest - middle.depth) < 0.2 * least:
            return wider
        return min(max(lowest, farther.depth + least), nearer.depth - least)
