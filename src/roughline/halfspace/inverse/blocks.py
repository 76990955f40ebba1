"""Even pressures on the blocks of a contact, where a base is softer than the layers on it.

A hard layer on a soft base is free between the nodes that it rests on. The inverse convolution, cut
to those, holds it too firmly, the more so the longer the wave: 25 to 300 times on bases ten times
as soft, and more where the layer bends as a plate. So here the equations between the blocks that
hold nodes are solved, those within larger blocks by themselves and those between larger blocks all
together, as in deflation [1]_ and balancing [2]_.

Where blocks are wider than the layer is thick, what varies within them is displaced by waves that
feel the base, and counts less: the stencil of the inverse convolution is of shorter waves.

References
----------
.. [1] R. A. Nicolaides, "Deflation of conjugate gradients with applications to boundary value
   problems", SIAM J. Numer. Anal. 24, 355-365 (1987).
.. [2] J. Mandel, "Balancing domain decomposition", Commun. Numer. Methods Eng. 9, 233-241 (1993).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg import blas, lapack

from roughline.computing import fft
from roughline.computing.arrays import Indices, Integers, Real
from roughline.computing.compiled import compiled
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.operators.even_sums import even_sums
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.operators.restricted import RESOLVED_EXCESS, excess_compliance

_MOST_CELLS = 16  # along the side of a block, where these are square
_ALONG_LARGER = 4  # blocks along the side of a larger one
_MOST_LARGER = 500  # with nodes, whose equations are solved all together
_LEAST_LEFT = (
    0.01  # part of the pressures of a block that is left where they do not push on the whole
)


def stretch(operator: Convolution) -> float:
    """Return by how much longer blocks and stencils are along x than squares, in cells."""
    dx, dy = operator.spacing
    return float(np.clip(np.sqrt(dy / dx), 0.25, 4.0))


def block_sides(operator: Convolution, cells: int) -> tuple[int, int]:
    """Return the sides of blocks that are about as large as squares of so many cells a side."""
    (nx, ny), factor = operator.shape, stretch(operator)
    return min(max(1, round(cells * factor)), nx), min(max(1, round(cells / factor)), ny)


@dataclass(frozen=True, eq=False)
class BlockOperator:
    """What even pressures on blocks of a grid displace on average over others."""

    sides: tuple[int, int]  # of a block, in cells
    shape: tuple[int, int]  # blocks along x and y; the last ones may be cut by the grid's edge
    kernel: Real  # by the distance of two blocks along x and y
    half_spectrum: Real  # over the product of the periods
    periods: tuple[int, int]
    own: float  # by which a node displaces itself more than its block does
    details: float  # weight of what varies within blocks, at most 1

    @classmethod
    def of(
        cls, operator: Convolution, sides: tuple[int, int], diagonal: float, even_term: float
    ) -> BlockOperator:
        """Average an operator over blocks.

        The diagonal is what a node displaces itself, and the even term is added to the kernel.
        """
        shape, lags, periods = [], [], []
        for n, side, repeats in zip(operator.shape, sides, operator.repeats, strict=True):
            count = -(-n // side)
            wraps = repeats and n % side == 0
            shape.append(count)
            lags.append(np.arange(count if wraps else count + 1) * side)
            periods.append(count if wraps else 2 * count)
        kernel = even_sums(operator.spectrum, operator.periods, (lags[0], lags[1]), sides)
        kernel += even_term
        x, y = (np.minimum(np.arange(n), -np.arange(n) % n) for n in periods)
        spectrum = fft.half_spectrum(kernel[x[:, np.newaxis], y]).real / math.prod(periods)
        own = max(0.0, diagonal - float(kernel[0, 0]))
        # the mean between the compliances for short waves and for those that blocks just show
        assert operator.half_space is not None
        width = max(side * each for side, each in zip(sides, operator.spacing, strict=True))
        excess = max(0.0, excess_compliance(operator.half_space, 2 * width))
        return cls(
            sides,
            (shape[0], shape[1]),
            kernel,
            spectrum,
            (periods[0], periods[1]),
            own,
            1 / math.sqrt(1 + excess),
        )

    def larger_with_nodes(self, nodes: GridNodes) -> int:
        """Return how many larger blocks hold nodes."""
        along_x, along_y = (_ALONG_LARGER * side for side in self.sides)
        holds = np.zeros([-(-n // _ALONG_LARGER) for n in self.shape], dtype=bool)
        rows = np.repeat(nodes.rows, np.diff(nodes.starts))
        holds[rows // along_x, nodes.columns // along_y] = True
        return int(np.count_nonzero(holds))


class BlockOperators:
    """An operator averaged over blocks of several sides, made as they are needed.

    Larger blocks of the smallest ones are hardly wider than twice the thickness that a wave as long
    feels alone.
    """

    def __init__(self, operator: Convolution, diagonal: float, even_term: float) -> None:
        self._of = operator, diagonal, even_term
        self._cells = _MOST_CELLS
        while self._cells > 1 and self._is_wide():
            self._cells //= 2
        self._made: dict[int, BlockOperator] = {}

    def _is_wide(self) -> bool:
        """Whether waves of twice two blocks feel more than the surface's own modulus."""
        operator, *_ = self._of
        half_space, sides = operator.half_space, block_sides(operator, self._cells)
        assert half_space is not None
        width = max(n * side for n, side in zip(sides, operator.spacing, strict=True))
        return excess_compliance(half_space, 2 * width) > RESOLVED_EXCESS

    def on(self, nodes: GridNodes) -> BlockOperator:
        """Return that of the smallest blocks of which few enough larger ones hold nodes."""
        cells = self._cells
        while True:
            if cells not in self._made:
                operator, *terms = self._of
                sides = block_sides(operator, cells)
                self._made[cells] = BlockOperator.of(operator, sides, *terms)
            found = self._made[cells]
            if found.larger_with_nodes(nodes) <= _MOST_LARGER:
                return found
            cells *= 2


