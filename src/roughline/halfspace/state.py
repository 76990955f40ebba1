"""What is prescribed, and what a contact under one load is."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import Literal

from roughline.computing.arrays import Indices, Real
from roughline.halfspace.conditions import Residuals, UnilateralContact
from roughline.halfspace.half_space import HalfSpace
from roughline.halfspace.operator import Operator, Precision
from roughline.halfspace.preconditioner import ApproximateInverse


class Outcome(enum.Enum):
    """How the search for the contact set ended."""

    CONVERGED = "converged"
    STALLED = "stalled"
    MAX_ITERATIONS = "max_iterations"


@dataclass(frozen=True, eq=False)
class Problem:
    """A rough body over a half-space on a grid, before any load.

    Attributes
    ----------
    half_space : HalfSpace
        The half-space.
    operator : Operator
        Its displacements under pressures on the grid.
    inverse : ApproximateInverse
        Approximate inverse of the operator.
    separation : ndarray, shape (nx, ny)
        Distance of the bodies at first touch, zero at the highest point. [length]
    rms_height : float
        Gaps are compared with this, or with the depth where that is smaller; zero for a flat
        punch, where it is the depth. [length]
    conditions : UnilateralContact
        What pressures and gaps obey.
    """

    half_space: HalfSpace
    operator: Operator
    inverse: ApproximateInverse
    separation: Real
    rms_height: float
    conditions: UnilateralContact

    @classmethod
    def of(
        cls,
        half_space: HalfSpace,
        operator: Operator,
        separation: Real,
        rms_height: float,
        conditions: UnilateralContact,
    ) -> Problem:
        """Put a rough body over a half-space; the operator is one that the half-space made."""
        inverse = ApproximateInverse.of(operator)
        return cls(half_space, operator, inverse, separation, rms_height, conditions)


@dataclass(frozen=True)
class Method:
    """How a contact is solved.

    Attributes
    ----------
    rtol : float
        Bound on every residual.
    max_iterations : int
        Bound on the convolutions of one load.
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
        Nodes in contact, ascending flat indices.
    pressure : ndarray, shape (nodes,)
        Pressures on them. [pressure]
    gap : ndarray, shape (nx, ny)
        Gap on the whole grid. [length]
    separation : ndarray, shape (nx, ny)
        Distance of the bodies at first touch, as this load leaves their surfaces. [length]
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
    gap: Real
    separation: Real
    residuals: Residuals
    outcome: Outcome
    convolutions: int
