"""The exact stiffness dF/dd, and how the pressures follow the load while the contact set stays.

On a fixed set E of elastic nodes a change of force displaces all of them alike. So w = dp/dF solves
K_EE w = c, where the forces of w sum to one; c is the compliance, and k = 1 / c. Under more load, E
is the contact without the nodes at the hardness; under less, it is all of the contact.
"""

from __future__ import annotations

import math

import numpy as np

from roughline.computing.arrays import InGrid, Mask, Real, among
from roughline.halfspace.operators.corrected import CorrectedOperator
from roughline.halfspace.search import small_grid
from roughline.halfspace.search.patch import MOST_STEPS, ConjugateGradients, Patch
from roughline.halfspace.search.problem import Contact, Grid, Method
from roughline.halfspace.search.response import Response, Tangent
from roughline.halfspace.search.window import GridWindow

# The stiffness is the energy form 1 / (w K w). Conjugate gradients estimate the energy of their
# error, and the bound on it is this part of the tolerance on residuals.
_ENERGY_MARGIN = 0.01
_SLOW_GAIN = 0.01  # of the turn before; a restricted operator that gains more is given up


def response(
    contact: Contact, window: GridWindow, start: tuple[Real, Real] | None, method: Method
) -> Response:
    """Solve for the exact stiffness of a contact, on further loading and on unloading.

    It is solved in the window in which the contact was found. Nodes at a bound bear no more on
    loading. On unloading, those at the upper one follow, too, as their overlap stays in the
    surface. The start are guesses of dp/dF on loading and on unloading, such as those of the
    load before; without any, it is the pressures themselves.
    """
    loading, unloading = start or (None, None)
    grid, pressure = window.bodies.grid, contact.pressure
    nodes = InGrid(window.inside(contact.nodes))  # the window is the grid here
    back = _tangent(grid, nodes, pressure, ~contact.pulling, unloading, method)
    if not contact.plastic.any():
        return Response(back, back)
    return Response(_tangent(grid, nodes, pressure, contact.touching, loading, method), back)


def _tangent(
    grid: Grid, nodes: InGrid, pressure: Real, follow: Mask, start: Real | None, method: Method
) -> Tangent:
    """Solve for the exact stiffness of a contact of which some nodes follow a change of the load.

    The stiffness is the energy form 1 / (w K w), so it errs upwards, by the square of the residual.
    """
    operator, every = grid.inverse.operator, bool(follow.all())
    cell_area = operator.cell_area
    following = nodes if every else among(nodes, follow)
    if not following.size:
        return Tangent(0.0, np.zeros(nodes.size))
    if operator.mean_is_free and following.size == math.prod(grid.shape):  # rigid
        even = np.full(following.size, 1 / (following.size * cell_area))
        return Tangent(np.inf, even)
    change = _unit_force(follow, cell_area, start, pressure)
    compliance, convolutions = punch_compliance(grid, following, change, method)
    if not every:
        pressure_per_force = np.zeros(nodes.size)
        pressure_per_force[follow] = change
        change = pressure_per_force
    return Tangent(1 / compliance if compliance > 0 else np.nan, change, convolutions)


def punch_compliance(
    grid: Grid, nodes: InGrid, pressure: Real, method: Method
) -> tuple[float, int]:
    """Lead pressures of unit force, which are overwritten, to those that displace all nodes alike.

    In each turn, steps lessen the compliance from what the pressures so far have. The first turn
    takes a restricted operator where it serves. Its steps err by a part of what they gain, which
    shows in the gain of the next turn. Return the compliance, NaN where it is not found, and the
    convolutions.
    """
    inverse, listed = grid.inverse, grid.nodes(nodes)
    if inverse.operator.small_grid:
        found, spent = small_grid.compliance(inverse, nodes, pressure, _ENERGY_MARGIN * method.rtol)
        if not np.isnan(found):
            return found, spent
    operator = CorrectedOperator(inverse.operator, inverse.restricted.on(listed), listed)
    patch = Patch(operator.linear, inverse, listed)
    accuracy, gained, convolutions = _ENERGY_MARGIN * method.rtol, np.nan, 0
    for turn in range(8):  # each computes the energy form afresh; two or three are enough
        # 1. The turn is exact but for a first one with a restricted operator.
        exact = turn > 0 or operator.restricted is None
        if exact and operator.restricted is not None:
            operator = operator.recentred(pressure, None, method.certificate)
        aim = 0.1 * accuracy if exact else accuracy
        gained_before = gained
        before, gained, error, steps = _lessened(operator, patch, pressure, aim, method)
        convolutions += exact + (steps if operator.restricted is None else 0)
        # 2. By how much steps have lessened the compliance, and the part of that by which they err.
        compliance = before - gained
        part = min(gained / gained_before, 1.0) if gained_before > 0 else 1.0
        if exact and max(error, np.sqrt(part) * gained) <= accuracy * compliance:
            return compliance, convolutions
        slow = not (part <= _SLOW_GAIN and error <= aim * before)
        if exact and operator.restricted is not None and slow:
            operator = CorrectedOperator(inverse.operator, None, listed)
            patch, gained = Patch(operator.linear, inverse, listed), np.nan
    return np.nan, convolutions


def _lessened(
    operator: CorrectedOperator, patch: Patch, pressure: Real, aim: float, method: Method
) -> tuple[float, float, float, int]:
    """Lessen the compliance of pressures of unit force, until so small a part of it is an error.

    Return the compliance before, what the steps have gained, what is left of the error, and the
    number of steps.
    """
    cell_area = operator.exact.cell_area  # compliances count forces, energies count pressures
    displacement = operator.displacement(pressure, None, method.certificate)
    compliance = float(pressure @ displacement) * cell_area
    gradients = ConjugateGradients(
        patch,
        pressure,
        np.negative(displacement, out=displacement),
        displacement[:0],
        fixed_total=True,
        precision=method.steps,
    )
    while gradients.energy * cell_area > aim * compliance and gradients.steps < MOST_STEPS:
        if not gradients.advance():
            break
    return compliance, gradients.gained * cell_area, gradients.energy * cell_area, gradients.steps


def _unit_force(follow: Mask, cell_area: float, start: Real | None, pressure: Real) -> Real:
    """Scale a guess on the nodes that follow to unit force: the first that is not zero there.

    On nodes that have just come into contact there is no pressure yet.
    """
    guesses = [pressure] if start is None else [start, pressure]
    guess = next((each for each in guesses if each[follow].sum() > 0), np.ones(follow.size))
    return guess[follow] / (guess[follow].sum() * cell_area)
