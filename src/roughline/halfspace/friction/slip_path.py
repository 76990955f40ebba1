"""A path of loads with friction: each state follows from the last shear and the last slide.

Displacements are linear in the tractions, so that the path has left nothing else. A node has moved
along the other body by t = slide - last slide - (u - last u) since the last load. One that was in
contact has slipped by that. A node that joins had a gap h, and a part of t is on its way to
contact. With its own pressure p and shear q, which displace it by m p and m' q, it came nearer by
h + m p, and along by t + m' q. If both went evenly it has slipped since by

    w = m p / (h + m p) · (t - (m' / m) (h / p) q),

which is as if it had a spring (m' / m) h / p of its own. It sticks where q / p is m / m' times
t / h. Along a straight path, with no displacement across shear (n = 0), that is exact [1]_, as all
moves in proportion then. Where a node yields, the dent that it takes adds to m p.

References
----------
.. [1] R. D. Mindlin and H. Deresiewicz, "Elastic spheres in contact under varying oblique forces",
   J. Appl. Mech. 20, 327-344 (1953): under dQ/dF < mu nothing slips.
.. [2] P. D. Panagiotopoulos, "A nonlinear programming approach to the unilateral contact-, and
   friction-boundary value problem in the theory of elasticity", Ing.-Arch. 44, 421-432 (1975).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from roughline.computing.arrays import InGrid, Mask, Real
from roughline.halfspace.friction.discs import Discs, DiscSearch, Linear, Sheared
from roughline.halfspace.friction.law import Friction
from roughline.halfspace.friction.rates import Going, Rim
from roughline.halfspace.friction.tangents import ShearTangents, coupled_tangents, shear_tangents
from roughline.halfspace.friction.vectors import on_nodes, within
from roughline.halfspace.inverse.approximate_inverse import preconditioner
from roughline.halfspace.inverse.cache import inverse_on
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.operators.restricted_shear import RestrictedShear
from roughline.halfspace.operators.shear import ShearConvolution, at_origin, shear_on_grid
from roughline.halfspace.search.path import LoadPath
from roughline.halfspace.search.problem import Contact, Load, Method, Outcome, Problem, Residuals
from roughline.halfspace.search.response import Response
from roughline.halfspace.search.tangent import response

_SLIDES_FROM = 1 - 1e-9  # of what friction bears, from which on it bears no more
_SAME_HEIGHT = 1e-9  # of the approach, up to which nodes are as high as the highest
_MOST_TURNS = 40  # of corrections by the exact operator
_TURN_SHARE = 0.1  # of what is wrong before a turn, to which it is solved
_ROUGH_SHARE = 5e-3  # the same of a turn with the rough operator, and what that errs by
_TOTAL_SHARE = 0.01  # of the tolerance, to which the shear force is kept
_MOST_ALTERNATIONS = 60  # between pressures and shear
_ROUGHEST_TURN = 1e-2  # tolerance of the first of them
_ALTERNATION_SHARE = 0.3  # of the tolerance, to which both agree


@dataclass(frozen=True)
class ShearLoad:
    """One load along the surface, by its force or by the slide; the other is None."""

    force: tuple[float, float] | None = None  # total shear force [force]
    slide: tuple[float, float] | None = None  # of the indenter [length]


@dataclass(frozen=True, eq=False)
class Slid:
    """State of a contact with friction under one load."""

    contact: Contact
    outcome: Outcome
    shear: Real  # on the contact nodes, shape (nodes, 2), on the half-space [pressure]
    displacement: Real  # there, along the surface [length]
    slide: Real  # of the indenter, shape (2,) [length]
    force: Real  # shape (2,)
    slip: Real  # since the last load, shape (nodes, 2) [length]
    sticks: Mask  # where nodes do not slip on
    limit: float  # largest shear force that friction bears [force]
    residual: float  # over its scale [1]
    convolutions: int
    load: ShearLoad | None = None
    went: Going | None = None  # how loads went to it
    tangents: ShearTangents | None = None

    @property
    def contact_as_solved(self) -> Contact:
        """The contact, with how far friction is from its conditions, and without what is lost."""
        contact, solved = self.contact, self.outcome is Outcome.CONVERGED
        residuals = replace(contact.residuals, slip=self.residual if self.shear.size else 0.0)
        return replace(
            contact,
            outcome=self.outcome,
            residuals=residuals,
            convolutions=self.convolutions,
            response=contact.response if solved else None,
        )

    @property
    def again(self) -> Slid:
        """The same under the same loads, after which nothing has slipped further."""
        contact, nothing = replace(self.contact, convolutions=0), np.zeros_like(self.slip)
        return replace(self, contact=contact, slip=nothing, convolutions=0)

    @property
    def dissipated(self) -> float:
        """Energy that the slip since the last load has dissipated. [force length]"""
        area = self.contact.problem.grid.cell_area
        return area * float(np.vdot(self.shear, self.slip))


@dataclass(frozen=True, eq=False)
class _Bodies:
    """Untouched bodies, the friction between them, and how they are solved."""

    problem: Problem
    friction: Friction
    method: Method

    @cached_property
    def exact(self) -> ShearConvolution:
        """How shear displaces them."""
        grid = self.problem.grid
        workspace = grid.inverse.operator.workspace
        return shear_on_grid(grid.half_space, grid.shape, grid.spacing, workspace)

    @cached_property
    def diagonal(self) -> float:
        """Displacement of a node by the pressure on itself. [length / pressure]"""
        operator = self.problem.operator
        return at_origin(operator.spectrum, operator.periods)

    def restricted(self, nodes: GridNodes) -> RestrictedShear | None:
        """Return how shear displaces them roughly, if that costs less on some nodes."""
        grid, forms = self.problem.grid, self.problem.grid.inverse.restricted
        ratios = forms.ratios(nodes)
        if ratios is None:
            return None
        if ratios not in self._made:
            operator = grid.inverse.operator
            made = RestrictedShear.of(self.exact, operator, ratios, forms.margins)
            self._made[ratios] = made
        return self._made[ratios]

    @cached_property
    def _made(self) -> dict[tuple[int, int], RestrictedShear]:
        return {}


class SlidePath:
    """The contact with friction along a path of loads."""

    def __init__(self, problem: Problem, friction: Friction, method: Method) -> None:
        self._path = LoadPath(problem, method)
        self._problem, self._method = problem, method
        self._bodies = _Bodies(problem, friction, method)
        self._last: Slid | None = None
        self._lost: Contact | None = None  # the first that was not solved

    def under(self, load: Load, shear: ShearLoad) -> Slid:
        """Return the state under the next load."""
        if self._lost is not None:
            return replace(_unknown(self._lost, Outcome.UNKNOWN_SURFACE), convolutions=0)
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
            return _unknown(contact, contact.outcome)
        if contact.response is None or not contact.nodes.size:
            return _apart(contact, shear, last)
        return _SlideStep(self._bodies, contact, last).under(shear)

    def _coupled(self, load: Load, shear: ShearLoad) -> Slid:
        """Find pressures under the last shear, and shear under these, in turn [2]_.

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
                return _unknown(contact, contact.outcome)
            dented = left.separation + (contact.separation - lifted.separation)
            unlifted = replace(contact, problem=replace(left, separation=dented))
            if not contact.nodes.size and lift.any():  # which nothing does where nothing touches
                start, found, step, lift = None, None, None, np.zeros_like(lift)
                continue
            if not contact.nodes.size:
                answer = response(contact, window, None, self._method)
                return _apart(replace(unlifted, response=answer), shear, last)
            step = _SlideStep(self._bodies, unlifted, last, (found, before, step), aim)
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
            return replace(_unknown(contact, Outcome.STALLED), residual=error)
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


