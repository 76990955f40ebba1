"""The exact tangential stiffness of a contact with friction, going on and turning back.

Going on, nodes that stick follow the slide, and nodes that slip follow it along the rims of their
discs alone: the slip goes on in their direction, so that shear across it is as stuck as all else.
Turning back, all of the contact sticks.

References
----------
.. [1] G. H. Golub and Q. Ye, "Inexact preconditioned conjugate gradient method with inner-outer
   iteration", SIAM J. Sci. Comput. 21, 1305-1320 (1999).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from roughline.computing.arrays import InGrid, Mask, Real, Single
from roughline.computing.krylov import least_residual
from roughline.halfspace.friction.discs import Linear
from roughline.halfspace.friction.rates import Going, Rates, Rim, rate_rounding, slip_on
from roughline.halfspace.friction.vectors import followed, inner, on_nodes
from roughline.halfspace.inverse.approximate_inverse import preconditioner
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.search.problem import Contact, Method

_ENERGY_MARGIN = 0.01  # part of the tolerance, to which the stiffness is solved
_MOST_STEPS = 300
_NOTHING_SLIDES = 1e-6  # of a slide in full contact, that is left without its mean
_NOTHING_RESISTS = 1e-9  # of the largest stiffness along the surface
_ROUGH_SHARE = 1e-6  # of the energy of an error, that steps with rough operators leave
_ROUGH_ERROR = 0.03  # of the energy that they find, at most
_COUPLED_SHARE = 1e-3  # of what rough operators of coupled bodies correct, and what they err by
_MOST_TURNS = 10  # of corrections
_SCALE_SHARE = 0.1  # of the energy that counts, up to which they go on


@dataclass(frozen=True, eq=False)
class UnitSlides:
    """Shear of nodes by unit slides along x and along y, each of shape (nodes, 2)."""

    shear: tuple[Real, Real]
    displacement: tuple[Real, Real] | None = None  # by the shear, exactly

    @staticmethod
    def along(way: Real, unit: tuple[Real, Real]) -> Real:
        """Return what a slide along a way brings, from that of unit slides."""
        return np.asarray(way[0] * unit[0] + way[1] * unit[1], np.float64)


@dataclass(frozen=True, eq=False)
class UnitWays:
    """Pressures and shear of nodes by unit slides along x and y, and by a unit approach.

    They are kept to start from, in single precision.
    """

    nodes: InGrid
    tractions: Single  # shape (nodes, 3, 3): shear along x and y and pressure, by each of the ways
    totals: Real  # of these, shape (3, 3) [force / length]

    def moved(self, others: UnitWays, to: UnitWays) -> UnitWays:
        """Return these where others, of the same nodes, have gone elsewhere."""
        change = to.tractions - on_nodes(to.nodes, others.nodes, others.tractions)
        tractions = on_nodes(to.nodes, self.nodes, self.tractions) + change
        return replace(to, tractions=tractions.astype(np.float32))

    def led(self, going: Going) -> tuple[Real, Real]:
        """Return the ways after which loads have gone so, and what nodes bear more after them."""
        ways = _ways(self.totals, going)
        return ways, self.tractions.astype(np.float64) @ ways


@dataclass(frozen=True, eq=False)
class ShearTangents:
    """Stiffness dQ/d(slide) at a state, each 2 by 2, and where it sticks. [force / length]"""

    sticks: Mask  # if loads go on as they did last
    on: Real
    back: Real
    convolutions: int = 0
    led: tuple[UnitSlides, UnitSlides] | None = None  # how shear follows, on and back
    coupled: tuple[UnitWays, UnitWays] | None = None  # the same of bodies that are coupled


class ShearMaps(Protocol):
    """How shear displaces the nodes: exactly, roughly, and about how that is undone."""

    diagonal: float  # displacement of a node by shear on itself [length / pressure]

    def exact(self, shear: Real) -> Real:
        """Return the displacements."""

    @property
    def rough(self) -> Linear | None:
        """Displacements, roughly; None where the exact ones cost no more."""

    def inverse(self, moved: Real) -> Real:
        """Return about the shear that displaces so."""


def shear_tangents(
    maps: ShearMaps,
    contact: Contact,
    rim: Rim,
    going: Going,
    method: Method,
    last: ShearTangents | None = None,
) -> ShearTangents:
    """Solve for both tangents of a state.

    That of turning back is known from the last load, if that was of the same contact.
    """
    grid, nobody = contact.problem.grid, np.zeros_like(rim.full)
    accuracy = _ENERGY_MARGIN * method.rtol
    if _is_rigid(contact):
        base = _OnBase(maps, contact.nodes.size)
        rates = _ShearRates(base, contact, rim, going, accuracy, base)
        slips = slip_on(rim, rates.of) if rim.may_slip.any() else nobody
        back = np.diag([np.inf, np.inf])
        on = grid.cell_area * base.without_base(rates.form(slips)) if slips.any() else back
        return ShearTangents(~slips, on, back, rates.spent)
    rates = _ShearRates(maps, contact, rim, going, accuracy)
    if last is not None and last.led is not None:
        back = last.back
        rates.start_from(nobody, last.led[1], back / grid.cell_area)
    else:
        back = grid.cell_area * rates.form(nobody)
    stuck = rates.known
    if last and last.led and (last.sticks == rim.full).sum() < rim.full.sum():
        # fewer nodes differ from those that slipped on, though directions may have turned
        rates.begin_from(last.led[0])
    slips = slip_on(rim, rates.of) if rim.may_slip.any() else nobody
    on = grid.cell_area * rates.form(slips) if slips.any() else back
    led = None if stuck is None else (rates.known or stuck, stuck)
    return ShearTangents(~slips, on, back, rates.spent, led)


def _is_rigid(contact: Contact) -> bool:
    """Whether even shear displaces nothing: in full contact, displaced from the mean."""
    free = contact.problem.grid.inverse.operator.mean_is_free
    return free and contact.nodes.size == contact.separation.size


class _OnBase:
    """Full contact on a base that gives way to even shear, so that all slides are finite.

    The base adds to a slide what the total of the shear asks for, and nothing else.
    """

    def __init__(self, maps: ShearMaps, nodes: int) -> None:
        self._maps, self.diagonal = maps, maps.diagonal
        self._compliance = maps.diagonal / math.sqrt(nodes)  # by the total of the shear

    def _base(self, shear: Real) -> Real:
        return np.asarray(self._compliance * shear.sum(axis=0), np.float64)

    def exact(self, shear: Real) -> Real:
        """Return the displacements."""
        return self._maps.exact(shear) + self._base(shear)

    @property
    def rough(self) -> Linear | None:
        """Displacements, roughly; None where the exact ones cost no more."""
        rough = self._maps.rough
        return None if rough is None else lambda shear: rough(shear) + self._base(shear)

    def inverse(self, moved: Real) -> Real:
        """Return about the shear that displaces so."""
        return self._maps.inverse(moved)

    def _apart(self, form: Real) -> tuple[Real, Real, Real]:
        """Return the directions of a form, its values there, and what of a slide is no base's."""
        values, directions = np.linalg.eigh(form)
        left = 1 - self._compliance * values
        return directions, values, np.where(left > _NOTHING_SLIDES, left, 0.0)

    def with_base(self, slide: Real, form: Real) -> Real:
        """Return a slide and what the base adds to it; nothing where bodies alone do not slide."""
        directions, _, left = self._apart(form)
        share = np.divide(1.0, left, out=np.zeros(2), where=left > 0)
        return np.asarray(directions @ (share * (directions.T @ slide)), np.float64)

    def without_base(self, form: Real) -> Real:
        """Return a form of the bodies alone, infinite along what they do not slide."""
        directions, values, left = self._apart(form)
        stiffness = np.divide(values, left, out=np.full(2, np.inf), where=left > 0)
        whole = np.zeros((2, 2))
        for axis, value in zip(directions.T, stiffness, strict=True):
            square = np.outer(axis, axis)
            some = np.abs(square) > _NOTHING_SLIDES
            whole[some] += value * square[some]
        return whole


