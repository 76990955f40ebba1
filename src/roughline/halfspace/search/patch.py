"""The nodes in contact, and the elastic equations on them by conjugate gradients."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property

import numpy as np

from roughline.computing.arrays import InGrid, Mask, Real
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
        self._direction, self.energy = self._projected()

    def _projected(self) -> tuple[Real, float]:
        """Precondition the error; with a fixed total, so that the sum of the step is zero.

        Return the step, and the energy norm of the error by it, squared.
        """
        step = self._patch.precondition(self.error)
        if self._fixed_total:
            even = self._patch.even_preconditioned
            rise = -float(step.sum() / even.sum())
            step += rise * even
            self.error += rise
            self.level += rise
        return step, float(self.error @ step)

    def advance(self) -> bool:
        """Do one step; return False if there is nothing more to gain."""
        before = self.energy
        if not self._goes():
            return False
        # the new direction is conjugate to this one
        step, self.energy = self._projected()
        self._direction *= self.energy / before
        self._direction += step
        return True

    def _goes(self) -> bool:
        """Go along the direction to the least energy; return whether there is any to gain."""
        response, watched = self._patch.displacement(self._direction, self._precision)
        curvature = float(self._direction @ response)
        if not (curvature > 0 and self.energy > 0):
            return False
        length = self.energy / curvature
        self.pressure += length * self._direction
        self.watched += length * watched
        response *= length
        self.error -= response
        self.steps += 1
        self.gained += length * self.energy
        return True