class _SlideStep:
    """The step from the last state to the next one, whose normal contact is known."""

    def __init__(
        self,
        bodies: _Bodies,
        contact: Contact,
        last: Slid | None,
        again: tuple[Slid | None, Real | None, _SlideStep | None] = (None, None, None),
        rtol: float | None = None,
    ) -> None:
        """Take the bodies, the contact, and the last state.

        If it is solved again, there is the state under nearly these pressures, how the last state
        displaces all of the grid, and the step as it was solved before.
        """
        grid, exact = bodies.problem.grid, bodies.exact
        self._exact, self._contact, self._last = exact, contact, last
        self._method = replace(bodies.method, rtol=rtol or bodies.method.rtol)
        self._untouched, self._friction = bodies.problem, bodies.friction
        self._nodes = nodes = grid.nodes(contact.nodes)
        self._bound = bodies.friction.bound(contact.pressure, contact.nodes)
        self._operators = _Operators(bodies, nodes)
        self._area = grid.cell_area
        self.convolutions = contact.convolutions
        self._slide_before = np.zeros(2) if last is None else last.slide
        self._pushed = exact.by_pressure(contact.pressure, nodes, nodes)
        # shear on the nodes, and the displacement by it
        self._known: tuple[Real, Real] | None = None
        self._nearly, (self._moved_before, self._start) = again[0], self._before(again[1])
        if self._nearly is not None:
            self._start = self._on_these_discs(self._nearly)
        if again[2] is not None and np.array_equal(again[2]._contact.nodes, contact.nodes):
            self._known = again[2]._known
        gap, own = self._gaps_before(), bodies.diagonal * contact.pressure + self._dented()
        self._springs = gap / own * exact.diagonal
        self._since_contact = own / (gap + own)
        presses, bears = float(contact.pressure.sum()), float(self._bound.sum())
        # a strength beyond the pressures is never borne, and nothing is compared with it
        counts = min(presses, bears)
        self._scale = contact.length_scale * counts / presses
        self._counts = counts / bears  # of what friction bears

    def _before(self, everywhere: Real | None) -> tuple[Real, Real]:
        """Return how the nodes of this load were displaced at the last one, and their shear.

        What their pressure displaces now is taken off: the shear has to add the rest.
        """
        nodes, last = self._contact.nodes, self._last
        moved, shear = np.zeros((2, nodes.size, 2))
        if last is None or not last.displacement.any():
            return moved - self._pushed, shear
        before = last.contact
        shear = on_nodes(nodes, before.nodes, last.shear)
        kept = int(np.isin(nodes, before.nodes, assume_unique=True).sum())
        if kept == nodes.size:
            moved = on_nodes(nodes, before.nodes, last.displacement)
        elif everywhere is not None:
            moved = everywhere[nodes]
        else:
            sources = before.problem.grid.nodes(before.nodes)
            self.convolutions += 2
            moved = self._exact.displacement(last.shear, sources, self._nodes)
            moved += self._exact.by_pressure(before.pressure, sources, self._nodes)
        if kept == before.nodes.size and not before.problem.grid.half_space.is_coupled:
            self._known = shear, moved
        return moved - self._pushed, shear

    def _on_these_discs(self, nearly: Slid) -> Real:
        """Return the shear under nearly these pressures; nodes that slip go on to bear all."""
        nodes, others = self._contact.nodes, nearly.contact.nodes
        bound = self._friction.bound(nearly.contact.pressure, others)
        rim = Rim.of(nearly.shear, bound, np.zeros_like(bound, dtype=bool), bound)
        slips = on_nodes(nodes, others, rim.full.astype(np.float64)) > 0
        on_rim = self._bound[:, np.newaxis] * on_nodes(nodes, others, rim.outward)
        return np.where(slips[:, np.newaxis], on_rim, on_nodes(nodes, others, nearly.shear))

    def _gaps_before(self) -> Real:
        """Return the gaps that nodes had at the last load; zero where they were in contact."""
        last, nodes = self._last, self._contact.nodes
        if last is None or not last.contact.nodes.size:
            before = self._untouched.touch if last is None else last.contact.depth
            bodies = self._untouched if last is None else last.contact
            return np.maximum(bodies.separation.ravel()[nodes] - before, 0.0)
        gap = np.zeros(nodes.size)
        joined = ~np.isin(nodes, last.contact.nodes, assume_unique=True)
        gap[joined] = np.maximum(last.contact.gap_at(InGrid(nodes[joined])), 0.0)
        return gap

    def _dented(self) -> Real | float:
        """Return how much deeper nodes were dented since the last load."""
        if self._untouched.law.memory != "dents":
            return 0.0
        before = self._untouched if self._last is None else self._last.contact
        change: Real = self._contact.separation - before.separation
        return change.ravel()[self._contact.nodes]

    def under(self, load: ShearLoad) -> Slid:
        """Return the state under a load along the surface."""
        limit = self._area * float(self._bound.sum())
        tolerance = self._method.rtol * self._scale
        if load.slide is not None:
            way = np.array(load.slide) - self._slide_before
            start = self._guess(way), np.zeros(2)
            found = self._solved(self._moved_before + way, None, start, tolerance)
            return self._state(found, np.array(load.slide), limit, load)
        assert load.force is not None
        force = np.array(load.force)
        if not np.hypot(*force) < _SLIDES_FROM * limit:
            return replace(_unknown(self._contact, Outcome.SLIDES), limit=limit)
        total, way = force / self._area, self._guessed_way(force)
        if self._nearly is not None:
            way = self._nearly.slide - self._slide_before
        found = self._solved(self._moved_before, total, (self._guess(way), way), tolerance)
        return self._state(found, self._slide_before + found.level, limit, load)

    def coupled_tangents(self, found: Slid) -> tuple[ShearTangents, tuple[float, float]]:
        """Return the tangents of bodies that are coupled, and the normal stiffness on both."""
        assert found.went is not None
        given = self._operators, self._contact, self._rim(found.shear), found.went, self._method
        return coupled_tangents(*given, None if self._last is None else self._last.tangents)

    @property
    def _rigid(self) -> float:
        """Force per approach of the contact, about. [force / length]"""
        contact = self._contact
        if contact.response is not None:
            return contact.response.unloading.stiffness
        radius = math.sqrt(contact.nodes.size * self._area / math.pi)
        return contact.problem.grid.half_space.disc_stiffness(radius)

    @property
    def _tangents(self) -> ShearTangents | None:
        """Those of the last load, if it was of the same contact."""
        last = self._last
        if last is None or last.contact.load != self._contact.load:
            return None
        return last.tangents

    def _guess(self, way: Real) -> Real:
        """Return about the shear after a way of the indenter: the last, led along its tangent."""
        contact, last, tangents = self._contact, self._last, self._tangents
        if tangents is not None and tangents.led is not None:
            assert last is not None
            unit = tangents.led[0 if last.force @ way >= 0 else 1]
            led: Real = self._start + unit.along(way, unit.shear)
            if self._known is not None and unit.displacement is not None:
                self._known = led, self._known[1] + unit.along(way, unit.displacement)
            return led
        if contact.problem.grid.half_space.is_coupled:
            return self._start
        nearer = contact.depth - (self._untouched.touch if last is None else last.contact.depth)
        if not nearer > 0:
            return self._start
        before = (
            0.0
            if last is None
            else on_nodes(contact.nodes, last.contact.nodes, last.contact.pressure)
        )
        slope = way / (nearer * contact.problem.grid.half_space.even_shear[1])
        added: Real = (contact.pressure - before)[:, np.newaxis] * slope
        return self._start + added

    def _guessed_way(self, force: Real) -> Real:
        """Return about how far the indenter slides: as it comes nearer, along a straight path."""
        contact, last, tangents = self._contact, self._last, self._tangents
        before = np.zeros(2) if last is None else last.force
        if tangents is not None:
            change = force - before
            stiffness = tangents.on if before @ change >= 0 else tangents.back
            if not np.isfinite(stiffness).all():  # full contact, without a mean
                return np.zeros(2)
            return np.asarray(np.linalg.solve(stiffness, change), np.float64)
        pushed = contact.force - (0.0 if last is None else last.contact.force)
        nearer = contact.depth - (self._untouched.touch if last is None else last.contact.depth)
        factor = contact.problem.grid.half_space.even_shear[1]
        rigid = self._rigid
        if pushed > 0 and nearer > 0:
            return (force - before) / pushed * nearer * factor
        return (force - before) / rigid * factor if rigid > 0 else np.zeros(2)

    def _solved(
        self, target: Real, total: Real | None, start: tuple[Real, Real], tolerance: float
    ) -> Sheared:
        """Return the shear on the discs from one and a level, to the tolerance by the exact one."""
        discs = Discs(self._bound, target, total, self._exact.diagonal, self._springs)
        accuracy = tolerance, _TOTAL_SHARE * self._method.rtol * self._counts
        found = self._operators.found(discs, start, self._known, accuracy)
        self.convolutions += self._operators.convolutions
        self._known = found.shear, found.displacement
        return found

    def _rim(self, shear: Real) -> Rim:
        """Return which nodes have all the shear that they bear."""
        contact = self._contact
        slope = self._friction.slope(contact.pressure, contact.nodes)
        # a node that joins bears little where that follows its pressure, and all of a strength
        joined = (self._springs > 0) & ~contact.plastic & (slope > 0)
        return Rim.of(shear, self._bound, joined, slope)

    def _went(self, load: ShearLoad, slide: Real) -> Going:
        """Return how loads went to this one; if nothing changed, as they went before."""
        contact, last = self._contact, self._last
        assert contact.load is not None
        coupled, touch = contact.problem.grid.half_space.is_coupled, self._untouched.touch
        by_depth = coupled and contact.load.depth is not None
        normal = contact.depth - touch if by_depth else contact.force
        along = slide - self._slide_before if load.force is None else np.array(load.force)
        if last is not None:
            same, before = last.contact.load == contact.load, last.contact
            normal -= before.depth - touch if by_depth else before.force
            normal = 0.0 if same else normal
            if load.force is not None:
                along = np.zeros(2) if last.load == load else along - last.force
        going = Going(float(normal), (along[0], along[1]), not by_depth, load.force is not None)
        return last.went if going.stands and last is not None and last.went else going

    def _state(self, found: Sheared, slide: Real, limit: float, load: ShearLoad) -> Slid:
        """Return the state with some shear."""
        scale = self._scale
        force = self._area * found.shear.sum(axis=0)
        off = self._area * found.missing / (limit * self._counts)
        residual = max(found.residual / scale, off)
        converged = residual <= self._method.rtol
        rim, going, tangents = self._rim(found.shear), self._went(load, slide), None
        if converged and not self._contact.problem.grid.half_space.is_coupled:
            tangents = shear_tangents(
                self._operators, self._contact, rim, going, self._method, self._tangents
            )
            self.convolutions += tangents.convolutions
        return Slid(
            self._contact,
            Outcome.CONVERGED if converged else Outcome.STALLED,
            found.shear,
            found.displacement + self._pushed,
            slide,
            force,
            found.slip * self._since_contact[:, np.newaxis],
            ~rim.full if tangents is None else tangents.sticks,
            limit,
            residual,
            self.convolutions,
            load,
            going,
            tangents,
        )


