"""The contact problem under a load, and its solution."""

from __future__ import annotations

import enum
import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal

import numpy as np

from roughline.computing.arrays import InGrid, InRegion, Mask, Real
from roughline.errors import InputError
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.inverse.approximate_inverse import ApproximateInverse
from roughline.halfspace.inverse.cache import inverse_on
from roughline.halfspace.laws.bounds import Bounds
from roughline.halfspace.laws.law import ContactLaw
from roughline.halfspace.laws.pulling_zone import pulled_length
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.operators.discretisation import coarser_grid
from roughline.halfspace.operators.grid_nodes import GridNodes, Precision
from roughline.halfspace.search.pull import Pull, Shares
from roughline.halfspace.search.response import Response

# Displacements by even pressures, which are zero on a periodic half-space, are up to 0.5 machine
# epsilons of pi C F / A_0 on grids of 8 to 10^6 points. C is the compliance of the longest wave, in
# which rounded pressures displace most.
_DEPTH_ROUNDINGS = 2.0
SINGLE_ABOVE = 1e-4
"""Single precision serves while errors are above this part of what moves; its own are 1e-7."""
_FORESEEN_DEPTH = 1.05  # times the approach of a start up to which bodies are looked at
_LEAST_PULL = 1e-3  # of the largest pull, with which pressures are compared at least


class Outcome(enum.Enum):
    """How the search for the contact set ended."""

    CONVERGED = "converged"
    STALLED = "stalled"
    MAX_ITERATIONS = "max_iterations"
    UNKNOWN_SURFACE = "unknown_surface"
    PULLED_OFF = "pulled_off"
    SLIDES = "slides"


@dataclass(frozen=True, eq=False)
class Grid:
    """A half-space divided into cells; its operator is made when it is needed."""

    half_space: HalfSpace
    shape: tuple[int, int]
    spacing: tuple[float, float]  # sides of a cell [length]

    @cached_property
    def inverse(self) -> ApproximateInverse:
        """Approximate inverse of the operator, which it has with it."""
        return inverse_on(self.half_space, self.shape, self.spacing)

    @property
    def cell_area(self) -> float:
        """Area of one cell. [length²]"""
        return self.spacing[0] * self.spacing[1]

    def nodes(self, indices: InGrid) -> GridNodes:
        """List the nodes with these ascending flat indices."""
        return GridNodes.of(indices, self.shape)

    @property
    def coarser(self) -> Grid:
        """The grid of half as many points a side."""
        coarse = coarser_grid(self.shape, self.spacing, periodic=self.half_space.periodic)
        return Grid(self.half_space, *coarse)


