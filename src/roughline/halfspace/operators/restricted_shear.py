"""Displacement along the surface by shear, at a cost that grows with the contact alone.

It is split as pressure's is (see `restricted.py`), into a far part on a coarse grid and a near part
that is summed. What depends on the direction of a wave needs another share of the far part [1]_:
the near part's spectrum is smooth at q = 0, and so its kernel falls fast, if with x = q w / 2 that
share is erfc(x) for what waves of all directions have in common, erfc(x) + 2 x exp(-x²) / sqrt(pi)
for what goes with twice their angle, and exp(-x²) for what goes with the angle, as pressure does.

References
----------
.. [1] H. Hasimoto, "On the periodic fundamental solutions of the Stokes equations and their
   application to viscous flow past a cubic array of spheres", J. Fluid Mech. 5, 317-328 (1959).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from roughline.computing import fft
from roughline.computing.arrays import Floats, Indices, Integers, Real, Single
from roughline.computing.compiled import compiled, compiled_sums
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.operators.coarse_grid import PaddedGrid, Splines, sharpened
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.operators.even_sums import even_sums
from roughline.halfspace.operators.grid_nodes import RUN_UNIT, GridNodes
from roughline.halfspace.operators.restricted import (
    NEAR_RADIUS,
    SMOOTHING_WIDTH,
    interpolate_row,
)
from roughline.halfspace.operators.shear import ShearConvolution

_EVEN_PARTS, _SKEW_PART, _ALONG_X, _ALONG_Y = (
    (False, False),
    (True, True),
    (True, False),
    (False, True),
)


@dataclass(frozen=True, eq=False)
class _NearAndFar:
    """What displaces in one direction or two, by values of one kind or two."""

    near: Single  # shape (to, by, lags, lags)
    far: Any  # shape (to, by, modes, modes), complex or not


@dataclass(frozen=True, eq=False)
class RestrictedShear:
    """The displacement of some nodes under the shear on some nodes, to a thousandth or so.

    Where pressure displaces along the surface, and shear into the body, it has these too.
    """

    # of displacement along x by shear along x, along y by that along y, and across; along x and
    # along y by pressure
    far: tuple[Single, ...]  # spectra on the coarse grid, for q >= 0 along y
    near: tuple[Single, ...]  # by the distance in cells, and seven zeros beside each row
    reach: Indices  # columns to which each row of the near parts reaches, to both sides
    splines: Splines
    periods: tuple[int, int]  # of the coarse grid
    shape: tuple[int, int]  # of the grid
    margins: tuple[int, int]  # cells around it, on which values are laid out

    @classmethod
    def of(
        cls,
        exact: ShearConvolution,
        operator: Convolution,
        ratios: tuple[int, int],
        margins: tuple[int, int],
    ) -> RestrictedShear:
        """Split an operator, with so many cells along the sides of a coarse cell.

        The other operator is that of pressures on the same grid.
        """
        split = _Split(operator, ratios)
        mean, part, skew = (each[split.modes] for each in (exact.mean, exact.part, exact.skew))
        common, twice, once = split.shares
        mean, part = mean * common, part * twice
        # the spectrum of the near part goes on to q = 0, whatever the operator does with the mean
        mean[0, 0] -= split.at_rest * split.limit
        parts = [
            split.made(exact.mean + exact.part, mean + part, _EVEN_PARTS, common),
            split.made(exact.mean - exact.part, mean - part, _EVEN_PARTS, common),
            split.made(exact.skew, skew * twice, _SKEW_PART, twice),
        ]
        if exact.towards is not None:
            for each, odd in zip(exact.towards, (_ALONG_X, _ALONG_Y), strict=True):
                parts.append(split.made(each, each[split.modes] * once, odd, once))
        near, far = zip(*parts, strict=True)
        splines = Splines.of(operator, ratios)
        return cls(far, near, split.reach, splines, split.coarse, operator.shape, margins)

    def displacement(self, shear: Real, sources: GridNodes, targets: GridNodes) -> Real:
        """Return the displacements of nodes under shear; both of shape (nodes, 2)."""
        return self._moved(shear, sources, targets, self._by_shear)

    def by_pressure(self, pressure: Real, sources: GridNodes, targets: GridNodes) -> Real:
        """Return the displacements of nodes along the surface, shape (targets, 2)."""
        return self._moved(pressure[:, np.newaxis], sources, targets, self._by_pressure)

    def into_body(self, shear: Real, sources: GridNodes, targets: GridNodes) -> Real:
        """Return the displacements of nodes into the body under shear, shape (targets,)."""
        return self._moved(shear, sources, targets, self._into_body)[:, 0]

    @cached_property
    def _by_shear(self) -> _NearAndFar:
        near, far = ([[xx, xy], [xy, yy]] for xx, yy, xy in (self.near[:3], self.far[:3]))
        return _NearAndFar(np.array(near), np.array(far))

    @cached_property
    def _by_pressure(self) -> _NearAndFar:
        near, far = ([[each] for each in part[3:]] for part in (self.near, self.far))
        return _NearAndFar(np.array(near), np.complex64(1j) * np.array(far))

    @cached_property
    def _into_body(self) -> _NearAndFar:
        back = (
            -np.swapaxes(each, 0, 1) for each in (self._by_pressure.near, self._by_pressure.far)
        )
        return _NearAndFar(*map(np.ascontiguousarray, back))

    def _moved(
        self, values: Real, sources: GridNodes, targets: GridNodes, parts: _NearAndFar
    ) -> Real:
        """Return what values displace, near and far."""
        splines, workspace = self.splines, self.splines.workspace
        unit, (to, by) = np.abs(values).max(initial=0.0), parts.near.shape[:2]
        result = np.zeros((targets.indices.size, to), dtype=np.float32)
        if unit == 0:
            return result.astype(np.float64)
        grids = [
            PaddedGrid.of(self.shape, self.margins, workspace, f"padded grid{part}")
            for part in ("", " of y")[:by]
        ]
        spread = np.empty((by, *splines.shape), dtype=np.float32)
        for axis, grid in enumerate(grids):
            given = (values[:, axis] / unit).astype(np.float32)
            spread[axis] = splines.spread(given, sources, grid, "spread pressures")
        moved = []
        for axis, far in enumerate(fft.convolved_together(spread, parts.far, self.periods)):
            moved.append(splines.array(f"coarse displacements {axis}"))
            splines.inside(moved[axis])[:] = far
            splines.wrap(moved[axis])
        nodes = targets.rows, targets.columns, *targets.runs
        padded = tuple(each.values for each in grids), grids[0].margins

        def add(first: int, last: int) -> None:
            near, far = (parts.near, self.reach), (tuple(moved), splines.weights)
            _add_near_and_far(padded, near, *far, nodes, (first, last), result)

        rows_at_a_time = targets.rows_holding(2**21 // parts.near.size)
        fft.share_out_blocks(add, targets.rows.size, rows_at_a_time)
        for grid in grids:
            grid.clear(sources, wrapped=splines.repeats)
        return np.multiply(result, unit, dtype=np.float64)


class _Split:
    """How spectra on a grid are split into near and far, with so many cells in a coarse one."""

    def __init__(self, operator: Convolution, ratios: tuple[int, int]) -> None:
        from scipy.special import erfc  # here because it loads slowly

        (px, py), (dx, dy), (rx, ry) = operator.periods, operator.spacing, ratios
        self._operator, self._ratios = operator, ratios
        self.coarse = px // rx, py // ry
        side = max(rx * dx, ry * dy)
        self._waves = tuple(np.arange(n // 2 + 1) for n in self.coarse)
        kx, ky = self._waves
        self.modes = slice(kx.size), slice(ky.size)
        q = 2 * np.pi * np.hypot(kx[:, np.newaxis] / (px * dx), ky / (py * dy))
        x = q * SMOOTHING_WIDTH * side / 2
        common = erfc(x)
        gauss, half_space = np.exp(-(x**2)), operator.half_space
        assert half_space is not None
        of_one = [float(each[0]) for each in half_space.shear_spectrum(np.ones(1))]
        self.limit = sum(of_one) / (2 * px * py)  # of q times the mean spectrum
        self.shares = common, common + 2 * x / math.sqrt(math.pi) * gauss, gauss
        self.at_rest = SMOOTHING_WIDTH * side / math.sqrt(math.pi)
        radius = NEAR_RADIUS * side
        self._lags = np.arange(int(radius / dx) + 1), np.arange(int(radius / dy) + 1)
        self._inside = np.hypot(self._lags[0][:, np.newaxis] * dx, self._lags[1] * dy) <= radius
        reach = self._inside.sum(axis=1) - 1
        self.reach = np.concatenate([reach[:0:-1], reach])

    def made(
        self, spectrum: Real, smooth: Real, odd: tuple[bool, bool], share: Real
    ) -> tuple[Single, Real]:
        """Return the near part of a spectrum, and that of the far part on the coarse grid."""
        (px, py), (rx, ry), lags = self._operator.periods, self._ratios, self._lags
        sign = -1.0 if any(odd) else 1.0  # of two odd axes, or of one and the factor i
        near = even_sums(spectrum, (px, py), lags, odd=odd)
        near -= even_sums(smooth, self.coarse, (lags[0] / rx, lags[1] / ry), odd=odd)
        near *= sign
        near[~self._inside] = 0
        x, y = (
            np.where(lag > 0, 2, 1) * (np.sin if is_odd else np.cos)(angle)
            for lag, is_odd, angle in (
                (lag, is_odd, 2 * np.pi / period * np.outer(k, lag))
                for k, lag, period, is_odd in zip(self._waves, lags, (px, py), odd, strict=True)
            )
        )
        # what the cut leaves out is smooth
        left = spectrum[self.modes] - smooth - sign * (x @ near @ y.T) / (px * py)
        smooth = smooth + left * share
        for axis, is_odd in enumerate(odd):  # a wave that is its own opposite has no odd part
            if is_odd and self.coarse[axis] % 2 == 0:
                smooth[(slice(None),) * axis + (-1,)] = 0.0
        signs = [-1.0 if is_odd else 1.0 for is_odd in odd]
        # taps go by the distance of what displaces, so that one that is odd turns
        near = math.prod(signs) * np.concatenate([signs[0] * near[:0:-1], near])
        beside = np.zeros((len(near), RUN_UNIT - 1))
        taps = np.concatenate([signs[1] * near[:, :0:-1], near, beside], axis=1)
        half = sharpened(smooth, self.coarse)[np.minimum(*self._rows_of_half)]
        half[self.coarse[0] // 2 + 1 :] *= signs[0]
        return taps.astype(np.float32), half.astype(np.float32)

    @property
    def _rows_of_half(self) -> tuple[Indices, Indices]:
        """Rows of a quarter of a spectrum for all waves along x, and those of their opposites."""
        modes = np.arange(self.coarse[0])
        return modes, self.coarse[0] - modes


def is_uniform(half_space: HalfSpace) -> bool:
    """Whether all waves feel the same moduli, so that its spectra fall as 1 / q."""
    q = np.array([1e-6, 1.0, 1e6])
    spectra = (*half_space.shear_spectrum(q), half_space.coupling_spectrum(q))
    return all(np.allclose(each * q, each[1], rtol=1e-9, atol=0) for each in spectra)


@compiled
def _add_near_and_far(
    padded: tuple[tuple[Floats, ...], tuple[int, int]],
    near: tuple[Floats, Integers],
    coarse: tuple[Floats, ...],
    weights: tuple[Floats, Floats],
    nodes: tuple[Integers, Integers, Integers, Integers],
    block: tuple[int, int],
    result: Floats,
) -> None:
    """Add what near values and what the coarse grid displace, at each node of a block of rows.

    All is as for pressures, with a padded grid for each kind of values, a coarse grid for each kind
    of displacements, and a near part for both.
    """
    (grids, margins), (taps, reach), (rows, columns, first_run, runs) = padded, near, nodes
    ratio, radius, width = weights[1].shape[0], taps.shape[2] // 2, grids[0].shape[1]
    far, sums = np.empty_like(coarse[0][0]), np.empty_like(grids[0][:2])
    last = len(coarse) - 1
    for k in range(block[0], block[1]):
        above = (rows[k] + margins[0] - radius) * width
        for run in range(first_run[k], first_run[k + 1]):
            begin, end, length = runs[run]
            start = columns[begin]
            sums[:, :length] = 0
            for by in range(len(grids)):
                flat = grids[by].reshape(-1)[above + start :]
                both = taps[0, by], taps[last, by], reach
                _sum_near(flat, (width, margins[1]), both, sums[0, :length], sums[1, :length])
            for i in range(begin, end):
                for to in range(len(coarse)):
                    result[i, to] = sums[to, columns[i] - start]
        for to in range(len(coarse)):
            interpolate_row(coarse[to], weights[0], rows[k], far)
            for i in range(runs[first_run[k], 0], runs[first_run[k + 1] - 1, 1]):
                column, part = columns[i] // ratio, columns[i] % ratio
                for a in range(4):
                    result[i, to] += weights[1][part, a] * far[column + a]


@compiled_sums
def _sum_near(
    flat: Floats,
    place: tuple[int, int],
    near: tuple[Floats, Floats, Integers],
    first: Floats,
    second: Floats,
) -> None:
    """Add two near parts over a run, from the first row that they reach on.

    The place is the width of the flat grid, and its margin.
    """
    (ones, others, reach), (width, margin) = near, place
    across = (ones.shape[1] - 8) // 2
    for di in range(ones.shape[0]):
        groups = (2 * reach[di] + 8) // 8  # of eight taps
        at = di * width + margin - reach[di]
        line = flat[at : at + 8 * groups + first.size]
        one, other = ones[di, across - reach[di] :], others[di, across - reach[di] :]
        for g in range(0, 8 * groups, 8):
            s0, s1, s2, s3 = one[g], one[g + 1], one[g + 2], one[g + 3]
            s4, s5, s6, s7 = one[g + 4], one[g + 5], one[g + 6], one[g + 7]
            t0, t1, t2, t3 = other[g], other[g + 1], other[g + 2], other[g + 3]
            t4, t5, t6, t7 = other[g + 4], other[g + 5], other[g + 6], other[g + 7]
            p = line[g:]
            for j in range(first.size):
                p0, p1, p2, p3 = p[j], p[j + 1], p[j + 2], p[j + 3]
                p4, p5, p6, p7 = p[j + 4], p[j + 5], p[j + 6], p[j + 7]
                first[j] += ((s0 * p0 + s1 * p1) + (s2 * p2 + s3 * p3)) + (
                    (s4 * p4 + s5 * p5) + (s6 * p6 + s7 * p7)
                )
                second[j] += ((t0 * p0 + t1 * p1) + (t2 * p2 + t3 * p3)) + (
                    (t4 * p4 + t5 * p5) + (t6 * p6 + t7 * p7)
                )
