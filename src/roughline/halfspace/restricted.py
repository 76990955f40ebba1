"""An approximate operator that costs what the contact costs, and not what the grid costs.

The kernel is split into a smooth far part and a near part, K = far + near, as in Ewald's method.
The far part of a pressure is convolved on a coarse grid, to which cubic B-splines lead and back
[1]_ [2]_. The near part is summed over the nodes themselves. In Fourier space, far is K times
erfc(q w / 2), where w is the width of the smoothing: near then falls like erfc(r / w) / r, and is cut
at a few cells of the coarse grid [3]_. Products err by a thousandth or so. What they miss is left
to the correction of the defect, with the exact convolution.

References
----------
.. [1] A. Brandt and A. A. Lubrecht, "Multilevel matrix multiplication and fast solution of integral
   equations", J. Comput. Phys. 90, 348-370 (1990).
.. [2] J. R. Phillips and J. K. White, "A precorrected-FFT method for electrostatic analysis of
   complicated 3-D structures", IEEE Trans. Comput.-Aided Des. 16, 1059-1072 (1997).
.. [3] U. Essmann, L. Perera, M. L. Berkowitz, T. Darden, H. Lee and L. G. Pedersen, "A smooth
   particle mesh Ewald method", J. Chem. Phys. 103, 8577-8593 (1995).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.special import erfc

from roughline.computing import fft
from roughline.computing.arrays import Indices, Real, Single
from roughline.halfspace import restricted_loops as loops
from roughline.halfspace.convolution import Convolution
from roughline.halfspace.operator import GridNodes, Operator, Precision

_WIDTH = 1.3  # of the smoothing, in cells of the coarse grid
_RADIUS = 2.25  # of the near part, in cells of the coarse grid
_SIDES = 2, 4, 8  # cells along the side of a coarse cell, where these are square
_REACH = int(_RADIUS * _SIDES[-1])  # of the near part, at most
_SHARES = 0.6, 0.25, 0.025  # of the grid, up to which the coarse cells of each size serve best
_FEWEST_POINTS = 64  # along the shorter side of the grid
_ROUNDING = 8  # to which the lengths of runs are rounded up
_SPREAD_AT_A_TIME = 2**14  # nodes, whose work takes a thread longer than to begin with it
_SUMS_AT_A_TIME = 2**21  # near sums, likewise

NEAR = _REACH + 1, _REACH + 1
"""Distances in cells, counted from zero, at which the kernel is needed."""


@dataclass(frozen=True, eq=False)
class PaddedGrid:
    """Memory for values on a grid with a margin; zero when not in use.

    Attributes
    ----------
    values : ndarray, shape (nx + 2 margins[0], ny + 2 margins[1])
        The values.
    margins : tuple of int
        Cells of the margin along x and y.
    """

    values: Single
    margins: tuple[int, int]

    @classmethod
    def of(cls, shape: tuple[int, int], margins: tuple[int, int]) -> PaddedGrid:
        """Put a margin around a grid."""
        padded = shape[0] + 2 * margins[0], shape[1] + 2 * margins[1]
        return cls(np.zeros(padded, dtype=np.float32), margins)

    def wrap(self) -> None:
        """Fill the margin with what lies a period away."""
        for values, margin in zip((self.values, self.values.T), self.margins, strict=True):
            values[:margin] = values[-2 * margin : -margin]
            values[-margin:] = values[margin : 2 * margin]

    def clear_margin(self) -> None:
        """Set the margin to zero."""
        for values, margin in zip((self.values, self.values.T), self.margins, strict=True):
            values[:margin] = 0
            values[-margin:] = 0


@dataclass(frozen=True, eq=False)
class RestrictedOperator:
    """The displacement of some nodes under the pressure on some nodes, to a thousandth or so.

    Attributes
    ----------
    far : Convolution
        The far part, on the coarse grid.
    taps : ndarray, shape (2 radius + 1, 2 radius + 8)
        The near part, by the distance in cells, followed by zeros. [length / pressure]
    reach : ndarray of int
        Columns to which each row of the near part reaches, to both sides.
    weights : tuple of ndarray, shape (ratio, 4)
        Weights of the four coarse rows around a row, by its place between two of them, and those
        of the columns around a column.
    grid : PaddedGrid
        Memory for pressures.
    periodic : bool
        Whether pressures repeat themselves beyond the grid.
    """

    far: Convolution
    taps: Single
    reach: Indices
    weights: tuple[Single, Single]
    grid: PaddedGrid
    periodic: bool

    @classmethod
    def of(
        cls, operator: Operator, ratios: tuple[int, int], kernel: Real, grid: PaddedGrid
    ) -> RestrictedOperator:
        """Split an operator.

        Parameters
        ----------
        operator : Operator
            The operator.
        ratios : tuple of int
            Cells along the sides of a coarse cell; they divide the periods.
        kernel : ndarray, shape NEAR
            Displacement under unit pressure on one node, by the distance from it in cells.
            [length / pressure]
        grid : PaddedGrid
            Memory, as described above.
        """
        (px, py), (dx, dy), (rx, ry) = operator.periods, operator.spacing, ratios
        coarse = px // rx, py // ry
        side = max(rx * dx, ry * dy)
        modes = [np.arange(period // 2 + 1) for period in coarse]
        q = 2 * np.pi * np.hypot(modes[0][:, np.newaxis] / (px * dx), modes[1] / (py * dy))
        spectrum = operator.spectrum[: modes[0].size, : modes[1].size]
        smooth = spectrum * erfc(q * _WIDTH * side / 2)
        # the spectrum of the near part goes on to q = 0, whatever the operator does with the mean
        some = 1 + modes[0].size // 8
        smooth[0, 0] -= spectrum[some, 0] * q[some, 0] * _WIDTH * side / np.sqrt(np.pi)
        lags = [np.arange(int(_RADIUS * side / spacing) + 1) for spacing in (dx, dy)]
        taps = kernel[: lags[0].size, : lags[1].size] - _at_cells(smooth, coarse, ratios, lags)
        inside = np.hypot(lags[0][:, np.newaxis] * dx, lags[1] * dy) <= _RADIUS * side
        taps[~inside] = 0
        taps = np.concatenate([taps[:0:-1], taps])
        taps = np.concatenate([taps[:, :0:-1], taps, np.zeros((len(taps), 7))], axis=1)
        reach = inside.sum(axis=1) - 1
        # the spectrum of a B-spline's values on the grid, there and back
        splines = [(2 + np.cos(2 * np.pi * k / n)) / 3 for k, n in zip(modes, coarse, strict=True)]
        smooth /= (splines[0][:, np.newaxis] * splines[1]) ** 2
        periodic = operator.periods == operator.shape
        shape = coarse if periodic else _spread_shape(operator.shape, ratios)
        far = Convolution(shape, (rx * dx, ry * dy), coarse, smooth, operator.zero_mean)
        return cls(
            far,
            taps.astype(np.float32),
            np.concatenate([reach[:0:-1], reach]),
            (_spline_weights(rx), _spline_weights(ry)),
            grid,
            periodic,
        )

    @cached_property
    def _coarse(self) -> tuple[Single, Single]:
        """Memory of the coarse grid, where splines spread and whence they interpolate."""
        (nx, ny), beyond = self.far.shape, 3 if self.periodic else 0
        shape = nx + beyond, ny + beyond
        return np.empty(shape, dtype=np.float32), np.empty(shape, dtype=np.float32)

    @cached_property
    def _everywhere(self) -> GridNodes:
        """All nodes of the coarse grid."""
        return GridNodes.of(np.arange(self.far.shape[0] * self.far.shape[1]), self.far.shape)

    def displacement(
        self,
        pressure: Real,
        sources: GridNodes,
        targets: GridNodes,
        precision: Precision = "float32",
        out: Real | None = None,
    ) -> Real:
        """Return the displacement of some nodes under the pressure on some nodes.

        Parameters and result are those of :meth:`roughline.halfspace.operator.Operator.displacement`,
        but targets are given, and all is computed in single precision.
        """
        if out is None:
            out = np.empty(targets.indices.size)
        unit = np.abs(pressure).max(initial=0.0)
        if unit == 0:
            out[:] = 0
            return out
        values = (pressure / unit).astype(np.float32)
        spread, moved = self._coarse
        grid, margins = self.grid.values, self.grid.margins
        lines = np.empty((sources.rows.size, spread.shape[1]), dtype=np.float32)
        place = np.full((spread.shape[0] - 3) * self.weights[0].shape[0], -1)
        place[sources.rows] = np.arange(sources.rows.size)
        at = sources.starts, sources.columns, sources.rows

        def spread_along(first: int, last: int) -> None:
            loops.spread_along_rows(values, *at, self.weights[1], margins, first, last, grid, lines)

        def spread_across(first: int, last: int) -> None:
            loops.spread_across_rows(lines, place, self.weights[0], first, last, spread)

        fft.share_out_blocks(spread_along, sources.rows.size, sources.rows_of(_SPREAD_AT_A_TIME))
        fft.share_out_blocks(spread_across, len(spread), max(1, _SPREAD_AT_A_TIME // len(spread)))
        self._convolve(spread, moved)
        if self.periodic:
            self.grid.wrap()
        runs, first_run = targets.runs
        result = np.empty(targets.indices.size, dtype=np.float32)

        def add(first: int, last: int) -> None:
            loops.add_near_and_far(
                grid,
                margins,
                self.taps,
                self.reach,
                moved,
                self.weights,
                targets.rows,
                targets.columns,
                first_run,
                runs,
                first,
                last,
                result,
            )

        fft.share_out_blocks(
            add, targets.rows.size, targets.rows_of(_SUMS_AT_A_TIME // self.taps.size)
        )
        loops.clear_grid(*at, margins, grid)
        if self.periodic:
            self.grid.clear_margin()
        return np.multiply(result, unit, out=out)

    def _convolve(self, spread: Single, moved: Single) -> None:
        """Convolve on the coarse grid."""
        if not self.periodic:
            self.far.displacement(spread.ravel(), self._everywhere, None, "float32", moved)
            return
        folded = _folded(_folded(spread).T).T
        inner = self.far.displacement(folded.ravel(), self._everywhere, None, "float32")
        moved[:] = np.pad(inner, (1, 2), mode="wrap")


def _at_cells(
    spectrum: Real, periods: tuple[int, int], ratios: tuple[int, int], lags: list[Indices]
) -> Real:
    """Transform an even spectrum back, given by its quarter, at fractions of a coarse cell."""
    result = spectrum
    for axis, period in enumerate(periods):
        modes = np.arange(period // 2 + 1)
        weights = np.where((modes == 0) | (2 * modes == period), 1.0, 2.0)
        cosines = np.cos(2 * np.pi / (period * ratios[axis]) * np.outer(lags[axis], modes))
        result = np.moveaxis(np.tensordot(weights * cosines, result, axes=(1, axis)), 0, axis)
    return result


def _folded(values: Single) -> Single:
    """Add the rows that splines reach beyond a period to those a period away."""
    inner = values[1:-2].copy()
    inner[-1] += values[0]
    inner[0] += values[-2]
    inner[1] += values[-1]
    return inner


def _spread_shape(shape: tuple[int, int], ratios: tuple[int, int]) -> tuple[int, int]:
    """Return the points of the coarse grid that splines on the grid reach."""
    return -(-shape[0] // ratios[0]) + 3, -(-shape[1] // ratios[1]) + 3


def _spline_weights(ratio: int) -> Single:
    """Return the weights of the four cubic B-splines that reach a point, by its place."""
    t = np.arange(ratio) / ratio
    weights = [(1 - t) ** 3, 4 - 6 * t**2 + 3 * t**3, 1 + 3 * t + 3 * t**2 - 3 * t**3, t**3]
    return (np.stack(weights, axis=1) / 6).astype(np.float32)


class RestrictedOperators:
    """The restricted forms of an operator, made as they are needed.

    Parameters
    ----------
    operator : Operator
        The operator.
    kernel : ndarray, shape NEAR
        Displacement under unit pressure on one node, by the distance from it in cells.
        [length / pressure]
    margins : tuple of int
        Cells of the margin that others need, who use the same memory.
    """

    def __init__(self, operator: Operator, kernel: Real, margins: tuple[int, int]) -> None:
        self._operator = operator
        self._kernel = kernel
        self._margins = margins
        self._ratios = _ratios(operator)
        self._made: dict[tuple[int, int], RestrictedOperator] = {}

    @cached_property
    def grid(self) -> PaddedGrid:
        """Memory for values on the grid and on a margin; zero when not in use."""
        margins = self._margins
        if self._ratios:
            margins = max(margins[0], _REACH), max(margins[1], _REACH + _ROUNDING)
        return PaddedGrid.of(self._operator.shape, margins)

    def on(self, nodes: GridNodes) -> RestrictedOperator | None:
        """Return the cheapest one for some nodes, or None where the exact operator is cheaper."""
        if not self._ratios:
            return None
        points = self._operator.shape[0] * self._operator.shape[1]
        part = int(nodes.runs[0][:, 2].sum()) / points
        ratios = next((each for share, each in reversed(self._ratios) if part <= share), None)
        if ratios is None:
            return None
        if ratios not in self._made:
            self._made[ratios] = RestrictedOperator.of(
                self._operator, ratios, self._kernel, self.grid
            )
        return self._made[ratios]


def _ratios(operator: Operator) -> list[tuple[float, tuple[int, int]]]:
    """List possible coarse cells, about square, and the share of the grid up to which they serve."""
    possible: list[tuple[float, tuple[int, int]]] = []
    if min(operator.shape) < _FEWEST_POINTS:
        return []
    dx, dy = operator.spacing
    longer = max(dx, dy)
    for ratio, share in zip(_SIDES, _SHARES, strict=True):
        ratios = ratio * 2 ** round(np.log2(longer / dx)), ratio * 2 ** round(np.log2(longer / dy))
        radius = _RADIUS * max(ratios[0] * dx, ratios[1] * dy) / min(dx, dy)
        divides = all(p % r == 0 for p, r in zip(operator.periods, ratios, strict=True))
        if divides and radius < _REACH + 1:
            possible.append((share, ratios))
    return possible
