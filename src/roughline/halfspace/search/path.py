"""A path of loads: each contact starts from an earlier one, extrapolated along its tangent.

Loads may rise and fall. Below the largest load so far the bodies are elastic: all nodes spring
back, and on reloading the contact passes through the same states again. A load beyond the largest
one therefore starts from the contact under that, as if there had been no unloading.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.halfspace.laws.conditions import Residuals, UnilateralContact
from roughline.halfspace.search.cascade import first_guess
from roughline.halfspace.search.contact_set import ContactSet
from roughline.halfspace.search.correction import solve
from roughline.halfspace.search.state import Contact, Load, Method, Outcome, Problem
from roughline.halfspace.search.tangent import Response, Tangent, response

# Where the force changes by more than this, over the force so far, coarser grids guess better than
# the tangent.
_LARGEST_CHANGE = 1.0
# A guess whose pressures exceed the hardness so many times leaves no doubt that nodes yield.
_BEYOND_DOUBT = 3.0

# Forces that differ by no more than this part count as one, whatever the tolerance.
_SAME_FORCE = 1e-13


def solve_path(
    problem: Problem, loads: Sequence[Load], method: Method
) -> Iterator[tuple[Contact, Response | None]]:
    """Solve the contact under each load in turn; each meets the surfaces that the last one left.

    Parameters
    ----------
    problem : Problem
        The untouched bodies and the half-space.
    loads : sequence of Load
        Loads, all by force or all by depth. A load of zero leaves the bodies just apart.
    method : Method
        Tolerance, bound on the convolutions and precision.

    Yields
    ------
    tuple of Contact and Response
        For each load; without a response where the contact was not certified.
    """
    path = _Path(problem, method)
    del problem  # once surfaces are indented, the untouched ones need no memory
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
        self._yielding = problem.conditions
        # as long as no node reaches the hardness, the contact is the elastic one to the last bit
        self._yields = False
        self._problem = replace(problem, conditions=UnilateralContact())
        self._method = method
        self._start: ContactSet | None = None
        self._last: _Tangents | None = None
        self._furthest: _Solved | None = None  # under the largest load, until a larger one follows
        self._unknown_below = 0.0  # the largest load that was not solved

    def under(self, load: Load, next_load: Load | None) -> tuple[Contact, Response | None]:
        """Return the contact under a load, and prepare the next."""
        if load.value < self._unknown_below:
            return apart(self._problem, load, Outcome.UNKNOWN_SURFACE), None
        furthest = self._furthest
        if furthest is not None and load == furthest.load:
            self._prepare(next_load, furthest)
            return furthest.again
        if load.value == 0 or (load.depth is not None and load.depth <= self._problem.touch):
            self._prepare(next_load, None)
            return apart(self._problem, load, Outcome.CONVERGED), _NO_RESPONSE
        contact = self._contact(load)
        if contact.outcome is not Outcome.CONVERGED:
            self._last = None
            if self._yielding.largest_pressure < np.inf:
                self._unknown_below = load.value
            return contact, None
        if contact.separation is not self._problem.separation:
            self._problem = replace(self._problem, separation=contact.separation)
            self._furthest = None
        start = None if self._last is None else self._last.on(contact.nodes)
        solved = _Solved(load, contact, response(self._problem, contact, start, self._method))
        self._prepare(next_load, solved)
        return contact, solved.response

    def _contact(self, load: Load) -> Contact:
        """Solve the contact under a load; elastic until a node exceeds the hardness."""
        if self._furthest is not None and load.value > self._furthest.load.value:
            self._furthest = None
        problem, most = self._elastic_or_yielding(load), self._yielding.largest_pressure
        if self._start is None:
            self._start, largest = first_guess(problem, load)
            if largest > _BEYOND_DOUBT * most and problem.conditions is not self._yielding:
                problem = replace(problem, conditions=self._yielding)
                self._start, _ = first_guess(problem, load)
        contact = self._solve(problem, load)
        if contact.pressure.max() > most:
            problem = replace(problem, conditions=self._yielding)
            pressure = self._yielding.projected(contact.pressure)
            self._start, spent = ContactSet(contact.nodes, pressure), contact.convolutions
            del contact, pressure
            contact = self._solve(problem, load, spent)
            contact = replace(contact, convolutions=contact.convolutions + spent)
        self._yields |= problem.conditions is self._yielding
        return contact

    def _solve(self, problem: Problem, load: Load, spent: int = 0) -> Contact:
        """Solve a contact from its start; it has spent some of its convolutions before.

        Where nodes at the hardness alone would bear the force, it is made slightly less: with no
        elastic node among them the depth would be open.
        """
        if problem.conditions is self._yielding and load.force is not None:
            nodes = load.force / (self._yielding.largest_pressure * problem.operator.cell_area)
            whole = round(nodes)
            if whole and abs(nodes - whole) <= _SAME_FORCE * whole:
                load = Load(force=load.force * (1 - 2 * _SAME_FORCE))
        left = max(1, self._method.max_iterations - spent)
        method = replace(self._method, max_iterations=left)
        return solve(problem, load, self._taken_start(), method)

    def _taken_start(self) -> ContactSet:
        """Return where a search starts, and hold it no longer."""
        start, self._start = self._start, None
        assert start is not None
        return start

    def _elastic_or_yielding(self, load: Load) -> Problem:
        """Return the bodies as the last load left them, elastic if they may be under this one.

        They are until a node reaches the hardness, and under less than the largest load so far.
        """
        beyond_full_contact = (
            load.depth is not None
            and self._problem.operator.mean_is_free
            and load.depth >= float(self._problem.separation.mean())
        )
        if (self._yields or beyond_full_contact) and self._furthest is None:
            return replace(self._problem, conditions=self._yielding)
        return self._problem

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
        if solved is not None and load.value <= solved.load.value and self._furthest is None:
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
        if tangent.stiffness > 0 and abs(change) < _LARGEST_CHANGE * contact.force:
            self._start = _predicted(self._problem, change, contact, tangent)


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


def apart(problem: Problem, load: Load, outcome: Outcome) -> Contact:
    """Return bodies that do not touch, or just touch, as a contact without nodes."""
    depth = problem.touch if load.depth is None else load.depth
    none = np.empty(0)
    return Contact(
        depth=depth,
        force=0.0,
        nodes=np.empty(0, dtype=np.intp),
        pressure=none,
        plastic=np.empty(0, dtype=bool),
        gap=np.asarray(problem.separation) - depth,
        separation=problem.separation,
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


def _predicted(problem: Problem, change: float, contact: Contact, tangent: Tangent) -> ContactSet:
    """Follow the tangent to p + dF dp/dF, and find the nodes that are in contact then."""
    pressure = contact.pressure + change * tangent.pressure_per_force
    pressure = problem.conditions.projected(pressure)
    loaded = pressure > 0
    return ContactSet(contact.nodes[loaded], pressure[loaded])
