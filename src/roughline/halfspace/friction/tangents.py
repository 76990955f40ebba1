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

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.computing.krylov import least_residual
from roughline.halfspace.friction.discs import Linear
from roughline.halfspace.friction.vectors import followed, inner
from roughline.halfspace.inverse.approximate_inverse import preconditioner
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.search.problem import Contact, Method

_ENERGY_MARGIN = 0.01  # part of the tolerance, to which the stiffness is solved
_MOST_STEPS = 300
_ROUGH_SHARE = 1e-6  # of the energy of an error, that steps with rough operators leave
_ROUGH_ERROR = 0.03  # of the energy that they find, at most
_COUPLED_SHARE = 3e-3  # of what rough operators of coupled bodies correct, and what they err by
_MOST_TURNS = 10  # of corrections
_SCALE_SHARE = 0.1  # of the energy that counts, up to which they go on


Rates = tuple[Real, Real]
"""Shear of nodes by unit slides along x and along y, each of shape (nodes, 2)."""


@dataclass(frozen=True, eq=False)
class ShearTangents:
    """Stiffness dQ/d(slide) at a state, each 2 by 2. [force / length]"""

    on: Real
    back: Real
    convolutions: int = 0
    rates: tuple[Rates, Rates] | None = None  # how shear follows, going on and turning back


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
    state: tuple[Real, Mask],
    method: Method,
    last: ShearTangents | None = None,
) -> ShearTangents:
    """Solve for both tangents of a state, which is its shear, and where it sticks.

    That of turning back is known from the last load, if that was of the same contact.
    """
    (shear, sticks), grid = state, contact.problem.grid
    rigid = np.diag([np.inf, np.inf])
    is_whole = contact.nodes.size == contact.separation.size
    if is_whole and grid.inverse.operator.mean_is_free and sticks.all():
        return ShearTangents(rigid, rigid)
    accuracy, spent = _ENERGY_MARGIN * method.rtol, 0
    size = np.maximum(np.hypot(shear[:, 0], shear[:, 1]), 1e-300)
    rim = np.stack([-shear[:, 1] / size, shear[:, 0] / size], axis=1)
    if last is None or last.rates is None:
        none = np.zeros_like(sticks)
        found, rates, spent = _Stuck(maps, none, rim).stiffness(accuracy, _even_rates(contact))
        back = grid.cell_area * found
        start = rates
    else:
        back, (start, rates) = last.back, last.rates
    if sticks.all():
        return ShearTangents(back, back, spent, (rates, rates))
    found, on, more = _Stuck(maps, ~sticks, rim).stiffness(accuracy, start)
    return ShearTangents(grid.cell_area * found, back, spent + more, (on, rates))


def _even_rates(contact: Contact) -> Rates | None:
    """Return shear that goes as the pressure does when the bodies come nearer."""
    if contact.response is None:
        return None
    rate = contact.response.unloading.pressure_per_force
    if not (rate.any() and np.isfinite(rate).all()):
        return None
    none = np.zeros_like(rate)
    return np.stack([rate, none], axis=1), np.stack([none, rate], axis=1)


class CoupledMaps(ShearMaps, Protocol):
    """The same of bodies in which pressure displaces along the surface, and shear into the body."""

    nodes: GridNodes
    diagonal: float

    def displaced(self, pressure: Real, shear: Real) -> tuple[Real, Real]:
        """Return the displacements into the body and along the surface."""

    def roughly_displaced(self, pressure: Real, shear: Real) -> tuple[Real, Real]:
        """Return the same roughly, if there are rough ones."""