class _Operators:
    """How shear displaces a set of nodes: exactly, and nearly, at the cost of the contact."""

    def __init__(self, bodies: _Bodies, nodes: GridNodes) -> None:
        self._exact, self.nodes, grid = bodies.exact, nodes, bodies.problem.grid
        self._restricted = bodies.restricted(nodes)
        half_space, self._factor = grid.half_space.even_shear
        inverse = inverse_on(half_space, grid.shape, grid.spacing)
        self._precondition = preconditioner(inverse, nodes)
        self._normal = grid.inverse.operator
        self.convolutions = 0
        self.diagonal = bodies.exact.diagonal

    def exact(self, shear: Real) -> Real:
        """Return the displacements by the exact operator."""
        self.convolutions += 2
        return self._exact.displacement(shear, self.nodes, self.nodes)

    def displaced(self, pressure: Real, shear: Real) -> tuple[Real, Real]:
        """Return the displacements into the body and along the surface by pressure and shear."""
        here = self._normal.spectrum, self.nodes, self.nodes
        return self._exact.displaced(pressure, shear, *here)

    def roughly_displaced(self, pressure: Real, shear: Real) -> tuple[Real, Real]:
        """Return the same, roughly."""
        assert self._restricted is not None
        return self._restricted.displaced(pressure, shear, self.nodes, self.nodes)

    @property
    def rough(self) -> Linear | None:
        """Displacements, roughly; None where the exact ones cost no more."""
        return None if self._restricted is None else self._roughly

    def _roughly(self, shear: Real) -> Real:
        assert self._restricted is not None
        return self._restricted.displacement(shear, self.nodes, self.nodes)

    def inverse(self, moved: Real) -> Real:
        """Return about the shear that displaces so."""
        shear = np.empty_like(moved)
        for axis in range(2):
            shear[:, axis] = self._precondition(np.ascontiguousarray(moved[:, axis]))
        shear /= self._factor
        return shear

    def found(
        self,
        discs: Discs,
        start: tuple[Real, Real],
        known: tuple[Real, Real] | None,
        accuracy: tuple[float, float],
    ) -> Sheared:
        """Return the shear on the discs from one and a level, as :class:`DiscSearch` does.

        Where there is a rough operator, it is corrected for what it misses of the shear so far, or
        of one whose exact displacement is known. The accuracy is a tolerance and a share.
        """
        self.convolutions, (tolerance, share) = 0, accuracy
        exact, rough = DiscSearch(self.exact, self.inverse), self.rough
        if rough is None:
            return exact.found(discs, start, tolerance=tolerance, share=share)
        before, inside = math.inf, within(start[0], discs.bound)
        known = known or (inside, self.exact(inside))
        for _ in range(_MOST_TURNS):
            search = DiscSearch(rough, self.inverse, known)
            aims = {"tolerance": 0.5 * tolerance, "share": share, "gain": _ROUGH_SHARE}
            better = search.found(discs, start, **aims)
            start = better.shear, better.level
            now = discs.judged(*start, self.exact(better.shear))
            known = now.shear, now.displacement
            if now.residual <= tolerance and now.missing <= share * float(discs.bound.sum()):
                return now
            if now.residual > 0.7 * before:
                break
            before = now.residual
        return exact.found(discs, start, tolerance=tolerance, share=share)


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


