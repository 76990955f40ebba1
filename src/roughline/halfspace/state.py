"""What is prescribed, and what a contact under one load is."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from roughline.halfspace.operator import Operator, Precision
from roughline.halfspace.preconditioner import Approximation

Field = NDArray[np.float64]
Vector = NDArray[np.float64]
Nodes = NDArray[np.intp]


class Outcome(enum.Enum):
    """How the search for the contact set ended."""

    CONVERGED = "converged"
    STALLED = "stalled"
    MAX_ITERATIONS = "max_iterations"


@dataclass(frozen=True, eq=False)
class Problem:
    """A body over a half-space, before any load.

    Attributes
    ----------
    operator : Operator
        The half-space.
    approximation : Approximation
        What its preconditioner knows of it.
    separation : ndarray, shape (nx, ny)
        Distance of the bodies at first touch, zero at the highest point. [length]
    rms_height : float
        Gaps are compared with this, or with the depth where that is smaller; zero for a flat
        punch, where it is the depth. [length]
    """

    operator: Operator
    approximation: Approximation
    separation: Field
    rms_height: float

    @classmethod
    def of(cls, operator: Operator, separation: Field, rms_height: float) -> Problem:
        """Put a body over a half-space."""
        return cls(operator, Approximation.of(operator), separation, rms_height)


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
        Of the convolutions; mixed: steps in single precision, residuals in double.
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
        """Precision of the residuals."""
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


@dataclass(frozen=True, eq=False)
class Start:
    """Where a search for the contact starts from.

    Attributes
    ----------
    nodes : ndarray of int
        Nodes in contact, ascending flat indices; at least one.
    pressure : ndarray, shape (nodes,)
        Pressures on them, none negative. [pressure]
    """

    nodes: Nodes
    pressure: Vector


@dataclass(frozen=True)
class Residuals:
    """Violations of the contact conditions, recomputed from the returned pressures.

    Attributes
    ----------
    gap, penetration : float
        Largest gap on contact nodes and overlap off them, over the length scale.
    tension : float
        Largest pull, over the mean contact pressure.
    load : float
        Error of the force, over the force; zero under depth control.
    """

    gap: float
    penetration: float
    tension: float
    load: float

    @classmethod
    def of(
        cls, gap: Field, nodes: Nodes, pressure: Vector, force: float, load: Load, scale: float
    ) -> Residuals:
        """Compute them; gaps are compared with the length `scale`."""
        on_contact = gap.flat[nodes]
        # gaps on contact count as such whatever their sign, so they may stay in the minimum
        overlap_everywhere = max(0.0, -float(gap.min()))
        overlap_on_contact = max(0.0, -float(on_contact.min()))
        penetration = overlap_everywhere if overlap_everywhere > overlap_on_contact else 0.0
        pull = max(0.0, -float(pressure.min()))
        return cls(
            gap=float(np.abs(on_contact).max()) / scale,
            penetration=penetration / scale,
            tension=pull / abs(float(pressure.mean())) if pull else 0.0,
            load=0.0 if load.force is None else abs(force - load.force) / load.force,
        )

    @property
    def worst(self) -> float:
        """The largest of the four."""
        return max(self.gap, self.penetration, self.tension, self.load)


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
        On the whole grid. [length]
    residuals : Residuals
        Recomputed from the fields above.
    outcome : Outcome
        Whether they are within the tolerance.
    convolutions : int
        Convolutions spent on this load.
    """

    depth: float
    force: float
    nodes: Nodes
    pressure: Vector
    gap: Field
    residuals: Residuals
    outcome: Outcome
    convolutions: int