class _ShearRates:
    """How the shear goes on where pressures do not depend on it."""

    def __init__(
        self,
        maps: ShearMaps,
        contact: Contact,
        rim: Rim,
        going: Going,
        accuracy: float,
        base: _OnBase | None = None,
    ) -> None:
        self._maps, self._rim, self._going, self._accuracy = maps, rim, going, accuracy
        self._base = base
        self._area, self.spent = contact.problem.grid.cell_area, 0
        self._slips: Mask | None = None  # of the nodes, for which all is known
        self.known: UnitSlides | None = _as_pressed(contact)
        answer = contact.response
        assert answer is not None
        tangent = answer.loading if going.normal > 0 else answer.unloading
        self._bears_more = rim.slope * tangent.pressure_per_force * going.normal

    def start_from(self, slips: Mask, unit: UnitSlides, form: Real) -> None:
        """Take the shear by unit slides, and its totals, where some nodes slip."""
        self._slips, self.known, self._form = slips, unit, form

    def begin_from(self, unit: UnitSlides) -> None:
        """Take the shear by unit slides where other nodes slip, as a guess."""
        self._slips, self.known = None, unit

    def form(self, slips: Mask) -> Real:
        """Return the totals of the shear by unit slides."""
        if self._slips is None or (self._slips != slips).any():
            stuck = _Stuck(self._maps, slips, self._rim.outward)
            form, unit, spent = stuck.stiffness(self._accuracy, self.known)
            self.spent += spent
            self.start_from(slips.copy(), unit, form)
        return self._form

    def of(self, slips: Mask) -> Rates | None:
        """Return how nodes go on where some slip; None if nothing goes on."""
        if self._going.stands:
            return None
        form = self.form(slips)
        unit = self.known
        assert unit is not None
        assert unit.displacement is not None
        rate = np.where(slips, self._bears_more, 0.0)[:, np.newaxis] * self._rim.outward
        moved = np.zeros_like(rate)
        if rate.any():
            stuck = _Stuck(self._maps, slips, self._rim.outward)
            moved = self._maps.exact(rate)
            follows = stuck.solved(-stuck.allowed(moved), None, None, self._accuracy)
            rate, moved = rate + follows.shear, moved + follows.displacement
            self.spent += 2 * (1 + follows.products)
        slide = np.array(self._going.along)
        if self._going.by_shear:
            missing = slide / self._area - rate.sum(axis=0)
            slide = np.linalg.lstsq(form, missing, rcond=None)[0]
        elif self._base is not None:
            slide = self._base.with_base(slide, form)
        rate = rate + unit.along(slide, unit.shear)
        moved = moved + unit.along(slide, unit.displacement)
        return Rates(self._rim.along(slide - moved), self._rim.along(rate) - self._bears_more)