def _unknown(contact: Contact, outcome: Outcome) -> Slid:
    """Return a load that was not solved."""
    nothing = np.full((contact.nodes.size, 2), math.nan)
    unknown = np.full(2, math.nan)
    sticks = np.zeros(contact.nodes.size, dtype=bool)
    parts = contact, outcome, nothing, nothing, unknown, unknown, nothing, sticks
    return Slid(*parts, math.nan, math.nan, contact.convolutions)


def _apart(contact: Contact, shear: ShearLoad, last: Slid | None) -> Slid:
    """Return bodies that are apart: nothing is sheared.

    With no shear force they come off where the highest nodes, which are the last in contact and
    stick till then, bear no shear any more.
    """
    slide = np.zeros(2) if last is None else last.slide
    if last is not None and last.contact.nodes.size:
        separation = last.contact.separation.ravel()[last.contact.nodes]
        above = separation - separation.min()
        highest = above <= _SAME_HEIGHT * (last.contact.depth - separation.min())
        slide = slide - last.displacement[highest].mean(axis=0)
    if shear.slide is not None:
        slide = np.array(shear.slide)
    nothing = np.zeros((contact.nodes.size, 2))
    sticks = np.zeros(contact.nodes.size, dtype=bool)
    parts = contact, Outcome.CONVERGED, nothing, nothing, slide, np.zeros(2), nothing, sticks
    return Slid(*parts, 0.0, 0.0, contact.convolutions)
