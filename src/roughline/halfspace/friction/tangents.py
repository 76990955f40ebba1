"""The exact tangential stiffness of a contact with friction, going on and turning back.

Going on, nodes that stick follow the slide, and nodes that slip follow it along the rims of their
discs alone: the slip goes on in their direction, so that shear across it is as stuck as all else.
Turning back, all of the contact sticks.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.halfspace.search.problem import Contact, Method

_ENERGY_MARGIN = 0.01  # part of the tolerance, to which the stiffness is solved
_MOST_STEPS = 300


@dataclass(frozen=True, eq=False)
class ShearTangents:
    """Stiffness dQ/d(slide) at a state, each 2 by 2. [force / length]"""

    on: Real
    back: Real
    convolutions: int = 0


class _Maps(Protocol):
    """How shear displaces the nodes, and about how that is undone."""

    def exact(self, shear: Real) -> Real: ...
    def inverse(self, moved: Real) -> Real: ...


def shear_tangents(
    maps: _Maps, contact: Contact, shear: Real, sticks: Mask, method: Method
) -> ShearTangents:
    """Solve for both tangents."""
    grid = contact.problem.grid
    whole = contact.nodes.size == contact.separation.size
    accuracy = _ENERGY_MARGIN * method.rtol
    rigid = np.diag([np.inf, np.inf])
    rim = np.zeros_like(shear)
    size = np.maximum(np.hypot(shear[:, 0], shear[:, 1]), 1e-300)
    rim[:, 0], rim[:, 1] = -shear[:, 1] / size, shear[:, 0] / size
    if whole and grid.inverse.operator.mean_is_free and sticks.all():
        return ShearTangents(rigid, rigid)
    back, spent = _stiffness(maps, np.ones(sticks.size, dtype=bool), rim, accuracy)
    back *= grid.cell_area
    if sticks.all():
        return ShearTangents(back, back, spent)
    on, more = _stiffness(maps, sticks, rim, accuracy)
    return ShearTangents(grid.cell_area * on, back, spent + more)


def _stiffness(maps: _Maps, sticks: Mask, rim: Real, accuracy: float) -> tuple[Real, int]:
    """Return the total shear by unit slides along x and y, by conjugate gradients for both.

    It is the energy form of the solutions, so that it errs by the square of their residuals.
    """
    slips, spent = ~sticks, 0

    def allowed(vectors: Real) -> Real:
        kept = vectors.copy()
        along = np.einsum("ij,ij->i", rim[slips], vectors[slips])
        kept[slips] = rim[slips] * along[:, np.newaxis]
        return kept

    targets = [allowed(np.zeros_like(rim) + axis) for axis in np.eye(2)]
    found = []
    for target in targets:
        shear, residual = np.zeros_like(rim), target.copy()
        direction, before = np.zeros_like(rim), 0.0
        for _ in range(_MOST_STEPS):
            step = allowed(maps.inverse(residual))
            energy = float(np.vdot(residual, step))
            if not energy > accuracy * max(float(np.vdot(shear, target)), 0.0):
                break
            direction = step + (energy / before if before > 0 else 0.0) * direction
            before, response = energy, allowed(maps.exact(direction))
            spent += 2
            length = energy / float(np.vdot(direction, response))
            shear, residual = shear + length * direction, residual - length * response
        found.append((shear, residual))
    form = np.array(
        [
            [float(np.vdot(target, shear) + np.vdot(other, rest)) for shear, rest in found]
            for target, (other, _) in zip(targets, found, strict=True)
        ]
    )
    return (form + form.T) / 2, spent
