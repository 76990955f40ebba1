"""A path of loads with friction: each state follows from the last shear and the last slide.

References
----------
.. [1] P. D. Panagiotopoulos, "A nonlinear programming approach to the unilateral contact-, and
   friction-boundary value problem in the theory of elasticity", Ing.-Arch. 44, 421-432 (1975).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from roughline.computing.arrays import InGrid, Real
from roughline.halfspace.friction.law import Friction
from roughline.halfspace.friction.rates import Going
from roughline.halfspace.friction.sheared_nodes import ShearedBodies
from roughline.halfspace.friction.slid import ShearLoad, Slid, apart, unknown
from roughline.halfspace.friction.slide_step import SlideStep
from roughline.halfspace.friction.vectors import within
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.search.path import LoadPath
from roughline.halfspace.search.problem import Contact, Load, Method, Outcome, Problem, Residuals
from roughline.halfspace.search.response import Response
from roughline.halfspace.search.tangent import response

_TURN_SHARE = 0.1  # of what is wrong before a turn, to which it is solved
_MOST_ALTERNATIONS = 60  # between pressures and shear
_ROUGHEST_TURN = 1e-2  # tolerance of the first of them
_ALTERNATION_SHARE = 0.3  # of the tolerance, to which both agree


class SlidePath:
    """The contact with friction along a path of loads."""

    def __init__(self, problem: Problem, friction: Friction, method: Method) -> None:
        self._path = LoadPath(problem, method)
        self._problem, self._method = problem, method
        self._bodies = ShearedBodies(problem, friction, method)
        self._last: Slid | None = None
        self._lost: Contact | None = None  # the first that was not solved

    def under(self, load: Load, shear: ShearLoad) -> Slid:
        """Return the state under the next load."""
        if self._lost is not None:
            return replace(unknown(self._lost, Outcome.UNKNOWN_SURFACE), convolutions=0)
        last = self._last
        if last is not None and last.load == shear and last.contact.load == load:
            return last.again
        if self._problem.grid.half_space.is_coupled:
            found = self._coupled(load, shear)
        else:
            found = self._uncoupled(load, shear)
        if found.outcome is Outcome.CONVERGED:
            self._last = found
        else:
            self._lost = found.contact
        return found

    def _uncoupled(self, load: Load, shear: ShearLoad) -> Slid:
        """Find the pressures first, on which shear has no effect."""
        last = self._last
        if last is not None and last.contact.load == load:
            contact = replace(last.contact, convolutions=0)
        else:
            contact = self._path.under(load)
        if contact.outcome is not Outcome.CONVERGED:
            return unknown(contact, contact.outcome)
        if contact.response is None or not contact.nodes.size:
            return apart(contact, shear, last)
        return SlideStep(self._bodies, contact, last).under(shear)

    def _coupled(self, load: Load, shear: ShearLoad) -> Slid:
        """Find pressures under the last shear, and shear under these, in turn [1]_.

        Shear displaces into the body as if that had another shape. Both are solved as well as they
        agree, and to the tolerance in the end.
        """
        last, problem = self._last, self._problem
        everywhere = problem.grid.nodes(InGrid(np.arange(problem.separation.size)))
        left = problem if last is None else last.contact.problem  # by the loads so far
        found, convolutions = None if left.is_apart_under(load) else self._led(load, shear), 0
        start, lift = None, np.zeros(problem.separation.shape)
        if found is not None:
            start = found.contact.contact_set
            lift = self._lift(found.contact.nodes, found.shear, everywhere)
        before = None if last is None else self._moved_by(last, everywhere)
        rtol, error, step = self._method.rtol, 1.0, None
        for _ in range(_MOST_ALTERNATIONS):
            aim = max(rtol, min(_ROUGHEST_TURN, _TURN_SHARE * error))
            method = replace(self._method, rtol=aim)
            lifted = replace(problem, separation=left.separation + lift)
            contact, window = self._path.settled_from(start, lifted, load, method)
            convolutions += contact.convolutions
            contact = replace(contact, load=load)
            if contact.outcome is not Outcome.CONVERGED:
                return unknown(contact, contact.outcome)
            dented = left.separation + (contact.separation - lifted.separation)
            unlifted = replace(contact, problem=replace(left, separation=dented))
            if not contact.nodes.size and lift.any():  # which nothing does where nothing touches
                start, found, step, lift = None, None, None, np.zeros_like(lift)
                continue
            if not contact.nodes.size:
                answer = response(contact, window, None, self._method)
                return apart(replace(unlifted, response=answer), shear, last)
            step = SlideStep(self._bodies, unlifted, last, (found, before, step), aim)
            found = step.under(shear)
            convolutions += step.convolutions
            if found.outcome is not Outcome.CONVERGED:
                return found
            start = contact.contact_set
            change = self._lift(contact.nodes, found.shear, everywhere) - lift
            lift, error = lift + change, float(np.abs(change).max()) / contact.length_scale
            if aim <= rtol and error <= _ALTERNATION_SHARE * rtol:
                break
        else:
            return replace(unknown(contact, Outcome.STALLED), residual=error)
        answer = response(contact, window, None, self._method)
        bodies, gaps = unlifted.problem, (contact.gap + change).ravel()
        contact = replace(contact, problem=bodies, looked_at=None, gaps=gaps)
        contact = replace(contact, residuals=_more_open(contact.residuals, error))
        tangents, stiffness = step.coupled_tangents(found)
        contact = replace(contact, response=_with_stiffness(answer, stiffness))
        convolutions += answer.convolutions + tangents.convolutions
        found = replace(found, sticks=tangents.sticks, tangents=tangents)
        return replace(found, contact=contact, convolutions=convolutions)

    def _led(self, load: Load, shear: ShearLoad) -> Slid | None:
        """Return about the state under the next load: the last, led along its tangent.

        None where nothing touched.
        """
        last = self._last
        if last is None or not last.contact.nodes.size:
            return None
        before, tangents = last.contact, last.tangents
        if tangents is None or tangents.coupled is None:
            return last
        by_force, by_shear = load.force is not None, shear.force is not None
        normal = load.value - (before.force if by_force else before.depth)
        along = np.array(shear.force if by_shear else shear.slide, np.float64)
        along -= last.force if by_shear else last.slide
        on, back = tangents.coupled
        tangent = on if last.force @ along >= 0 <= normal else back
        ways, more = tangent.led(Going(normal, (along[0], along[1]), by_force, by_shear))
        pressure = np.maximum(before.pressure + more[:, 2], 0.0)
        bound = self._bodies.friction.bound(pressure, before.nodes)
        return replace(
            last,
            contact=replace(before, pressure=pressure, depth=before.depth + ways[2]),
            shear=within(last.shear + more[:, :2], bound),
            slide=last.slide + ways[:2],
        )

    def _moved_by(self, last: Slid, everywhere: GridNodes) -> Real:
        """Return how a state displaces all of the grid along the surface."""
        nodes, exact = self._problem.grid.nodes(last.contact.nodes), self._bodies.exact
        moved = exact.by_pressure(last.contact.pressure, nodes, everywhere)
        moved += exact.displacement(last.shear, nodes, everywhere)
        return moved

    def _lift(self, nodes: InGrid, shear: Real, everywhere: GridNodes) -> Real:
        """Return how shear displaces all of the grid into the body."""
        grid = self._problem.grid
        moved = self._bodies.exact.into_body(shear, grid.nodes(nodes), everywhere)
        return moved.reshape(self._problem.separation.shape)


def slide_path(
    problem: Problem,
    friction: Friction,
    loads: Sequence[tuple[Load, ShearLoad]],
    method: Method,
) -> Iterator[Slid]:
    """Solve for the state under each load in turn."""
    path = SlidePath(problem, friction, method)
    for load, shear in loads:
        yield path.under(load, shear)


def _with_stiffness(answer: Response, stiffness: tuple[float, float]) -> Response:
    """Return how a contact answers, with the stiffness of bodies that are coupled."""
    on, back = stiffness
    return Response(
        replace(answer.loading, stiffness=on), replace(answer.unloading, stiffness=back)
    )


def _more_open(residuals: Residuals, error: float) -> Residuals:
    """Return residuals of gaps that are known up to an error."""
    gap, penetration = residuals.gap + error, residuals.penetration + error
    return replace(residuals, gap=gap, penetration=penetration)