def _as_pressed(contact: Contact) -> UnitSlides | None:
    """Return shear that goes as the pressure does when the bodies come nearer."""
    if contact.response is None:
        return None
    rate = contact.response.unloading.pressure_per_force
    if not (rate.any() and np.isfinite(rate).all()):
        return None
    none = np.zeros_like(rate)
    return UnitSlides((np.stack([rate, none], axis=1), np.stack([none, rate], axis=1)))


class CoupledMaps(ShearMaps, Protocol):
    """The same of bodies in which pressure displaces along the surface, and shear into the body."""

    nodes: GridNodes

    def displaced(self, pressure: Real, shear: Real) -> tuple[Real, Real]:
        """Return the displacements into the body and along the surface."""

    def roughly_displaced(self, pressure: Real, shear: Real) -> tuple[Real, Real]:
        """Return the same roughly, if there are rough ones."""


def coupled_tangents(
    maps: CoupledMaps,
    contact: Contact,
    rim: Rim,
    going: Going,
    method: Method,
    last: ShearTangents | None = None,
) -> tuple[ShearTangents, tuple[float, float]]:
    """Solve for both tangents of bodies that are coupled, and for dF/dd on both.

    Where a node slips its shear follows the pressure, so that the equations are not symmetric. The
    tangents are those under a constant force, and dF/dd is that under a constant shear force. They
    are begun with those of the last load.
    """
    nobody = np.zeros_like(rim.full)
    if _is_rigid(contact):  # how it goes on where some of it slips is not known
        stuck = np.diag([np.inf, np.inf])
        going_on = np.full((2, 2), np.nan) if rim.full.any() else stuck
        return ShearTangents(~rim.full, going_on, stuck), (np.inf, np.inf)
    begun = (None, None) if last is None or last.coupled is None else last.coupled
    rates = _CoupledRates(maps, contact, rim, going, method.rtol)
    back = rates.ways(nobody, begun[1])
    rates.start = back if begun[0] is None else begun[0].moved(begun[1], back)
    slips = rates.slips_on()
    on = rates.ways(slips) if slips.any() or rates.yielding.any() else back
    (along_on, normal_on), (along_back, normal_back) = (
        _condensed(on.totals),
        _condensed(back.totals),
    )
    if rates.yielding.sum() < contact.plastic.sum():  # under more load all of them yield on
        rates.yielding = contact.plastic
        _, normal_on = _condensed(rates.ways(slips).totals)
    both = (on, back) if np.isfinite([on.totals, back.totals]).all() else None
    tangents = ShearTangents(~slips, along_on, along_back, rates.spent, coupled=both)
    return tangents, (normal_on, normal_back)


