"""The contact problem p >= 0, gap >= 0, p gap = 0 under one load: primal-dual active set.

On the current set the pressures solve K p = d - s; nodes that pull are dropped, nodes outside that
overlap are added, until neither is left. Each round is solved only as sharply as the last one's
violations deserve. What is returned carries residuals recomputed from it.

References
----------
.. [1] M. Hintermüller, K. Ito and K. Kunisch, "The primal-dual active set strategy as a semismooth
   Newton method", SIAM J. Optim. 13, 865-888 (2003).
.. [2] I. A. Polonsky and L. M. Keer, "A numerical method for solving rough contact problems based
   on the multi-level multi-summation and conjugate gradient techniques", Wear 231, 206-219 (1999).
.. [3] J. J. Júdice and F. M. Pires, "A block principal pivoting algorithm for large-scale strictly
   monotone linear complementarity problems", Comput. Oper. Res. 21, 587-596 (1994).
"""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughline.halfspace.operator import Operator
from roughline.halfspace.patch import Patch
from roughline.halfspace.preconditioner import Stencil

Field = NDArray[np.float64]
Nodes = NDArray[np.intp]

# An inner solve aims below the tolerance so that the certificate is not missed by a hair.
_INNER_MARGIN = 0.3
# ... and, while the set still changes, at this part of the last violation.
_INNER_FRACTION = 0.03
# Rounds with no fewer wrong nodes than ever before, after which nodes change one by one [3]_.
_PATIENCE = 8


class Outcome(enum.Enum):
    """How the search for the contact set ended."""

    CONVERGED = "converged"
    STALLED = "stalled"
    MAX_ITERATIONS = "max_iterations"


@dataclass(frozen=True)
class Load:
    """One load, by depth or by force; the other is None.

    Attributes
    ----------
    depth : float or None
        Approach since first touch. [length]
    force : float or None
        Total force. [force]
    """

    depth: float | None = None
    force: float | None = None


@dataclass(frozen=True)
class Residuals:
    """Violations of the contact conditions, recomputed from the returned pressures.

    Attributes
    ----------
    gap, penetration : float
        Largest gap on contact nodes and overlap off them, over the length scale.
    tension : float
        Largest pull, over the mean contact pressure.
    load : float
        Error of the force, over the force; zero under depth control.
    """

    gap: float
    penetration: float
    tension: float
    load: float

    @property
    def worst(self) -> float:
        """The largest of the four."""
        return max(self.gap, self.penetration, self.tension, self.load)


@dataclass(frozen=True, eq=False)
class Contact:
    """State of the contact under one load.

    Attributes
    ----------
    depth, force : float
        Approach since first touch [length] and total force [force].
    pressure : ndarray, shape (nodes,)
        Pressures on the nodes in contact, ``patch.nodes``. [pressure]
    displacement, gap : ndarray, shape (nx, ny)
        On the whole grid. [length]
    residuals : Residuals
        Recomputed from the fields above.
    outcome : Outcome
        Whether they are within the tolerance.
    patch : Patch
        The equations on the contact nodes.
    convolutions : int
        Convolutions spent on this load.
    """

    depth: float
    force: float
    pressure: NDArray[np.float64]
    displacement: Field
    gap: Field
    residuals: Residuals
    outcome: Outcome
    patch: Patch
    convolutions: int


