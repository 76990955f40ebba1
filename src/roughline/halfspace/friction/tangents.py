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
from roughline.halfspace.inverse.approximate_inverse import preconditioner
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.search.problem import Contact, Method

_ENERGY_MARGIN = 0.01  # part of the tolerance, to which the stiffness is solved
_MOST_STEPS = 300
_ROUGH_SHARE = 1e-2  # of the energy of an error, that steps with rough operators leave


@dataclass(frozen=True, eq=False)
class ShearTangents:
    """Stiffness dQ/d(slide) at a state, each 2 by 2. [force / length]"""

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
    shear: Real,
    sticks: Mask,
    method: Method,
    back: Real | None = None,
) -> ShearTangents:
    """Solve for both tangents; that of turning back may be known of the same contact."""
    grid = contact.problem.grid
    rigid = np.diag([np.inf, np.inf])
    is_whole = contact.nodes.size == contact.separation.size
    if is_whole and grid.inverse.operator.mean_is_free and sticks.all():
        return ShearTangents(rigid, rigid)
    accuracy, spent = _ENERGY_MARGIN * method.rtol, 0
    size = np.maximum(np.hypot(shear[:, 0], shear[:, 1]), 1e-300)
    rim = np.stack([-shear[:, 1] / size, shear[:, 0] / size], axis=1)
    if back is None:
        found, spent = _Stuck(maps, np.zeros(0, dtype=np.intp), rim).stiffness(accuracy)
        back = grid.cell_area * found
    if sticks.all():
        return ShearTangents(back, back, spent)
    found, more = _Stuck(maps, np.flatnonzero(~sticks), rim).stiffness(accuracy)
    return ShearTangents(grid.cell_area * found, back, spent + more)


class CoupledMaps(ShearMaps, Protocol):
    """The same of bodies in which pressure displaces along the surface, and shear into the body."""

    nodes: GridNodes
    diagonal: float

    def by_pressure(self, pressure: Real) -> Real:
        """Return the displacements along the surface."""

    def into_body(self, shear: Real) -> Real:
        """Return the displacements into the body."""


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
        return matrix, self._products


class _Stuck:
    """A contact of which some nodes follow a slide along the rims of their discs alone."""

    def __init__(self, maps: ShearMaps, slips: Indices, rim: Real) -> None:
        self._maps, self._slips, self._rim, self._there = maps, slips, rim, rim[slips]

    def _allowed(self, vectors: Real) -> Real:
        if not self._slips.size:
            return vectors
        kept = vectors.copy()
        along = np.einsum("ij,ij->i", self._there, vectors[self._slips])
        kept[self._slips] = self._there * along[:, np.newaxis]
        return kept

    def stiffness(self, accuracy: float) -> tuple[Real, int]:
        """Return the total shear by unit slides along x and y, and the convolutions.

        It is the energy form of both solutions, so that it errs by the square of their residuals.
        """
        spent, found = 0, []
        targets = [self._allowed(np.zeros_like(self._rim) + axis) for axis in np.eye(2)]
        for target in targets:
            shear, residual, products = self._solved(target, accuracy)
            spent += 2 * products
            found.append((shear, residual))
        form = np.array(
            [
                [float(np.vdot(target, shear) + np.vdot(other, rest)) for shear, rest in found]
                for target, (other, _) in zip(targets, found, strict=True)
            ]
        )
        return (form + form.T) / 2, spent

    def _solved(self, target: Real, accuracy: float) -> tuple[Real, Real, int]:
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
            response = self._allowed(self._maps.exact(direction))
            length = float(np.vdot(direction, residual)) / float(np.vdot(direction, response))
            before, gone = energy, residual
            shear, residual = shear + length * direction, residual - length * response
        return shear, residual, _MOST_STEPS

    def _preconditioned(self, residual: Real) -> Real:
        """Return about the shear that displaces so, by some steps with rough operators."""
        rough = self._maps.rough
        step = self._allowed(self._maps.inverse(residual))
        if rough is None:
            return step
        shear, left, direction, before = np.zeros_like(residual), residual, step, 0.0
        first = float(np.vdot(left, step))
        for _ in range(_MOST_STEPS):
            energy = float(np.vdot(left, step))
            if not energy > _ROUGH_SHARE * first:
                break
            direction = step + (energy / before if before > 0 else 0.0) * direction
            before, response = energy, self._allowed(rough(direction))
            length = energy / float(np.vdot(direction, response))
            shear, left = shear + length * direction, left - length * response
            step = self._allowed(self._maps.inverse(left))
        return shear
