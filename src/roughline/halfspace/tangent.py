"""The exact stiffness dF/dd, and how the pressures follow the load while the contact set stays.

On a fixed contact set a change of force displaces all of its nodes alike, so dp/dF solves
K_CC w = c with the forces of w summing to one; c is the compliance and k = 1 / c.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughline.halfspace.active_set import Contact
from roughline.halfspace.operator import Operator

# The energy w K w errs by the square of what the displacements err by: this makes 1e-9 or better.
_RTOL = 1e-5
_LIMIT = 2000
# The secant compliance sets the first tolerance; near full periodic contact the tangent's is far
# smaller, and the tolerance has to follow it down.
_TIGHTENINGS = 6


@dataclass(frozen=True, eq=False)
class Tangent:
    """Linear response of a contact to a change of load.

    Attributes
    ----------
    stiffness : float
        k = dF/dd; infinite in full contact of the periodic half-space. [force / length]
    pressure_per_force : ndarray, shape (nodes,)
        dp/dF on the contact nodes. [1 / area]
    converged : bool
        Whether the linear equations were solved.
    """

    stiffness: float
    pressure_per_force: NDArray[np.float64]
    converged: bool


def tangent(
    operator: Operator, contact: Contact, start: NDArray[np.float64] | None = None
) -> Tangent:
    """Solve for the exact stiffness of a contact.

    The stiffness is the energy form 1 / (w K w), so it errs upwards, by the square of the
    residual.

    Parameters
    ----------
    operator : Operator
        The half-space.
    contact : Contact
        The contact whose set of nodes is held fixed.
    start : ndarray, shape (nodes,), optional
        Guess of dp/dF, such as that of the load before; the pressures themselves if absent.
        [1 / area]
    """
    cell_area, patch = operator.cell_area, contact.patch
    points = operator.shape[0] * operator.shape[1]
    if patch.nodes.size == points and operator.spectrum[0, 0] == 0:
        even = np.full(points, 1 / (points * cell_area))
        return Tangent(np.inf, even, converged=True)
    if start is None or not start.sum() > 0:
        start = contact.pressure
    pressure = start / (start.sum() * cell_area)
    target = np.zeros_like(pressure)
    under_load = contact.displacement.flat[patch.nodes]
    compliance = cell_area * float(contact.pressure @ under_load) / contact.force**2  # the secant
    for _ in range(_TIGHTENINGS):
        tolerance = _RTOL * compliance
        pressure = patch.pressure_for(target, pressure, tolerance, _LIMIT, fixed_total=True).values
        displacement = patch.displacement(pressure)
        compliance = cell_area * float(pressure @ displacement)
        if tolerance <= 4 * _RTOL * compliance:
            break
    error = np.abs(displacement - compliance).max()
    return Tangent(1 / compliance, pressure, converged=bool(error <= 10 * _RTOL * compliance))
