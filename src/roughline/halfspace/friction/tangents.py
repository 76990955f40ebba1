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

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.halfspace.friction.discs import Linear
from roughline.halfspace.friction.rates import Going, Rates, Rim, slip_on
from roughline.halfspace.inverse.approximate_inverse import preconditioner
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.search.problem import Contact, Method

_ENERGY_MARGIN = 0.01  # part of the tolerance, to which the stiffness is solved
_MOST_STEPS = 300
_NOTHING_RESISTS = 1e-9  # of the largest stiffness along the surface
_ROUGH_SHARE = 1e-2  # of the energy of an error, that steps with rough operators leave


@dataclass(frozen=True, eq=False)
class ShearTangents:
    """Stiffness dQ/d(slide) at a state, each 2 by 2, and where it sticks. [force / length]"""

    sticks: Mask  # if loads go on as they did last
    on: Real
    back: Real
    convolutions: int = 0


class ShearMaps(Protocol):
    """How shear displaces the nodes: exactly, roughly, and about how that is undone."""

    def exact(self, shear: Real) -> Real:
        """Return the displacements."""

    @property
    def rough(self) -> Linear | None:
        """Displacements as of one kind of shear alone; None where the exact ones cost no more."""

    def inverse(self, moved: Real) -> Real:
        """Return about the shear that displaces so."""


def shear_tangents(
    maps: ShearMaps,
    contact: Contact,
    rim: Rim,
    going: Going,
    method: Method,
    back: Real | None = None,
) -> ShearTangents:
    """Solve for both tangents; that of turning back may be known of the same contact."""
    grid, nodes = contact.problem.grid, contact.nodes.size
    accuracy, spent = _ENERGY_MARGIN * method.rtol, 0
    if nodes == contact.separation.size and grid.inverse.operator.mean_is_free:
        back = np.diag([np.inf, np.inf])
    if back is None:
        stuck = _Stuck(maps, np.zeros(0, dtype=np.intp), rim.outward)
        found, spent = stuck.stiffness(accuracy)
        back = grid.cell_area * found
    rates = _ShearRates(maps, contact, rim, going, accuracy)
    slips = slip_on(rim, rates.of) if rim.may_slip.any() else rim.may_slip
    on = grid.cell_area * rates.form(slips) if slips.any() else back
    return ShearTangents(~slips, on, back, spent + rates.spent)


class _ShearRates:
    """How the shear goes on where pressures do not depend on it."""

    def __init__(
        self, maps: ShearMaps, contact: Contact, rim: Rim, going: Going, accuracy: float
    ) -> None:
        self._maps, self._rim, self._going, self._accuracy = maps, rim, going, accuracy
        self._area, self.spent = contact.problem.grid.cell_area, 0
        self._known: tuple[Mask, list[Real], Real] | None = None
        answer = contact.response
        assert answer is not None
        tangent = answer.loading if going.normal > 0 else answer.unloading
        self._bears_more = rim.slope * tangent.pressure_per_force * going.normal

    def _columns(self, slips: Mask) -> tuple[list[Real], Real]:
        """Return the shear by unit slides along x and y, and its totals."""
        if self._known is None or (self._known[0] != slips).any():
            stuck = _Stuck(self._maps, np.flatnonzero(slips), self._rim.outward)
            form, spent = stuck.stiffness(self._accuracy)
            self.spent += spent
            self._known = slips.copy(), stuck.found, form
        return self._known[1:]

    def form(self, slips: Mask) -> Real:
        """Return the totals of the shear by unit slides."""
        return self._columns(slips)[1]

    def of(self, slips: Mask) -> Rates | None:
        """Return how nodes go on where some slip; None if nothing goes on."""
        if self._going.stands:
            return None
        (x, y), form = self._columns(slips)
        rate = np.where(slips, self._bears_more, 0.0)[:, np.newaxis] * self._rim.outward
        if rate.any():
            stuck = _Stuck(self._maps, np.flatnonzero(slips), self._rim.outward)
            moved = self._maps.exact(rate)
            follows, _, steps = stuck.solved(-stuck.allowed(moved), self._accuracy)
            rate, self.spent = rate + follows, self.spent + 2 * (1 + steps)
        slide = np.array(self._going.along)
        if self._going.by_shear:
            missing = slide / self._area - rate.sum(axis=0)
            slide = np.linalg.lstsq(form, missing, rcond=None)[0]
        rate = rate + slide[0] * x + slide[1] * y
        self.spent += 2
        slip = self._rim.along(slide - self._maps.exact(rate))
        return Rates(slip, self._rim.along(rate) - self._bears_more)


class CoupledMaps(ShearMaps, Protocol):
    """The same of bodies in which pressure displaces along the surface, and shear into the body."""

    nodes: GridNodes
    diagonal: float

    def by_pressure(self, pressure: Real) -> Real:
        """Return the displacements along the surface."""

    def into_body(self, shear: Real) -> Real:
        """Return the displacements into the body."""


