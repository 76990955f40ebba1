"""The prescribed load, and the state of the contact under it."""

from __future__ import annotations

import enum
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.inverse.approximate_inverse import ApproximateInverse
from roughline.halfspace.laws.conditions import ContactConditions, Residuals
from roughline.halfspace.operators.operator import GridNodes, Operator, Precision
from roughline.halfspace.operators.restricted import RestrictedOperator
from roughline.halfspace.search.separation import Separation

# Displacements by even pressures, which are zero on a periodic half-space, are up to 0.5 machine
# epsilons of F / (E* sqrt(A_0)) on grids of 8 to 10^6 points.
_ROUNDINGS = 2.0


class Outcome(enum.Enum):
    """How the search for the contact set ended."""

    CONVERGED = "converged"
    STALLED = "stalled"
    MAX_ITERATIONS = "max_iterations"
    UNKNOWN_SURFACE = "unknown_surface"


@dataclass(frozen=True, eq=False)
class Problem:
    """A rough body over a half-space on a grid, as the loads so far have left their surfaces.

    Attributes
    ----------
    half_space : HalfSpace
        The half-space.
    inverse : ApproximateInverse
        Approximate inverse of its operator on the grid.
    separation : ndarray or Separation, shape (nx, ny)
        Distance of the bodies at first touch of the untouched surfaces; zero at the highest point
        until that is indented. [length]
    rms_height : float
        Gaps are compared with this, or with what the load moves where that is less; zero for a
        flat punch. [length]
    resolution : float
        Gaps are compared with no less than this part of F / (E* sqrt(A_0)); see
        :attr:`Method.resolution`. [1]
    conditions : ContactConditions
        What pressures and gaps obey.
    """

    half_space: HalfSpace
    inverse: ApproximateInverse
    separation: Real | Separation
    rms_height: float
    resolution: float
    conditions: ContactConditions

    @property
    def operator(self) -> Operator:
        """The half-space's displacements under pressures on the grid."""
        return self.inverse.operator

    @cached_property
    def touch(self) -> float:
        """Depth at which the surfaces touch, as they are now. [length]"""
        return float(self.separation.min())

    @property
    def steps(self) -> Operator | RestrictedOperator:
        """What the steps of conjugate gradients take for the operator."""
        return self.operator

    def grid_nodes(self, nodes: Indices) -> GridNodes:
        """Return nodes of the problem as nodes of the grid."""
        return GridNodes.of(nodes, self.operator.shape)

    def displacement(self, pressure: Real, nodes: Indices, precision: Precision, out: Real) -> Real:
        """Return the displacement wherever there is a separation, under the pressure on nodes."""
        return self.operator.displacement(pressure, self.grid_nodes(nodes), None, precision, out)

    def fewest_nodes(self, load: Load) -> int:
        """Return how many nodes a load needs, so that one of them is below the hardness."""
        if load.force is None:
            return 1
        most = self.conditions.largest_pressure * self.operator.cell_area
        return 1 + int(load.force / most)


@dataclass(frozen=True)
class Method:
    """How a contact is solved.

    Attributes
    ----------
    rtol : float
        Bound on every residual.
    max_iterations : int
        Bound on the convolutions that find the contact of one load.
    precision : {"mixed", "float64", "float32"}
        Precision of the convolutions. Mixed: steps in single precision, residuals in double.
    """

    rtol: float
    max_iterations: int
    precision: Literal["mixed", "float64", "float32"] = "mixed"

    @property
    def steps(self) -> Precision:
        """Precision of the steps."""
        return "float64" if self.precision == "float64" else "float32"

    @property
    def certificate(self) -> Precision:
        """Precision of the residuals that are returned."""
        return "float32" if self.precision == "float32" else "float64"

    @property
    def resolution(self) -> float:
        """Rounding of displacements over F / (E* sqrt(A_0)), over the tolerance."""
        return _ROUNDINGS * float(np.finfo(self.certificate).eps) / self.rtol


@dataclass(frozen=True)
class Load:
    """One load, by depth or by force; the other is None.

    Attributes
    ----------
    depth : float or None
        Approach since first touch. [length]
    force : float or None
        Total force. [force]
    """

    depth: float | None = None
    force: float | None = None

    @property
    def value(self) -> float:
        """What is prescribed. [length] or [force]"""
        value = self.depth if self.force is None else self.force
        assert value is not None
        return value

    @classmethod
    def of(cls, control: Literal["depths", "forces"], value: float) -> Load:
        """Prescribe one value of the quantity under control."""
        return cls(force=value) if control == "forces" else cls(depth=value)

    def error(self, force: float) -> float:
        """Return how far a force is from the prescribed one, over it; zero under depth control."""
        return 0.0 if self.force is None else abs(force - self.force) / self.force


@dataclass(frozen=True, eq=False)
class Contact:
    """State of the contact under one load.

    Attributes
    ----------
    depth, force : float
        Approach since first touch [length] and total force [force].
    nodes : ndarray of int
        Nodes in contact, ascending flat indices: after a search, those under pressure.
    pressure : ndarray, shape (nodes,)
        Pressures on them. [pressure]
    plastic : ndarray of bool, shape (nodes,)
        Which of them are at the hardness.
    gap : ndarray, shape (nx, ny)
        Gap on the whole grid. [length]
    separation : ndarray or Separation, shape (nx, ny)
        Distance of the bodies at first touch, as this load leaves their surfaces: the problem's
        own array if it leaves them as they were. [length]
    residuals : Residuals
        Violations of the contact conditions by the fields above.
    outcome : Outcome
        How the search ended.
    convolutions : int
        Convolutions spent on this load.
    """

    depth: float
    force: float
    nodes: Indices
    pressure: Real
    plastic: Mask
    gap: Real
    separation: Real | Separation
    residuals: Residuals
    outcome: Outcome
    convolutions: int

    def of_loaded_nodes(self) -> Contact:
        """Return the contact without nodes that touch, within the tolerance, but bear nothing."""
        loaded = self.pressure > 0
        if loaded.all():
            return self
        nodes, pressure = self.nodes[loaded], self.pressure[loaded]
        return replace(self, nodes=nodes, pressure=pressure, plastic=self.plastic[loaded])