class _CoupledRates:
    """How pressures and shear go on where both move each other."""

    def __init__(
        self, maps: CoupledMaps, contact: Contact, rim: Rim, going: Going, rtol: float
    ) -> None:
        self._maps, self._contact, self._rim, self._going = maps, contact, rim, going
        self._rtol, self.spent = rtol, 0
        self.start: UnitWays | None = None
        self.yielding = np.zeros_like(rim.full)  # nodes at the hardness that bear no more
        self._known: tuple[Real, Real, UnitWays] | None = None
        self._goes_on_wrong = np.zeros_like(rim.full)

    def ways(self, slips: Mask, start: UnitWays | None = None) -> UnitWays:
        """Return pressures and shear by unit slides and a unit approach where some nodes slip."""
        sets = np.array([slips, self.yielding])
        if self._known is None or (self._known[0] != sets).any():
            stuck = _CoupledStuck(self._maps, self._contact, self._rim, slips, self.yielding)
            form, tractions = stuck.stiffness(self._rtol, start or self.start)
            self.spent += 7 * stuck.products
            totals = self._contact.problem.grid.cell_area * form
            ways = UnitWays(self._contact.nodes, tractions.astype(np.float32), totals)
            self._known, self.start = (sets, tractions, ways), ways
        return self._known[2]

    def slips_on(self) -> Mask:
        """Return which nodes slip on, and find those that yield on: the dents of these grow.

        A node at the hardness that yields no more must bear less.
        """
        self.yielding, slips = self._contact.plastic.copy(), self._rim.full & False
        for _ in range(_MOST_TURNS):
            self._goes_on_wrong[:] = False
            if self._rim.may_slip.any():
                slips = slip_on(self._rim, self.of)
            elif self.yielding.any():
                self.of(slips)
            if not self._goes_on_wrong.any():
                break
            self.yielding = self.yielding ^ self._goes_on_wrong
        return slips

    def of(self, slips: Mask) -> Rates | None:
        """Return how nodes go on where some slip; None if nothing goes on, or it is not solved."""
        totals = self.ways(slips).totals
        if self._going.stands or np.isnan(totals).any():
            return None
        assert self._known is not None
        moved = _ways(totals, self._going)
        both = self._known[1] @ moved
        shear, pressure = np.ascontiguousarray(both[:, :2]), both[:, 2].copy()
        self.spent += 7
        into, there = self._maps.displaced(pressure, shear)
        dents, plastic = moved[2] - into, self._contact.plastic
        self._goes_on_wrong = np.where(
            self.yielding,
            dents < -rate_rounding(dents),
            plastic & (pressure > rate_rounding(pressure)),
        )
        slip = self._rim.along(moved[:2] - there)
        return Rates(slip, self._rim.along(shear) - self._rim.slope * pressure)