def coupled_tangents(
    maps: CoupledMaps, contact: Contact, rim: Rim, going: Going, method: Method
) -> tuple[ShearTangents, tuple[float, float]]:
    """Solve for both tangents of bodies that are coupled, and for dF/dd on both.

    Where a node slips its shear follows the pressure, so that the equations are not symmetric. The
    tangents are those under a constant force, and dF/dd is that under a constant shear force.
    """
    grid, nobody = contact.problem.grid, np.zeros_like(rim.full)
    if contact.nodes.size == contact.separation.size and grid.inverse.operator.mean_is_free:
        unknown = np.full((2, 2), np.nan)
        return ShearTangents(~rim.full, unknown, unknown), (np.inf, np.inf)
    rates = _CoupledRates(maps, contact, rim, going, method.rtol)
    along_back, normal_back = _condensed(grid.cell_area * rates.form(nobody))
    slips = slip_on(rim, rates.of) if rim.may_slip.any() else nobody
    along_on, normal_on = _condensed(grid.cell_area * rates.form(slips))
    return ShearTangents(~slips, along_on, along_back, rates.spent), (normal_on, normal_back)


class _CoupledRates:
    """How pressures and shear go on where both move each other."""

    def __init__(
        self, maps: CoupledMaps, contact: Contact, rim: Rim, going: Going, rtol: float
    ) -> None:
        self._maps, self._contact, self._rim, self._going = maps, contact, rim, going
        self._rtol, self.spent = rtol, 0
        self._known: tuple[Mask, list[tuple[Real, Real]], Real] | None = None

    def _columns(self, slips: Mask) -> tuple[list[tuple[Real, Real]], Real]:
        """Return pressures and shear by unit slides and a unit approach, and their totals."""
        if self._known is None or (self._known[0] != slips).any():
            stuck = _CoupledStuck(self._maps, self._contact, self._rim, slips)
            form, products = stuck.stiffness(self._rtol)
            self.spent += 7 * products
            self._known = slips.copy(), stuck.found, form
        return self._known[1:]

    def form(self, slips: Mask) -> Real:
        """Return the totals of shear and pressure by unit slides and a unit approach."""
        return self._columns(slips)[1]

    def of(self, slips: Mask) -> Rates | None:
        """Return how nodes go on where some slip; None if nothing goes on, or it is not solved."""
        going, area = self._going, self._contact.problem.grid.cell_area
        columns, form = self._columns(slips)
        if going.stands or np.isnan(form).any():
            return None
        asked, given = area * form, np.array([*going.along, going.normal])
        if not going.by_shear:
            asked[:2] = np.eye(3)[:2]
        if not going.by_force:
            asked[2] = np.eye(3)[2]
        moved = np.linalg.lstsq(asked, given, rcond=None)[0]
        pressure = sum(each * p for each, (p, _) in zip(moved, columns, strict=True))
        shear = sum(each * q for each, (_, q) in zip(moved, columns, strict=True))
        self.spent += 4
        there = self._maps.exact(shear) + self._maps.by_pressure(pressure)
        slip = self._rim.along(moved[:2] - there)
        return Rates(slip, self._rim.along(shear) - self._rim.slope * pressure)


def _condensed(matrix: Real) -> tuple[Real, float]:
    """Return dQ/d(slide) under a constant force, and dF/dd under a constant shear force.

    Where nothing resists a slide, as where the bodies slide, dF/dd is that without it.
    """
    along, normal = matrix[:2, :2], float(matrix[2, 2])
    of_depth, of_slide = matrix[:2, 2], matrix[2, :2]
    held = along - np.outer(of_depth, of_slide) / normal
    if not np.isfinite(matrix).all():
        return held, np.nan
    slide = np.linalg.lstsq(along, of_depth, rcond=_NOTHING_RESISTS)[0]
    return held, normal - float(of_slide @ slide)


