"""An approximate inverse of the half-space on any set of contact nodes.

Neighbours within two cells are undone by a stencil, the inverse convolution cut short; what is
smooth over blocks of 16 cells by small dense systems for the mean pressure of each block, block by
block on ever coarser lattices. The spaces are split by zero means, so each level adds only what
the coarser ones cannot represent; the splitting is stable for operators of this order [1]_ [2]_.

References
----------
.. [1] P. Oswald, "Multilevel norms for H^(-1/2)", Computing 61, 235-255 (1998).
.. [2] M. Hahne and E. P. Stephan, "Schwarz iterations for the efficient solution of screen problems
   with boundary elements", Computing 56, 61-85 (1996).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from roughline.halfspace import loops
from roughline.halfspace.operator import Operator, Places

Field = NDArray[np.float64]

_RADIUS = 2
_BLOCK = 16  # cells along the side of a block
_COARSEST = 32  # blocks along a side of the lattice that is solved directly
_GROUP = 4  # blocks along a side of a group, which makes one block of the next lattice


@dataclass(frozen=True, eq=False)
class Approximation:
    """What the preconditioner knows of an operator.

    Attributes
    ----------
    shape : tuple of int
        Points of the grid.
    offsets : ndarray of int, shape (taps, 2)
        Cells from the centre of the stencil.
    taps : ndarray, shape (taps,)
        Its coefficients. All but the central one are negative and together weigh less than it, so
        the stencil cut to any set of nodes is positive definite. [pressure / length]
    own, block_own : float
        Displacement of a node by its own pressure, and by the mean of the others in its block.
    between : ndarray, shape (blocks along x, blocks along y)
        Displacement of one node by the pressure on one other, by the distance of their blocks.
    """

    shape: tuple[int, int]
    offsets: NDArray[np.intp]
    taps: Field
    own: float
    block_own: float
    between: Field

    @classmethod
    def of(cls, operator: Operator) -> Approximation:
        """Derive it from the operator's spectrum."""
        offsets, taps = _stencil(operator)
        near = [np.arange(min(_BLOCK, period)) for period in operator.periods]
        kernel = _even_sum(operator.spectrum, operator.periods, near)
        if operator.is_periodic:
            # even pressure displaces nothing: let it displace as much as the longest wave does
            raised = max(operator.spectrum.flat[1:].max(), 0.0)
            kernel = kernel + raised
        else:
            raised = 0.0
        pairs = [np.where(lags > 0, 2.0, 1.0) * (_BLOCK - lags) for lags in near]
        weights = np.outer(*pairs)
        weights[0, 0] = 0.0
        block_own = float((weights * kernel).sum() / weights.sum())
        far = [
            np.minimum(lags, period - lags)
            for lags, period in zip(
                (_BLOCK * np.arange(-(-n // _BLOCK)) for n in operator.shape),
                operator.periods,
                strict=True,
            )
        ]
        between = _even_sum(operator.spectrum, operator.periods, far) + raised
        between[0, 0] = block_own
        return cls(operator.shape, offsets, taps, float(kernel[0, 0]), block_own, between)


def _stencil(operator: Operator) -> tuple[NDArray[np.intp], Field]:
    scale = operator.periods[0] * operator.periods[1]
    inverse = np.zeros_like(operator.spectrum)
    np.divide(1 / scale**2, operator.spectrum, out=inverse, where=operator.spectrum > 0)
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
    lags = np.arange(_RADIUS + 1)
    taps = _even_sum(inverse, operator.periods, [lags, lags])[
        abs(offsets[:, 0]), abs(offsets[:, 1])
    ]
    centre = (offsets == 0).all(axis=1)
    around = np.minimum(taps, 0.0)
    around *= min(1.0, 0.99 * taps[centre].item() / max(-around.sum(), 1e-300))
    return offsets, np.where(centre, taps, around)


def _even_sum(quarter: Field, periods: tuple[int, int], lags: list[NDArray[np.intp]]) -> Field:
    """Transform an even spectrum given by its quarter, at the lags wanted only."""
    result = quarter
    for axis, period in enumerate(periods):
        modes = np.arange(period // 2 + 1)
        weights = np.full(modes.size, 2.0)
        weights[0] = 1.0
        if period % 2 == 0:
            weights[-1] = 1.0
        # the product modulo the period keeps the angle small and exact
        cosines = weights * np.cos(2 * np.pi / period * (np.outer(lags[axis], modes) % period))
        result = np.moveaxis(np.tensordot(cosines, result, axes=(1, axis)), 0, axis)
    return result


class Preconditioner:
    """The approximate inverse on one set of contact nodes."""

    def __init__(self, approximation: Approximation, places: Places) -> None:
        nx, ny = approximation.shape
        rows = np.repeat(places.rows, np.diff(places.starts))
        width = ny + 2 * _RADIUS
        self._taps = approximation.taps
        self._offsets = approximation.offsets @ np.array([width, 1])
        self._places = (rows + _RADIUS) * width + places.columns + _RADIUS
        self._grid = np.zeros((nx + 2 * _RADIUS) * width)
        lattice = approximation.between.shape
        self._block = ((rows // _BLOCK) * lattice[1] + places.columns // _BLOCK).astype(np.int32)
        count = np.bincount(self._block, minlength=lattice[0] * lattice[1]).astype(np.float64)
        self._per_node = 1 / np.maximum(count, 1.0)
        self._coarse = _Lattice(approximation, count.reshape(lattice))

    def __call__(self, residual: Field) -> Field:
        """Return the pressure change that would undo `residual`, were the inverse exact."""
        result = np.empty_like(residual)
        sums, sums_of_result = np.empty((2, self._per_node.size))
        loops.sum_blocks(residual, self._block, sums)
        loops.undo_details(
            residual,
            self._places,
            self._block,
            sums * self._per_node,
            self._grid,
            self._offsets,
            self._taps,
            result,
            sums_of_result,
        )
        means = self._coarse(sums) - sums_of_result * self._per_node
        loops.add_blocks(means, self._block, result)
        return result


class _Lattice:
    """Equations for the mean pressures of blocks, of which each holds some contact nodes.

    The energy of even pressures on two blocks is taken as if their nodes lay at random in them.
    """

    def __init__(self, approximation: Approximation, count: Field) -> None:
        between = approximation.between
        # of each block with itself
        energy = count * (approximation.own + (count - 1) * approximation.block_own)
        self._shape = count.shape
        self._groups: list[tuple[tuple[int, int], Field]] = []
        while max(count.shape) > _COARSEST:
            count, energy, between = self._gather(count, energy, between)
        occupied = np.flatnonzero(count)
        self._occupied = occupied
        matrix = _energies(count.ravel()[occupied], energy.ravel()[occupied], between, occupied)
        self._factor = cho_factor(matrix, overwrite_a=True)

    def _gather(self, count: Field, energy: Field, between: Field) -> tuple[Field, Field, Field]:
        """Invert the equations of each group of blocks, for pressures that sum to zero."""
        side = _GROUP
        shape = tuple(-(-n // side) for n in count.shape)
        padding = [(0, m * side - n) for m, n in zip(shape, count.shape, strict=True)]

        def grouped(values: Field) -> Field:
            padded = np.pad(values, padding).reshape(shape[0], side, shape[1], side)
            return padded.transpose(0, 2, 1, 3).reshape(-1, side * side)

        counts, energies = grouped(count), grouped(energy)
        near = np.zeros((side, side))
        near[: between.shape[0], : between.shape[1]] = between[:side, :side]
        x, y = np.divmod(np.arange(side * side), side)
        kernel = near[abs(x[:, np.newaxis] - x), abs(y[:, np.newaxis] - y)]
        matrices = counts[:, :, np.newaxis] * counts[:, np.newaxis, :] * kernel
        diagonal = np.arange(side * side)
        matrices[:, diagonal, diagonal] = energies
        sums = matrices.sum(axis=(1, 2))
        matrices[:, diagonal, diagonal] += counts == 0  # empty blocks: anything invertible
        inverses = np.linalg.inv(matrices)
        even = np.einsum("gij,gj->gi", inverses, counts)
        total = np.maximum(np.einsum("gi,gi->g", even, counts), 1e-300)
        inverses -= even[:, :, np.newaxis] * (even / total[:, np.newaxis])[:, np.newaxis, :]
        self._groups.append((count.shape, inverses))
        return counts.sum(axis=1).reshape(shape), sums.reshape(shape), between[::side, ::side]

    def __call__(self, sums: Field) -> Field:
        return self._solve(sums.reshape(self._shape), 0).ravel()

    def _solve(self, sums: Field, level: int) -> Field:
        if level == len(self._groups):
            pressure = np.zeros(sums.size)
            pressure[self._occupied] = cho_solve(self._factor, sums.ravel()[self._occupied])
            return pressure.reshape(sums.shape)
        (nx, ny), inverses = self._groups[level]
        side = _GROUP
        mx, my = -(-nx // side), -(-ny // side)
        padded = np.pad(sums, [(0, mx * side - nx), (0, my * side - ny)])
        groups = padded.reshape(mx, side, my, side).transpose(0, 2, 1, 3).reshape(mx * my, -1)
        pressure = np.einsum("gij,gj->gi", inverses, groups)
        pressure += self._solve(groups.sum(axis=1).reshape(mx, my), level + 1).reshape(-1, 1)
        spread = pressure.reshape(mx, my, side, side).transpose(0, 2, 1, 3)
        return spread.reshape(mx * side, my * side)[:nx, :ny]


def _energies(
    count: Field, energy: Field, between: Field, places: NDArray[np.intp]
) -> Field:
    x, y = np.divmod(places, between.shape[1])
    matrix = between[abs(x[:, np.newaxis] - x), abs(y[:, np.newaxis] - y)]
    matrix *= count[:, np.newaxis] * count
    np.fill_diagonal(matrix, energy)
    return matrix
