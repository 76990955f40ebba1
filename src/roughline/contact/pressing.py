"""A surface and how it is pressed, checked: what decides its curve."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from roughline.contact.curve import SurfaceCurve
from roughline.contact.field_request import FieldRequest
from roughline.contact.loads import Loads
from roughline.contact.measures import Measure
from roughline.contact.solver import AS_USUAL, Solver
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.laws.law import ContactLaw
from roughline.topography.body import Surface

_LOAD_ROUNDING = 1e-12  # relative difference of loads that are the same


@dataclass(frozen=True, eq=False)
class Pressing:
    """A surface that is pressed into a half-space under loads, by a contact law."""

    surface: Surface
    half_space: HalfSpace
    law: ContactLaw
    loads: Loads
    rtol: float
    measures: Sequence[Measure] = ()
    solver: Solver = AS_USUAL

    def curve(
        self,
        progress: Callable[[int, int], None] | None = None,
        kept_fields: frozenset[int] = frozenset(),
    ) -> SurfaceCurve:
        """Press it; keep the fields of loads with these numbers."""
        # imported here because compiled loops load slowly
        from roughline.contact.full import press_surface
        from roughline.halfspace.search.problem import Method

        return press_surface(
            self.surface,
            self.loads,
            self.law,
            half_space=self.half_space,
            method=Method(self.rtol, self.solver.max_iterations, self.solver.precision),
            wanted=FieldRequest(kept_fields, self.measures),
            progress=progress,
        )

    def tells(self, other: Pressing) -> bool:
        """Whether its curve is that of the other as well, and no less exact."""
        mine, its = self.loads, other.loads
        return (
            self.rtol <= other.rtol
            and {each.name for each in other.measures} <= {each.name for each in self.measures}
            and mine.control == its.control
            and mine.values.shape == its.values.shape
            and np.allclose(mine.values, its.values, rtol=_LOAD_ROUNDING, atol=0)
            and self.half_space == other.half_space
            and self.law == other.law
            and self.surface.sizes == other.surface.sizes
            and np.array_equal(self.surface.heights, other.surface.heights)
        )
