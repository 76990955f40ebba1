"""A short stencil that undoes the half-space locally, cut to the nodes in contact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughline.halfspace.loops import apply_stencil
from roughline.halfspace.operator import Operator

_RADIUS = 3


@dataclass(frozen=True, eq=False)
class Stencil:
    """Pressure that a displacement asks for, from the nodes within three cells.

    The taps are those of the inverse convolution. All but the central one are negative and
    together weigh less than it, so the stencil cut to any set of nodes is positive definite.

    Attributes
    ----------
    offsets : ndarray of int, shape (taps, 2)
        Cells from the centre.
    taps : ndarray, shape (taps,)
        Coefficients. [pressure / length]
    """

    offsets: NDArray[np.intp]
    taps: NDArray[np.float64]

    @classmethod
    def of(cls, operator: Operator) -> Stencil:
        """Derive the stencil from the operator's spectrum."""
        scale = operator.periods[0] * operator.periods[1]
        inverse = np.zeros_like(operator.spectrum)
        np.divide(1 / scale**2, operator.spectrum, out=inverse, where=operator.spectrum > 0)
        quarter = _even_sum(inverse, operator.periods)
        reach = range(-_RADIUS, _RADIUS + 1)
        cells = [
            (i, j)
            for i in reach
            for j in reach
            if i * i + j * j <= _RADIUS**2
            and 2 * abs(i) < operator.periods[0]
            and 2 * abs(j) < operator.periods[1]
        ]
        offsets = np.array(cells, dtype=np.intp)
        taps = quarter[abs(offsets[:, 0]), abs(offsets[:, 1])]
        centre = (offsets == 0).all(axis=1)
        around = np.minimum(taps, 0.0)
        around *= min(1.0, 0.99 * taps[centre].item() / max(-around.sum(), 1e-300))
        return cls(offsets, np.where(centre, taps, around))


def _even_sum(quarter: NDArray[np.float64], periods: tuple[int, int]) -> NDArray[np.float64]:
    """Transform an even array given by its quarter; a short corner of the result is enough."""
    result = quarter
    for axis, period in enumerate(periods):
        lags = np.arange(min(_RADIUS, period // 2) + 1)
        modes = np.arange(period // 2 + 1)
        weights = np.full(modes.size, 2.0)
        weights[0] = 1.0
        if period % 2 == 0:
            weights[-1] = 1.0
        cosines = weights * np.cos(2 * np.pi / period * np.outer(lags, modes))
        result = np.moveaxis(np.tensordot(cosines, result, axes=(1, axis)), 0, axis)
    return result


class Preconditioner:
    """The stencil on one set of contact nodes."""

    def __init__(self, stencil: Stencil, shape: tuple[int, int], nodes: NDArray[np.intp]) -> None:
        nx, ny = shape
        width = ny + 2 * _RADIUS
        self._taps = stencil.taps
        self._offsets = stencil.offsets[:, 0] * width + stencil.offsets[:, 1]
        self._places = (nodes // ny + _RADIUS) * width + nodes % ny + _RADIUS
        self._grid = np.zeros((nx + 2 * _RADIUS) * width)

    def __call__(self, residual: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the pressure change that would undo `residual`, were the stencil exact."""
        return apply_stencil(residual, self._places, self._grid, self._offsets, self._taps)
