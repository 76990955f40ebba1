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


class Maps(Protocol):
    """How shear displaces the nodes: exactly, roughly, and about how that is undone."""

    def exact(self, shear: Real) -> Real:
        """Return the displacements."""

    @property
    def rough(self) -> Linear | None:
        """Displacements as of one kind of shear alone; None where the exact ones cost no more."""

    def inverse(self, moved: Real) -> Real:
        """Return about the shear that displaces so."""


def shear_tangents(
    maps: Maps,
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


class _Stuck:
    """A contact of which some nodes follow a slide along the rims of their discs alone."""

    def __init__(self, maps: Maps, slips: Indices, rim: Real) -> None:
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
