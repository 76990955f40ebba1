"""A path of loads: each contact starts from an earlier one, extrapolated along its tangent.

Loads may rise and fall. Where a law keeps dents, bodies are elastic below the largest load so far,
and on reloading the contact passes through the same states again. A load beyond the largest one
therefore starts from the contact under that, as if there had been no unloading.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from roughline.computing.arrays import InGrid, InPatch, Real, among
from roughline.halfspace.search.by_depths import under_forces
from roughline.halfspace.search.cascade import first_guess
from roughline.halfspace.search.near_rounds import NearRounds
from roughline.halfspace.search.problem import (
    Contact,
    ContactSet,
    Load,
    Method,
    Outcome,
    Problem,
    Residuals,
)
from roughline.halfspace.search.pull import Shares
from roughline.halfspace.search.response import Tangent
from roughline.halfspace.search.rounds import Rounds
from roughline.halfspace.search.tangent import response
from roughline.halfspace.search.window import GridWindow

# Part of the misfit of shares to which their contact is solved while they are led to each other,
# and the largest such tolerance.
_MISFIT_SHARE, _LARGEST_TOLERANCE = 0.03, 1e-2
_SAME_FORCE = 1e-13  # forces that differ by no more than this part count as one


def solve_path(problem: Problem, loads: Sequence[Load], method: Method) -> Iterator[Contact]:
    """Solve the contact under each load in turn; each meets the surfaces that the last one left."""
    path = LoadPath(problem, method)
    if problem.law.only_pushes or loads[0].force is None:
        yield from map(path.under, loads)
    else:
        yield from under_forces(path, loads, method.rtol)


class LoadPath:
    """The contact along a path of loads."""

    def __init__(self, problem: Problem, method: Method) -> None:
        self._untouched = self._problem = problem
        self._method = method
        self._last: Contact | None = None  # until the next search
        self._start: ContactSet | None = None  # of the search, which takes it
        # dp/dF that led to it, on loading and on unloading, and where
        self._followed: tuple[InGrid, Real, Real] | None = None
        self._largest: float | None = None
        self._furthest: Contact | None = None  # under the largest load, until a larger one follows
        self._unknown_below = -np.inf  # the largest load that was not solved
        self._has_yielded = False

    def after_separation(self) -> LoadPath:
        """Return the path of bodies that have come apart, and remember nothing."""
        return LoadPath(self._untouched, self._method)

    def under(self, load: Load) -> Contact:
        """Return the contact under the next load."""
        last, self._last = self._last, None
        if last is not None:
            self._prepare(load, last)
        del last  # no contact is held while the next is solved
        if load.value < self._unknown_below:
            return _unsearched(self._problem, load, Outcome.UNKNOWN_SURFACE)
        if self._furthest is not None and load.value > self._furthest.load.value:
            self._furthest = None
        if self._furthest is not None and load == self._furthest.load:
            self._last = self._furthest = replace(self._furthest, convolutions=0)
        else:
            self._last = self._solved(load)
        return self._last

    def _solved(self, load: Load) -> Contact:
        """Solve the contact under a load, and for its tangents."""
        contact, window = self._found(load)
        if contact.outcome is not Outcome.CONVERGED:
            lost = {"none": -np.inf, "dents": load.value, "path": np.inf}
            self._unknown_below = lost[contact.problem.law.memory]
            self._problem = replace(self._problem, shares=contact.problem.shares)
            return replace(contact, load=load)
        self._largest = load.value if self._largest is None else max(self._largest, load.value)
        if contact.separation is not self._problem.separation:
            self._furthest = None
        self._problem = contact.problem
        answer = response(contact, window, self._guesses(contact.nodes), self._method)
        spent = contact.convolutions + answer.convolutions
        return replace(contact, load=load, response=answer, convolutions=spent)

    def _found(self, load: Load) -> tuple[Contact, GridWindow]:
        """Solve the contact under a load; return it with the window in which it was found."""
        memory = self._problem.law.memory
        if memory == "path":
            return self._led_to_gaps(load)
        if memory == "dents":
            return self._dented(load)
        return self._settled(load, self._problem, self._method)

    def _dented(self, load: Load) -> tuple[Contact, GridWindow]:
        """Solve for elastic bodies first, unless they have yielded and meet their largest load.

        That bodies yield shows before their elastic contact is found.
        """
        is_largest = self._largest is None or load.value > self._largest
        problem = replace(self._problem, is_elastic=not (is_largest and self._has_yielded))
        contact, window = self._settled(load, problem, self._method)
        if contact.problem.exceeds(contact.nodes, contact.pressure):
            problem = replace(problem, is_elastic=False)
            if np.isfinite(contact.force):  # else there is nothing to start from
                self._start = _under(problem, contact)
            contact, window = self._settled(load, problem, self._method, contact.convolutions)
        self._has_yielded |= not contact.problem.is_elastic
        return contact, window

    def _led_to_gaps(self, load: Load) -> tuple[Contact, GridWindow]:
        """Solve the contact in rounds, in which shares of the pull and gaps are led to each other.

        Contacts of shares that do not fit yet are solved roughly, in single precision while that
        serves.
        """
        near, rtol, single = self._near_rounds(load), _LARGEST_TOLERANCE, True
        if contact := near.contact():
            return contact, GridWindow.everywhere(contact.problem)
        problem, self._start, spent = near.problem, near.start, near.convolutions
        rounds = Rounds(problem.pull, problem.shares.above_zero)
        while True:
            method = self._method.to(rtol, single)
            contact, window = self._settled(load, problem, method, spent)
            spent = contact.convolutions
            problem = contact.problem  # which does not hold the bounds any more
            if contact.outcome is Outcome.STALLED:
                if contact.residuals.worst <= self._method.rtol:
                    contact = replace(contact, outcome=Outcome.CONVERGED)
                elif method.precision == "float32" and self._method.precision == "mixed":
                    single = False
                    continue
            if contact.outcome is not Outcome.CONVERGED:
                return contact, window
            following = rounds.then(contact.gap.ravel())
            misfit = following.misfit / contact.length_scale
            rtol = min(_MISFIT_SHARE * max(misfit, self._method.rtol), _LARGEST_TOLERANCE)
            if misfit > self._method.rtol:
                rounds, problem = following, replace(problem, shares=following.shares)
            else:  # the shares fit, and their contact is to be known well
                residuals = replace(contact.residuals, misfit=misfit)
                contact = replace(contact, residuals=residuals)
                if method.rtol <= self._method.rtol:
                    return contact, window
            if spent >= self._method.max_iterations:
                return replace(contact, outcome=Outcome.MAX_ITERATIONS), window
            self._start = _under(problem, contact)
            del contact, window, following  # none is held while the next is solved

    def _near_rounds(self, load: Load) -> NearRounds:
        """Return the search near the contact, which takes the start and the shares so far."""
        problem, start = replace(self._problem), self._start
        self._problem, self._start = replace(problem, shares=Shares.none()), None
        if start is None and not _known(problem, load, for_first_time=True):
            start, problem = first_guess(problem, load)
        return NearRounds(problem, load, start, self._method)

    def _settled(
        self, load: Load, problem: Problem, method: Method, spent: int = 0
    ) -> tuple[Contact, GridWindow]:
        """Solve the contact of bodies with fixed bounds, in the window in which they can touch."""
        most = method.max_iterations
        if contact := _known(problem, load, for_first_time=self._furthest is None):
            return contact, GridWindow.everywhere(problem)
        if load.force is not None:
            load = Load(force=_attainable(load.force, problem))
        if self._start is None:
            self._start, problem = first_guess(problem, load)
        window = GridWindow.of(problem, load, self._start)
        while True:
            method = replace(method, max_iterations=max(1, most - spent))
            turns = window.turns(load, self._start, method)
            self._start = None
            contact = window.contact(turns)
            spent += contact.convolutions
            holds = window.holds(contact)
            if holds or spent >= most:
                outcome = contact.outcome if holds else Outcome.MAX_ITERATIONS
                return replace(contact, outcome=outcome, convolutions=spent), window
            self._start, window = contact.contact_set, GridWindow.everywhere(problem)

    def settled_from(
        self, start: ContactSet | None, problem: Problem, load: Load, method: Method
    ) -> tuple[Contact, GridWindow]:
        """Solve the contact of other bodies from a start, and return it with its window."""
        self._start = start
        return self._settled(load, problem, method)

    def _guesses(self, nodes: InGrid) -> tuple[Real, Real] | None:
        """Return dp/dF of the contact before, on loading and on unloading, on nodes of this one."""
        if self._followed is None or not self._followed[0].size:
            return None
        before, *rates = self._followed
        places = InPatch(np.minimum(np.searchsorted(before, nodes), before.size - 1))
        known = before[places] == nodes
        loading, unloading = (np.where(known, each[places], 0.0) for each in rates)
        return loading, unloading

    def _prepare(self, load: Load, contact: Contact) -> None:
        """Choose the contact from which the next load starts, if any, and follow its tangent."""
        self._start = self._followed = None
        if contact.response is None:
            return
        if self._problem.law.memory == "dents":
            if load.value <= contact.load.value:
                self._furthest = self._furthest or contact
            elif self._furthest is not None and load.value > self._furthest.load.value:
                contact = self._furthest
        answer = contact.response
        if answer is None or not answer.converged or not contact.nodes.size:
            return
        follows = slice(None) if contact.problem.law.only_pushes else ~contact.pulling
        loading, unloading = (
            each.pressure_per_force[follows] for each in (answer.loading, answer.unloading)
        )
        self._followed = among(contact.nodes, follows), loading, unloading
        tangent = answer.loading if load.value > contact.load.value else answer.unloading
        self._start = _predicted(contact, tangent, load)


def _under(problem: Problem, contact: Contact) -> ContactSet:
    """Return a contact as the start under other bounds: nodes that pull are at the lower one."""
    low = problem.bounds_at(contact.nodes).low
    pressure = np.where(contact.pulling, low, contact.pressure)
    bears = pressure != 0
    return ContactSet(among(contact.nodes, bears), pressure[bears], contact.depth)


def _attainable(force: float, problem: Problem) -> float:
    """Return slightly less where nodes at an upper bound alone may bear a force.

    With no node below its bound the depth would be open.
    """
    nodes = force / problem.bounds.largest_force(problem.grid.cell_area)
    same = abs(nodes - np.round(nodes)) < _SAME_FORCE * nodes
    return force * (1 - 2 * _SAME_FORCE) if same else force


def _known(problem: Problem, load: Load, *, for_first_time: bool) -> Contact | None:
    """Return the contact where it needs no search: bodies apart, or no finite pressures do."""
    depth = load.depth
    if problem.is_apart_under(load) and not problem.shares.above_zero.nodes.size:
        return _unsearched(problem, load, Outcome.CONVERGED)
    # full contact is rigid where the mean is free; rounding counts where loads came back to it
    rigid = depth is not None and problem.grid.half_space.mean_is_free and for_first_time
    deep = rigid and load.value >= problem.separation.mean()
    if deep and problem.bounds.largest_force(1.0) == np.inf:
        return _unsearched(problem, load, Outcome.STALLED, problem.separation.size)
    return None


def _unsearched(problem: Problem, load: Load, outcome: Outcome, loaded: int = 0) -> Contact:
    """Return bodies that do not touch, or just touch, or infinite pressures on all their nodes."""
    depth = problem.touch if load.depth is None else load.depth
    nowhere = np.zeros(loaded, dtype=bool)
    largest = np.inf if loaded else 0.0
    return Contact(
        problem=problem,
        depth=depth,
        force=largest,
        nodes=InGrid(np.arange(loaded)),
        pressure=np.full(loaded, np.inf),
        plastic=nowhere,
        pulling=nowhere,
        looked_at=None,
        gaps=np.zeros(loaded) if loaded else problem.separation.ravel() - depth,
        length_scale=1.0,
        residuals=Residuals(gap=largest),
        outcome=outcome,
        convolutions=0,
        load=load,
    )


def _predicted(contact: Contact, tangent: Tangent, load: Load) -> ContactSet | None:
    """Follow the tangent to p + dF dp/dF, and find the nodes in contact then; None if it is far."""
    if load.force is None:
        change = tangent.stiffness * (load.value - contact.depth)
    else:
        change = load.force - contact.force
    # Where the force changes by more than nodes bear, coarser grids guess better than the tangent,
    # but in full contact that pulls there is nothing to guess.
    absolute_force = contact.problem.grid.cell_area * float(np.abs(contact.pressure).sum())
    stays = np.isinf(tangent.stiffness) and not contact.problem.law.only_pushes
    if not (tangent.stiffness > 0 and (abs(change) < absolute_force or stays)):
        return None
    pressure = contact.pressure + change * tangent.pressure_per_force
    loaded = pressure > 0
    if not contact.problem.law.only_pushes:  # pulls are those of the shares
        loaded = ~contact.pulling
    depth = contact.depth + change / tangent.stiffness
    return ContactSet(among(contact.nodes, loaded), pressure[loaded], depth)