def without_pulls(pressure: Real, nodes: GridNodes, sides: tuple[int, int]) -> Real:
    """Return pressures that nowhere pull; as far as they push on the whole, blocks keep their sums.

    Pulls that were just left out would move a hard layer far beyond the nodes that they leave. So
    what pushes in the same block is lessened by the same force.
    """
    counts = [-(-n // side) for n, side in zip(nodes.shape, sides, strict=True)]
    sums, pushes = np.zeros(counts), np.zeros(counts)
    result = np.empty_like(pressure)
    _lessen_pushes(pressure, nodes.listed, sides, sums, pushes, result)
    return result


class SolvedBlocks:
    """The pressures, even on the nodes of each block, that take up residuals.

    Even pressures x have the energy x A x, where A tells how far blocks displace each other, and
    how much farther the nodes of a block are displaced if they are few. With P, which spreads
    pressures evenly over larger blocks, G = P A P between these and D within each, they are
    G r + (1 - G A) D (1 - A G) r, where G and D stand for the inverses.
    """

    def __init__(self, operator: BlockOperator, count: Real) -> None:
        blocks = np.flatnonzero(count)
        x, y = np.divmod(blocks, count.shape[1])
        number = x // _ALONG_LARGER * count.shape[1] + y // _ALONG_LARGER
        order = np.argsort(number, kind="stable")
        number, places = number[order], (x[order], y[order])
        first = np.flatnonzero(np.diff(number, prepend=-1))
        self._operator, self._places, self._grid = operator, places, np.zeros(count.shape)
        self._starts = np.append(first, number.size)
        self._nodes = nodes = count[places]
        # each block counts by the energy of even pressure on its nodes, as if they lay at random
        self._alone = nodes * (1 - nodes / math.prod(operator.sides)) * operator.own
        between = np.empty((first.size, first.size))
        self._within = np.empty((first.size, _ALONG_LARGER**2, _ALONG_LARGER**2))
        is_positive = _sum_and_factor(
            operator.kernel, places, nodes, self._alone, self._starts, between, self._within
        )
        self._between, failed = lapack.dpotrf(between.T, lower=1, clean=0, overwrite_a=1)
        if failed or not is_positive:
            raise np.linalg.LinAlgError("the half-space is not positive definite")

    def __call__(self, sums: Real) -> Real:
        """Return the pressure on the nodes of each block, from the sums of their residuals."""
        residual = sums[self._places]
        pressure = self._even(residual)
        residual -= self._displaced(pressure)
        rest = np.empty_like(residual)
        _solve_within(self._within, self._starts, residual, rest)
        pressure += rest
        pressure -= self._even(self._displaced(rest))
        result = np.zeros(sums.shape)
        result[self._places] = pressure
        return result

    def _displaced(self, pressure: Real) -> Real:
        """Return the sums of the displacements of nodes under pressures on those of each block."""
        self._grid[self._places] = self._nodes * pressure
        moved = fft.convolved(self._grid, self._operator.half_spectrum, self._operator.periods)
        result: Real = self._nodes * moved[self._places]
        return result + self._alone * pressure

    def _even(self, residual: Real) -> Real:
        """Return the pressures, even on larger blocks, that take up residuals there."""
        half = blas.dtrsv(self._between, np.add.reduceat(residual, self._starts[:-1]), lower=1)
        pressure = blas.dtrsv(self._between, half, lower=1, trans=1, overwrite_x=1)
        return np.repeat(pressure, np.diff(self._starts))


@compiled
def _lessen_pushes(
    pressure: Real,
    nodes: tuple[Indices, Integers, Indices],
    sides: tuple[int, int],
    sums: Real,
    pushes: Real,
    result: Real,
) -> None:
    """Leave out what pulls, and lessen what pushes by as much in each block.

    The sums of blocks, and of what pushes there, are zero before.
    """
    starts, columns, rows = nodes
    for k in range(rows.size):
        x = rows[k] // sides[0]
        for i in range(starts[k], starts[k + 1]):
            y = columns[i] // sides[1]
            sums[x, y] += pressure[i]
            pushes[x, y] += max(pressure[i], 0.0)
    for k in range(rows.size):
        x = rows[k] // sides[0]
        for i in range(starts[k], starts[k + 1]):
            y, push = columns[i] // sides[1], max(pressure[i], 0.0)
            result[i] = push * max(sums[x, y] / pushes[x, y], _LEAST_LEFT) if push > 0 else 0.0


@compiled
def _sum_and_factor(
    kernel: Real,
    places: tuple[Indices, Indices],
    nodes: Real,
    alone: Real,
    starts: Indices,
    between: Real,
    within: Real,
) -> bool:
    """Fill the lower triangle between larger blocks, and Cholesky factors of those within each.

    Return whether the latter are positive definite.
    """
    x, y = places
    is_positive = True
    for a in range(starts.size - 1):
        for b in range(a + 1):
            total = 0.0
            for i in range(starts[a], starts[a + 1]):
                line = 0.0
                for j in range(starts[b], starts[b + 1]):
                    line += nodes[j] * kernel[abs(x[i] - x[j]), abs(y[i] - y[j])]
                total += nodes[i] * line
            between[b, a] = total
        factor = within[a]
        for i in range(starts[a + 1] - starts[a]):
            m = starts[a] + i
            between[a, a] += alone[m]
            for j in range(i + 1):
                n = starts[a] + j
                value = nodes[m] * nodes[n] * kernel[abs(x[m] - x[n]), abs(y[m] - y[n])]
                for k in range(j):
                    value -= factor[i, k] * factor[j, k]
                if j < i:
                    factor[i, j] = value / factor[j, j]
                else:
                    value += alone[m]
                    is_positive &= value > 0
                    factor[i, i] = math.sqrt(max(value, 1e-300))
    return is_positive


@compiled
def _solve_within(within: Real, starts: Indices, residual: Real, result: Real) -> None:
    """Solve the equations within each larger block by their factor."""
    for a in range(starts.size - 1):
        factor, first, size = within[a], starts[a], starts[a + 1] - starts[a]
        for i in range(size):
            value = residual[first + i]
            for k in range(i):
                value -= factor[i, k] * result[first + k]
            result[first + i] = value / factor[i, i]
        for i in range(size - 1, -1, -1):
            value = result[first + i]
            for k in range(i + 1, size):
                value -= factor[k, i] * result[first + k]
            result[first + i] = value / factor[i, i]