def coupled_tangents(
    maps: CoupledMaps, contact: Contact, state: tuple[Real, Mask, Real], method: Method
) -> tuple[ShearTangents, tuple[float, float]]:
    """Solve for both tangents of bodies that are coupled, and for dF/dd on both.

    The state is the shear, where it sticks, and how much more shear nodes bear under more pressure.
    Where a node slips its shear follows the pressure, so that the equations are not symmetric. The
    tangents are those under a constant force, and dF/dd is that under a constant shear force.
    """
    (shear, sticks, slope), grid = state, contact.problem.grid
    whole = contact.nodes.size == contact.separation.size
    unknown = np.full((2, 2), np.nan)
    if whole and grid.inverse.operator.mean_is_free:
        return ShearTangents(unknown, unknown), (np.inf, np.inf)
    found, spent = [], 0
    everywhere = np.ones_like(sticks)
    for holds in (everywhere,) if sticks.all() else (everywhere, sticks):
        matrix, products = _CoupledStuck(maps, contact, shear, holds, slope).stiffness(method.rtol)
        found.append(grid.cell_area * matrix)
        spent += 7 * products
    (along_back, normal_back), (along_on, normal_on) = map(_condensed, (found[0], found[-1]))
    return ShearTangents(along_on, along_back, spent), (normal_on, normal_back)


def _condensed(matrix: Real) -> tuple[Real, float]:
    """Return dQ/d(slide) under a constant force, and dF/dd under a constant shear force."""
    along, normal = matrix[:2, :2], float(matrix[2, 2])
    of_depth, of_slide = matrix[:2, 2], matrix[2, :2]
    held = along - np.outer(of_depth, of_slide) / normal
    return held, normal - float(of_slide @ np.linalg.solve(along, of_depth))


class _CoupledStuck:
    """A contact of coupled bodies, of which some nodes slip on."""

    def __init__(
        self, maps: CoupledMaps, contact: Contact, shear: Real, holds: Mask, slope: Real
    ) -> None:
        self._maps, self._grid, self._slips = maps, contact.problem.grid, ~holds
        size = np.maximum(np.hypot(shear[:, 0], shear[:, 1]), 1e-300)[:, np.newaxis]
        self._outward = np.where(self._slips[:, np.newaxis], shear / size, 0.0)
        self._slope = slope
        self._products = 0
        self._normal = preconditioner(self._grid.inverse, maps.nodes)

    def _radial(self, vectors: Real) -> Real:
        """Return what of vectors nodes that slip cannot follow."""
        along = np.einsum("ij,ij->i", self._outward, vectors)
        return self._outward * along[:, np.newaxis]

    def _exactly(self, unknown: Real) -> Real:
        self._products += 1
        return self._product(unknown, self._maps.displaced)

    def _roughly(self, unknown: Real) -> Real:
        return self._product(unknown, self._maps.roughly_displaced)

    def _product(self, unknown: Real, moved: Callable[[Real, Real], tuple[Real, Real]]) -> Real:
        """Return the displacements by pressure and shear, and what is left of the radial shear."""
        pressure, free = self._apart(unknown)
        radial = self._radial(free)
        shear = free - radial + self._outward * (self._slope * pressure)[:, np.newaxis]
        into, along = moved(pressure, shear)
        along = along + self._maps.diagonal * radial - self._radial(along)
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
        count, matrix = self._slips.size, np.full((3, 3), np.nan)
        for axis in range(3):
            target = np.zeros(3 * count)
            if axis == 2:
                target[:count] = 1.0
            else:
                even = np.zeros((count, 2)) + np.eye(2)[axis]
                target[count:] = (even - self._radial(even)).ravel()
            found = self._solved(target, rtol)
            if found is None:
                continue
            pressure, free = self._apart(found)
            shear = free - self._radial(free)
            shear += self._outward * (self._slope * pressure)[:, np.newaxis]
            matrix[:, axis] = *shear.sum(axis=0), pressure.sum()
        return matrix, self._products

    def _solved(self, target: Real, rtol: float) -> Real | None:
        """Solve with rough operators, and correct what they miss; None without convergence."""
        found, left = np.zeros_like(target), 1.0
        if self._maps.rough is not None:
            residual, whole = target, float(np.abs(target).max())
            for _ in range(_MOST_TURNS):
                aim = max(_COUPLED_SHARE, 0.3 * rtol / left)
                found = (
                    found + least_residual(self._roughly, self._preconditioned, residual, aim)[0]
                )
                residual = target - self._exactly(found)
                before, left = left, float(np.abs(residual).max()) / whole
                if left <= rtol:
                    return found
                if left > 0.5 * before:
                    break
        found, left = least_residual(self._exactly, self._preconditioned, target, rtol)
        return found if left <= rtol else None


