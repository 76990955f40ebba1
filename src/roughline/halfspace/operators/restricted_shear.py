"""Displacement along the surface by shear, at a cost that grows with the contact alone.

It is split as pressure's is (see `restricted.py`), into a far part on a coarse grid and a near part
that is summed. What depends on the direction of a wave needs another share of the far part [1]_:
the near part's spectrum is smooth at q = 0, and so its kernel falls fast, if with x = q w / 2 that
share is erfc(x) for what waves of all directions have in common, erfc(x) + 2 x exp(-x²) / sqrt(pi)
for what goes with twice their angle, and exp(-x²) for what goes with the angle, as pressure does.

Of layers, the spectra of a homogeneous body are split so, and the rest is smooth as a whole.

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
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.operators.coarse_grid import PaddedGrid, Splines, sharpened
from roughline.halfspace.operators.convolution import Convolution
from roughline.halfspace.operators.even_sums import even_sums
from roughline.halfspace.operators.grid_nodes import GridNodes
from roughline.halfspace.operators.restricted import (
    NEAR_RADIUS,
    SMOOTHING_WIDTH,
    interpolate_row,
    longest_wave,
    resolves,
    split_spectrum,
)
from roughline.halfspace.operators.shear import ShearConvolution, shear_on_grid

_EVEN_PARTS, _SKEW_PART, _ALONG_X, _ALONG_Y = (
    (False, False),
    (True, True),
    (True, False),
    (False, True),
)
_KINDS = [0, 1, 1, 2, 2]  # of spectra: what is common, goes with twice the angle, and with it
_SHORT_WAVE = 1e3 * math.pi  # over the side of a coarse cell: it feels the surface alone
_LAGS_AT_A_TIME = 4


@dataclass(frozen=True, eq=False)
class RestrictedShear:
    """The displacement of some nodes under the shear on some nodes, to a thousandth or so.

    Where pressure displaces along the surface, and shear into the body, it has these too.
    """

    # of displacement along x by shear along x, along y by that along y, and across; along x and
    # along y by pressure, and into the body by pressure
    far: tuple[Single, ...]  # spectra on the coarse grid, for q >= 0 along y
    # by the distance in cells, on one side of a node, and three zeros beside each row; on the other
    # side they are the same, or the opposite between shear and pressure
    near: tuple[Single, ...]
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
        (common, twice, once), (mean, part, skew, *towards) = split.shares, split.smooth(exact)
        parts = [
            split.made(exact.mean + exact.part, mean + part, _EVEN_PARTS, common),
            split.made(exact.mean - exact.part, mean - part, _EVEN_PARTS, common),
            split.made(exact.skew, skew, _SKEW_PART, twice),
        ]
        if exact.towards is not None:
            axes = zip(exact.towards, towards, (_ALONG_X, _ALONG_Y), strict=True)
            parts += [split.made(*each, once) for each in axes]
            parts.append(split.made(operator.spectrum, split.smooth_into, _EVEN_PARTS, common))
        near, far = zip(*parts, strict=True)
        splines = Splines.of(operator, ratios)
        return cls(far, near, split.reach, splines, split.coarse, operator.shape, margins)

    def displacement(self, shear: Real, sources: GridNodes, targets: GridNodes) -> Real:
        """Return the displacements of nodes under shear; both of shape (nodes, 2)."""
        return self._moved(shear, sources, targets, self.near[:3], self._by_shear)

    def displaced(
        self, pressure: Real, shear: Real, sources: GridNodes, targets: GridNodes
    ) -> tuple[Real, Real]:
        """Return the displacements into the body and along the surface by pressure and shear."""
        both = np.column_stack([shear, pressure])
        moved = self._moved(both, sources, targets, self.near, self._by_both)
        return moved[:, 2].copy(), moved[:, :2].copy()

    @cached_property
    def _by_shear(self) -> Single:
        xx, yy, xy = self.far[:3]
        return np.array([[xx, xy], [xy, yy]])

    @cached_property
    def _by_both(self) -> Any:
        xx, yy, xy, x, y, into = self.far
        rows = [[xx, xy, 1j * x], [xy, yy, 1j * y], [-1j * x, -1j * y, into]]
        return np.array(rows, dtype=np.complex64)

    def _moved(
        self,
        values: Real,
        sources: GridNodes,
        targets: GridNodes,
        near: tuple[Single, ...],
        far: Any,
    ) -> Real:
        """Return what values displace, near and far; as many of a node as there are of values."""
        splines, workspace = self.splines, self.splines.workspace
        unit, count = np.abs(values).max(initial=0.0), values.shape[1]
        result = np.zeros((targets.indices.size, count), dtype=np.float32)
        if unit == 0:
            return result.astype(np.float64)
        grids = [
            PaddedGrid.of(self.shape, self.margins, workspace, f"padded grid{part}")
            for part in ("", " of y", " of pressure")[:count]
        ]
        spread = np.empty((count, *splines.shape), dtype=np.float32)
        for axis, grid in enumerate(grids):
            given = (values[:, axis] / unit).astype(np.float32)
            spread[axis] = splines.spread(given, sources, grid, "spread pressures")
        moved = []
        for axis, each in enumerate(fft.convolved_together(spread, far, self.periods)):
            moved.append(splines.array(f"coarse displacements {axis}"))
            splines.inside(moved[axis])[:] = each
            splines.wrap(moved[axis])
        nodes = targets.rows, targets.columns, *targets.runs
        padded = tuple(each.values for each in grids), grids[0].margins

        def add(first: int, last: int) -> None:
            coarse = tuple(moved), splines.weights
            _add_near_and_far(padded, (near, self.reach), *coarse, nodes, (first, last), result)

        rows_at_a_time = targets.rows_holding(2**21 // (count * near[0].size))
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
        self._modes = slice(kx.size), slice(ky.size)
        self._q = 2 * np.pi * np.hypot(kx[:, np.newaxis] / (px * dx), ky / (py * dy))
        x = self._q * SMOOTHING_WIDTH * side / 2
        common, gauss = erfc(x), np.exp(-(x**2))
        self.shares = common, common + 2 * x / math.sqrt(math.pi) * gauss, gauss
        self._side, self._at_rest = side, SMOOTHING_WIDTH * side / math.sqrt(math.pi) / (px * py)
        radius = NEAR_RADIUS * side
        self._lags = np.arange(int(radius / dx) + 1), np.arange(int(radius / dy) + 1)
        self._inside = np.hypot(self._lags[0][:, np.newaxis] * dx, self._lags[1] * dy) <= radius
        self.reach = self._inside.sum(axis=1) - 1

    def smooth(self, exact: ShearConvolution) -> list[Real]:
        """Return the far parts of the spectra of shear, and of pressure that moves along."""
        common, twice, once = self.shares
        steep, limit, rest = self._steep(exact)
        shares = common, twice, twice, once, once
        far = [e * share + f for e, share, f in zip(steep, shares, rest, strict=False)]
        far[0][0, 0] -= self._at_rest * limit  # whatever the operator does with the mean
        return far

    @property
    def smooth_into(self) -> Real:
        """That of pressure that displaces into the body."""
        steep, limit, rest = split_spectrum(self._operator, self._side, self._q)
        far = steep * self.shares[0] + rest
        far[0, 0] -= self._at_rest * limit
        return far

    def _steep(self, exact: ShearConvolution) -> tuple[list[Real], float, list[Real]]:
        """Split spectra as :func:`split_spectrum` does that of pressure, and return the same.

        Those that fall as 1 / q are of a homogeneous body, each times a factor of its own.
        """
        operator, side = self._operator, self._side
        half_space, zero = operator.half_space, np.zeros(self._q.shape)
        assert half_space is not None
        spectra = [each[self._modes] for each in _spectra(exact)]
        limits = _falling(half_space, longest_wave(operator))
        at_surface = _falling(half_space, _SHORT_WAVE / side)
        if np.abs(limits - at_surface).max() <= 1e-9 * at_surface[0]:
            return spectra, float(limits[0]), [zero for _ in spectra]
        smooth = np.exp(-((self._q * side) ** 2) / 4)
        if resolves(half_space, side):
            limits, smooth = at_surface, zero + 1
        beta = 0.5 if half_space.is_coupled else 0.0
        plain = Homogeneous(2.0, half_space.periodic, poisson=0.5, beta=beta)
        alone = _spectra(shear_on_grid(plain, operator.shape, operator.spacing))
        factors = limits / _falling(plain, 1.0)
        steep = [f * each[self._modes] for f, each in zip(factors[_KINDS], alone, strict=False)]
        rest = [(one - other) * smooth for one, other in zip(spectra, steep, strict=True)]
        return steep, float(limits[0]), rest

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
        left = spectrum[self._modes] - smooth - sign * (x @ near @ y.T) / (px * py)
        smooth = smooth + left * share
        for axis, is_odd in enumerate(odd):  # a wave that is its own opposite has no odd part
            if is_odd and self.coarse[axis] % 2 == 0:
                smooth[(slice(None),) * axis + (-1,)] = 0.0
        signs = [-1.0 if is_odd else 1.0 for is_odd in odd]
        # taps go by the distance of what displaces, so that one that is odd turns
        near *= math.prod(signs)
        beside = np.zeros((len(near), _LAGS_AT_A_TIME - 1))
        taps = np.concatenate([signs[1] * near[:, :0:-1], near, beside], axis=1)
        taps[0] /= 2  # both sides have all of this row
        half = sharpened(smooth, self.coarse)[np.minimum(*self._rows_of_half)]
        half[self.coarse[0] // 2 + 1 :] *= signs[0]
        return taps.astype(np.float32), half.astype(np.float32)

    @property
    def _rows_of_half(self) -> tuple[Indices, Indices]:
        """Rows of a quarter of a spectrum for all waves along x, and those of their opposites."""
        modes = np.arange(self.coarse[0])
        return modes, self.coarse[0] - modes


def _spectra(exact: ShearConvolution) -> tuple[Real, ...]:
    """Return the spectra of an operator: those of shear, and of pressure along the surface."""
    return exact.mean, exact.part, exact.skew, *(exact.towards or ())


def _falling(half_space: HalfSpace, wave: float) -> Real:
    """Return q times the mean, half the difference, and the coupling of a wavenumber q."""
    q = np.array([wave])
    along, across = half_space.shear_spectrum(q)
    both = (along + across) / 2, (along - across) / 2, half_space.coupling_spectrum(q)
    return wave * np.concatenate(both)


@compiled
def _add_near_and_far(
    padded: tuple[tuple[Floats, ...], tuple[int, int]],
    near: tuple[tuple[Floats, ...], Integers],
    coarse: tuple[Floats, ...],
    weights: tuple[Floats, Floats],
    nodes: tuple[Integers, Integers, Integers, Integers],
    block: tuple[int, int],
    result: Floats,
) -> None:
    """Add what near values and what the coarse grid displace, at each node of a block of rows.

    All is as for pressures, with a padded grid for each kind of values, and a coarse grid for each
    kind of displacements.
    """
    (grids, margins), (rows, columns, first_run, runs) = padded, nodes
    ratio, width, count = weights[1].shape[0], grids[0].shape[1], len(coarse)
    far, sums = np.empty_like(coarse[0][0]), np.empty((count, width), dtype=np.float32)
    for k in range(block[0], block[1]):
        for run in range(first_run[k], first_run[k + 1]):
            begin, end, length = runs[run]
            place = rows[k] + margins[0], columns[begin] + margins[1]
            sums[:, :length] = 0
            _sum_shear(grids, place, near, sums[0, :length], sums[1, :length])
            if count == 3:
                _sum_by_pressure(grids, place, near, sums[0, :length], sums[1, :length])
                _sum_into_body(grids, place, near, sums[2, :length])
            for i in range(begin, end):
                for to in range(count):
                    result[i, to] = sums[to, columns[i] - columns[begin]]
        for to in range(count):
            interpolate_row(coarse[to], weights[0], rows[k], far)
            for i in range(runs[first_run[k], 0], runs[first_run[k + 1] - 1, 1]):
                column, part = columns[i] // ratio, columns[i] % ratio
                for a in range(4):
                    result[i, to] += weights[1][part, a] * far[column + a]


@compiled_sums
def _sum_shear(
    grids: tuple[Floats, ...],
    place: tuple[int, int],
    near: tuple[tuple[Floats, ...], Integers],
    first: Floats,
    second: Floats,
) -> None:
    """Add the displacements along the surface by near shear over a run that begins at a place.

    Shear at opposite distances displaces alike, so that its sums are weighed.
    """
    parts, reach = near
    xx, yy, xy = parts[0], parts[1], parts[2]
    x, y, width = grids[0].reshape(-1), grids[1].reshape(-1), grids[0].shape[1]
    across, start = (xx.shape[1] - 4) // 2, place[0] * width + place[1]
    for di in range(xx.shape[0]):
        begin, off = across - reach[di], start - di * width + reach[di] - 3
        on = start + di * width - reach[di]
        one, two, both = xx[di, begin:], yy[di, begin:], xy[di, begin:]
        for g in range(0, 2 * reach[di] + 1, 4):
            a0, a1, a2, a3 = one[g], one[g + 1], one[g + 2], one[g + 3]
            b0, b1, b2, b3 = two[g], two[g + 1], two[g + 2], two[g + 3]
            c0, c1, c2, c3 = both[g], both[g + 1], both[g + 2], both[g + 3]
            p, q, r, s = x[on + g :], y[on + g :], x[off - g :], y[off - g :]
            for j in range(first.size):
                p0, p1, p2, p3 = (
                    p[j] + r[j + 3],
                    p[j + 1] + r[j + 2],
                    p[j + 2] + r[j + 1],
                    p[j + 3] + r[j],
                )
                q0, q1, q2, q3 = (
                    q[j] + s[j + 3],
                    q[j + 1] + s[j + 2],
                    q[j + 2] + s[j + 1],
                    q[j + 3] + s[j],
                )
                first[j] += ((a0 * p0 + a1 * p1) + (a2 * p2 + a3 * p3)) + (
                    (c0 * q0 + c1 * q1) + (c2 * q2 + c3 * q3)
                )
                second[j] += ((c0 * p0 + c1 * p1) + (c2 * p2 + c3 * p3)) + (
                    (b0 * q0 + b1 * q1) + (b2 * q2 + b3 * q3)
                )


@compiled_sums
def _sum_by_pressure(
    grids: tuple[Floats, ...],
    place: tuple[int, int],
    near: tuple[tuple[Floats, ...], Integers],
    first: Floats,
    second: Floats,
) -> None:
    """Add the displacements along the surface by near pressure, opposite at opposite distances.

    A loop of its own: one with all kinds of results would not be vectorised.
    """
    (parts, reach), last = near, len(grids) - 1
    along_x, along_y, z = parts[last + 1], parts[last + 2], grids[last].reshape(-1)
    width, across = grids[last].shape[1], (along_x.shape[1] - 4) // 2
    start = place[0] * width + place[1]
    for di in range(along_x.shape[0]):
        begin, off = across - reach[di], start - di * width + reach[di] - 3
        on = start + di * width - reach[di]
        one, two = along_x[di, begin:], along_y[di, begin:]
        for g in range(0, 2 * reach[di] + 1, 4):
            a0, a1, a2, a3 = one[g], one[g + 1], one[g + 2], one[g + 3]
            b0, b1, b2, b3 = two[g], two[g + 1], two[g + 2], two[g + 3]
            p, r = z[on + g :], z[off - g :]
            for j in range(first.size):
                p0, p1 = p[j] - r[j + 3], p[j + 1] - r[j + 2]
                p2, p3 = p[j + 2] - r[j + 1], p[j + 3] - r[j]
                first[j] += (a0 * p0 + a1 * p1) + (a2 * p2 + a3 * p3)
                second[j] += (b0 * p0 + b1 * p1) + (b2 * p2 + b3 * p3)


@compiled_sums
def _sum_into_body(
    grids: tuple[Floats, ...],
    place: tuple[int, int],
    near: tuple[tuple[Floats, ...], Integers],
    sums: Floats,
) -> None:
    """Add the displacements into the body by near pressure and, turned about, by near shear."""
    (parts, reach), last = near, len(grids) - 1
    along_x, along_y, into = parts[last + 1], parts[last + 2], parts[last + 3]
    x, y, z = grids[0].reshape(-1), grids[1].reshape(-1), grids[last].reshape(-1)
    width, across = grids[0].shape[1], (into.shape[1] - 4) // 2
    start = place[0] * width + place[1]
    for di in range(into.shape[0]):
        begin, off = across - reach[di], start - di * width + reach[di] - 1
        on = start + di * width - reach[di]
        one, two, own = along_x[di, begin:], along_y[di, begin:], into[di, begin:]
        for g in range(0, 2 * reach[di] + 1, 2):
            a0, a1, b0, b1, c0, c1 = one[g], one[g + 1], two[g], two[g + 1], own[g], own[g + 1]
            p, q, r = x[on + g :], y[on + g :], z[on + g :]
            s, t, w = x[off - g :], y[off - g :], z[off - g :]
            for j in range(sums.size):
                sums[j] += (
                    (c0 * (r[j] + w[j + 1]) + c1 * (r[j + 1] + w[j]))
                    + (a0 * (s[j + 1] - p[j]) + a1 * (s[j] - p[j + 1]))
                    + (b0 * (t[j + 1] - q[j]) + b1 * (t[j] - q[j + 1]))
                )
