"""How shear and pressure displace the nodes of a contact: exactly, roughly, and about undone."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from roughline.computing.arrays import Real
from roughline.halfspace.friction.discs import Discs, DiscSearch, Linear, Sheared
from roughline.halfspace.friction.law import Friction
from roughline.halfspace.friction.vectors import within
from roughline.halfspace.inverse.approximate_inverse import preconditioner
from roughline.halfspace.inverse.cache import inverse_on
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.operators.restricted_shear import RestrictedShear
from roughline.halfspace.operators.shear import ShearConvolution, at_origin, shear_on_grid
from roughline.halfspace.search.problem import Method, Problem

_MOST_TURNS = 40  # of corrections by the exact operator
_ROUGH_SHARE = 5e-3  # of what is wrong before a turn with the rough operator, and what that errs by


class ShearMaps(Protocol):
    """How shear displaces the nodes: exactly, roughly, and about how that is undone."""

    diagonal: float  # displacement of a node by shear on itself [length / pressure]

    def exact(self, shear: Real) -> Real:
        """Return the displacements."""

    @property
    def rough(self) -> Linear | None:
        """Displacements, roughly; None where the exact ones cost no more."""

    def inverse(self, moved: Real) -> Real:
        """Return about the shear that displaces so."""


@dataclass(frozen=True, eq=False)
class ShearedBodies:
    """Untouched bodies, the friction between them, and how they are solved."""

    problem: Problem
    friction: Friction
    method: Method

    @cached_property
    def exact(self) -> ShearConvolution:
        """How shear displaces them."""
        grid = self.problem.grid
        workspace = grid.inverse.operator.workspace
        return shear_on_grid(grid.half_space, grid.shape, grid.spacing, workspace)

    @cached_property
    def diagonal(self) -> float:
        """Displacement of a node by the pressure on itself. [length / pressure]"""
        operator = self.problem.operator
        return at_origin(operator.spectrum, operator.periods)

    def restricted(self, nodes: GridNodes) -> RestrictedShear | None:
        """Return how shear displaces them roughly, if that costs less on some nodes."""
        grid, forms = self.problem.grid, self.problem.grid.inverse.restricted
        ratios = forms.ratios(nodes)
        if ratios is None:
            return None
        if ratios not in self._made:
            operator = grid.inverse.operator
            made = RestrictedShear.of(self.exact, operator, ratios, forms.margins)
            self._made[ratios] = made
        return self._made[ratios]

    @cached_property
    def _made(self) -> dict[tuple[int, int], RestrictedShear]:
        return {}


class ShearedNodes:
    """How shear displaces a set of nodes: exactly, and nearly, at the cost of the contact."""

    def __init__(self, bodies: ShearedBodies, nodes: GridNodes) -> None:
        self._exact, self.nodes, grid = bodies.exact, nodes, bodies.problem.grid
        self._restricted = bodies.restricted(nodes)
        half_space, self._factor = grid.half_space.even_shear
        inverse = inverse_on(half_space, grid.shape, grid.spacing)
        self._precondition = preconditioner(inverse, nodes)
        self._normal = grid.inverse.operator
        self.convolutions = 0
        self.diagonal = bodies.exact.diagonal

    def exact(self, shear: Real) -> Real:
        """Return the displacements by the exact operator."""
        self.convolutions += 2
        return self._exact.displacement(shear, self.nodes, self.nodes)

    def displaced(self, pressure: Real, shear: Real) -> tuple[Real, Real]:
        """Return the displacements into the body and along the surface by pressure and shear."""
        here = self._normal.spectrum, self.nodes, self.nodes
        return self._exact.displaced(pressure, shear, *here)

    def roughly_displaced(self, pressure: Real, shear: Real) -> tuple[Real, Real]:
        """Return the same, roughly."""
        assert self._restricted is not None
        return self._restricted.displaced(pressure, shear, self.nodes, self.nodes)

    @property
    def rough(self) -> Linear | None:
        """Displacements, roughly; None where the exact ones cost no more."""
        return None if self._restricted is None else self._roughly

    def _roughly(self, shear: Real) -> Real:
        assert self._restricted is not None
        return self._restricted.displacement(shear, self.nodes, self.nodes)

    def inverse(self, moved: Real) -> Real:
        """Return about the shear that displaces so."""
        shear = np.empty_like(moved)
        for axis in range(2):
            shear[:, axis] = self._precondition(np.ascontiguousarray(moved[:, axis]))
        shear /= self._factor
        return shear

    def found(
        self,
        discs: Discs,
        start: tuple[Real, Real],
        known: tuple[Real, Real] | None,
        accuracy: tuple[float, float],
    ) -> Sheared:
        """Return the shear on the discs from one and a level, as :class:`DiscSearch` does.

        Where there is a rough operator, it is corrected for what it misses of the shear so far, or
        of one whose exact displacement is known. The accuracy is a tolerance and a share.
        """
        self.convolutions, (tolerance, share) = 0, accuracy
        exact, rough = DiscSearch(self.exact, self.inverse), self.rough
        if rough is None:
            return exact.found(discs, start, tolerance=tolerance, share=share)
        before, inside = math.inf, within(start[0], discs.bound)
        known = known or (inside, self.exact(inside))
        for _ in range(_MOST_TURNS):
            search = DiscSearch(rough, self.inverse, known)
            aims = {"tolerance": 0.5 * tolerance, "share": share, "gain": _ROUGH_SHARE}
            better = search.found(discs, start, **aims)
            start = better.shear, better.level
            now = discs.judged(*start, self.exact(better.shear))
            known = now.shear, now.displacement
            if now.residual <= tolerance and now.missing <= share * float(discs.bound.sum()):
                return now
            if now.residual > 0.7 * before:
                break
            before = now.residual
        return exact.found(discs, start, tolerance=tolerance, share=share)
