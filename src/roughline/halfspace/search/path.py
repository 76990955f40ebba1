"""A path of loads: each contact starts from an earlier one, extrapolated along its tangent.

Loads may rise and fall. Where a law keeps dents, bodies are elastic below the largest load so far,
and on reloading the contact passes through the same states again. A load beyond the largest one
therefore starts from the contact under that, as if there had been no unloading.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.search.cascade import first_guess
from roughline.halfspace.search.problem import Contact, ContactSet, Load, Method, Outcome, Problem
from roughline.halfspace.search.residuals import Residuals
from roughline.halfspace.search.tangent import Response, Tangent, response
from roughline.halfspace.search.turns import Turns
from roughline.halfspace.search.window import Window

# Where the force changes by more than this, over the force so far, coarser grids guess better than
# the tangent.
_LARGEST_CHANGE = 1.0


def solve_path(
    problem: Problem, loads: Sequence[Load], method: Method
) -> Iterator[tuple[Contact, Response | None]]:
    """Solve the contact under each load in turn; each meets the surfaces that the last one left.

    Parameters
    ----------
    problem : Problem
        The untouched bodies and the half-space.
    loads : sequence of Load
        Loads, all by force or all by depth.
    method : Method
        Tolerance, bound on the convolutions and precision.

    Yields
    ------
    tuple of Contact and Response
        For each load; without a response where the contact was not certified.
    """
    path = _Path(problem, method)
    for load, next_load in zip_longest(loads, loads[1:]):
        yield path.under(load, next_load)


class _Path:
    """The contact along a path of loads.

    Parameters
    ----------
    problem, method
        As for :func:`solve_path`.
    """

    def __init__(self, problem: Problem, method: Method) -> None:
        self._problem = problem
        self._method = method
        self._start: ContactSet | None = None
        self._last: _Tangents | None = None
        self._before: float | None = None
        self._largest: float | None = None
        self._furthest: _Solved | None = None  # under the largest load, until a larger one follows
        self._unknown_below = -np.inf  # the largest load that was not solved

    def under(self, load: Load, next_load: Load | None) -> tuple[Contact, Response | None]:
        """Return the contact under a load, and prepare the next."""
        if load.value < self._unknown_below:
            return _apart(self._problem, load, Outcome.UNKNOWN_SURFACE), None
        if self._furthest is not None and load.value > self._furthest.load.value:
            self._furthest = None
        if self._furthest is not None and load == self._furthest.load:
            self._prepare(next_load, self._furthest)
            return self._furthest.again
        found, window = self._found(load)
        contact = window.contact(found)
        self._before = load.value
        if contact.outcome is not Outcome.CONVERGED:
            self._last = None
            lost = {"none": -np.inf, "dents": load.value, "path": np.inf}
            self._unknown_below = lost[contact.problem.law.memory]
            self._problem = self._problem.obeying(contact.problem.law)
            return contact, None
        self._largest = load.value if self._largest is None else max(self._largest, load.value)
        if contact.separation is not self._problem.separation:
            self._furthest = None
        self._problem = contact.problem
        if not contact.nodes.size:
            self._prepare(next_load, None)
            return contact, _NO_RESPONSE
        start = None if self._last is None else self._last.on(contact.nodes)
        solved = _Solved(load, contact, response(found, start, self._method))
        self._prepare(next_load, solved)
        return contact, solved.response

    def _found(self, load: Load) -> tuple[Contact, Window]:
        """Solve the contact under a load, by one law after the other until one settles it.

        The contact is that in a window.
        """
        law = self._problem.law.start(load.value, self._before, self._largest)
        if self._furthest is None and self._problem.is_beyond_full_contact(load):
            law = law.bounded()
        spent = 0
        while True:
            found, window = self._settled(load, law, spent)
            # that bodies yield shows before their elastic contact is found
            told = found.outcome is Outcome.CONVERGED or found.problem.law.memory == "dents"
            following = window.problem.law.then(window.contact(found)) if told else None
            if following is None:
                return found, window
            self._start, law = window.contact(found).contact_set, following
            spent = found.convolutions

    def _settled(self, load: Load, law: ContactLaw, spent: int) -> tuple[Contact, Window]:
        """Solve the contact by a law, in the window in which bodies can touch."""
        problem = self._problem.obeying(law)
        if _is_apart(problem, load):
            return _apart(problem, load, Outcome.CONVERGED), Window.whole(problem)
        if load.force is not None:
            load = Load(force=law.attainable(load.force, problem.grid.cell_area))
        if self._start is None:
            problem = self._guess(problem, load)
        assert self._start is not None
        window = Window.of(problem, load, self._start)
        self._start = window.inside(self._start)
        while True:
            method = replace(
                self._method, max_iterations=max(1, self._method.max_iterations - spent)
            )
            found = Turns(window.bodies, load, self._taken_start(), method).contact()
            spent += found.convolutions
            if window.holds(found) or spent >= self._method.max_iterations:
                held = found.outcome if window.holds(found) else Outcome.MAX_ITERATIONS
                return replace(found, outcome=held, convolutions=spent), window
            self._start, window = window.contact(found).contact_set, Window.whole(problem)

    def _guess(self, problem: Problem, load: Load) -> Problem:
        """Start from a first guess, and return the bodies under the law that it foresees."""
        self._start, law = first_guess(problem, load)
        if law is not problem.law:
            problem = problem.obeying(law)
            self._start, _ = first_guess(problem, load)
        return problem

    def _taken_start(self) -> ContactSet:
        """Return where a search starts, and hold it no longer."""
        start, self._start = self._start, None
        assert start is not None
        return start

    def _prepare(self, load: Load | None, solved: _Solved | None) -> None:
        """Choose the contact from which the next load starts, and follow its tangent.

        Parameters
        ----------
        load : Load or None
            The next load; None if there is none.
        solved : _Solved or None
            The last load; None where it left the bodies apart.
        """
        self._start, self._last = None, None
        if load is None:
            return
        if self._problem.law.memory == "dents":
            falls = solved is not None and load.value <= solved.load.value
            if falls and self._furthest is None:
                self._furthest = solved
            if self._furthest is not None and load.value > self._furthest.load.value:
                solved = self._furthest
        if solved is None or not solved.response.converged:
            return
        contact, answer = solved.contact, solved.response
        self._last = _Tangents.of(solved)
        rises = load.value > solved.load.value
        tangent = answer.loading if rises else answer.unloading
        change = _change(contact, tangent, load)
        if tangent.stiffness > 0 and abs(change) < _LARGEST_CHANGE * abs(contact.force):
            self._start = _predicted(change, contact, tangent)


@dataclass(frozen=True, eq=False)
class _Solved:
    """A load, the contact under it, and how that answers a change of load."""

    load: Load
    contact: Contact
    response: Response

    @property
    def again(self) -> tuple[Contact, Response]:
        """The same under the same load once more, which takes no convolutions."""
        tangents = self.response.loading, self.response.unloading
        loading, unloading = (replace(each, convolutions=0) for each in tangents)
        return replace(self.contact, convolutions=0), Response(loading, unloading)


@dataclass(frozen=True, eq=False)
class _Tangents:
    """Tangents of a contact, on its nodes, from which those of the next are sought.

    Attributes
    ----------
    nodes : ndarray of int
        Nodes in contact.
    loading, unloading : ndarray, shape (nodes,)
        dp/dF of both. [1 / area]
    """

    nodes: Indices
    loading: Real
    unloading: Real

    @classmethod
    def of(cls, solved: _Solved) -> _Tangents:
        """Take what is needed of a solved load."""
        answer = solved.response
        return cls(
            solved.contact.nodes,
            answer.loading.pressure_per_force,
            answer.unloading.pressure_per_force,
        )

    def on(self, nodes: Indices) -> tuple[Real, Real]:
        """Return both on other nodes, zero on those that had none."""
        where = np.searchsorted(self.nodes, nodes)
        where[where == self.nodes.size] = 0
        known = self.nodes[where] == nodes
        transferred = np.zeros((2, nodes.size))
        for values, before in zip(transferred, (self.loading, self.unloading), strict=True):
            values[known] = before[where[known]]
        return transferred[0], transferred[1]


_APART = Tangent(0.0, np.empty(0), 0, converged=True)
_NO_RESPONSE = Response(_APART, _APART)


def _is_apart(problem: Problem, load: Load) -> bool:
    """Whether no node bears anything under a load: nothing touches, and nothing pulls."""
    if not problem.law.only_pushes and Bounds.of(problem.law, None).pulled.size:
        return False
    return load.value == 0 if load.depth is None else load.depth <= problem.touch


def _apart(problem: Problem, load: Load, outcome: Outcome) -> Contact:
    """Return bodies that do not touch, or just touch, as a contact without nodes."""
    depth = problem.touch if load.depth is None else load.depth
    none, nowhere = np.empty(0), np.empty(0, dtype=bool)
    return Contact(
        problem=problem,
        depth=depth,
        force=0.0,
        nodes=np.empty(0, dtype=np.intp),
        pressure=none,
        plastic=nowhere,
        pulling=nowhere,
        looked_at=None,
        gaps=problem.separation.ravel() - depth,
        residuals=Residuals(),
        outcome=outcome,
        convolutions=0,
    )


def _change(contact: Contact, tangent: Tangent, load: Load) -> float:
    """Return the change of force to a load; along the tangent, where the depth is given."""
    if load.force is not None:
        return load.force - contact.force
    assert load.depth is not None
    return tangent.stiffness * (load.depth - contact.depth)


def _predicted(change: float, contact: Contact, tangent: Tangent) -> ContactSet:
    """Follow the tangent to p + dF dp/dF, and find the nodes that are in contact then."""
    pressure = contact.pressure + change * tangent.pressure_per_force
    loaded = pressure > 0
    if not contact.problem.law.only_pushes:
        loaded[:] = True
    depth = contact.depth + change / tangent.stiffness
    return ContactSet(contact.nodes[loaded], pressure[loaded], depth)
