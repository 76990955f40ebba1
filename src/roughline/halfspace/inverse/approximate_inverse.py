"""An approximate inverse of the half-space on any set of contact nodes.

Neighbours within two cells are inverted by a stencil, which is the inverse convolution cut short.
What is smooth over blocks of 16 cells is inverted by the inverse convolution of the kernel between
blocks. The two spaces are split by zero means, so each adds only what the other cannot represent;
the splitting is stable for operators of this order [1]_ [2]_.

Where a base is softer than the layers on it, the equations between blocks are solved instead.

References
----------
.. [1] P. Oswald, "Multilevel norms for H^(-1/2)", Computing 61, 235-255 (1998).
.. [2] M. Hahne and E. P. Stephan, "Schwarz iterations for the efficient solution of screen problems
   with boundary elements", Computing 56, 61-85 (1996).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.linalg import blas, lapack

from roughline.computing import fft
from roughline.computing.arrays import Floats, Indices, InGrid, Integers, Real, Single
from roughline.computing.compiled import compiled
from roughline.halfspace.inverse.blocks import (
    BlockOperator,
    BlockOperators,
    SolvedBlocks,
    block_sides,
    stretch,
)
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.operators.even_sums import even_sums
from roughline.halfspace.operators.grid_nodes import RUN_UNIT, GridNodes, unit_in_single
from roughline.halfspace.operators.restricted import (
    RESOLVED_EXCESS,
    RestrictedOperators,
    excess_compliance,
)
from roughline.halfspace.operators.small_grid import SmallGrid

_BLOCK_CELLS = 16  # cells along the side of a block, where these are square
_LEAST_EIGENVALUE = 0.1  # of an inverse convolution, over that of the wave or the usual one
_MOST_DIRECT_NODES = 300  # whose equations are solved directly
_PLATES_FROM = 50.0  # fall of wavenumber times compliance, from which on plates bend


@dataclass(frozen=True, eq=False)
class ApproximateInverse:
    """What the approximate inverses of an operator on all sets of nodes have in common."""

    operator: Convolution
    offsets: Indices  # cells from the centre of the stencil
    # Of the stencil, in the same order. All but the central one are negative, and together they
    # weigh less than it: the stencil cut to any set of nodes is positive definite.
    taps: Real
    diagonal: float  # displacement of a node by the pressure on itself
    block_sides: tuple[int, int]  # in cells
    block_kernel: Real  # averaged over two blocks, by their distance
    blocks: BlockOperators  # the operator between blocks, by their sides
    restricted: RestrictedOperators  # forms of the operator that cost what the contact costs

    @classmethod
    def of(cls, operator: Convolution) -> ApproximateInverse:
        """Derive it from the operator's spectrum."""
        (nx, ny), cell = operator.shape, min(operator.spacing)
        offsets, taps = _stencil(operator, stretch(operator))
        reach_x, reach_y = (int(each) for each in abs(offsets).max(axis=0))
        assert operator.half_space is not None
        block = _BLOCK_CELLS
        if excess_compliance(operator.half_space, block / 4 * cell) > RESOLVED_EXCESS:
            block //= 2
        sides = block_sides(operator, block)
        corners = np.arange(0, nx, sides[0]), np.arange(0, ny, sides[1])
        grid, origin = (operator.spectrum, operator.periods), (np.zeros(1), np.zeros(1))
        even_term = _even_pressure_term(operator)
        diagonal = float(even_sums(*grid, origin)[0, 0]) + even_term
        return cls(
            operator,
            offsets,
            taps,
            diagonal,
            sides,
            even_sums(*grid, corners, sides) + even_term,
            BlockOperators(operator, diagonal, even_term),
            RestrictedOperators(operator, (reach_x, reach_y + RUN_UNIT)),
        )

    @property
    def nbytes(self) -> int:
        """Memory of its tables and those of the operator, the kernel among them. [bytes]"""
        few = self.operator.small_grid
        held = self.operator.spectrum.nbytes + (few.nbytes if few else 0)
        return held + 4 * self.operator.shape[0] * self.operator.shape[1]

    @cached_property
    def block_inverse(self) -> tuple[Real, tuple[int, int]]:
        """Spectrum of the inverse of the kernel of blocks, and its periods.

        Cut short, the kernel may have eigenvalues that are too small.
        """
        (mx, my), kernel = self.block_kernel.shape, self.block_kernel
        mx, my = (
            n if repeated else max(1, 2 * n - 2)
            for n, repeated in zip((mx, my), self.operator.repeats, strict=True)
        )
        x, y = (np.minimum(np.arange(n), -np.arange(n) % n) for n in (mx, my))
        spectrum = fft.half_spectrum(kernel[x[:, np.newaxis], y]).real
        return 1 / (np.maximum(spectrum, 0.1 * np.median(spectrum)) * mx * my), (mx, my)

    @cached_property
    def is_of_plates(self) -> bool:
        """Whether plates bend on the grid."""
        return bends_as_plates(self.operator)

    @cached_property
    def solves_blocks(self) -> bool:
        """Whether a softer base gives way to long waves, under plates or resolved layers."""
        operator, half_space = self.operator, self.operator.half_space
        assert half_space is not None
        sides = [n * side for n, side in zip(operator.periods, operator.spacing, strict=True)]
        block = min(n * side for n, side in zip(self.block_sides, operator.spacing, strict=True))
        longest, short = (excess_compliance(half_space, side / 2) for side in (max(sides), block))
        return self.is_of_plates or longest > RESOLVED_EXCESS > short

    @cached_property
    def small_inverse(self) -> tuple[SmallGrid, Real]:
        """The inverse convolution with less padding, and transforms for it.

        Its kernel falls so fast that a quarter of a free side is enough between the grid and its
        repetition.
        """
        operator, half_space = self.operator, self.operator.half_space
        assert half_space is not None
        kx, ky = (
            2 * np.pi / (n * side) * np.arange(n // 2 + 1)
            for n, side in zip(operator.periods, operator.spacing, strict=True)
        )
        modes, q = math.prod(operator.periods), np.hypot(kx[:, np.newaxis], ky)
        q[0, 0] = max(kx[-1], ky[-1])  # in place of no wave
        least = _LEAST_EIGENVALUE / modes * half_space.spectrum(q)
        kernel = np.maximum(operator.spectrum, least)
        kernel[0, 0] += self.even_pressure_term
        kernel *= modes**2
        np.reciprocal(kernel, out=kernel)
        fft.cosine_spectrum(kernel, operator.periods)
        px, py = (
            n if repeated else fft.good_size(n + -(-n // 4))
            for n, repeated in zip(operator.shape, operator.repeats, strict=True)
        )
        spectrum = np.ascontiguousarray(kernel[: px // 2 + 1, : py // 2 + 1])
        fft.cosine_spectrum(spectrum, (px, py))
        np.maximum(spectrum, _LEAST_EIGENVALUE * np.median(spectrum), out=spectrum)
        spectrum /= px * py
        return SmallGrid(operator.shape, (px, py)), spectrum

    def flattening(self, nodes: InGrid, above: Real) -> tuple[Real, Real]:
        """Return the pressures that flatten heights of nodes, and those that press all alike."""
        grid, spectrum = self.small_inverse
        around = grid.fields()
        places, found = around.places(nodes), []
        for displacement in (-above, np.ones_like(above)):
            around.put(displacement, places)
            around.convolve(spectrum)
            found.append(around.at(places))
        return found[0], found[1]

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
    def kernel(self) -> Floats:
        """Displacement under unit pressure on one node, by the distance from it in cells.

        In double precision on a small grid, in single precision on others.
        """
        corner = GridNodes.of(InGrid(np.zeros(1, dtype=np.intp)), self.operator.shape)
        kernel = self.operator.displacement(np.ones(1), corner, None, "float32")
        kernel += self.even_pressure_term
        return kernel if self.operator.small_grid else kernel.astype(np.float32)

    @property
    def even_pressure_term(self) -> float:
        """What is added to the kernel, so that even pressure displaces as other pressures do.

        Nothing, unless even pressure displaces nothing. [length / pressure]
        """
        return _even_pressure_term(self.operator)


def bends_as_plates(operator: Convolution) -> bool:
    """Whether compliance falls far more with the wavenumber than a half-space's does."""
    half_space, spacing = operator.half_space, operator.spacing
    assert half_space is not None
    sides = [n * side for n, side in zip(operator.periods, spacing, strict=True)]
    q = np.geomspace(2 * np.pi / max(sides), np.pi / min(spacing))
    compliance = q * half_space.spectrum(q)
    return bool((np.maximum.accumulate(compliance) > _PLATES_FROM * compliance).any())


def _even_pressure_term(operator: Convolution) -> float:
    """Return what is added to the kernel, so that even pressure displaces as other pressures do.

    Nothing, unless even pressure displaces nothing.
    """
    return float(operator.spectrum.max()) if operator.mean_is_free else 0.0


def _stencil(operator: Convolution, stretch: float) -> tuple[Indices, Real]:
    """Return the inverse convolution cut short: cells from its centre, and their coefficients."""
    radii, periods = (2 * stretch, 2 / stretch), operator.periods
    reach = [min(int(r), (period - 1) // 2) for r, period in zip(radii, periods, strict=True)]
    x, y = (cells.ravel() for cells in np.mgrid[tuple(slice(-r, r + 1) for r in reach)])
    within = (x / radii[0]) ** 2 + (y / radii[1]) ** 2 <= 1
    offsets = np.stack([x[within], y[within]], axis=1)
    lags = np.arange(reach[0] + 1), np.arange(reach[1] + 1)
    inverse = even_sums(operator.spectrum, periods, lags, inverse=True)
    taps = inverse[abs(offsets[:, 0]), abs(offsets[:, 1])] / float(periods[0] * periods[1]) ** 2
    centre = (offsets == 0).all(axis=1)
    around = np.minimum(taps, 0.0)
    around *= min(1.0, 0.99 * taps[centre].item() / max(-around.sum(), 1e-300))
    return offsets, np.where(centre, taps, around)


_Preconditioner = Callable[[Real], Real]
"""Returns the change of pressure that causes a displacement; exactly so, were the inverse exact."""


def preconditioner(inverse: ApproximateInverse, nodes: GridNodes) -> _Preconditioner:
    """Return the approximate inverse on a set of contact nodes; for few nodes it is the inverse."""
    if nodes.indices.size <= _MOST_DIRECT_NODES:
        return _Direct(inverse, nodes)
    return _TwoLevels(inverse, nodes, inverse.blocks.on(nodes) if inverse.solves_blocks else None)


class _Direct:
    """The inverse on few nodes, by a Cholesky factor.

    LAPACK and BLAS are called without detours, for there are many such matrices and most are small.
    """

    def __init__(self, inverse: ApproximateInverse, nodes: GridNodes) -> None:
        rows = np.repeat(nodes.rows, np.diff(nodes.starts))
        matrix = np.empty((rows.size, rows.size))
        fill_triangle(inverse.kernel, rows, nodes.columns, matrix)
        self._factor, failed = lapack.dpotrf(matrix.T, lower=1, clean=0, overwrite_a=1)
        if failed:
            raise np.linalg.LinAlgError("the matrix is not positive definite")

    def __call__(self, residual: Real) -> Real:
        """Return the change of pressure that causes the displacement `residual`."""
        if not residual.size:
            return residual
        half = blas.dtrsv(self._factor, residual, lower=1)
        return blas.dtrsv(self._factor, half, lower=1, trans=1, overwrite_x=1)


class _TwoLevels:
    """The approximate inverse on many contact nodes; an operator between blocks is solved."""

    def __init__(
        self, inverse: ApproximateInverse, nodes: GridNodes, solved: BlockOperator | None
    ) -> None:
        grid, sides = inverse.restricted.grid, solved.sides if solved else inverse.block_sides
        shape = solved.shape if solved else inverse.block_kernel.shape
        width = grid.values.shape[1]
        self._at = _Layout(
            np.searchsorted(nodes.rows, np.arange(shape[0] + 1) * sides[0]),
            (np.arange(nodes.shape[1]) // sides[1]).astype(np.int32),
            nodes.rows,
            nodes.starts,
            nodes.columns,
            *nodes.runs,
            grid.margins[0] * width + grid.margins[1],
            width,
        )
        offsets, taps = inverse.stencil
        if solved:
            taps = taps * np.float32(solved.details)
        self._nodes, self._grid, self._stencil = nodes, grid, (offsets, taps)
        self._bands_at_a_time = max(1, fft.VALUES_AT_A_TIME * shape[0] // nodes.indices.size)
        count = np.empty(shape)
        self._share_out(lambda first, last: _count_nodes(self._at, first, last, count))
        self._per_node = 1 / np.maximum(count, 1.0)
        self._even = SolvedBlocks(solved, count) if solved else _CutBlocks(inverse, count)

    def _share_out(self, work: Callable[[int, int], None]) -> None:
        """Do some work on all bands."""
        fft.share_out_blocks(work, self._at.bands.size - 1, self._bands_at_a_time)

    def __call__(self, residual: Real) -> Real:
        """Return the change of pressure that causes the displacement `residual`, about."""
        if (unit := unit_in_single(residual)) != 1:
            return unit * self(residual / unit)
        at, grid, per_node = self._at, self._grid.values.reshape(-1), self._per_node
        sums, result = np.empty(per_node.shape), np.empty(residual.size)

        def scatter(first: int, last: int) -> None:
            _scatter_details(residual, at, per_node, first, last, sums, grid)

        def apply(first: int, last: int) -> None:
            _apply_stencil(grid, at, self._stencil, even, first, last, result)

        self._share_out(scatter)
        even = self._even(sums), per_node
        self._share_out(apply)
        self._grid.clear(self._nodes)
        return result


class _CutBlocks:
    """The inverse convolution between blocks, cut to those with nodes."""

    def __init__(self, inverse: ApproximateInverse, count: Real) -> None:
        full, cells = float(inverse.block_kernel[0, 0]), math.prod(inverse.block_sides)
        if not full > 0:
            raise np.linalg.LinAlgError("the half-space is not positive definite")
        # Each block counts by the energy of even pressure on its nodes, as if they lay at random.
        alone = (1 - count / cells) * max(0.0, inverse.diagonal - full)
        self._scale = 1 / np.sqrt(np.maximum(count * (count + alone / full), 1.0))
        self._block_inverse = inverse.block_inverse

    def __call__(self, sums: Real) -> Real:
        """Return the pressure on the nodes of each block, from the sums of their residuals."""
        pressure: Real = fft.convolved(sums * self._scale, *self._block_inverse)
        return pressure * self._scale


class _Layout(NamedTuple):
    """Where contact nodes lie: in a flat grid with margins, and in blocks."""

    bands: Indices  # where in `rows` each band begins, and one more
    blocks: Integers  # of a band, for each column
    # as those of the nodes, and their runs
    rows: Indices
    starts: Indices
    columns: Integers
    first_run: Indices
    runs: Integers
    # place of the first node in the flat grid, and the places from one row to the next
    corner: int
    width: int


@compiled
def _count_nodes(at: _Layout, first: int, last: int, count: Floats) -> None:
    """Count the nodes of each block of some bands."""
    for band in range(first, last):
        counts = count[band]
        counts[:] = 0
        for i in range(at.starts[at.bands[band]], at.starts[at.bands[band + 1]]):
            counts[at.blocks[at.columns[i]]] += 1


@compiled
def _scatter_details(
    values: Real, at: _Layout, per_node: Real, first: int, last: int, sums: Real, grid: Floats
) -> None:
    """Write the values of some bands, without their means over blocks, to a flat grid.

    The sums over blocks, of the shape of the lattice, are written, too, in these bands.
    """
    for band in range(first, last):
        total = sums[band]
        total[:] = 0
        for i in range(at.starts[at.bands[band]], at.starts[at.bands[band + 1]]):
            total[at.blocks[at.columns[i]]] += values[i]
        means = total * per_node[band]
        for k in range(at.bands[band], at.bands[band + 1]):
            line = grid[at.corner + at.rows[k] * at.width :]
            for i in range(at.starts[k], at.starts[k + 1]):
                line[at.columns[i]] = values[i] - means[at.blocks[at.columns[i]]]


@compiled
def _apply_stencil(
    grid: Floats,
    at: _Layout,
    stencil: tuple[Integers, Floats],
    even: tuple[Real, Real],
    first: int,
    last: int,
    result: Real,
) -> None:
    """Apply a stencil at the nodes of some bands, and set the means over blocks.

    The grid is flat, and zero but at the nodes, with margins wider than the stencil by RUN_UNIT. Of
    the stencil, flat offsets and 1 + 6 n coefficients are given, the central one first; of what is
    even, the means over blocks, and one over the nodes of each block.
    """
    (offsets, taps), (means, per_node) = stencil, even
    sums = np.empty(at.width, dtype=grid.dtype)
    for band in range(first, last):
        totals = np.zeros(means.shape[1])
        for k in range(at.bands[band], at.bands[band + 1]):
            for run in range(at.first_run[k], at.first_run[k + 1]):
                begin, end, length = at.runs[run]
                start = at.columns[begin]
                place = at.corner + at.rows[k] * at.width + start
                total, here, tap = sums[:length], grid[place:], taps[0]
                for j in range(length):
                    total[j] = tap * here[j]
                for m in range(1, offsets.size, 6):
                    t0, t1, t2 = taps[m], taps[m + 1], taps[m + 2]
                    t3, t4, t5 = taps[m + 3], taps[m + 4], taps[m + 5]
                    g0, g1 = grid[place + offsets[m] :], grid[place + offsets[m + 1] :]
                    g2, g3 = grid[place + offsets[m + 2] :], grid[place + offsets[m + 3] :]
                    g4, g5 = grid[place + offsets[m + 4] :], grid[place + offsets[m + 5] :]
                    for j in range(length):
                        total[j] += t0 * g0[j] + t1 * g1[j] + t2 * g2[j]
                        total[j] += t3 * g3[j] + t4 * g4[j] + t5 * g5[j]
                for i in range(begin, end):
                    value = total[at.columns[i] - start]
                    result[i] = value
                    totals[at.blocks[at.columns[i]]] += value
        shifts = means[band] - totals * per_node[band]
        for i in range(at.starts[at.bands[band]], at.starts[at.bands[band + 1]]):
            result[i] += shifts[at.blocks[at.columns[i]]]


@compiled
def fill_triangle(kernel: Floats, rows: Integers, columns: Integers, matrix: Real) -> None:
    """Fill the upper triangle with the kernel at the distances of nodes.

    Its diagonal is raised where the kernel comes in single precision.
    """
    raised = 1 + 1e-6 if kernel.itemsize == 4 else 1.0
    for i in range(rows.size):
        for j in range(i + 1, rows.size):
            matrix[i, j] = kernel[abs(rows[i] - rows[j]), abs(columns[i] - columns[j])]
        matrix[i, i] = raised * kernel[0, 0]