@dataclass(frozen=True, eq=False)
class Problem:
    """A rough body over a half-space on a grid, as the loads so far have left their surfaces."""

    grid: Grid
    # distance of the bodies at first touch of the untouched surfaces; zero at the highest point
    # until that is indented [length]
    separation: Real
    # gaps are compared with this, or with what the load moves where that is less; zero for a flat
    # punch [length]
    rms_height: float
    # but with no less than this times the sum of the forces on all nodes, :meth:`Method.resolution`
    resolution: float
    law: ContactLaw
    # what nodes that are apart are pulled with, of the largest pull
    shares: Shares = field(default_factory=Shares.none)
    # whether the upper bounds are left out, as long as no node exceeds its own
    is_elastic: bool = False

    def __post_init__(self) -> None:
        """Refuse a law whose bounds are not those of this grid's nodes."""
        count = self.separation.size
        for bound in self.law.bounds(None):
            if np.shape(bound) not in ((), (count,)):
                nodes = " x ".join(map(str, self.separation.shape))
                raise InputError(
                    f"gives bounds of the shape {np.shape(bound)} for all nodes of a grid of "
                    f"{nodes}: let `bounds` give one number or {count}, and let `on` take the "
                    "law's fields to other grids",
                    "law",
                )

    def is_apart_under(self, load: Load) -> bool:
        """Whether nothing is pressed by a load, as the surfaces are now."""
        return load.value == 0 if load.depth is None else load.depth <= self.touch

    @property
    def inverse(self) -> ApproximateInverse:
        """Approximate inverse of the operator."""
        return self.grid.inverse

    @property
    def operator(self) -> Convolution:
        """The half-space's displacements under pressures on the grid."""
        return self.grid.inverse.operator

    @cached_property
    def touch(self) -> float:
        """Depth at which the surfaces touch, as they are now. [length]"""
        return float(self.separation.min())

    def reach(self, depth: float) -> float:
        """Return how near, beyond the least separation, bodies are that can touch. [length]

        Where a law only pushes, and pressure displaces all of the surface away from the other
        body, the gap is at least the separation less the depth. So where the separation is larger
        than the depth the gap is positive, and bodies cannot touch.
        """
        pushed = self.law.only_pushes and self.grid.half_space.is_pushed_everywhere
        return max(0.0, depth - self.touch) if pushed else math.inf

    def foreseen_reach(self, load: Load, start: ContactSet) -> float:
        """Return the reach up to which nodes are looked at, from what a start foresees. [length]"""
        depth = start.depth if load.depth is None else load.depth
        return math.inf if depth is None else _FORESEEN_DEPTH * self.reach(depth)

    @cached_property
    def bounds(self) -> Bounds:
        """The bounds that the pressures of all nodes have now."""
        return self.bounds_at(None)

    def bounds_at(self, nodes: InGrid | None) -> Bounds:
        """Return the bounds that the pressures of ascending nodes have now, or of all."""
        low, high = self.law.bounds(nodes)
        if not self.law.only_pushes:
            shares = self.shares
            low = low * (shares.field(self.separation.size) if nodes is None else shares.at(nodes))
        return Bounds(low, math.inf if self.is_elastic else high)

    @property
    def pull(self) -> Pull:
        """The pull across gaps."""
        half_space, compliance = self.grid.half_space, self.grid.inverse.diagonal
        return Pull(self.law, self.separation, compliance, half_space.repeats)

    def exceeds(self, nodes: InGrid, pressure: Real, times: float = 1.0) -> bool:
        """Whether elastic bodies bear more than so many times an upper bound, on some of nodes."""
        most = Bounds.of(self.law, nodes).high
        return self.is_elastic and bool(np.any(pressure > times * np.asarray(most)))

    def scales(self, pressure: Real, displacement: Real) -> tuple[float, float]:
        """Return with what pressures and gaps are compared in the residuals.

        They are the mean magnitude of the pressures, which does not vanish where pushes and pulls
        balance, and the largest displacement towards the half-space. Bodies that pull may displace
        each other by nothing, so their gaps are compared with the range. Nor need they bear
        anything: where they touch under no load and nothing else is within reach, pressures are
        compared with a part of the largest pull. [pressure] and [length]
        """
        mean = float(np.abs(pressure).mean())
        if self.law.only_pushes:
            return mean, float(displacement.max())
        least = _LEAST_PULL * Bounds.of(self.law).largest_pull
        return max(mean, least), pulled_length(self.law)


@dataclass(frozen=True)
class Method:
    """How a contact is solved. Mixed precision takes steps in single, residuals in double."""

    rtol: float  # bound on every residual
    max_iterations: int  # bound on the convolutions that find the contact of one load
    precision: Literal["mixed", "float64", "float32"] = "mixed"

    @property
    def steps(self) -> Precision:
        """Precision of the steps."""
        return "float64" if self.precision == "float64" else "float32"

    @property
    def certificate(self) -> Precision:
        """Precision of the residuals that are returned."""
        return "float32" if self.precision == "float32" else "float64"

    def to(self, rtol: float, single: bool) -> Method:
        """Return the method for such a tolerance, which may be somewhat less than its own.

        Single precision, where it is allowed, serves while the error is large, and hides it where
        it is small.
        """
        precision = self.precision
        if precision == "mixed":
            precision = "float32" if single and rtol >= SINGLE_ABOVE else "float64"
        return replace(self, rtol=rtol, precision=precision)

    def resolution(self, grid: Grid) -> float:
        """Rounding of displacements over the force, over the tolerance. [length / force]"""
        sides = [n * spacing for n, spacing in zip(grid.shape, grid.spacing, strict=True)]
        rounding = _DEPTH_ROUNDINGS * float(np.finfo(self.certificate).eps)
        longest = float(grid.half_space.spectrum(np.array([2 * np.pi / max(sides)]))[0])
        return rounding / self.rtol * math.pi * longest / math.prod(sides)


@dataclass(frozen=True)
class Load:
    """One load, by depth or by force; the other is None."""

    depth: float | None = None  # approach since first touch [length]
    force: float | None = None  # total force [force]

    @property
    def value(self) -> float:
        """What is prescribed. [length] or [force]"""
        value = self.depth if self.force is None else self.force
        assert value is not None
        return value

    def total(self, cell_area: float) -> float | None:
        """Return the sum of all pressures under a given force; None under a given depth."""
        return None if self.force is None else self.force / cell_area


