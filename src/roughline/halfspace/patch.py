"""The nodes in contact, and the elastic equations on them by conjugate gradients."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roughline.halfspace.operator import Operator, Places, Precision
from roughline.halfspace.preconditioner import Approximation, preconditioner

Vector = NDArray[np.float64]
Nodes = NDArray[np.intp]


class Patch:
    """A set of contact nodes of one operator; all vectors run over these nodes only.

    Parameters
    ----------
    operator, approximation
        The half-space and what its preconditioner knows of it.
    nodes : ndarray of int
        Flat indices in the grid, ascending.
    watched : ndarray of int, optional
        Nodes off the contact whose displacement is followed as well.
    """

    def __init__(
        self,
        operator: Operator,
        approximation: Approximation,
        nodes: Nodes,
        watched: Nodes | None = None,
    ) -> None:
        self.operator = operator
        self.nodes = nodes
        self.places = Places.of(nodes, operator.shape)
        self.precondition = preconditioner(approximation, self.places)
        self._targets = self.places
        if watched is not None and watched.size:
            both, order = merged(nodes, watched)
            self._targets = Places.of(both, operator.shape)
            self._is_contact = order < nodes.size

    def displacement(self, pressure: Vector, precision: Precision) -> tuple[Vector, Vector]:
        """Displacement of the nodes, and of the watched ones, under pressures on the nodes."""
        found = self.operator.convolve(pressure, self.places, self._targets, precision)
        if self._targets is self.places:
            return found, found[:0]
        return found[self._is_contact], found[~self._is_contact]


class ConjugateGradients:
    """Steps towards the pressures that displace the nodes of a patch by a target.

    With `fixed_total` the sum of the pressures stays as it is, and the nodes are displaced by
    ``target + level``, the level being found as well: residuals are projected so that no step
    changes the sum (Polonsky and Keer 1999, here with a preconditioner).

    Parameters
    ----------
    patch : Patch
        The equations.
    pressure : ndarray, shape (nodes,)
        Pressures to start from.
    residual : ndarray, shape (nodes,)
        The target less the displacement that they cause. [length]
    watched : ndarray, shape (watched,)
        Displacement of the watched nodes. [length]
    fixed_total : bool
        Whether the total load or the level is prescribed.
    precision : {"float64", "float32"}
        Of the convolutions.

    Attributes
    ----------
    pressure, watched : ndarray
        After the steps so far.
    level : float
        The uniform displacement that goes with a fixed total; zero where the total is free.
    error : ndarray, shape (nodes,)
        Displacement that is still missing. [length]
    energy : float
        Estimate of the energy norm of the error, squared. [pressure length]
    steps : int
        Steps, and so convolutions, done.
    """

    def __init__(
        self,
        patch: Patch,
        pressure: Vector,
        residual: Vector,
        watched: Vector,
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
        self._project()

    def _project(self) -> None:
        self._step = self._patch.precondition(self._residual)
        if self._ones is not None:
            self.level = -float(self._step.sum() / self._ones.sum())
            self._step += self.level * self._ones
        self.error = self._residual + self.level
        self._energy_before, self.energy = self.energy, float(self.error @ self._step)

    def advance(self) -> bool:
        """Do one step; return False if there is nothing more to gain."""
        self._direction *= self.energy / self._energy_before  # nothing yet on the first step
        self._direction += self._step
        response, watched = self._patch.displacement(self._direction, self._precision)
        curvature = float(self._direction @ response)
        if not (curvature > 0 and self.energy > 0):
            return False
        length = self.energy / curvature
        self.pressure += length * self._direction
        self.watched += length * watched
        self._residual -= length * response
        self.steps += 1
        self._project()
        return True


def merged(nodes: Nodes, others: Nodes) -> tuple[Nodes, NDArray[np.intp]]:
    """Merge two ascending, disjoint lists; also return where each entry stood in their chain."""
    chain = np.concatenate([nodes, others])
    order = np.argsort(chain, kind="stable")
    return chain[order], order
