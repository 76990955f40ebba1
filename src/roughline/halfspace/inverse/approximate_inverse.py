"""An approximate inverse of the half-space on any set of contact nodes.

Neighbours within two cells are inverted by a stencil, which is the inverse convolution cut short.
What is smooth over blocks of 16 cells is inverted by the inverse convolution of the kernel between
blocks. The two spaces are split by zero means, so each adds only what the other cannot represent;
the splitting is stable for operators of this order [1]_ [2]_.

Cut to blocks that bear unevenly, the inverse convolution mixes long waves with short ones. That is
harmless unless a base that is softer than the layer gives way to long waves far more. There the
equations between blocks are solved as they are for pressures of a few shapes, and the inverse
convolution serves for the rest, as in deflation [3]_ and balancing [4]_.

A hard layer on a much softer base bends as a plate does, and its compliance falls faster with the
wavenumber than 1 / q. There the inverse convolution of the whole grid is used.

References
----------
.. [1] P. Oswald, "Multilevel norms for H^(-1/2)", Computing 61, 235-255 (1998).
.. [2] M. Hahne and E. P. Stephan, "Schwarz iterations for the efficient solution of screen problems
   with boundary elements", Computing 56, 61-85 (1996).
.. [3] R. A. Nicolaides, "Deflation of conjugate gradients with applications to boundary value
   problems", SIAM J. Numer. Anal. 24, 355-365 (1987).
.. [4] J. Mandel, "Balancing domain decomposition", Commun. Numer. Methods Eng. 9, 233-241 (1993).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.linalg import blas, lapack

from roughline.computing import fft
from roughline.computing.arrays import Floats, Indices, InGrid, Integers, Real, Single
from roughline.computing.compiled import compiled
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
_MOST_DIRECT_NODES = 300  # whose equations are solved directly

_MOST_PARTS = 4  # of the surface along an axis; and fewest blocks along the side of one
_PLATES_FROM = 50.0  # fall of wavenumber times compliance, from which on plates bend
_EIGENVALUE_FLOOR = 0.1  # of the eigenvalues on a grid, over the compliance of the wave


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
    restricted: RestrictedOperators  # forms of the operator that cost what the contact costs

    @classmethod
    def of(cls, operator: Convolution) -> ApproximateInverse:
        """Derive it from the operator's spectrum."""
        (nx, ny), (dx, dy) = operator.shape, operator.spacing
        stretch = float(np.clip(np.sqrt(dy / dx), 0.25, 4.0))  # of stencil and blocks along x
        offsets, taps = _stencil(operator, stretch)
        reach_x, reach_y = (int(each) for each in abs(offsets).max(axis=0))
        assert operator.half_space is not None
        block = _BLOCK_CELLS
        if excess_compliance(operator.half_space, block / 4 * min(dx, dy)) > RESOLVED_EXCESS:
            block //= 2
        sides = min(round(block * stretch), nx), min(round(block / stretch), ny)
        corners = np.arange(0, nx, sides[0]), np.arange(0, ny, sides[1])
        grid, origin = (operator.spectrum, operator.periods), (np.zeros(1), np.zeros(1))
        return cls(
            operator,
            offsets,
            taps,
            float(even_sums(*grid, origin)[0, 0]) + _even_pressure_term(operator),
            sides,
            even_sums(*grid, corners, sides) + _even_pressure_term(operator),
            RestrictedOperators(operator, (reach_x, reach_y + RUN_UNIT)),
        )

    @property
    def nbytes(self) -> int:
        """Memory of its tables and those of the operator, the kernel among them. [bytes]"""
        few = self.operator.small_grid
        held = self.operator.spectrum.nbytes + (few.nbytes if few else 0)
        return held + 4 * self.operator.shape[0] * self.operator.shape[1]

    @cached_property
    def block_spectrum(self) -> tuple[Real, tuple[int, int]]:
        """Half of the spectrum of the kernel of blocks, and its periods."""
        (mx, my), kernel = self.block_kernel.shape, self.block_kernel
        mx, my = (
            n if repeated else max(1, 2 * n - 2)
            for n, repeated in zip((mx, my), self.operator.repeats, strict=True)
        )
        x, y = (np.minimum(np.arange(n), -np.arange(n) % n) for n in (mx, my))
        return fft.half_spectrum(kernel[x[:, np.newaxis], y]).real, (mx, my)

    @cached_property
    def block_inverse(self) -> tuple[Real, tuple[int, int]]:
        """Spectrum of the inverse of that kernel, and its periods.

        Cut short, the kernel may have eigenvalues that are too small.
        """
        spectrum, (mx, my) = self.block_spectrum
        return 1 / (np.maximum(spectrum, 0.1 * np.median(spectrum)) * mx * my), (mx, my)

    @cached_property
    def mixes_waves(self) -> bool:
        """Whether a softer base gives way to long waves, under a layer that blocks resolve."""
        operator, half_space = self.operator, self.operator.half_space
        assert half_space is not None
        sides = [n * side for n, side in zip(operator.periods, operator.spacing, strict=True)]
        block = min(n * side for n, side in zip(self.block_sides, operator.spacing, strict=True))
        longest, short = (excess_compliance(half_space, side / 2) for side in (max(sides), block))
        return longest > RESOLVED_EXCESS > short

    @cached_property
    def is_of_plates(self) -> bool:
        """Whether plates bend on the grid."""
        return bends_as_plates(self.operator)

    @cached_property
    def inverse_convolution(self) -> Convolution:
        """The inverse convolution of the whole grid."""
        operator, half_space = self.operator, self.operator.half_space
        assert half_space is not None
        kx, ky = (
            2 * np.pi / (n * side) * np.arange(n // 2 + 1)
            for n, side in zip(operator.periods, operator.spacing, strict=True)
        )
        modes, inverse = float(np.prod(operator.periods)), operator.spectrum.copy()

        def fill(first: int, last: int) -> None:
            q, eigenvalues = np.hypot(kx[first:last, np.newaxis], ky), inverse[first:last]
            q[q == 0] = max(kx[-1], ky[-1])  # in place of no wave
            np.maximum(
                eigenvalues, _EIGENVALUE_FLOOR / modes * half_space.spectrum(q), out=eigenvalues
            )

        fft.share_out_blocks(fill, kx.size, 1 + fft.VALUES_AT_A_TIME // ky.size)
        inverse[0, 0] += _even_pressure_term(operator)
        inverse *= modes**2
        np.reciprocal(inverse, out=inverse)
        return replace(operator, spectrum=inverse, half_space=None)

    @cached_property
    def small_inverse(self) -> tuple[SmallGrid, Real]:
        """The inverse convolution with less padding, and transforms for it.

        Its kernel falls so fast that a quarter of a free side is enough between the grid and its
        repetition.
        """
        inverse = self.inverse_convolution
        px, py = (
            n if repeated else fft.good_size(n + -(-n // 4))
            for n, repeated in zip(inverse.shape, inverse.repeats, strict=True)
        )
        kernel = inverse.spectrum.copy()
        fft.cosine_spectrum(kernel, inverse.periods)
        spectrum = np.ascontiguousarray(kernel[: px // 2 + 1, : py // 2 + 1])
        fft.cosine_spectrum(spectrum, (px, py))
        np.maximum(spectrum, _EIGENVALUE_FLOOR * np.median(spectrum), out=spectrum)
        spectrum /= px * py
        return SmallGrid(inverse.shape, (px, py)), spectrum

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
    return (_Waves if inverse.is_of_plates else _TwoLevels)(inverse, nodes)


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


class _Waves:
    """The inverse convolution of the whole grid, cut to the contact nodes.

    It is taken in double precision, as compliances of waves differ by many powers of ten.
    """

    def __init__(self, inverse: ApproximateInverse, nodes: GridNodes) -> None:
        self._convolution, self._nodes = inverse.inverse_convolution, nodes

    def __call__(self, residual: Real) -> Real:
        """Return the change of pressure that causes the displacement `residual`, about."""
        return self._convolution.displacement(residual, self._nodes, self._nodes)


class _TwoLevels:
    """The approximate inverse on many contact nodes."""

    def __init__(self, inverse: ApproximateInverse, nodes: GridNodes) -> None:
        grid, sides, kernel = inverse.restricted.grid, inverse.block_sides, inverse.block_kernel
        width = grid.values.shape[1]
        self._at = _Layout(
            np.searchsorted(nodes.rows, np.arange(len(kernel) + 1) * sides[0]),
            (np.arange(nodes.shape[1]) // sides[1]).astype(np.int32),
            nodes.rows,
            nodes.starts,
            nodes.columns,
            *nodes.runs,
            grid.margins[0] * width + grid.margins[1],
            width,
        )
        self._nodes, self._grid, self._stencil = nodes, grid, inverse.stencil
        self._bands_at_a_time = max(1, fft.VALUES_AT_A_TIME * len(kernel) // nodes.indices.size)
        count, full = np.empty(kernel.shape), float(kernel[0, 0])
        self._share_out(lambda first, last: _count_nodes(self._at, first, last, count))
        self._per_node = 1 / np.maximum(count, 1.0)
        if not full > 0:
            raise np.linalg.LinAlgError("the half-space is not positive definite")
        # Each block counts by the energy of even pressure on its nodes, as if they lay at random.
        alone = (1 - count / (sides[0] * sides[1])) * max(0.0, inverse.diagonal - full)
        self._scale = 1 / np.sqrt(np.maximum(count * (count + alone / full), 1.0))
        self._block_inverse = inverse.block_inverse
        self._shapes = _Shapes(inverse, count, alone, self._scale) if inverse.mixes_waves else None

    def _share_out(self, work: Callable[[int, int], None]) -> None:
        """Do some work on all bands."""
        fft.share_out_blocks(work, self._at.bands.size - 1, self._bands_at_a_time)

    def _even(self, sums: Real) -> Real:
        """Return the pressure on the nodes of each block, from the sums of their residuals."""
        if self._shapes is None:
            return self._cut(sums)
        solved_part, rest = self._shapes.solved(sums)
        pressure = self._cut(rest)
        return solved_part + pressure - self._shapes.of(pressure)

    def _cut(self, sums: Real) -> Real:
        """Return it by the inverse convolution alone, cut to the blocks with nodes."""
        pressure: Real = fft.convolved(sums * self._scale, *self._block_inverse)
        return pressure * self._scale

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


class _Shapes:
    """Pressures of a few shapes, even on the nodes of each block, and what they displace.

    A shape bears on one part of the surface, as its blocks would if they did not displace each
    other. Even pressures x have the energy x A x, where A tells how far blocks displace each other,
    and how much farther the nodes of a block are displaced if they are few.
    """

    def __init__(self, inverse: ApproximateInverse, count: Real, alone: Real, scale: Real) -> None:
        parts = [max(1, min(_MOST_PARTS, n // _MOST_PARTS)) for n in count.shape]
        rows, columns = (np.arange(n) * m // n for n, m in zip(count.shape, parts, strict=True))
        part = rows[:, np.newaxis] * parts[1] + columns
        each = (np.where(part == k, count * scale**2, 0.0) for k in range(math.prod(parts)))
        shapes = [shape for shape in each if shape.any()]
        spectrum, periods = inverse.block_spectrum
        kernel = spectrum / math.prod(periods)
        displaced = [
            count * (fft.convolved(count * shape, kernel, periods) + alone * shape)
            for shape in shapes
        ]
        self._shapes, self._displaced = (np.reshape(x, (len(x), -1)) for x in (shapes, displaced))
        self._inverse = np.linalg.inv(self._displaced @ self._shapes.T)

    def solved(self, sums: Real) -> tuple[Real, Real]:
        """Return the pressures by which shapes take up residuals, and what remains of these."""
        parts = self._inverse @ (self._shapes @ sums.ravel())
        solved_part, moved = parts @ self._shapes, parts @ self._displaced
        return solved_part.reshape(sums.shape), sums - moved.reshape(sums.shape)

    def of(self, pressure: Real) -> Real:
        """Return the part of pressures that shapes have, by energy."""
        parts = self._inverse @ (self._displaced @ pressure.ravel())
        return (parts @ self._shapes).reshape(pressure.shape)


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