def solve(
    operator: Operator,
    stencil: Stencil,
    separation: Field,
    rms_height: float,
    load: Load,
    start: tuple[float, Nodes, NDArray[np.float64]],
    rtol: float,
    max_iterations: int,
) -> Contact:
    """Find the contact set and the pressures under one load.

    Parameters
    ----------
    operator, stencil
        The half-space and its preconditioner.
    separation : ndarray, shape (nx, ny)
        Distance of the bodies at first touch, zero at the highest point. [length]
    rms_height : float
        Gaps are compared with this, or with the depth where that is smaller; zero for a flat
        punch, where it is the depth. [length]
    load : Load
        What is prescribed.
    start : tuple
        Depth to start from [length], nodes, ascending, and their pressures.
    rtol : float
        Bound on every residual.
    max_iterations : int
        Bound on the convolutions.
    """
    depth, nodes, pressure = start
    sharpest = _INNER_MARGIN * rtol
    sharpness = max(0.1, sharpest)
    convolutions, fewest_changes, waited = 0, nodes.size + separation.size, 0
    while True:
        patch = Patch(operator, stencil, nodes)
        target = -separation.flat[nodes] + (load.depth or 0.0)
        length_scale = min(rms_height or np.inf, abs(depth))
        if load.force is not None:
            pressure = _with_total(pressure, load.force / operator.cell_area)
        pressure, level = patch.pressure_for(
            target,
            pressure,
            sharpness * length_scale,
            max_iterations - convolutions,
            fixed_total=load.force is not None,
        )
        depth = level if load.depth is None else load.depth
        length_scale = min(rms_height or np.inf, abs(depth))
        displacement = patch.displacement_everywhere(pressure)
        convolutions += patch.convolutions
        gap = displacement - (depth - separation)
        force = operator.cell_area * float(pressure.sum())
        residuals = _residuals(gap, nodes, pressure, force, load, length_scale)

        pulling = pressure < 0
        overlapping = gap.ravel() < -residuals.gap * length_scale
        overlapping[nodes] = False
        changes = int(np.count_nonzero(pulling) + np.count_nonzero(overlapping))
        waited = 0 if changes < fewest_changes else waited + 1
        fewest_changes = min(changes, fewest_changes)

        outcome = None
        if residuals.worst <= rtol and (not changes or waited > _PATIENCE):
            outcome = Outcome.CONVERGED
        elif convolutions >= max_iterations:
            outcome = Outcome.MAX_ITERATIONS
        elif not np.isfinite(residuals.worst) or (not changes and sharpness <= sharpest):
            outcome = Outcome.STALLED
        if outcome is not None:
            return Contact(
                depth, force, pressure, displacement, gap, residuals, outcome, patch, convolutions
            )

        if changes:
            sharpness = _INNER_FRACTION * max(residuals.penetration, residuals.tension)
            sharpness = min(max(sharpness, sharpest), 0.1)
        else:
            sharpness = sharpest
        if waited > _PATIENCE:
            _keep_last(pulling, overlapping, nodes)
            sharpness = sharpest
        nodes, pressure = _exchanged(nodes, pressure, pulling, overlapping, separation)


def _residuals(
    gap: Field,
    nodes: Nodes,
    pressure: NDArray[np.float64],
    force: float,
    load: Load,
    length_scale: float,
) -> Residuals:
    on_contact = gap.flat[nodes]
    # gaps on contact count as such whatever their sign, so they may stay in the minimum
    overlap_everywhere = max(0.0, -float(gap.min()))
    overlap_on_contact = max(0.0, -float(on_contact.min()))
    penetration = overlap_everywhere if overlap_everywhere > overlap_on_contact else 0.0
    return Residuals(
        gap=float(np.abs(on_contact).max()) / length_scale,
        penetration=penetration / length_scale,
        tension=max(0.0, -float(pressure.min())) / abs(float(pressure.mean())),
        load=0.0 if load.force is None else abs(force - load.force) / load.force,
    )


def _with_total(pressure: NDArray[np.float64], total: float) -> NDArray[np.float64]:
    """Scale the pressures to a total; spread it evenly where there is nothing to scale."""
    now = float(pressure.sum())
    if now > 0:
        return pressure * (total / now)
    return np.full_like(pressure, total / pressure.size)


def _keep_last(pulling: NDArray[np.bool_], overlapping: NDArray[np.bool_], nodes: Nodes) -> None:
    """Leave only the wrong node of highest index, the rule that cannot cycle."""
    last_pulling = nodes[pulling].max(initial=-1)
    last_overlapping = np.flatnonzero(overlapping).max(initial=-1)
    if last_pulling > last_overlapping:
        overlapping[:] = False
        pulling &= nodes == last_pulling
    else:
        pulling[:] = False
        overlapping[:last_overlapping] = False


def _exchanged(
    nodes: Nodes,
    pressure: NDArray[np.float64],
    pulling: NDArray[np.bool_],
    overlapping: NDArray[np.bool_],
    separation: Field,
) -> tuple[Nodes, NDArray[np.float64]]:
    """Drop the pulling nodes and add the overlapping ones; the highest point stays if none does."""
    field = np.zeros(separation.size)
    field[nodes] = pressure
    in_contact = overlapping
    in_contact[nodes[~pulling]] = True
    if not in_contact.any():
        in_contact[separation.argmin()] = True
    kept = np.flatnonzero(in_contact)
    return kept, np.maximum(field[kept], 0.0)
