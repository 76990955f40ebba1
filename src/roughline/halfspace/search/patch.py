"""The nodes in contact, and the elastic equations on them by conjugate gradients."""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Real
from roughline.halfspace.inverse.approximate_inverse import ApproximateInverse, preconditioner
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.operators.grid_nodes import GridNodes, Precision
from roughline.halfspace.operators.restricted import RestrictedOperator
from roughline.halfspace.search.carriers import merged


class Patch:
    """The elastic equations on a set of nodes; all vectors run over these nodes only.

    Parameters
    ----------
    operator : Convolution
        Displacement under pressures on the whole grid.
    inverse : ApproximateInverse
        Approximate inverse of the operator, for the preconditioner.
    nodes : GridNodes
        The nodes.
    watched : GridNodes, optional
        Other nodes whose displacement is computed as well.
    """

    def __init__(
        self,
        operator: Convolution | RestrictedOperator,
        inverse: ApproximateInverse,
        nodes: GridNodes,
        watched: GridNodes | None = None,
    ) -> None:
        self._operator = operator
        self._nodes = nodes
        self.precondition = preconditioner(inverse, nodes)
        self._targets = nodes
        if watched is not None and watched.indices.size:
            both, order = merged(nodes.indices, watched.indices)
            self._targets = GridNodes.of(both, nodes.shape)
            self._in_patch = order < nodes.indices.size

    def displacement(self, pressure: Real, precision: Precision) -> tuple[Real, Real]:
        """Displacement of the nodes, and of the watched ones, under pressures on the nodes."""
        displacement = self._operator.displacement(pressure, self._nodes, self._targets, precision)
        if self._targets is self._nodes:
            return displacement, displacement[:0]
        return displacement[self._in_patch], displacement[~self._in_patch]


class ConjugateGradients:
    """Steps towards the pressures that displace the nodes of a patch by a target.

    With `fixed_total` the sum of the pressures stays as it is, and the nodes are displaced by
    ``target + level``. The level is an unknown then, found from the condition that no step changes
    the sum. These are the conjugate gradients of Polonsky and Keer [1]_ with a preconditioner, and
    without their corrections of single nodes, which are left to the active set.

    Parameters
    ----------
    patch : Patch
        The equations.
    pressure : ndarray, shape (nodes,)
        Pressures to start from; overwritten. [pressure]
    residual : ndarray, shape (nodes,)
        The target less the displacement that they cause; overwritten. [length]
    watched : ndarray, shape (watched,)
        Displacement of the watched nodes, from any datum; overwritten. [length]
    fixed_total : bool
        Whether the total load or the level is prescribed.
    precision : {"float64", "float32"}
        Precision of the convolutions.

    Attributes
    ----------
    pressure, watched : ndarray
        Pressures, and displacements of the watched nodes, after the steps so far.
    level : float
        The uniform displacement that goes with a fixed total; zero where the total is free.
        [length]
    energy : float
        Estimate of the energy norm of the error, squared. [pressure length]
    gained : float
        By how much the steps so far have lessened the energy norm of the error, squared.
        [pressure length]
    steps : int
        Steps done; each takes one convolution.

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
        self.watched = watched
        self.level = 0.0
        self.steps = 0
        self._patch = patch
        self._precision = precision
        self._residual = residual
        self._ones = patch.precondition(np.ones_like(pressure)) if fixed_total else None
        self._direction = np.zeros_like(pressure)
        self.energy = np.inf
        self.gained = 0.0
        self._project()

    def _project(self) -> None:
        """Precondition the residual; with a fixed total, so that the sum of the step is zero."""
        self._step = self._patch.precondition(self._residual)
        if self._ones is not None:
            self.level = -float(self._step.sum() / self._ones.sum())
            self._step += self.level * self._ones
        self._energy_before, self.energy = self.energy, float(self.error @ self._step)

    @property
    def error(self) -> Real:
        """Displacement that is still missing, shape (nodes,). [length]"""
        return self._residual + self.level

    def advance(self) -> bool:
        """Do one step; return False if there is nothing more to gain."""
        # 1. The new direction is conjugate to the last one, which is zero before the first step.
        self._direction *= self.energy / self._energy_before
        self._direction += self._step
        # 2. The displacement that it causes, by one convolution.
        response, watched = self._patch.displacement(self._direction, self._precision)
        curvature = float(self._direction @ response)
        if not (curvature > 0 and self.energy > 0):
            return False
        # 3. Go along it to the least energy.
        length = self.energy / curvature
        self.pressure += length * self._direction
        self.watched += length * watched
        self._residual -= length * response
        self.steps += 1
        self.gained += length * self.energy
        # 4. Project and precondition what is left.
        self._project()
        return True
