"""A trial contact set with its pressures: the gap that they leave, and their errors."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.halfspace.laws.conditions import Residuals, residuals
from roughline.halfspace.operators import loops
from roughline.halfspace.operators.operator import Precision
from roughline.halfspace.search.contact_set import ContactSet
from roughline.halfspace.search.state import Contact, Load, Outcome, Problem

_GAPS_AT_A_TIME = 2**18  # so many fit into a cache


@dataclass(frozen=True, eq=False)
class Trial:
    """A trial contact set under a load, and what follows from its pressures.

    Attributes
    ----------
    contact_set : ContactSet
        The nodes, and the pressures on them.
    approach, force : float
        Approach since the surfaces, as they are now, touch [length] and total force [force].
    gap : ndarray, shape (nx, ny)
        Gap on the whole grid, on the surface as the load indents it. [length]
    overlap : ndarray, shape (nodes at the hardness,)
        By how much it indents these nodes. [length]
    length_scale : float
        Gaps are compared with this. [length]
    residuals : Residuals
        Violations of the contact conditions.
    """

    contact_set: ContactSet
    approach: float
    force: float
    gap: Real
    overlap: Real
    length_scale: float
    residuals: Residuals

    @classmethod
    def of(
        cls,
        problem: Problem,
        load: Load,
        contact_set: ContactSet,
        precision: Precision,
        out: Real,
        *,
        rescale: bool = False,
    ) -> Trial:
        """Compute the gap everywhere, and with it the residuals.

        Parameters
        ----------
        problem, load : Problem, Load
            The bodies, and what is prescribed.
        contact_set : ContactSet
            Trial nodes and pressures. Under a given force the pressures are scaled to it.
        precision : {"float64", "float32"}
            Precision of the convolution.
        out : ndarray, shape (nx, ny)
            Where the gap is written.
        rescale : bool
            Whether to scale the pressures under a given depth, too, to those of least energy.
        """
        operator, conditions = problem.operator, problem.conditions
        nodes, pressure = contact_set.nodes, contact_set.pressure
        cell_area = operator.cell_area
        most = conditions.largest_pressure
        if load.force is None:
            pressure = np.minimum(pressure, most)
        else:
            pressure = conditions.with_total(pressure, load.force / cell_area)
        elastic = conditions.elastic(pressure)
        gap = problem.displacement(pressure, nodes, precision, out)
        # dents put touch deep: from there on, differences of lengths lose least to rounding
        above = problem.separation.flat[nodes] - problem.touch
        approach = None if load.depth is None else load.depth - problem.touch
        if approach is not None and rescale and elastic.all():
            factor = _best_factor(approach - above, pressure, gap.flat[nodes])
            below = np.nextafter(most, 0.0)
            if factor * float(pressure.max()) > below:  # so that none reaches the hardness
                factor = below / float(pressure.max())
            pressure = np.minimum(factor * pressure, below)  # the product may be rounded up
            gap *= factor
        displacement = gap.flat[nodes]
        if approach is None:
            approach = _level(displacement + above, pressure, elastic)
        _leave_gaps(problem, gap, approach)
        held = nodes[~elastic]
        overlap = np.maximum(-gap.flat[held], 0.0)
        gap.flat[held] += overlap
        force = cell_area * float(pressure.sum())
        length_scale = _length_scale(problem, approach, displacement, pressure, force)
        violated = residuals(
            conditions, gap, nodes, pressure, length_scale, load.error(force), approach
        )
        return cls(
            ContactSet(nodes, pressure), approach, force, gap, overlap, length_scale, violated
        )

    def certified(self, rtol: float) -> bool:
        """Whether the residuals are within a tolerance, and no node overlaps that was left out."""
        return self.residuals.worst <= rtol and not self.residuals.penetration

    def contact(self, problem: Problem, outcome: Outcome, convolutions: int) -> Contact:
        """Return the trial as the contact with which a search ended."""
        nodes, pressure = self.contact_set.nodes, self.contact_set.pressure
        plastic, separation = ~problem.conditions.elastic(pressure), problem.separation
        if self.overlap.any():
            separation = np.array(separation)
            separation.flat[nodes[plastic]] += self.overlap
        return Contact(
            depth=problem.touch + self.approach,
            force=self.force,
            nodes=nodes,
            pressure=pressure,
            plastic=plastic,
            gap=self.gap,
            separation=separation,
            residuals=self.residuals,
            outcome=outcome,
            convolutions=convolutions,
        )


def _leave_gaps(problem: Problem, displacement: Real, approach: float) -> None:
    """Turn displacements into the gaps that they leave, some rows at a time."""
    rows = 1 + _GAPS_AT_A_TIME * len(displacement) // displacement.size
    for first in range(0, len(displacement), rows):
        part = slice(first, first + rows)
        separation = np.atleast_2d(problem.separation[part])
        loops.leave_gaps(np.atleast_2d(displacement[part]), separation, problem.touch, approach)


def _length_scale(
    problem: Problem, approach: float, displacement: Real, pressure: Real, force: float
) -> float:
    """Return the length with which gaps are compared, as :func:`roughline.press` defines it.

    It is the least of the rms height and of what the load moves: the largest displacement on the
    contact. Where a flat body bears evenly hardly anything moves. There a gap is compared with
    what rounding leaves of displacements, over the tolerance.
    """
    moved = float(displacement.max()) if pressure.any() else abs(approach)
    operator = problem.operator
    length = math.sqrt(math.prod(operator.shape)) * math.sqrt(operator.cell_area)
    moved = max(moved, problem.resolution * force / (problem.half_space.E_star * length))
    return min(problem.rms_height, moved) if problem.rms_height else moved


def _level(displaced: Real, pressure: Real, elastic: Mask) -> float:
    """Return the depth that goes with pressures, from where they put the nodes under them."""
    weights = pressure[elastic]
    total = float(weights.sum())
    if total > 0:  # the work of the pressures
        return float(weights @ displaced[elastic]) / total
    # nodes that have just come into contact, or else all of them overlap
    return float(displaced[elastic].mean() if elastic.any() else displaced.max())


def _best_factor(target: Real, pressure: Real, displacement: Real) -> float:
    """Return the factor by which the pressures come closest to the target, in energy."""
    energy = float(pressure @ displacement)
    return max(float(pressure @ target) / energy, 0.0) if energy > 0 else 1.0
