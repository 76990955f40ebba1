"""An approximate inverse of the half-space on any set of contact nodes.

Neighbours within two cells are inverted by a stencil, which is the inverse convolution cut short.
What is smooth over blocks of 16 cells is inverted by small dense systems for the mean pressure of
each block, on ever coarser lattices of blocks. The spaces are split by zero means, so each level
adds only what the coarser ones cannot represent; the splitting is stable for operators of this
order [1]_ [2]_.

References
----------
.. [1] P. Oswald, "Multilevel norms for H^(-1/2)", Computing 61, 235-255 (1998).
.. [2] M. Hahne and E. P. Stephan, "Schwarz iterations for the efficient solution of screen problems
   with boundary elements", Computing 56, 61-85 (1996).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from roughline.computing.arrays import Indices, Real, Single
from roughline.halfspace import loops
from roughline.halfspace.even_sums import Lags, even_sums
from roughline.halfspace.lattices import (
    Lattices,
    kernels_on,
    lags_for,
    lattice_shapes,
    set_diagonal,
)
from roughline.halfspace.operator import GridNodes, Operator, unit_in_single
from roughline.halfspace.restricted import NEAR, RestrictedOperators

_RADIUS = 2  # of the stencil in cells, where these are square
_BLOCK = 16  # cells along the side of a block, where these are square
_DIRECT = 300  # nodes or fewer, whose equations are solved directly
_STRETCH = 4.0  # up to which stencil and blocks follow the shape of oblong cells
_SINGLE_RIDGE = 1 + 1e-6  # factor on diagonals, against the rounding of single precision


@dataclass(frozen=True, eq=False)
class ApproximateInverse:
    """What the approximate inverses of an operator on all sets of nodes have in common.

    Attributes
    ----------
    operator : Operator
        Displacement under pressures on the whole grid.
    offsets : ndarray of int, shape (taps, 2)
        Cells from the centre of the stencil.
    taps : ndarray, shape (taps,)
        Coefficients of the stencil. All but the central one are negative, and together they weigh
        less than it, so the stencil cut to any set of nodes is positive definite.
        [pressure / length]
    block_sides : tuple of int
        Cells along the sides of the smallest blocks.
    diagonal : float
        Diagonal of the operator: displacement of a node by the pressure on itself.
        [length / pressure]
    block_kernels : tuple of ndarray
        For each lattice, displacement of a node by the pressure on another, averaged over the
        blocks of the two, by the distance of these blocks. A positive definite function, as the
        kernel is. [length / pressure]
    restricted : RestrictedOperators
        Forms of the operator that cost what the contact costs.
    """

    operator: Operator
    offsets: Indices
    taps: Real
    block_sides: tuple[int, int]
    diagonal: float
    block_kernels: tuple[Real, ...]
    restricted: RestrictedOperators

    @classmethod
    def of(cls, operator: Operator) -> ApproximateInverse:
        """Derive it from the operator's spectrum."""
        raised = _raised(operator)
        dx, dy = operator.spacing
        stretch = float(np.clip(np.sqrt(dy / dx), 1 / _STRETCH, _STRETCH))
        nx, ny = operator.shape
        smallest = (
            min(max(1, round(_BLOCK * stretch)), nx),
            min(max(1, round(_BLOCK / stretch)), ny),
        )
        lattices = lattice_shapes((-(-nx // smallest[0]), -(-ny // smallest[1])))
        offsets = _stencil_cells(operator, stretch)
        margins = int(abs(offsets[:, 0]).max()), int(abs(offsets[:, 1]).max())
        kernel, inverse, near = even_sums(
            operator.spectrum,
            operator.periods,
            Lags(lags_for(lattices), smallest),
            Lags((margins[0] + 1, margins[1] + 1)),
            Lags(NEAR),
        )
        inverse /= float(operator.periods[0] * operator.periods[1]) ** 2
        return cls(
            operator,
            offsets,
            _stencil_taps(offsets, inverse),
            smallest,
            float(near[0, 0]) + raised,
            kernels_on(lattices, kernel + raised),
            RestrictedOperators(operator, near, margins),
        )

    @cached_property
    def kernel(self) -> Single:
        """Displacement under unit pressure on one node, by the distance from it in cells."""
        corner = GridNodes.of(np.zeros(1, dtype=np.intp), self.operator.shape)
        kernel = self.operator.displacement(np.ones(1), corner, None, "float32")
        kernel += _raised(self.operator)
        return kernel.astype(np.float32)


def _raised(operator: Operator) -> float:
    """Return what is added to the kernel, so that even pressure displaces as other pressures do.

    Nothing, unless even pressure displaces nothing.
    """
    return float(operator.spectrum.max()) if operator.zero_mean else 0.0


def _stencil_cells(operator: Operator, stretch: float) -> Indices:
    """Return the cells of the stencil, counted from its centre."""
    radii = _RADIUS * stretch, _RADIUS / stretch
    reach = [
        np.arange(-min(int(radius), (period - 1) // 2), min(int(radius), (period - 1) // 2) + 1)
        for radius, period in zip(radii, operator.periods, strict=True)
    ]
    x, y = (cells.ravel() for cells in np.meshgrid(*reach, indexing="ij"))
    within = (x / radii[0]) ** 2 + (y / radii[1]) ** 2 <= 1
    return np.stack([x[within], y[within]], axis=1)


def _stencil_taps(offsets: Indices, inverse: Real) -> Real:
    """Return the coefficients of the inverse convolution, cut short."""
    taps = inverse[abs(offsets[:, 0]), abs(offsets[:, 1])]
    centre = (offsets == 0).all(axis=1)
    around = np.minimum(taps, 0.0)
    around *= min(1.0, 0.99 * taps[centre].item() / max(-around.sum(), 1e-300))
    return np.where(centre, taps, around)


Preconditioner = Callable[[Real], Real]
"""Returns the change of pressure that causes a displacement; exactly so, were the inverse exact."""


def preconditioner(inverse: ApproximateInverse, nodes: GridNodes) -> Preconditioner:
    """Return the approximate inverse on a set of contact nodes; for few nodes it is the inverse."""
    if nodes.indices.size > _DIRECT:
        return _Multilevel(inverse, nodes)
    rows = np.repeat(nodes.rows, np.diff(nodes.starts))
    columns = nodes.columns
    matrix = inverse.kernel[
        abs(rows[:, np.newaxis] - rows), abs(columns[:, np.newaxis] - columns)
    ].astype(np.float64)
    set_diagonal(matrix, matrix.diagonal() * _SINGLE_RIDGE)
    factor = cho_factor(matrix, overwrite_a=True, check_finite=False)
    return lambda residual: cho_solve(factor, residual, check_finite=False)


class _Multilevel:
    """The approximate inverse on many contact nodes."""

    def __init__(self, inverse: ApproximateInverse, nodes: GridNodes) -> None:
        grid, sides = inverse.restricted.grid, inverse.block_sides
        rows = np.repeat(nodes.rows, np.diff(nodes.starts))
        width = grid.values.shape[1]
        self._taps = inverse.taps
        self._offsets = inverse.offsets @ np.array([width, 1])
        self._grid = grid.values.reshape(-1)
        index: type[np.integer] = np.int32 if self._grid.size < 2**31 else np.int64
        self._places = ((rows + grid.margins[0]) * width + nodes.columns + grid.margins[1]).astype(
            index
        )
        kernel = inverse.block_kernels[0]
        self._lattice = kernel.shape
        block = (rows // sides[0]) * self._lattice[1] + nodes.columns // sides[1]
        self._block = block.astype(np.int32)
        count = np.bincount(self._block, minlength=kernel.size).astype(np.float64)
        self._per_node = 1 / np.maximum(count, 1.0)
        energy = count**2 * kernel[0, 0]
        # as if the nodes of a block lay at random in it
        energy += count * (1 - count / (sides[0] * sides[1])) * (inverse.diagonal - kernel[0, 0])
        self._coarse = Lattices(
            inverse.block_kernels, count.reshape(self._lattice), energy.reshape(self._lattice)
        )

    def __call__(self, residual: Real) -> Real:
        """Return the change of pressure that causes the displacement `residual`, about."""
        if (unit := unit_in_single(residual)) != 1:
            return unit * self(residual / unit)
        result = np.empty_like(residual)
        sums, sums_of_result = np.empty((2, self._per_node.size))
        places, block, grid = self._places, self._block, self._grid
        loops.sum_blocks(residual, block, sums)
        loops.scatter_details(residual, block, sums * self._per_node, places, grid)
        loops.apply_stencil(grid, places, self._offsets, self._taps, block, result, sums_of_result)
        means = self._coarse(sums.reshape(self._lattice)).ravel()
        means -= sums_of_result * self._per_node
        loops.add_blocks(means, block, result)
        return result