def _ways(totals: Real, going: Going) -> Real:
    """Return the slides and the approach with which loads go so."""
    asked, given = totals.copy(), np.array([*going.along, going.normal])
    if not going.by_shear:
        asked[:2] = np.eye(3)[:2]
    if not going.by_force:
        asked[2] = np.eye(3)[2]
    return np.asarray(np.linalg.lstsq(asked, given, rcond=None)[0], np.float64)


def _condensed(matrix: Real) -> tuple[Real, float]:
    """Return dQ/d(slide) under a constant force, and dF/dd under a constant shear force.

    Where nothing resists a slide, as where the bodies slide, dF/dd is that without it.
    """
    along, normal = matrix[:2, :2], float(matrix[2, 2])
    of_depth, of_slide = matrix[:2, 2], matrix[2, :2]
    held = along
    if normal:  # else all nodes yield on, and bear no more in any case
        held = along - np.outer(of_depth, of_slide) / normal
    if not np.isfinite(matrix).all():
        return held, np.nan
    slide = np.linalg.lstsq(along, of_depth, rcond=_NOTHING_RESISTS)[0]
    return held, normal - float(of_slide @ slide)


class _CoupledStuck:
    """A contact of coupled bodies, of which some nodes slip on, and some yield on."""

    def __init__(
        self, maps: CoupledMaps, contact: Contact, rim: Rim, slips: Mask, yielding: Mask
    ) -> None:
        self._maps, self._contact, self._slips = maps, contact, slips
        self._yielding = yielding
        self._outward = np.where(slips[:, np.newaxis], rim.outward, 0.0)
        self._slope, self.products = rim.slope, 0
        self._normal = preconditioner(contact.problem.grid.inverse, maps.nodes)

    def _radial(self, vectors: Real) -> Real:
        """Return what of vectors nodes that slip cannot follow."""
        along = np.einsum("ij,ij->i", self._outward, vectors)
        return self._outward * along[:, np.newaxis]

    def _exactly(self, unknown: Real) -> Real:
        self.products += 1
        return self._product(unknown, self._maps.displaced)

    def _roughly(self, unknown: Real) -> Real:
        return self._product(unknown, self._maps.roughly_displaced)

    def _product(self, unknown: Real, moved: Callable[[Real, Real], tuple[Real, Real]]) -> Real:
        """Return the displacements by pressure and shear, and what is left of the radial shear.

        Of a node that yields on it is what is left of its pressure.
        """
        given, free = self._apart(unknown)
        pressure = np.where(self._yielding, 0.0, given)
        radial = self._radial(free)
        shear = free - radial + self._outward * (self._slope * pressure)[:, np.newaxis]
        into, along = moved(pressure, shear)
        along = along + self._maps.diagonal * radial - self._radial(along)
        into = np.where(self._yielding, self._maps.diagonal * given, into)
        return np.concatenate([into, along.ravel()])

    def _preconditioned(self, moved: Real) -> Real:
        into, along = self._apart(moved)
        radial = self._radial(along)
        shear = self._maps.inverse(along - radial)
        shear += radial / self._maps.diagonal - self._radial(shear)
        pressure = self._normal(np.where(self._yielding, 0.0, into))
        pressure = np.where(self._yielding, into / self._maps.diagonal, pressure)
        return np.concatenate([pressure, shear.ravel()])

    def _apart(self, both: Real) -> tuple[Real, Real]:
        count = self._slips.size
        return np.ascontiguousarray(both[:count]), both[count:].reshape(-1, 2)

    def stiffness(self, rtol: float, start: UnitWays | None) -> tuple[Real, Real]:
        """Return the totals by unit slides and a unit approach, and the tractions.

        Where all nodes stick the equations are symmetric, and the totals are the energy form.
        """
        count = self._slips.size
        matrix, tractions = np.full((3, 3), np.nan), np.zeros((count, 3, 3))
        begun = self._begun(start)
        solved = []
        for axis in range(3):
            target = np.zeros(3 * count)
            if axis == 2:
                target[:count] = ~self._yielding
            else:
                even = np.zeros((count, 2)) + np.eye(2)[axis]
                target[count:] = (even - self._radial(even)).ravel()
            solved.append((target, self._solved(target, begun[axis], rtol)))
        for axis, (_, found) in enumerate(solved):
            if found is None:
                continue
            pressure, free = self._apart(found[0])
            pressure = np.where(self._yielding, 0.0, pressure)
            shear = free - self._radial(free)
            shear += self._outward * (self._slope * pressure)[:, np.newaxis]
            tractions[:, :2, axis], tractions[:, 2, axis] = shear, pressure
            matrix[:, axis] = *shear.sum(axis=0), pressure.sum()
            if not self._slips.any():
                for other, (_, whole) in enumerate(solved):
                    if whole is not None:
                        matrix[other, axis] += np.einsum("i,i->", whole[0], found[1])
        return matrix, tractions

    def _begun(self, start: UnitWays | None) -> list[Real]:
        """Return the unknowns to begin with: as they were, or as the bodies are pressed."""
        count = self._slips.size
        tractions = np.zeros((count, 3, 3))
        if start is not None:
            tractions = on_nodes(self._contact.nodes, start.nodes, start.tractions)
        begun = []
        for axis in range(3):
            shear = tractions[:, :2, axis].astype(np.float64)
            free = shear - self._radial(shear)
            begun.append(np.concatenate([tractions[:, 2, axis], free.ravel()]))
        return begun

    def _solved(self, target: Real, start: Real, rtol: float) -> tuple[Real, Real] | None:
        """Solve with rough operators, and correct what they miss; None without convergence.

        What is left is returned, too. Where all nodes stick, the totals err by its energy.
        """
        if not target.any():  # all nodes yield on: none is pressed by an approach
            return np.zeros_like(target), target
        symmetric, rough = not self._slips.any(), self._maps.rough is not None
        enough = math.sqrt(_ENERGY_MARGIN * rtol) if symmetric else rtol
        found, whole, left = start, float(np.abs(target).max()), math.inf
        for _ in range(_MOST_TURNS):
            residual = target - self._exactly(found) if found.any() else target
            before, left = left, float(np.abs(residual).max()) / whole
            if left <= rtol:
                return found, residual
            if symmetric and found.any():
                energy = float(np.einsum("i,i->", residual, self._preconditioned(residual)))
                if energy <= _ENERGY_MARGIN * rtol * float(np.einsum("i,i->", target, found)):
                    return found, residual
            rough &= left <= 0.5 * before
            aim = max(_COUPLED_SHARE if rough else 0.0, 0.3 * enough / left)
            product = self._roughly if rough else self._exactly
            found = found + least_residual(product, self._preconditioned, residual, aim)[0]
        return None


