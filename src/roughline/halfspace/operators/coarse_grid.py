"""The far part of an operator on a coarse grid; cubic B-splines transfer values to and fro.

References
----------
.. [1] U. Essmann, L. Perera, M. L. Berkowitz, T. Darden, H. Lee and L. G. Pedersen, "A smooth
   particle mesh Ewald method", J. Chem. Phys. 103, 8577-8593 (1995).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Floats, InGrid, Integers, Real, Single
from roughline.computing.compiled import compiled
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.operators.workspace import Workspace

_ONE_THREAD_MODES = 2**18  # up to which one thread transforms all sooner than two share them
_SPLINE_MARGIN = 3  # coarse nodes that splines reach beyond the grid


@dataclass(frozen=True, eq=False)
class PaddedGrid:
    """Memory for values on a grid with a margin along x and y; zero when not in use."""

    values: Single
    margins: tuple[int, int]

    @classmethod
    def of(
        cls,
        shape: tuple[int, int],
        margins: tuple[int, int],
        workspace: Workspace,
        part: str = "padded grid",
    ) -> PaddedGrid:
        """Put a margin around a grid."""
        padded = shape[0] + 2 * margins[0], shape[1] + 2 * margins[1]
        return cls(workspace.array(part, padded, np.float32), margins)

    def wrap(self, repeats: tuple[bool, bool]) -> None:
        """Fill the margins along x and y, where these repeat, with what lies a period away."""
        both = self.values, self.values.T
        for values, margin, repeated in zip(both, self.margins, repeats, strict=True):
            if repeated:
                values[:margin] = values[-2 * margin : -margin]
                values[-margin:] = values[margin : 2 * margin]

    def clear(self, nodes: GridNodes, *, wrapped: tuple[bool, bool] = (False, False)) -> None:
        """Set the nodes to zero, and the margins where they were filled."""
        _clear_runs(nodes.rows, nodes.columns, *nodes.runs, self.values, self.margins)
        both = self.values, self.values.T
        for values, margin, repeated in zip(both, self.margins, wrapped, strict=True):
            if repeated:
                values[:margin] = values[-margin:] = 0


@dataclass(frozen=True, eq=False)
class Splines:
    """Cubic B-splines, which take values from nodes of a fine grid to a coarse one, and back [1]_.

    The weights are those of the four coarse rows around a row, by its place between two of them,
    and those of the columns around a column.
    """

    shape: tuple[int, int]  # of the coarse grid
    weights: tuple[Single, Single]
    repeats: tuple[bool, bool]  # along x and y
    workspace: Workspace

    @classmethod
    def of(cls, operator: Convolution, ratios: tuple[int, int]) -> Splines:
        """Take a coarse grid with so many cells of the operator along the sides of a cell."""
        nx, ny = (
            n // ratio if repeated else -(-n // ratio) + _SPLINE_MARGIN
            for n, ratio, repeated in zip(operator.shape, ratios, operator.repeats, strict=True)
        )
        weights = _spline_weights(ratios[0]), _spline_weights(ratios[1])
        return cls((nx, ny), weights, operator.repeats, operator.workspace)

    def array(self, part: str) -> Single:
        """Return memory for values on the coarse grid, and beyond it where it repeats."""
        nx, ny = (
            n + _SPLINE_MARGIN if repeated else n
            for n, repeated in zip(self.shape, self.repeats, strict=True)
        )
        memory: Single = self.workspace.array(part, (nx, ny), np.float32)
        return memory

    def spread(self, values: Single, sources: GridNodes, grid: PaddedGrid, part: str) -> Single:
        """Spread values over the coarse grid, and leave them on a fine one."""
        spread = self.array(part)
        lines = np.empty((sources.rows.size, spread.shape[1]), dtype=np.float32)
        place = sources.place_of_rows
        along, across = self.weights[1], self.weights[0]

        def spread_along(first: int, last: int) -> None:
            parts = (first, last), grid.values, grid.margins, lines
            _spread_along_rows(values, sources.listed, along, *parts)

        def spread_across(first: int, last: int) -> None:
            _spread_across_rows(lines, place, across, first, last, spread)

        fft.share_out_blocks(
            spread_along, sources.rows.size, sources.rows_holding(fft.VALUES_AT_A_TIME)
        )
        fft.share_out_blocks(spread_across, len(spread), 1 + fft.VALUES_AT_A_TIME // len(spread))
        if not any(self.repeats):
            return spread
        grid.wrap(self.repeats)
        for values, repeated in zip((spread, spread.T), self.repeats, strict=True):
            if repeated:  # what lies beyond a period, to a period away
                values[-_SPLINE_MARGIN] += values[0]
                values[1:_SPLINE_MARGIN] += values[-2:]
        return np.ascontiguousarray(self.inside(spread))

    def inside(self, values: Single) -> Single:
        """Return what lies within a period where the grid repeats."""
        (nx, ny), margins = values.shape, [(1, 2) if each else (0, 0) for each in self.repeats]
        (left, right), (low, high) = margins
        return values[left : nx - right, low : ny - high]

    def wrap(self, values: Single) -> Single:
        """Fill what lies beyond a period with what lies a period away."""
        for each, repeated in zip((values, values.T), self.repeats, strict=True):
            if repeated:
                each[0], each[-2:] = each[-3], each[1:3]
        return values


@dataclass(frozen=True, eq=False)
class CoarseGrid:
    """A smooth kernel on a coarse grid, between nodes of the fine one."""

    convolution: Convolution
    splines: Splines

    @classmethod
    def of(cls, operator: Convolution, ratios: tuple[int, int], spectrum: Real) -> CoarseGrid:
        """Put a smooth kernel, given by a quarter of its spectrum, on a coarse grid.

        The ratios are cells of the operator along the sides of a coarse cell, and divide its
        periods.
        """
        splines = Splines.of(operator, ratios)
        px, py = (period // ratio for period, ratio in zip(operator.periods, ratios, strict=True))
        dx, dy = (ratio * side for ratio, side in zip(ratios, operator.spacing, strict=True))
        given = splines.shape, (dx, dy), (px, py), sharpened(spectrum, (px, py))
        return cls(Convolution(*given, workspace=operator.workspace), splines)

    @cached_property
    def _half_spectrum(self) -> Single:
        """Half of the eigenvalues, of which the convolution stores a quarter."""
        modes, quarter = np.arange(self.convolution.periods[0]), self.convolution.spectrum
        return quarter[np.minimum(modes, modes[::-1] + 1)].astype(np.float32)

    @cached_property
    def _everywhere(self) -> GridNodes:
        nx, ny = self.convolution.shape
        return GridNodes.of(InGrid(np.arange(nx * ny)), (nx, ny))

    def displacement(self, pressure: Single, sources: GridNodes, grid: PaddedGrid) -> Single:
        """Return the displacement of the coarse nodes, and leave the pressures on a fine grid."""
        splines = self.splines
        spread = splines.spread(pressure, sources, grid, "spread pressures")
        moved = splines.array("coarse displacements")
        if not any(splines.repeats):
            return self._convolved(spread, moved)
        splines.inside(moved)[:] = self._convolved(spread, np.empty_like(spread))
        return splines.wrap(moved)

    def _convolved(self, pressure: Single, out: Single) -> Single:
        """Convolve on the coarse grid; all is in single precision, whatever the types say."""
        periods = self.convolution.periods
        if periods[0] * periods[1] <= _ONE_THREAD_MODES:
            out[:] = fft.convolved(pressure, self._half_spectrum, periods)
            return out
        values: Any = pressure.ravel()
        result: Any = out
        self.convolution.displacement(values, self._everywhere, None, "float32", result)
        return out


def sharpened(spectrum: Real, periods: tuple[int, int]) -> Real:
    """Return a quarter of a spectrum without what splines take from it, there and back."""
    # the spectrum of a B-spline's values on the grid
    x, y = ((2 + np.cos(2 * np.pi / n * np.arange(n // 2 + 1))) / 3 for n in periods)
    return spectrum / (x[:, np.newaxis] * y) ** 2


def _spline_weights(ratio: int) -> Single:
    """Return the weights of the four cubic B-splines that reach a point, by its place."""
    t = np.arange(ratio) / ratio
    weights = [(1 - t) ** 3, 4 - 6 * t**2 + 3 * t**3, 1 + 3 * t + 3 * t**2 - 3 * t**3, t**3]
    return (np.stack(weights, axis=1) / 6).astype(np.float32)


@compiled
def _spread_along_rows(
    values: Floats,
    nodes: tuple[Integers, Integers, Integers],
    weights: Floats,
    block: tuple[int, int],
    grid: Floats,
    margins: tuple[int, int],
    lines: Floats,
) -> None:
    """Write the values of a block of rows to the grid, and spread them over the coarse columns.

    Nodes are starts, columns and rows. Each of the lines gets a row, spread by the weights of the
    four coarse columns around a column, which go by its place between two of them.
    """
    starts, columns, rows = nodes
    ratio = weights.shape[0]
    for k in range(block[0], block[1]):
        places, line = grid[rows[k] + margins[0]], lines[k]
        line[:] = 0
        for i in range(starts[k], starts[k + 1]):
            places[columns[i] + margins[1]] = values[i]
            coarse, part = columns[i] // ratio, columns[i] % ratio
            for a in range(4):
                line[coarse + a] += weights[part, a] * values[i]


@compiled
def _clear_runs(
    rows: Integers,
    columns: Integers,
    first_run: Integers,
    runs: Integers,
    grid: Floats,
    margins: tuple[int, int],
) -> None:
    """Set a grid with margins to zero where there are runs of nodes."""
    for k in range(rows.size):
        places = grid[rows[k] + margins[0]]
        for run in range(first_run[k], first_run[k + 1]):
            start = columns[runs[run, 0]] + margins[1]
            places[start : start + runs[run, 2]] = 0


@compiled
def _spread_across_rows(
    lines: Floats, place: Integers, weights: Floats, first: int, last: int, coarse: Floats
) -> None:
    """Spread lines, one for each row with values, over the coarse rows from first to last.

    The place of each row of the grid among the lines is -1 where it holds no value. Weights are
    those of the four coarse rows around a row, by its place between two of them.
    """
    ratio = weights.shape[0]
    for row in range(first, last):
        total = coarse[row]
        total[:] = 0
        for i in range(max(0, (row - 3) * ratio), min(place.size, (row + 1) * ratio)):
            if place[i] >= 0:
                weight = weights[i % ratio, row - i // ratio]
                line = lines[place[i]]
                for j in range(line.size):
                    total[j] += weight * line[j]
