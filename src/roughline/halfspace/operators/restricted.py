"""An approximate operator whose cost grows with the contact, and not with the grid.

The kernel is split into a smooth far part and a near part, K = far + near, as in Ewald's method.
The far part is convolved on a coarse grid [1]_, and the near part is summed over the nodes
themselves [2]_. In Fourier space, far is K times erfc(q w / 2), where w is the width of the
smoothing: near then falls like erfc(r / w) / r, and is cut at a few coarse cells. Products have
an error of about a thousandth. The correction of the defect by the exact convolution removes it.

That is so where K falls as 1 / q. What a layered body adds to that is smooth as a whole, if the
coarse grid resolves the depth that it comes from, and far.

References
----------
.. [1] A. Brandt and A. A. Lubrecht, "Multilevel matrix multiplication and fast solution of integral
   equations", J. Comput. Phys. 90, 348-370 (1990).
.. [2] J. R. Phillips and J. K. White, "A precorrected-FFT method for electrostatic analysis of
   complicated 3-D structures", IEEE Trans. Comput.-Aided Des. 16, 1059-1072 (1997).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Floats, Indices, Integers, Real, Single
from roughline.computing.compiled import compiled
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.operators.coarse_grid import CoarseGrid, PaddedGrid
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.operators.discretisation import on_grid
from roughline.halfspace.operators.even_sums import even_sums
from roughline.halfspace.operators.grid_nodes import RUN_UNIT, GridNodes, Precision

SMOOTHING_WIDTH = 1.3  # of the smoothing, in cells of the coarse grid
NEAR_RADIUS = 2.25  # of the near part, in cells of the coarse grid
# Cells along the side of a coarse cell, where these are square, and up to which part of the grid
# they serve best.
_SIDES = (8, 0.025), (4, 0.35), (2, 1.0)
_LARGEST_SHARE = 0.15  # of the grid for each mode a point; up to it the exact operator takes longer
_MOST_REACH = int(NEAR_RADIUS * _SIDES[0][0])  # of the near part, at most
RESOLVED_EXCESS = 0.15  # compliance that lower layers may add for a coarse grid's shortest waves


@dataclass(frozen=True, eq=False)
class RestrictedOperator:
    """The displacement of some nodes under the pressure on some nodes, to a thousandth or so."""

    far: CoarseGrid
    taps: Single  # the near part by the distance in cells, and seven zeros beside each row of it
    reach: Indices  # columns to which each row of the near part reaches, to both sides
    shape: tuple[int, int]  # of the grid
    margins: tuple[int, int]  # cells around it, on which pressures are laid out

    @classmethod
    def of(
        cls, operator: Convolution, ratios: tuple[int, int], margins: tuple[int, int]
    ) -> RestrictedOperator:
        """Split an operator, with so many cells along the sides of a coarse cell."""
        from scipy.special import erfc  # here because it loads slowly

        (px, py), (dx, dy), (rx, ry) = operator.periods, operator.spacing, ratios
        coarse = px // rx, py // ry
        side = max(rx * dx, ry * dy)
        kx, ky = np.arange(coarse[0] // 2 + 1), np.arange(coarse[1] // 2 + 1)
        q = 2 * np.pi * np.hypot(kx[:, np.newaxis] / (px * dx), ky / (py * dy))
        spectrum = operator.spectrum[: kx.size, : ky.size]
        share = erfc(q * SMOOTHING_WIDTH * side / 2)
        spectrum = operator.spectrum[: kx.size, : ky.size]
        steep, limit, rest = split_spectrum(operator, side, q)
        smooth = steep * share + rest
        # the spectrum of the near part goes on to q = 0, whatever the operator does with the mean
        smooth[0, 0] -= limit / (px * py) * SMOOTHING_WIDTH * side / np.sqrt(np.pi)
        lags = (
            np.arange(int(NEAR_RADIUS * side / dx) + 1),
            np.arange(int(NEAR_RADIUS * side / dy) + 1),
        )
        near = even_sums(operator.spectrum, operator.periods, lags)
        near -= even_sums(smooth, coarse, (lags[0] / rx, lags[1] / ry))
        inside = np.hypot(lags[0][:, np.newaxis] * dx, lags[1] * dy) <= NEAR_RADIUS * side
        near[~inside] = 0
        # what the cut leaves out, far more where the body has a length of its own, is smooth
        x, y = (
            np.where(lag > 0, 2, 1) * np.cos(2 * np.pi / period * np.outer(k, lag))
            for k, lag, period in zip((kx, ky), lags, operator.periods, strict=True)
        )
        smooth += (spectrum - smooth - x @ near @ y.T / (px * py)) * share
        near = np.concatenate([near[:0:-1], near])
        taps = np.concatenate([near[:, :0:-1], near, np.zeros((len(near), RUN_UNIT - 1))], axis=1)
        reach = inside.sum(axis=1) - 1
        return cls(
            CoarseGrid.of(operator, ratios, smooth),
            taps.astype(np.float32),
            np.concatenate([reach[:0:-1], reach]),
            operator.shape,
            margins,
        )

    def displacement(
        self,
        pressure: Real,
        sources: GridNodes,
        targets: GridNodes,
        precision: Precision = "float32",
    ) -> Real:
        """Return the displacement of some nodes under the pressure on some, in single precision."""
        unit = np.abs(pressure).max(initial=0.0)
        if unit == 0:
            return np.zeros(targets.indices.size)
        grid = PaddedGrid.of(self.shape, self.margins, self.far.convolution.workspace)
        moved = self.far.displacement((pressure / unit).astype(np.float32), sources, grid)
        nodes = targets.rows, targets.columns, *targets.runs
        result = np.empty(targets.indices.size, dtype=np.float32)

        def add(first: int, last: int) -> None:
            near, far = (self.taps, self.reach), (moved, self.far.splines.weights)
            padded = grid.values, grid.margins
            parts = padded, near, *far, nodes, (first, last), result
            _add_near_and_far(*parts)

        # for fewer near sums, starting a thread does not pay
        rows_at_a_time = targets.rows_holding(2**21 // self.taps.size)
        fft.share_out_blocks(add, targets.rows.size, rows_at_a_time)
        grid.clear(sources, wrapped=self.far.splines.repeats)
        return np.multiply(result, unit, dtype=np.float64)


class RestrictedOperators:
    """The restricted forms of an operator, made as they are needed.

    The margins are cells that others need, who use the same padded grid.
    """

    def __init__(self, operator: Convolution, margins: tuple[int, int]) -> None:
        self._operator = operator
        self._ratios = _ratios(operator)
        if self._ratios:
            margins = max(margins[0], _MOST_REACH), max(margins[1], _MOST_REACH + RUN_UNIT)
        self.margins = margins
        self._made: dict[tuple[int, int], RestrictedOperator] = {}

    @property
    def grid(self) -> PaddedGrid:
        """Memory for values on the grid and on a margin; zero when not in use."""
        return PaddedGrid.of(self._operator.shape, self.margins, self._operator.workspace)

    def on(self, nodes: GridNodes) -> RestrictedOperator | None:
        """Return the cheapest one for some nodes, or None where the exact operator is cheaper."""
        ratios = self.ratios(nodes)
        if ratios and ratios not in self._made:
            self._made[ratios] = RestrictedOperator.of(self._operator, ratios, self.margins)
        return self._made[ratios] if ratios else None

    def ratios(self, nodes: GridNodes) -> tuple[int, int] | None:
        """Return the cells along the sides of a coarse cell that serve some nodes best, if any."""
        part = nodes.runs[1][:, 2].sum() / np.prod(self._operator.shape) if self._ratios else 1.0
        return next((each for each, share in self._ratios if part <= share), None)


def split_spectrum(operator: Convolution, side: float, q: Real) -> tuple[Real, float, Real]:
    """Split a spectrum into one that falls as 1 / q, and the smooth part of the rest.

    Return the first at the waves of a coarse grid, its q C(q), and the second. Where the coarse
    grid resolves what waves feel beside the modulus of the surface, the first is of that modulus,
    and all of the rest is smooth. Else it is of the modulus that the longest waves feel.
    """
    half_space, (kx, ky) = operator.half_space, q.shape
    assert half_space is not None
    spectrum = operator.spectrum[:kx, :ky]
    limit = 2 / float(half_space.modulus(np.array([longest_wave(operator)]))[0])
    if math.isclose(limit, 2 / half_space.E_star, rel_tol=1e-9):
        return spectrum, limit, np.zeros(q.shape)
    smooth = np.exp(-((q * side) ** 2) / 4)
    if resolves(half_space, side):
        limit, smooth = 2 / half_space.E_star, np.ones(q.shape)
    plain = Homogeneous(2.0, half_space.periodic)  # C(q) = 1 / q
    steep = on_grid(plain, operator.shape, operator.spacing).spectrum[:kx, :ky] * limit
    return steep, limit, (spectrum - steep) * smooth


def longest_wave(operator: Convolution) -> float:
    """Return the wavenumber of a wave far longer than the grid, which feels the base alone."""
    longest = max(n * each for n, each in zip(operator.periods, operator.spacing, strict=True))
    return 1e-3 * 2 * math.pi / longest


def excess_compliance(half_space: HalfSpace, side: float) -> float:
    """Return by which part more than the surface's own modulus lets it a wave is displaced.

    The wave is the shortest on a grid with cells of such a side.
    """
    return half_space.E_star / float(half_space.modulus(np.array([np.pi / side]))[0]) - 1


def resolves(half_space: HalfSpace, side: float) -> bool:
    """Whether a coarse grid resolves what waves feel beside the modulus of the surface."""
    return abs(excess_compliance(half_space, side)) < RESOLVED_EXCESS


def _ratios(operator: Convolution) -> list[tuple[tuple[int, int], float]]:
    """List possible coarse cells, about square, and up to which part of the grid they serve."""
    (dx, dy), possible = operator.spacing, []
    most = _LARGEST_SHARE * math.prod(operator.periods) / math.prod(operator.shape)
    for side, share in _SIDES:
        rx, ry = (side * 2 ** round(np.log2(max(dx, dy) / each)) for each in (dx, dy))
        radius = NEAR_RADIUS * max(rx * dx, ry * dy) / min(dx, dy)
        divide = operator.periods[0] % rx == operator.periods[1] % ry == 0
        large = min(operator.shape) >= 64 and not operator.small_grid
        if large and divide and radius < _MOST_REACH + 1:
            possible.append(((rx, ry), min(share, most)))
    half_space = operator.half_space
    assert half_space is not None
    resolving = [
        ((rx, ry), share)
        for (rx, ry), share in possible
        if resolves(half_space, max(rx * dx, ry * dy))
    ]
    return resolving or possible


@compiled
def _add_near_and_far(
    padded: tuple[Floats, tuple[int, int]],
    near: tuple[Floats, Integers],
    coarse: Floats,
    weights: tuple[Floats, Floats],
    nodes: tuple[Integers, Integers, Integers, Integers],
    block: tuple[int, int],
    result: Floats,
) -> None:
    """Add what near values and what the coarse grid displace, at each node of a block of rows.

    The padded grid holds the pressures within its margins. The near part is the kernel by the
    distance in cells, each row followed by seven zeros, and the columns to which each row of it
    reaches, to both sides. Weights are those of the coarse rows and columns. Nodes are rows,
    columns, where the runs of each row begin, and the runs.
    """
    (grid, margins), (rows, columns, first_run, runs) = padded, nodes
    ratio, radius = weights[1].shape[0], near[0].shape[0] // 2
    far, sums = np.empty_like(coarse[0]), np.empty_like(grid[0])
    flat, width = grid.reshape(-1), grid.shape[1]
    for k in range(block[0], block[1]):
        interpolate_row(coarse, weights[0], rows[k], far)
        above = (rows[k] + margins[0] - radius) * width
        for run in range(first_run[k], first_run[k + 1]):
            begin, end, length = runs[run]
            start = columns[begin]
            _sum_near(flat[above + start :], width, margins[1], near, sums[:length])
            for i in range(begin, end):
                column, part = columns[i] // ratio, columns[i] % ratio
                value = sums[columns[i] - start]
                for a in range(4):
                    value += weights[1][part, a] * far[column + a]
                result[i] = value


@compiled
def interpolate_row(coarse: Floats, weights: Floats, row: int, far: Floats) -> None:
    """Interpolate between coarse rows, for all coarse columns."""
    ratio = weights.shape[0]
    above, part = row // ratio, row % ratio
    c0, c1, c2, c3 = coarse[above], coarse[above + 1], coarse[above + 2], coarse[above + 3]
    w0, w1, w2, w3 = weights[part]
    for j in range(far.size):
        far[j] = w0 * c0[j] + w1 * c1[j] + w2 * c2[j] + w3 * c3[j]


@compiled
def _sum_near(
    flat: Floats, width: int, margin: int, near: tuple[Floats, Integers], sums: Floats
) -> None:
    """Sum the near part over a run, from the first row that it reaches on."""
    taps, reach = near
    across = (taps.shape[1] - 8) // 2
    sums[:] = 0
    for di in range(taps.shape[0]):
        groups = (2 * reach[di] + 8) // 8  # of eight taps
        at = di * width + margin - reach[di]
        line, tap = flat[at : at + 8 * groups + sums.size], taps[di, across - reach[di] :]
        for g in range(0, 8 * groups, 8):
            t0, t1, t2, t3 = tap[g], tap[g + 1], tap[g + 2], tap[g + 3]
            t4, t5, t6, t7 = tap[g + 4], tap[g + 5], tap[g + 6], tap[g + 7]
            p = line[g:]
            for j in range(sums.size):  # summed in pairs, which need not wait for each other
                sums[j] += ((t0 * p[j] + t1 * p[j + 1]) + (t2 * p[j + 2] + t3 * p[j + 3])) + (
                    (t4 * p[j + 4] + t5 * p[j + 5]) + (t6 * p[j + 6] + t7 * p[j + 7])
                )