@dataclass(frozen=True, eq=False)
class _Followed:
    """Shear that follows a displacement, and what is left of this."""

    shear: Real
    displacement: Real  # by the shear, exactly
    rest: Real
    step: Real  # about the shear that the rest asks for
    products: int


class _Stuck:
    """A contact of which some nodes follow a slide along the rims of their discs alone."""

    def __init__(self, maps: ShearMaps, slips: Mask, outward: Real) -> None:
        self._maps, self._slips = maps, slips
        self._rim = np.stack([-outward[:, 1], outward[:, 0]], axis=1)

    def allowed(self, vectors: Real) -> Real:
        """Return what of vectors nodes can follow."""
        return followed(vectors, self._slips, self._rim)

    def stiffness(self, accuracy: float, start: UnitSlides | None) -> tuple[Real, UnitSlides, int]:
        """Return the total shear by unit slides along x and y, the shear, and the convolutions.

        It is the energy form of both solutions, so that it errs by the square of their residuals;
        of what these still displace, the energy form by the preconditioner is added.
        """
        found = []
        targets = [self.allowed(np.zeros_like(self._rim) + axis) for axis in np.eye(2)]
        for axis, target in enumerate(targets):
            begun = None if start is None else start.shear[axis]
            moved = None if start is None or not start.displacement else start.displacement[axis]
            found.append(self.solved(target, begun, moved, accuracy))
        form = np.array(
            [
                [
                    inner(target, each.shear)
                    + inner(other.shear, each.rest)
                    + inner(other.rest, each.step)
                    for each in found
                ]
                for target, other in zip(targets, found, strict=True)
            ]
        )
        x, y = found
        unit = UnitSlides((x.shear, y.shear), (x.displacement, y.displacement))
        return (form + form.T) / 2, unit, 2 * (x.products + y.products)

    def solved(
        self, target: Real, start: Real | None, known: Real | None, accuracy: float
    ) -> _Followed:
        """Solve by conjugate gradients, whose preconditioner may be a solution by rough ones.

        As that differs from step to step, directions are conjugate by the change of residuals [1]_.
        The start may displace as is known.
        """
        shear, moved, products = np.zeros_like(target), np.zeros_like(target), 0
        if start is not None:
            shear = self._begun(target, start, known, accuracy)
            moved, products = self._maps.exact(shear), 1
            energy = inner(shear, moved)
            if known is None and energy > 0:  # else nodes can follow nothing of the start
                length = inner(shear, target) / energy
                shear, moved = length * shear, length * moved
        residual = target - self.allowed(moved)
        direction, before, gone = np.zeros_like(target), 0.0, residual
        while True:
            scale = accuracy * max(inner(shear, target), 0.0)
            step, error = self._preconditioned(residual, scale)
            energy = inner(residual, step)
            if not error * energy > scale or products > _MOST_STEPS:
                return _Followed(shear, moved, residual, step, products)
            part = inner(residual - gone, step) / before if before > 0 else 0.0
            direction = step + max(part, 0.0) * direction
            response = self._maps.exact(direction)
            products += 1
            length = inner(direction, residual) / inner(direction, response)
            before, gone = energy, residual
            shear, moved = shear + length * direction, moved + length * response
            residual = residual - length * self.allowed(response)

    def _begun(self, target: Real, start: Real, known: Real | None, accuracy: float) -> Real:
        """Return what nodes can follow of a start, led on by the rough operator if it is known."""
        shear, rough = self.allowed(start), self._maps.rough
        if known is None or rough is None:
            return shear
        left = target - self.allowed(known + rough(shear - start))
        return shear + self._preconditioned(left, accuracy * max(inner(shear, target), 0.0))[0]

    def _preconditioned(self, residual: Real, scale: float) -> tuple[Real, float]:
        """Return about the shear that displaces so, by steps with rough operators, and its error.

        The error is a part of its energy; less energy than the scale does not count.
        """
        rough = self._maps.rough
        step = self.allowed(self._maps.inverse(residual))
        if rough is None:
            return step, 1.0
        shear, left, direction, before = np.zeros_like(residual), residual, step, 0.0
        gained = 0.0
        for _ in range(_MOST_STEPS):
            energy = inner(left, step)
            if not energy > max(_ROUGH_SHARE * gained, _SCALE_SHARE * scale):
                break
            direction = step + (energy / before if before > 0 else 0.0) * direction
            before, response = energy, self.allowed(rough(direction))
            length = energy / inner(direction, response)
            shear, left = shear + length * direction, left - length * response
            gained += length * energy
            step = self.allowed(self._maps.inverse(left))
        return shear, _ROUGH_ERROR
