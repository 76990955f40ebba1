"""Conjugate gradients on a trial contact set, until the error of the set itself dominates."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.halfspace.laws.conditions import (
    ContactConditions,
    Violations,
    out_of_bounds,
    violations,
)
from roughline.halfspace.operators.operator import Precision
from roughline.halfspace.search.contact_set import merged
from roughline.halfspace.search.patch import ConjugateGradients, Patch
from roughline.halfspace.search.state import Load, Problem
from roughline.halfspace.search.trial import Trial

# Conjugate gradients aim below the tolerance so that the certificate is not missed by a hair.
_AIM = 0.3
# Steps on one set of nodes before it is looked at again.
_STEPS = 200


@dataclass(frozen=True, eq=False)
class Relaxation:
    """Where conjugate gradients on a trial contact set ended.

    Attributes
    ----------
    violations : Violations
        Nodes of the set that pull, yield or lift, and watched nodes that overlap.
    level : float
        Approach since touch that goes with the pressures. [length]
    largest_error : float
        Largest displacement that is missing on the elastic nodes; a pressure out of its bounds
        counts as the displacement that it causes at its own node. [length]
    steps : int
        Steps done; each takes one convolution.
    """

    violations: Violations
    level: float
    largest_error: float
    steps: int


def relaxed(
    problem: Problem,
    load: Load,
    trial: Trial,
    watched: Indices,
    rtol: float,
    precision: Precision,
    *,
    most_steps: int,
    to_tolerance: bool,
) -> Relaxation:
    """Lead the pressures of a trial towards those that close the gap; they are overwritten.

    Parameters
    ----------
    problem, load : Problem, Load
        The bodies, and what is prescribed.
    trial : Trial
        The trial contact set, its pressures and the gap that they leave.
    watched : ndarray of int
        Nodes off the contact at which overlap is looked for.
    rtol : float
        Bound on the residuals.
    precision : {"float64", "float32"}
        Precision of the convolutions.
    most_steps : int
        Bound on the steps.
    to_tolerance : bool
        Whether to go on to the tolerance, whatever is wrong with the set of nodes.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the operator is not positive definite.
    """
    conditions, diagonal = problem.conditions, problem.inverse.diagonal
    tolerance, most_steps = _AIM * rtol * trial.length_scale, min(most_steps, _STEPS)
    pressure = trial.contact_set.pressure
    elastic = conditions.elastic(pressure)
    if not elastic.any():  # under a given depth, all may be at the hardness
        off, held = trial.gap.flat[watched], trial.gap.flat[trial.contact_set.nodes] - trial.overlap
        wrong = violations(conditions, elastic, pressure[:0], off, held, 0.0, tolerance)
        return Relaxation(wrong, trial.approach, 0.0, 0)
    equations = _Equations.of(problem, load, trial, watched, elastic, precision)
    gradients = equations.gradients
    while True:
        level = trial.approach if load.force is None else gradients.level
        error, squared = _largest_and_squared(gradients.error)
        wrong = equations.violations(conditions, level, tolerance)
        if error <= tolerance or gradients.steps >= most_steps:
            break
        outweighed = wrong.squared(diagonal) > squared
        if outweighed and gradients.steps and not to_tolerance:
            break
        if not gradients.advance():
            break
    pressure[elastic] = gradients.pressure
    largest_error = max(error, max(out_of_bounds(conditions, gradients.pressure)) * diagonal)
    return Relaxation(wrong, level, largest_error, gradients.steps)


def _largest_and_squared(values: Real) -> tuple[float, float]:
    """Return the largest magnitude, and the sum of squares."""
    return float(np.abs(values).max(initial=0.0)), float(values @ values)


@dataclass(frozen=True, eq=False)
class _Equations:
    """The equations of the elastic nodes of a trial, and what is looked at beside them.

    Attributes
    ----------
    gradients : ConjugateGradients
        Steps towards their solution.
    elastic : ndarray of bool, shape (nodes,)
        Which nodes in contact are elastic.
    off_contact : ndarray of bool
        Which of the nodes whose displacement is followed are off the contact; the others are at
        the hardness.
    """

    gradients: ConjugateGradients
    elastic: Mask
    off_contact: Mask

    @classmethod
    def of(
        cls,
        problem: Problem,
        load: Load,
        trial: Trial,
        watched: Indices,
        elastic: Mask,
        precision: Precision,
    ) -> _Equations:
        """Set up the equations."""
        nodes, pressure = trial.contact_set.nodes, trial.contact_set.pressure
        held = nodes[~elastic]
        followed, order = merged(watched, held)
        gaps = np.concatenate([trial.gap.flat[watched], trial.gap.flat[held] - trial.overlap])
        fixed_total = load.force is not None
        gradients = ConjugateGradients(
            Patch(
                problem.steps,
                problem.inverse,
                problem.grid_nodes(nodes[elastic]),
                problem.grid_nodes(followed),
            ),
            pressure[elastic],
            -trial.gap.flat[nodes[elastic]] - (trial.approach if fixed_total else 0.0),
            gaps[order] + trial.approach,
            fixed_total=fixed_total,
            precision=precision,
        )
        return cls(gradients, elastic, order < watched.size)

    def violations(
        self, conditions: ContactConditions, level: float, tolerance: float
    ) -> Violations:
        """Return the nodes that are on the wrong side after the steps so far."""
        followed = self.gradients.watched
        return violations(
            conditions,
            self.elastic,
            self.gradients.pressure,
            followed[self.off_contact],
            followed[~self.off_contact],
            level,
            tolerance,
        )
