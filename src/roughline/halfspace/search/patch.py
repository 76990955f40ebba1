"""The nodes in contact, and the elastic equations on them by conjugate gradients."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property

import numpy as np

from roughline.computing.arrays import Floats, InGrid, Mask, Real
from roughline.computing.compiled import compiled_sums
from roughline.halfspace.inverse.approximate_inverse import ApproximateInverse, preconditioner
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.operators.grid_nodes import GridNodes, Precision
from roughline.halfspace.operators.restricted import RestrictedOperator
from roughline.halfspace.search.carriers import merged

MOST_STEPS = 200  # steps on one set of nodes, after which their displacement is computed afresh


class Patch:
    """The elastic equations on a set of nodes; all vectors run over these nodes only.

    The displacement of other nodes, which are watched, is computed as well.
    """

    def __init__(
        self,
        operator: Convolution | RestrictedOperator,
        inverse: ApproximateInverse,
        nodes: GridNodes,
        watched: GridNodes | None = None,
    ) -> None:
        self._operator: Callable[..., Real] = operator.displacement
        self._nodes = nodes
        self.precondition = preconditioner(inverse, nodes)
        self._targets: GridNodes | None = nodes
        self._parts: tuple[InGrid, InGrid] | tuple[Mask, Mask] | None = None
        if watched is None or not watched.indices.size:
            return
        looked_at = nodes.indices.size + watched.indices.size
        if isinstance(operator, Convolution) and 2 * looked_at > math.prod(operator.shape):
            # a field takes less memory than a list of most of its nodes
            self._targets, self._parts = None, (nodes.indices, watched.indices)
        else:
            both, order = merged(nodes.indices, watched.indices)
            in_patch = order < nodes.indices.size
            self._targets, self._parts = GridNodes.of(both, nodes.shape), (in_patch, ~in_patch)

    @cached_property
    def even_preconditioned(self) -> Real:
        """What the preconditioner makes of an even displacement."""
        return self.precondition(np.ones(self._nodes.indices.size))

    def displacement(self, pressure: Real, precision: Precision) -> tuple[Real, Real]:
        """Displacement of the nodes, and of the watched ones, under pressures on the nodes."""
        displacement = self._operator(pressure, self._nodes, self._targets, precision)
        if self._parts is None:
            return displacement, displacement[:0]
        displacement = displacement.ravel()
        return displacement[self._parts[0]], displacement[self._parts[1]]


class ConjugateGradients:
    """Steps towards the pressures that displace the nodes of a patch by a target.

    With `fixed_total` the sum of the pressures stays as it is, and the nodes are displaced by
    ``target + level``. The level is an unknown then, found from the condition that no step changes
    the sum. These are the conjugate gradients of Polonsky and Keer [1]_ with a preconditioner, and
    without their corrections of single nodes, which are left to the active set.

    They start from pressures, what these miss of the target, and the displacements of the watched
    nodes from any datum, and overwrite all three. What is gained is by how much they have lessened
    the energy norm of the error, squared.

    References
    ----------
    .. [1] I. A. Polonsky and L. M. Keer, "A numerical method for solving rough contact problems
       based on the multi-level multi-summation and conjugate gradient techniques", Wear 231,
       206-219 (1999).
    """

    def __init__(
        self,
        patch: Patch,
        pressure: Real,
        residual: Real,
        watched: Real,
        *,
        fixed_total: bool,
        precision: Precision,
    ) -> None:
        self.pressure = pressure
        self.error = residual
        self.watched = watched
        self.level = 0.0  # goes with a fixed total [length]
        self.steps = 0  # each takes one convolution
        self.gained = 0.0  # [pressure length]
        self._patch = patch
        self._fixed_total = fixed_total
        self._precision = precision
        self._direction = np.zeros_like(pressure)
        self.energy = 0.0  # of the error, norm squared, by the preconditioner
        self.largest_error = 0.0  # [length]
        self._turn()

    def _turn(self) -> None:
        """Precondition the error, and take the next direction, which is conjugate to the last.

        With a fixed total the sum of the direction is zero.
        """
        step = self._patch.precondition(self.error)
        rise = 0.0
        even = self._patch.even_preconditioned if self._fixed_total else None
        if even is not None:
            rise = -float(step.sum() / even.sum())
            self.level += rise
        self.energy, self.largest_error = _next_direction(
            step, even, rise, self.energy, self.error, self._direction
        )

    def advance(self) -> bool:
        """Do one step; return False if there is nothing more to gain."""
        response, watched = self._patch.displacement(self._direction, self._precision)
        length = _step(
            self._direction, response, watched, self.energy, self.pressure, self.error, self.watched
        )
        if not length > 0:
            return False
        self.steps += 1
        self.gained += length * self.energy
        self._turn()
        return True


@compiled_sums
def _next_direction(
    step: Floats,
    even: Floats | None,
    rise: float,
    before: float,
    error: Floats,
    direction: Floats,
) -> tuple[float, float]:
    """Raise the error and its step, and let the direction be conjugate to the one before.

    Return the energy of the error, and its largest value. The energy before is zero at first.
    """
    energy, largest = 0.0, 0.0
    for i in range(step.size):
        if even is not None:
            step[i] += rise * even[i]
            error[i] += rise
        energy += error[i] * step[i]
        largest = max(largest, abs(error[i]))
    part = energy / before if before > 0 else 0.0
    for i in range(step.size):
        direction[i] = step[i] + part * direction[i]
    return energy, largest


@compiled_sums
def _step(
    direction: Floats,
    response: Floats,
    watched_response: Floats,
    energy: float,
    pressure: Floats,
    error: Floats,
    watched: Floats,
) -> float:
    """Go along a direction to the least energy; return how far, zero if there is none to gain."""
    curvature = 0.0
    for i in range(direction.size):
        curvature += direction[i] * response[i]
    if not (curvature > 0 and energy > 0):
        return 0.0
    length = energy / curvature
    for i in range(direction.size):
        pressure[i] += length * direction[i]
        error[i] -= length * response[i]
    for i in range(watched.size):
        watched[i] += length * watched_response[i]
    return length