@dataclass(frozen=True, eq=False)
class ContactSet:
    """Nodes in contact, ascending flat indices in the grid, and the pressures on them."""

    nodes: InGrid
    pressure: Real
    depth: float | None = None  # that goes with them, about; None where it is not known [length]


def _largest(numbers: tuple[float, ...]) -> float:
    """Return the largest of some numbers; NaN if one is."""
    return math.nan if any(map(math.isnan, numbers)) else max(numbers)


@dataclass(frozen=True)
class Residuals:
    """Violations of the contact conditions, recomputed from the returned pressures."""

    # largest gap where the bodies touch, and overlap elsewhere, over the length scale
    gap: float = 0.0
    penetration: float = 0.0
    # how far pressures are below and above their bounds at most, over the pressure scale
    tension: float = 0.0
    excess: float = 0.0
    # error of the force, over the sum of the forces on all nodes; zero under depth control
    load: float = 0.0
    # spacing of numbers at the depth, over the length scale: smaller gaps are lost in it
    rounding: float = 0.0
    # largest misfit of a law that follows gaps, over the length scale
    misfit: float = 0.0
    # largest violation of friction, over the length by which sliding displaces
    slip: float = 0.0

    @property
    def _each(self) -> tuple[float, ...]:
        return (
            self.gap,
            self.penetration,
            self.tension,
            self.excess,
            self.load,
            self.rounding,
            self.misfit,
            self.slip,
        )

    @property
    def worst(self) -> float:
        """The largest of them; NaN if one is."""
        return _largest(self._each)

    @property
    def violation(self) -> float:
        """The largest of them but for the rounding."""
        return _largest((*self._each[:5], self.misfit))

    @property
    def worst_name(self) -> str:
        """What the largest of them is of, in words."""
        return (
            "the gap within the contact",
            "the overlap outside the contact",
            "tension",
            "pressure above the hardness",
            "the force",
            "the rounding of the depth",
            "the pull across gaps",
            "the slip",
        )[int(np.argmax(self._each))]


@dataclass(frozen=True, eq=False)
class Contact:
    """State of the contact under one load."""

    # the bodies, as this load leaves them: with the same separation if it leaves that as it was
    problem: Problem
    depth: float  # approach since first touch [length]
    force: float
    nodes: InGrid  # with a pressure, ascending flat indices
    pressure: Real
    # which of them are at the upper bound, and at a lower bound that is not zero; at the other ones
    # the bodies touch, and the pressure follows the load
    plastic: Mask
    pulling: Mask
    # the nodes that can touch, and the neighbours of the contact; None: all of the grid
    looked_at: GridNodes | None
    gaps: Real  # there [length]
    length_scale: float  # with which gaps are compared [length]
    residuals: Residuals
    outcome: Outcome
    convolutions: int  # spent on this load
    load: Load
    response: Response | None = None  # to a change of the load, once the contact is certified

    @property
    def touching(self) -> Mask:
        """Which nodes' pressures follow a larger load."""
        return ~(self.plastic | self.pulling)

    @property
    def contact_set(self) -> ContactSet:
        """The nodes under pressure, the pressures and the depth."""
        return ContactSet(self.nodes, self.pressure, self.depth)

    @property
    def separation(self) -> Real:
        """Distance of the bodies at first touch, as this load leaves them, shape (nx, ny)."""
        return self.problem.separation

    @cached_property
    def gap(self) -> Real:
        """Gap on the whole grid, shape (nx, ny). [length]"""
        if self.looked_at is None:
            return self.gaps.reshape(self.separation.shape)
        nodes = GridNodes.of(self.nodes, self.separation.shape)
        gap = self.problem.operator.displacement(self.pressure, nodes)
        gap += self.separation
        gap -= self.depth
        gap.flat[self.looked_at.indices] = self.gaps
        return gap

    def gap_at(self, nodes: InGrid) -> Real:
        """Return the gap at nodes that were looked at: those in contact and their neighbours."""
        places = InRegion(nodes)  # all of the grid, unless less was looked at
        if self.looked_at is not None:
            places = InRegion(np.searchsorted(self.looked_at.indices, nodes))
            places[places == self.gaps.size] = 0
            if not np.array_equal(self.looked_at.indices[places], nodes):
                return self.gap.ravel()[nodes]
        return self.gaps[places]
