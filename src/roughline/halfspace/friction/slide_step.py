"""The step of a path with friction from one state to the next, whose normal contact is known.

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
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from roughline.computing.arrays import InGrid, Real
from roughline.halfspace.friction.coupled_tangents import coupled_tangents
from roughline.halfspace.friction.discs import Discs, Sheared
from roughline.halfspace.friction.rates import Going, Rim
from roughline.halfspace.friction.sheared_nodes import ShearedBodies, ShearedNodes
from roughline.halfspace.friction.slid import ShearLoad, Slid, unknown
from roughline.halfspace.friction.tangents import shear_tangents
from roughline.halfspace.friction.unit_ways import ShearTangents
from roughline.halfspace.friction.vectors import on_nodes
from roughline.halfspace.search.problem import Contact, Outcome

_SLIDES_FROM = 1 - 1e-9  # of what friction bears, from which on it bears no more
_TOTAL_SHARE = 0.01  # of the tolerance, to which the shear force is kept


class SlideStep:
    """The step from the last state to the next one, whose normal contact is known."""

    def __init__(
        self,
        bodies: ShearedBodies,
        contact: Contact,
        last: Slid | None,
        again: tuple[Slid | None, Real | None, SlideStep | None] = (None, None, None),
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
        self._operators = ShearedNodes(bodies, nodes)
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
            return replace(unknown(self._contact, Outcome.SLIDES), limit=limit)
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