class _CoupledStuck:
    """A contact of coupled bodies, of which some nodes slip on."""

    def __init__(self, maps: CoupledMaps, contact: Contact, rim: Rim, slips: Mask) -> None:
        self._maps, self._grid, self._slips = maps, contact.problem.grid, slips
        self._outward = np.where(slips[:, np.newaxis], rim.outward, 0.0)
        self._slope, self._products = rim.slope, 0
        self._normal = preconditioner(self._grid.inverse, maps.nodes)
        self.found: list[tuple[Real, Real]] = []  # pressures and shear by unit ways

    def _radial(self, vectors: Real) -> Real:
        """Return what of vectors nodes that slip cannot follow."""
        along = np.einsum("ij,ij->i", self._outward, vectors)
        return self._outward * along[:, np.newaxis]

    def _product(self, unknown: Real) -> Real:
        """Return the displacements by pressure and shear, and what is left of the radial shear."""
        pressure, free = self._apart(unknown)
        self._products += 1
        radial = self._radial(free)
        shear = free - radial + self._outward * (self._slope * pressure)[:, np.newaxis]
        nodes, operator = self._maps.nodes, self._grid.inverse.operator
        into = operator.displacement(pressure, nodes, nodes) + self._maps.into_body(shear)
        along = self._maps.exact(shear) + self._maps.by_pressure(pressure)
        along += self._maps.diagonal * radial - self._radial(along)
        return np.concatenate([into, along.ravel()])

    def _preconditioned(self, moved: Real) -> Real:
        into, along = self._apart(moved)
        radial = self._radial(along)
        shear = self._maps.inverse(along - radial)
        shear += radial / self._maps.diagonal - self._radial(shear)
        return np.concatenate([self._normal(into), shear.ravel()])

    def _apart(self, both: Real) -> tuple[Real, Real]:
        count = self._slips.size
        return np.ascontiguousarray(both[:count]), both[count:].reshape(-1, 2)

    def stiffness(self, rtol: float) -> tuple[Real, int]:
        """Return total shear and pressure by unit slides and a unit approach, and the products."""
        from scipy.sparse.linalg import LinearOperator, gmres  # here because it loads slowly

        count, matrix = self._slips.size, np.full((3, 3), np.nan)
        shape = 3 * count, 3 * count
        operator = LinearOperator(shape, self._product, dtype=np.float64)
        inverse = LinearOperator(shape, self._preconditioned, dtype=np.float64)
        for axis in range(3):
            target = np.zeros(3 * count)
            if axis == 2:
                target[:count] = 1.0
            else:
                even = np.zeros((count, 2)) + np.eye(2)[axis]
                target[count:] = (even - self._radial(even)).ravel()
            given = {"rtol": rtol, "atol": 0.0, "restart": 80, "maxiter": 5}
            found, failed = gmres(operator, target, M=inverse, **given)
            if failed:
                continue
            pressure, free = self._apart(found)
            shear = free - self._radial(free)
            shear += self._outward * (self._slope * pressure)[:, np.newaxis]
            matrix[:, axis] = *shear.sum(axis=0), pressure.sum()
            self.found.append((pressure, shear))
        return matrix, self._products


class _Stuck:
    """A contact of which some nodes follow a slide along the rims of their discs alone."""

    def __init__(self, maps: ShearMaps, slips: Indices, outward: Real) -> None:
        self._maps, self._slips, out = maps, slips, outward[slips]
        self._rim = np.stack([-out[:, 1], out[:, 0]], axis=1)
        self._nowhere = np.zeros_like(outward)
        self.found: list[Real] = []  # the shear by unit slides along x and y

    def allowed(self, vectors: Real) -> Real:
        """Return what of vectors nodes can follow."""
        if not self._slips.size:
            return vectors
        kept = vectors.copy()
        along = np.einsum("ij,ij->i", self._rim, vectors[self._slips])
        kept[self._slips] = self._rim * along[:, np.newaxis]
        return kept

    def stiffness(self, accuracy: float) -> tuple[Real, int]:
        """Return the total shear by unit slides along x and y, and the convolutions.

        It is the energy form of both solutions, so that it errs by the square of their residuals.
        """
        spent, found = 0, []
        targets = [self.allowed(self._nowhere + axis) for axis in np.eye(2)]
        for target in targets:
            shear, residual, products = self.solved(target, accuracy)
            spent += 2 * products
            found.append((shear, residual))
        self.found = [shear for shear, _ in found]
        form = np.array(
            [
                [float(np.vdot(target, shear) + np.vdot(other, rest)) for shear, rest in found]
                for target, (other, _) in zip(targets, found, strict=True)
            ]
        )
        return (form + form.T) / 2, spent

    def solved(self, target: Real, accuracy: float) -> tuple[Real, Real, int]:
        """Solve by conjugate gradients, whose preconditioner may be a solution by rough ones.

        As that differs from step to step, directions are conjugate by the change of residuals [1]_.
        """
        shear, residual = np.zeros_like(target), target.copy()
        direction, before, gone = np.zeros_like(target), 0.0, residual
        for steps in range(_MOST_STEPS):
            step = self._preconditioned(residual)
            energy = float(np.vdot(residual, step))
            if not energy > accuracy * max(float(np.vdot(shear, target)), 0.0):
                return shear, residual, steps
            part = float(np.vdot(residual - gone, step)) / before if before > 0 else 0.0
            direction = step + max(part, 0.0) * direction
            response = self.allowed(self._maps.exact(direction))
            length = float(np.vdot(direction, residual)) / float(np.vdot(direction, response))
            before, gone = energy, residual
            shear, residual = shear + length * direction, residual - length * response
        return shear, residual, _MOST_STEPS

    def _preconditioned(self, residual: Real) -> Real:
        """Return about the shear that displaces so, by some steps with rough operators."""
        rough = self._maps.rough
        step = self.allowed(self._maps.inverse(residual))
        if rough is None:
            return step
        shear, left, direction, before = np.zeros_like(residual), residual, step, 0.0
        first = float(np.vdot(left, step))
        for _ in range(_MOST_STEPS):
            energy = float(np.vdot(left, step))
            if not energy > _ROUGH_SHARE * first:
                break
            direction = step + (energy / before if before > 0 else 0.0) * direction
            before, response = energy, self.allowed(rough(direction))
            length = energy / float(np.vdot(direction, response))
            shear, left = shear + length * direction, left - length * response
            step = self.allowed(self._maps.inverse(left))
        return shear
