"""The exact stiffness dF/dd, and how the pressures follow the load while the contact set stays.

On a fixed contact set a change of force displaces all of its nodes alike, so dp/dF solves
K_CC w = c with the forces of w summing to one; c is the compliance and k = 1 / c.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.halfspace.patch import ConjugateGradients, Patch
from roughline.halfspace.state import Contact, Method, Problem, Vector

# The stiffness is the energy form 1 / (w K w); conjugate gradients tell the energy of their error,
# and stop at this part of the tolerance for all else.
_MARGIN = 0.01
_STEPS = 300  # steps after which the energy is computed afresh
_ROUNDS = 6


@dataclass(frozen=True, eq=False)
class Tangent:
    """Linear response of a contact to a change of load.

    Attributes
    ----------
    stiffness : float
        k = dF/dd; infinite in full contact of the periodic half-space. [force / length]
    pressure_per_force : ndarray, shape (nodes,)
        dp/dF on the contact nodes. [1 / area]
    convolutions : int
        Convolutions spent.
    converged : bool
        Whether the linear equations were solved.
    """

    stiffness: float
    pressure_per_force: Vector
    convolutions: int
    converged: bool


def tangent(
    problem: Problem,
    contact: Contact,
    start: Vector | None,
    method: Method,
) -> Tangent:
    """Solve for the exact stiffness of a contact.

    The stiffness is the energy form 1 / (w K w), so it errs upwards, by the square of the
    residual.

    Parameters
    ----------
    problem : Problem
        The body and the half-space.
    contact : Contact
        The contact whose set of nodes is held fixed.
    start : ndarray, shape (nodes,), optional
        Guess of dp/dF, such as that of the load before; the pressures themselves if absent.
        [1 / area]
    method : Method
        The stiffness is sought to a hundredth of its tolerance.
    """
    operator = problem.operator
    cell_area = operator.cell_area
    if operator.is_periodic and contact.nodes.size == contact.gap.size:
        even = np.full(contact.nodes.size, 1 / (contact.nodes.size * cell_area))
        return Tangent(np.inf, even, 0, converged=True)
    patch = Patch(operator, problem.approximation, contact.nodes)
    if start is None or not start.sum() > 0:
        start = contact.pressure
    pressure = start / (start.sum() * cell_area)
    convolutions, accuracy = 0, _MARGIN * method.rtol
    for _ in range(_ROUNDS):
        displacement, watched = patch.displacement(pressure, method.certificate)
        compliance = float(pressure @ displacement) * cell_area
        solution = ConjugateGradients(
            patch, pressure, -displacement, watched, fixed_total=True, precision=method.steps
        )
        convolutions += 1
        # compliance counts forces, energies of errors count pressures
        converged = solution.energy * cell_area <= accuracy * compliance
        if converged:
            break
        while solution.energy * cell_area > 0.1 * accuracy * compliance and (
            solution.steps < _STEPS and solution.advance()
        ):
            pass
        pressure = solution.pressure
        convolutions += solution.steps
    stiffness = 1 / compliance if compliance > 0 else np.nan
    return Tangent(stiffness, pressure, convolutions, converged=converged and compliance > 0)
