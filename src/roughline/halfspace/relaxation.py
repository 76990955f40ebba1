"""Conjugate gradients on a trial contact set, until the set itself is what is wrong."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from roughline.computing.arrays import Indices, Mask
from roughline.halfspace.conditions import Violations
from roughline.halfspace.operator import Precision
from roughline.halfspace.patch import ConjugateGradients, Patch
from roughline.halfspace.state import Load, Problem
from roughline.halfspace.trial import Trial

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
        Nodes of the set that pull, and watched nodes that overlap.
    level : float
        Depth that goes with the pressures. [length]
    largest_error : float
        Largest displacement that is missing on the set; a pull counts as the displacement that it
        causes at its own node. [length]
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
    elastic, gradients = _equations(problem, load, trial, watched, precision)
    while True:
        level = trial.depth if load.force is None else gradients.level
        error = float(np.abs(gradients.error).max())
        violations = conditions.violations(gradients.pressure, gradients.watched, level)
        if error <= tolerance or gradients.steps >= most_steps:
            break
        outweighed = violations.squared(diagonal) > gradients.error @ gradients.error
        if outweighed and gradients.steps and not to_tolerance:
            break
        if not gradients.advance():
            break
    trial.contact_set.pressure[elastic] = gradients.pressure
    pulling = np.zeros(trial.contact_set.nodes.size, dtype=bool)
    pulling[elastic] = violations.pulling
    largest_error = max(error, conditions.largest_pull(gradients.pressure) * diagonal)
    return Relaxation(replace(violations, pulling=pulling), level, largest_error, gradients.steps)


def _equations(
    problem: Problem, load: Load, trial: Trial, watched: Indices, precision: Precision
) -> tuple[Mask | slice, ConjugateGradients]:
    """Set up the equations of the elastic nodes of a trial; also return which these are."""
    nodes, pressure = trial.contact_set.nodes, trial.contact_set.pressure
    elastic = problem.conditions.elastic(pressure)
    nodes = nodes[elastic]
    fixed_total = load.force is not None
    gradients = ConjugateGradients(
        Patch(problem.operator, problem.inverse, nodes, watched),
        pressure[elastic],
        -trial.gap.flat[nodes] - (trial.depth if fixed_total else 0.0),
        trial.gap.flat[watched] + trial.depth,
        fixed_total=fixed_total,
        precision=precision,
    )
    return elastic, gradients
