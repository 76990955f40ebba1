"""A trial contact set with its pressures: the gap that they leave, and how wrong they are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.halfspace.conditions import Residuals, residuals
from roughline.halfspace.contact_set import ContactSet
from roughline.halfspace.operator import GridNodes, Precision
from roughline.halfspace.state import Contact, Load, Outcome, Problem

# Dents put first touch deep. The gaps of an approach beyond it are compared with this part of the
# depth at least, since rounding hides smaller ones.
_LEAST_APPROACH = 1e-7


@dataclass(frozen=True, eq=False)
class Trial:
    """A trial contact set under a load, and what follows from its pressures.

    Attributes
    ----------
    contact_set : ContactSet
        The nodes, and the pressures on them.
    depth, force : float
        Approach since first touch [length] and total force [force].
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
    depth: float
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
        sources = GridNodes.of(nodes, operator.shape)
        gap = operator.displacement(pressure, sources, None, precision, out=out)
        if load.depth is not None and rescale and elastic.all():
            factor = _best_factor(
                load.depth - problem.separation.flat[nodes], pressure, gap.flat[nodes]
            )
            below = np.nextafter(most, 0.0)
            if factor * float(pressure.max()) > below:  # so that none reaches the hardness
                factor = below / float(pressure.max())
            pressure = np.minimum(factor * pressure, below)  # the product may be rounded up
            gap *= factor
        gap += problem.separation
        depth = load.depth
        if depth is None:
            depth = _level(gap.flat[nodes], pressure, elastic)
        gap -= depth
        held = nodes[~elastic]
        overlap = np.maximum(-gap.flat[held], 0.0)
        gap.flat[held] += overlap
        force = cell_area * float(pressure.sum())
        length_scale = _length_scale(problem, depth)
        violated = residuals(conditions, gap, nodes, pressure, length_scale, load.error(force))
        return cls(ContactSet(nodes, pressure), depth, force, gap, overlap, length_scale, violated)

    def contact(self, problem: Problem, outcome: Outcome, convolutions: int) -> Contact:
        """Return the trial as the contact with which a search ended."""
        nodes, pressure = self.contact_set.nodes, self.contact_set.pressure
        plastic, separation = ~problem.conditions.elastic(pressure), problem.separation
        if self.overlap.any():
            separation = separation.copy()
            separation.flat[nodes[plastic]] += self.overlap
        return Contact(
            depth=self.depth,
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


def _length_scale(problem: Problem, depth: float) -> float:
    """Return the length with which gaps are compared."""
    if problem.operator.zero_mean and not problem.rms_height:
        return 1.0  # even pressure on a flat surface moves nothing
    approach = max(abs(depth - problem.touch), _LEAST_APPROACH * abs(depth))
    return min(problem.rms_height, approach) if problem.rms_height else approach


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
