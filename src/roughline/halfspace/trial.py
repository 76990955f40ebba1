"""A trial contact set with its pressures: the gap that they leave, and how wrong they are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.halfspace.conditions import Residuals
from roughline.halfspace.contact_set import ContactSet
from roughline.halfspace.operator import GridNodes, Precision
from roughline.halfspace.state import Contact, Load, Outcome, Problem


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
        Gap on the whole grid. [length]
    length_scale : float
        Gaps are compared with this. [length]
    residuals : Residuals
        Violations of the contact conditions.
    """

    contact_set: ContactSet
    depth: float
    force: float
    gap: Real
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
        operator, nodes, pressure = problem.operator, contact_set.nodes, contact_set.pressure
        cell_area = operator.cell_area
        if load.force is not None:
            pressure = _with_total(pressure, load.force / cell_area)
        sources = GridNodes.of(nodes, operator.shape)
        gap = operator.displacement(pressure, sources, None, precision, out=out)
        if load.depth is not None and rescale:
            factor = _best_factor(
                load.depth - problem.separation.flat[nodes], pressure, gap.flat[nodes]
            )
            pressure = factor * pressure
            gap *= factor
        gap += problem.separation
        total = float(pressure.sum())
        depth = load.depth
        if depth is None:  # the work of the pressures
            depth = float(pressure @ gap.flat[nodes]) / total
        gap -= depth
        force = cell_area * total
        length_scale = _length_scale(problem, depth)
        residuals = problem.conditions.residuals(
            gap, nodes, pressure, length_scale, load.error(force)
        )
        return cls(ContactSet(nodes, pressure), depth, force, gap, length_scale, residuals)

    def contact(self, problem: Problem, outcome: Outcome, convolutions: int) -> Contact:
        """Return the trial as the contact with which a search ended."""
        return Contact(
            depth=self.depth,
            force=self.force,
            nodes=self.contact_set.nodes,
            pressure=self.contact_set.pressure,
            gap=self.gap,
            separation=problem.separation,
            residuals=self.residuals,
            outcome=outcome,
            convolutions=convolutions,
        )


def _length_scale(problem: Problem, depth: float) -> float:
    """Return the length with which gaps are compared."""
    if problem.rms_height:
        return min(problem.rms_height, abs(depth))
    if problem.operator.zero_mean:  # even pressure on a flat surface moves nothing
        return 1.0
    return abs(depth)


def _with_total(pressure: Real, total: float) -> Real:
    """Scale the pressures to a total; spread it evenly where there is nothing to scale."""
    now = float(pressure.sum())
    if now > 0:
        return pressure * (total / now)
    return np.full_like(pressure, total / pressure.size)


def _best_factor(target: Real, pressure: Real, displacement: Real) -> float:
    """Return the factor by which the pressures come closest to the target, in energy."""
    energy = float(pressure @ displacement)
    return max(float(pressure @ target) / energy, 0.0) if energy > 0 else 1.0
