"""The nodes in contact, and the elastic equations on them by conjugate gradients."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from roughline.halfspace.operator import Operator
from roughline.halfspace.preconditioner import Preconditioner, Stencil

Vector = NDArray[np.float64]

_STALLED_AFTER = 200  # iterations without a smaller error: rounding is all that is left
_REFRESH = 50  # iterations after which the residual is recomputed rather than updated


class Solution(NamedTuple):
    """What conjugate gradients return.

    Attributes
    ----------
    values : ndarray, shape (nodes,)
        Pressures on the nodes.
    level : float
        The uniform displacement that goes with a fixed total; zero where the total is free.
    """

    values: Vector
    level: float


class Patch:
    """A set of contact nodes of one operator; all vectors run over these nodes only.

    Attributes
    ----------
    nodes : ndarray of int
        Flat indices in the grid, ascending.
    convolutions : int
        Convolutions done on this patch so far.
    """

    def __init__(self, operator: Operator, stencil: Stencil, nodes: NDArray[np.intp]) -> None:
        self.nodes = nodes
        self.convolutions = 0
        self._operator = operator
        self._columns = nodes % operator.shape[1]
        self._rows, self._row = np.unique(nodes // operator.shape[1], return_inverse=True)
        self._precondition = Preconditioner(stencil, operator.shape, nodes)

    def displacement(self, pressure: Vector) -> Vector:
        """Displacement of the nodes under pressures on them."""
        return self._convolve(pressure, self._rows)[self._row, self._columns]

    def displacement_everywhere(self, pressure: Vector) -> NDArray[np.float64]:
        """Displacement of the whole grid under pressures on the nodes."""
        return self._convolve(pressure, self._operator.all_rows)

    def _convolve(self, pressure: Vector, rows_out: NDArray[np.intp]) -> NDArray[np.float64]:
        self.convolutions += 1
        pressure_rows = np.zeros((len(self._rows), self._operator.shape[1]))
        pressure_rows[self._row, self._columns] = pressure
        return self._operator.convolve(pressure_rows, self._rows, rows_out)

    def pressure_for(
        self, target: Vector, start: Vector, tolerance: float, limit: int, *, fixed_total: bool
    ) -> Solution:
        """Find the pressures that displace the nodes by `target`.

        With ``fixed_total`` the sum of the pressures stays that of `start`, and the nodes are
        displaced by ``target + level``, the level being found as well: the residual is projected
        so that no step changes the sum (Polonsky and Keer 1999, here with a preconditioner).

        Parameters
        ----------
        target, start : ndarray, shape (nodes,)
            Displacements wanted and pressures to start from.
        tolerance : float
            Largest error of a displacement. [length]
        limit : int
            Largest number of iterations; what is returned then may miss the tolerance.
        fixed_total : bool
            Whether the total load or the level is prescribed.
        """
        pressure = start.copy()
        ones = self._precondition(np.ones_like(start)) if fixed_total else start
        total_of_ones = ones.sum()
        residual = target - self.displacement(pressure)
        direction = np.zeros_like(start)
        slope, level = 1.0, 0.0
        least_error, least_at = np.inf, 0
        for iteration in range(limit + 1):
            step = self._precondition(residual)
            if fixed_total:
                level = -step.sum() / total_of_ones
                step += level * ones
            error = float(np.abs(residual + level).max())
            if error < least_error:
                least_error, least_at = error, iteration
            if error <= tolerance or iteration == limit or iteration - least_at > _STALLED_AFTER:
                break
            slope_before, slope = slope, float((residual + level) @ step)
            direction = step + (slope / slope_before if iteration else 0.0) * direction
            response = self.displacement(direction)
            curvature = float(direction @ response)
            if not (curvature > 0 and slope > 0):
                break  # nothing more to gain
            pressure += slope / curvature * direction
            if (iteration + 1) % _REFRESH:
                residual -= slope / curvature * response
            else:
                residual = target - self.displacement(pressure)
        return Solution(pressure, level)