class _Stuck:
    """A contact of which some nodes follow a slide along the rims of their discs alone."""

    def __init__(self, maps: ShearMaps, slips: Mask, rim: Real) -> None:
        self._maps, self._slips, self._rim = maps, slips, rim

    def _allowed(self, vectors: Real) -> Real:
        return followed(vectors, self._slips, self._rim)

    def stiffness(self, accuracy: float, start: Rates | None) -> tuple[Real, Rates, int]:
        """Return the total shear by unit slides along x and y, the shear, and the convolutions.

        It is the energy form of both solutions, so that it errs by the square of their residuals;
        of what these still displace, the energy form by the preconditioner is added.
        """
        spent, found = 0, []
        targets = [self._allowed(np.zeros_like(self._rim) + axis) for axis in np.eye(2)]
        for axis, target in enumerate(targets):
            begun = None if start is None else self._allowed(start[axis])
            *solved, products = self._solved(target, begun, accuracy)
            spent += 2 * products
            found.append(solved)
        form = np.array(
            [
                [
                    inner(target, shear) + inner(other, rest) + inner(other_rest, step)
                    for shear, rest, step in found
                ]
                for target, (other, other_rest, _) in zip(targets, found, strict=True)
            ]
        )
        return (form + form.T) / 2, (found[0][0], found[1][0]), spent

    def _solved(
        self, target: Real, start: Real | None, accuracy: float
    ) -> tuple[Real, Real, Real, int]:
        """Solve by conjugate gradients, whose preconditioner may be a solution by rough ones.

        As that differs from step to step, directions are conjugate by the change of residuals [1]_.
        Return the shear, what it leaves, the next step, and the products.
        """
        shear, residual, products = np.zeros_like(target), target.copy(), 0
        if start is not None:
            response = self._allowed(self._maps.exact(start))
            length, products = inner(start, target) / inner(start, response), 1
            shear, residual = length * start, residual - length * response
        direction, before, gone = np.zeros_like(target), 0.0, residual
        while True:
            scale = accuracy * max(inner(shear, target), 0.0)
            step, error = self._preconditioned(residual, scale)
            energy = inner(residual, step)
            if not error * energy > scale or products > _MOST_STEPS:
                return shear, residual, step, products
            part = inner(residual - gone, step) / before if before > 0 else 0.0
            direction = step + max(part, 0.0) * direction
            response = self._allowed(self._maps.exact(direction))
            products += 1
            length = inner(direction, residual) / inner(direction, response)
            before, gone = energy, residual
            shear, residual = shear + length * direction, residual - length * response

    def _preconditioned(self, residual: Real, scale: float) -> tuple[Real, float]:
        """Return about the shear that displaces so, by steps with rough operators, and its error.

        The error is a part of its energy; less energy than the scale does not count.
        """
        rough = self._maps.rough
        step = self._allowed(self._maps.inverse(residual))
        if rough is None:
            return step, 1.0
        shear, left, direction, before = np.zeros_like(residual), residual, step, 0.0
        gained = 0.0
        for _ in range(_MOST_STEPS):
            energy = inner(left, step)
            if not energy > max(_ROUGH_SHARE * gained, _SCALE_SHARE * scale):
                break
            direction = step + (energy / before if before > 0 else 0.0) * direction
            before, response = energy, self._allowed(rough(direction))
            length = energy / inner(direction, response)
            shear, left = shear + length * direction, left - length * response
            gained += length * energy
            step = self._allowed(self._maps.inverse(left))
        return shear, _ROUGH_ERROR
