"""The exact stiffness dF/dd, and how the pressures follow the load while the contact set stays.

On a fixed contact set C a change of force displaces all elastic nodes alike. So w = dp/dF solves
K_CC w = c, where the forces of w sum to one; c is the compliance, and k = 1 / c.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughline.computing.arrays import Real
from roughline.halfspace.patch import ConjugateGradients, Patch
from roughline.halfspace.state import Contact, Method, Problem

# The stiffness is the energy form 1 / (w K w). Conjugate gradients estimate the energy of their
# error, and the bound on it is this part of the tolerance on residuals.
_ENERGY_MARGIN = 0.01
_STEPS = 300  # after which the energy form is computed afresh
_ROUNDS = 6  # of so many steps, at most


@dataclass(frozen=True, eq=False)
class Tangent:
    """Linear response of a contact to a change of load.

    Attributes
    ----------
    stiffness : float
        k = dF/dd; infinite in full contact of the periodic half-space. [force / length]
    pressure_per_force : ndarray, shape (nodes,)
        dp/dF on the contact nodes; zero on nodes that are not elastic. [1 / area]
    convolutions : int
        Convolutions spent.
    converged : bool
        Whether the linear equations were solved.
    """

    stiffness: float
    pressure_per_force: Real
    convolutions: int
    converged: bool


def tangent(
    problem: Problem,
    contact: Contact,
    start: Real | None,
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
        The contact, whose set of nodes is held fixed.
    start : ndarray, shape (nodes,), or None
        Guess of dp/dF, such as that of the load before; None: the pressures themselves.
        [1 / area]
    method : Method
        The stiffness is sought to a hundredth of its tolerance.
    """
    operator = problem.operator
    cell_area = operator.cell_area
    elastic = problem.conditions.elastic(contact.pressure)
    nodes = contact.nodes[elastic]
    if operator.zero_mean and nodes.size == contact.gap.size:  # full contact is rigid
        even = np.full(nodes.size, 1 / (nodes.size * cell_area))
        return Tangent(np.inf, even, 0, converged=True)
    patch = Patch(operator, problem.inverse, nodes)
    if start is None or not start.sum() > 0:
        start = contact.pressure
    pressure = start[elastic] / (start[elastic].sum() * cell_area)
    convolutions, accuracy = 0, _ENERGY_MARGIN * method.rtol
    for _ in range(_ROUNDS):
        displacement, watched = patch.displacement(pressure, method.certificate)
        compliance = float(pressure @ displacement) * cell_area
        gradients = ConjugateGradients(
            patch, pressure, -displacement, watched, fixed_total=True, precision=method.steps
        )
        convolutions += 1
        # compliance counts forces, energies of errors count pressures
        converged = gradients.energy * cell_area <= accuracy * compliance
        if converged:
            break
        while gradients.energy * cell_area > 0.1 * accuracy * compliance and (
            gradients.steps < _STEPS and gradients.advance()
        ):
            pass
        pressure = gradients.pressure
        convolutions += gradients.steps
    pressure_per_force = np.zeros(contact.nodes.size)
    pressure_per_force[elastic] = pressure
    stiffness = 1 / compliance if compliance > 0 else np.nan
    return Tangent(stiffness, pressure_per_force, convolutions, converged and compliance > 0)
