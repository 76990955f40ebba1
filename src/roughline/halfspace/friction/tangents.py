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
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.halfspace.friction.discs import Linear
from roughline.halfspace.friction.rates import Going, Rates, Rim, slip_on
from roughline.halfspace.friction.sheared_nodes import ShearMaps
from roughline.halfspace.friction.unit_ways import ShearTangents, UnitSlides
from roughline.halfspace.friction.vectors import followed, inner
from roughline.halfspace.search.problem import Contact, Method

ENERGY_MARGIN = 0.01
"""Part of the tolerance, to which a stiffness is solved."""
_MOST_STEPS = 300
_NOTHING_SLIDES = 1e-6  # of a slide in full contact, that is left without its mean
_ROUGH_SHARE = 1e-6  # of the energy of an error, that steps with rough operators leave
_ROUGH_ERROR = 0.03  # of the energy that they find, at most
_SCALE_SHARE = 0.1  # of the energy that counts, up to which they go on


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
    accuracy = ENERGY_MARGIN * method.rtol
    if is_rigid(contact):
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


def is_rigid(contact: Contact) -> bool:
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
