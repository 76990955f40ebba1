"""An approximate inverse of the half-space on any set of contact nodes.

Neighbours within two cells are inverted by a stencil, which is the inverse convolution cut short.
What is smooth over blocks of 16 cells is inverted by the inverse convolution of the kernel between
blocks. The two spaces are split by zero means, so each adds only what the other cannot represent;
the splitting is stable for operators of this order [1]_ [2]_.

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

from roughline.computing import fft
from roughline.computing.arrays import Indices, Integers, Real, Single
from roughline.halfspace.inverse import block_loops as loops
from roughline.halfspace.inverse.blocks import BlockKernel, EvenOnBlocks
from roughline.halfspace.inverse.direct import Direct
from roughline.halfspace.inverse.even_sums import Lags, even_sums
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.operators.grid_nodes import GridNodes, unit_in_single
from roughline.halfspace.operators.loops import ROUNDING
from roughline.halfspace.operators.restricted import RestrictedOperators

_RADIUS = 2  # of the stencil in cells, where these are square
_BLOCK = 16  # cells along the side of a block, where these are square
_DIRECT = 300  # nodes or fewer, whose equations are solved directly
_STRETCH = 4.0  # up to which stencil and blocks follow the shape of oblong cells


@dataclass(frozen=True, eq=False)
class ApproximateInverse:
    """What the approximate inverses of an operator on all sets of nodes have in common.

    Attributes
    ----------
    operator : Convolution
        Displacement under pressures on the whole grid.
    offsets : ndarray of int, shape (taps, 2)
        Cells from the centre of the stencil.
    taps : ndarray, shape (taps,)
        Coefficients of the stencil. All but the central one are negative, and together they weigh
        less than it, so the stencil cut to any set of nodes is positive definite.
        [pressure / length]
    block_sides : tuple of int
        Cells along the sides of the sides blocks.
    diagonal : float
        Diagonal of the operator: displacement of a node by the pressure on itself.
        [length / pressure]
    block_kernel : BlockKernel
        The kernel averaged over blocks.
    restricted : RestrictedOperators
        Forms of the operator that cost what the contact costs.
    """

    operator: Convolution
    offsets: Indices
    taps: Real
    block_sides: tuple[int, int]
    diagonal: float
    block_kernel: BlockKernel
    restricted: RestrictedOperators

    @classmethod
    def of(cls, operator: Convolution) -> ApproximateInverse:
        """Derive it from the operator's spectrum."""
        raised = _raised(operator)
        dx, dy = operator.spacing
        stretch = float(np.clip(np.sqrt(dy / dx), 1 / _STRETCH, _STRETCH))
        nx, ny = operator.shape
        sides = (
            min(max(1, round(_BLOCK * stretch)), nx),
            min(max(1, round(_BLOCK / stretch)), ny),
        )
        lattice = -(-nx // sides[0]), -(-ny // sides[1])
        offsets = _stencil_cells(operator, stretch)
        margins = int(abs(offsets[:, 0]).max()), int(abs(offsets[:, 1]).max())
        whole = operator.spectrum, operator.periods
        reach = Lags((margins[0] + 1, margins[1] + 1))
        inverse = even_sums(*whole, reach, inverse=True)
        inverse /= float(operator.periods[0] * operator.periods[1]) ** 2
        return cls(
            operator,
            offsets,
            _stencil_taps(offsets, inverse),
            sides,
            float(even_sums(*whole, Lags((1, 1)))[0, 0]) + raised,
            BlockKernel(
                even_sums(*whole, Lags(lattice, sides)) + raised, operator.periods == operator.shape
            ),
            RestrictedOperators(operator, (margins[0], margins[1] + ROUNDING)),
        )

    @property
    def nbytes(self) -> int:
        """Memory of its tables and those of the operator, the kernel among them. [bytes]"""
        return self.operator.spectrum.nbytes + 4 * self.operator.shape[0] * self.operator.shape[1]

    @cached_property
    def block_of_column(self) -> Integers:
        """Which block along a row of blocks each column of the grid belongs to."""
        return (np.arange(self.operator.shape[1]) // self.block_sides[1]).astype(np.int32)

    @cached_property
    def stencil(self) -> tuple[Integers, Single]:
        """Offsets of the stencil in the restricted operators' flat grid, and its coefficients.

        The central one comes first, and idle ones fill up the last six.
        """
        places = self.offsets @ np.array([self.restricted.grid.values.shape[1], 1])
        order = np.argsort(abs(places))
        idle = np.zeros(-(order.size - 1) % 6)
        return (
            np.append(places[order], idle.astype(places.dtype)),
            np.append(self.taps[order], idle).astype(np.float32),
        )

    @cached_property
    def kernel(self) -> Single:
        """Displacement under unit pressure on one node, by the distance from it in cells."""
        corner = GridNodes.of(np.zeros(1, dtype=np.intp), self.operator.shape)
        kernel = self.operator.displacement(np.ones(1), corner, None, "float32")
        kernel += _raised(self.operator)
        return kernel.astype(np.float32)


def _raised(operator: Convolution) -> float:
    """Return what is added to the kernel, so that even pressure displaces as other pressures do.

    Nothing, unless even pressure displaces nothing.
    """
    return float(operator.spectrum.max()) if operator.mean_is_free else 0.0


def _stencil_cells(operator: Convolution, stretch: float) -> Indices:
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
    if nodes.indices.size <= _DIRECT:
        return Direct(inverse.kernel, nodes)
    return _TwoLevels(inverse, nodes)


class _TwoLevels:
    """The approximate inverse on many contact nodes."""

    def __init__(self, inverse: ApproximateInverse, nodes: GridNodes) -> None:
        grid, sides, kernel = (
            inverse.restricted.grid,
            inverse.block_sides,
            inverse.block_kernel.values,
        )
        width = grid.values.shape[1]
        bands = np.arange(kernel.shape[0] + 1) * sides[0]
        self._at = loops.Layout(
            np.searchsorted(nodes.rows, bands),
            inverse.block_of_column,
            nodes.rows,
            nodes.starts,
            nodes.columns,
            *nodes.runs,
            grid.margins[0] * width + grid.margins[1],
            width,
        )
        self._grid = grid.values.reshape(-1)
        self._stencil = inverse.stencil
        nodes_of_band = nodes.indices.size / kernel.shape[0]
        self._bands_at_a_time = max(1, int(fft.VALUES_AT_A_TIME / nodes_of_band))
        count = np.empty(kernel.shape)
        self._share_out(lambda first, last: loops.count_nodes(self._at, first, last, count))
        self._per_node = 1 / np.maximum(count, 1.0)
        energy = count**2 * kernel[0, 0]
        # as if the nodes of a block lay at random in it
        energy += count * (1 - count / (sides[0] * sides[1])) * (inverse.diagonal - kernel[0, 0])
        self._even = EvenOnBlocks(inverse.block_kernel, count, energy)

    def _share_out(self, work: Callable[[int, int], None]) -> None:
        """Do some work on all bands."""
        bands = self._at.bands.size - 1
        if self._bands_at_a_time >= bands:
            work(0, bands)
        else:
            fft.share_out_blocks(work, bands, self._bands_at_a_time)

    def __call__(self, residual: Real) -> Real:
        """Return the change of pressure that causes the displacement `residual`, about."""
        if (unit := unit_in_single(residual)) != 1:
            return unit * self(residual / unit)
        at, grid, per_node = self._at, self._grid, self._per_node
        sums, result = np.empty(per_node.shape), np.empty(residual.size)

        def scatter(first: int, last: int) -> None:
            loops.scatter_details(residual, at, per_node, first, last, sums, grid)

        def apply(first: int, last: int) -> None:
            loops.apply_stencil(grid, at, self._stencil, even, first, last, result)

        self._share_out(scatter)
        even = self._even(sums), per_node
        self._share_out(apply)
        self._share_out(lambda first, last: loops.clear_nodes(at, first, last, grid))
        return result
