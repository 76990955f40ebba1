"""The kernels of layers: those of the top material, and smooth rests that are tabulated once.

A wave at the angle phi is displaced along the surface by the shear s by

    (along + across) / 2 s + (along - across) / 2 (cos 2 phi, sin 2 phi; sin 2 phi, -cos 2 phi) s,

and by pressure as (cos phi, sin phi). On the surface, at the distance r and the angle theta, these
are Hankel transforms of order 0, 2 and 1, times the same of theta, and the second with the other
sign.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy import fft

from roughline.computing.arrays import Floats, Integers, Real
from roughline.computing.compiled import compiled
from roughline.computing.hankel import hankel
from roughline.halfspace.elasticity.half_space import HalfSpace
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.elasticity.kernel import love

_PIECE, _PIECES, _DEGREE = 0.5, 40, 15  # of the table, in asinh(r / 2); up to 5e8
# Gauss points along the side of a cell, from so many quarters of the side on between the cell and
# the nearest singularity, which is at the imaginary distance 2 from the axis
_POINTS = (2, 500.0), (3, 60.0), (4, 24.0), (5, 13.0), (6, 9.0), (7, 7.5), (8, 6.0)


def layered_kernel(
    body: HalfSpace,
    lengths: tuple[float, float],
    first: int,
    spacing: tuple[float, float],
    rows: Real,
) -> None:
    """Fill rows of the table of displacements under unit pressure on one cell.

    Lengths are the thickness of the top layer, over which it changes, and the longest, up to which
    it changes farther away.
    """
    h, longest = lengths
    cells = _in_thicknesses(h, first, spacing, rows)
    love(*cells[:2], *spacing, 1 / body.E_star, rows)
    rest = _beside_top_layer(body.in_units(body.E_star, h), longest / h)
    rows += rest.displacement(cells, h / body.E_star)


def layered_shear_kernel(
    body: HalfSpace,
    top: Homogeneous,
    lengths: tuple[float, float],
    first: int,
    spacing: tuple[float, float],
    rows: tuple[Real, Real, Real],
) -> None:
    """Fill rows of the tables of displacements along the surface under unit shear on one cell."""
    (xx, yy, xy), (h, longest) = rows, lengths
    top.shear_kernel(first, spacing, rows)
    cells, factor = _in_thicknesses(h, first, spacing, xx), h / top.E_star
    mean, difference = _beside_shear(body.in_units(top.E_star, h), top, longest / h)
    part = mean.displacement(cells, factor)
    xx += part
    yy += part
    part = difference.displacement(cells, factor)
    xx -= part
    yy += part
    xy -= difference.displacement(cells, factor, odd=True)


def layered_coupling_kernel(
    body: HalfSpace,
    top: Homogeneous,
    lengths: tuple[float, float],
    first: int,
    spacing: tuple[float, float],
    rows: tuple[Real, Real],
) -> None:
    """Fill rows of the tables of displacements along the surface under pressure on one cell."""
    h, longest = lengths
    top.coupling_kernel(first, spacing, rows)
    cells, factor = _in_thicknesses(h, first, spacing, rows[0]), h / top.E_star
    rest = _beside_coupling(body.in_units(top.E_star, h), top, longest / h)
    rows[0][:] += rest.displacement(cells, factor)
    rows[1][:] += rest.displacement(cells, factor, odd=True)


_CellOffsets = tuple[Integers, Integers, tuple[float, float]]
"""Distances along x and y in cells, and the sides of a cell."""


def _in_thicknesses(h: float, first: int, spacing: tuple[float, float], rows: Real) -> _CellOffsets:
    """Return the cells of a table, in units of the thickness h."""
    x, y = first + np.arange(rows.shape[0]), np.arange(rows.shape[1])
    return x, y, (spacing[0] / h, spacing[1] / h)


@lru_cache
def _beside_top_layer(body: HalfSpace, longest: float) -> SmoothKernel:
    """Tabulate what a body displaces beside its top layer's material, in units of that layer."""
    return SmoothKernel.of(lambda q: q / 2 * body.spectrum(q) - 1, longest)


@lru_cache
def _beside_shear(
    body: HalfSpace, top: Homogeneous, longest: float
) -> tuple[SmoothKernel, SmoothKernel]:
    """Tabulate the same of shear: of the mean along and across waves, and of half the difference.

    The top layer's material may be in another unit of pressure.
    """
    along, across = (top.E_star / 2 * float(each[0]) for each in top.shear_spectrum(np.ones(1)))

    def mean(q: Real, sign: int = 1) -> Real:
        waves = body.shear_spectrum(q)
        return (q / 2 * waves[0] - along + sign * (q / 2 * waves[1] - across)) / 2

    return SmoothKernel.of(mean, longest), SmoothKernel.of(lambda q: mean(q, -1), longest, 2)


@lru_cache
def _beside_coupling(body: HalfSpace, top: Homogeneous, longest: float) -> SmoothKernel:
    """Tabulate the same of displacements along the surface under pressure."""
    return SmoothKernel.of(lambda q: q / 2 * body.coupling_spectrum(q) - top.beta, longest, 1)


@dataclass(frozen=True, eq=False)
class SmoothKernel:
    """Displacement by a unit force beside that of a half-space of the top layer.

    Lengths are over the thickness of the top layer, and E* is one. Over r^m, with the order m, and
    times (r² + 4)^((m + 1) / 2) it is smooth in asinh(r / 2), near and far. Pieces of it are
    polynomials.
    """

    order: int
    table: Real  # Chebyshev coefficients of each piece
    rules: Real  # of Gauss: least distance, number, points and weights on a side of one

    @classmethod
    def of(cls, beside: Callable[[Real], Real], longest: float, order: int = 0) -> SmoothKernel:
        """Tabulate ``(1 / pi) * integral of beside(q) J(q r) dq``, as `hankel` computes it."""
        cosines = np.cos(np.pi * (np.arange(_DEGREE + 1) + 0.5) / (_DEGREE + 1))
        table = np.empty((_PIECES, _DEGREE + 1))
        for piece, row in enumerate(table):
            r = 2 * np.sinh(_PIECE * (piece + (1 + cosines) / 2))
            found = hankel(beside, r, 1.0, longest, order) * np.hypot(r, 2) / np.pi
            found *= (np.hypot(r, 2) / r) ** order
            row[:] = fft.dct(found) / (_DEGREE + 1)
            row[0] /= 2
        most = _POINTS[-1][0]
        rules = np.zeros((len(_POINTS), 2, 1 + most))
        for rule, (count, least) in zip(rules, _POINTS, strict=True):
            rule[:, 0] = least, count
            rule[:, 1 : 1 + count] = np.array(np.polynomial.legendre.leggauss(count)) / 2
        return cls(order, table, rules)

    def displacement(self, cells: _CellOffsets, factor: float, *, odd: bool = False) -> Real:
        """Return what pressure on one cell displaces at its distances, times a factor.

        It is also times the cosine of the order times the angle from x, or the sine, which is odd.
        """
        x, y, (dx, dy) = cells
        rows, kind = np.empty((x.size, y.size)), (self.order, odd)
        _fill(x * dx, y * dy, (dx, dy), factor * dx * dy, kind, (self.table, self.rules), rows)
        return rows


@compiled
def _turned(x: float, y: float, kind: tuple[int, bool]) -> float:
    """Return r to the power of the order, times the cosine or the sine of so many angles."""
    order, odd = kind
    if order == 0:
        return 1.0
    if order == 1:
        return y if odd else x
    return 2 * x * y if odd else x * x - y * y


@compiled
def _value(r: float, table: Real) -> float:
    place = math.asinh(r / 2) / _PIECE
    piece = min(int(place), _PIECES - 1)
    x = 2 * min(place - piece, 1.0) - 1
    row, after, before = table[piece], 0.0, 0.0
    for k in range(_DEGREE, 0, -1):  # Clenshaw's recurrence
        before, after = 2 * x * before - after + row[k], before
    return (x * before - after + row[0]) / math.sqrt(r * r + 4)


@compiled
def _fill(
    x: Floats,
    y: Floats,
    spacing: tuple[float, float],
    factor: float,
    kind: tuple[int, bool],
    kernel: tuple[Real, Real],
    rows: Real,
) -> None:
    """Write the mean over a cell at each distance, times a factor.

    Where the best rule is not enough, it is used on parts of the cell.
    """
    (dx, dy), side, (table, rules) = spacing, max(spacing[0], spacing[1]), kernel
    for i in range(x.size):
        for j in range(y.size):
            ratio = 4 * math.sqrt(x[i] ** 2 + y[j] ** 2 + 4) / side
            k = 0
            while k < len(rules) - 1 and ratio < rules[k, 0, 0]:
                k += 1
            points, weights = rules[k]
            parts, total = max(1, math.ceil(rules[k, 0, 0] / ratio)), 0.0
            for part in range(parts**2):
                left, low = (part // parts + 0.5) / parts - 0.5, (part % parts + 0.5) / parts - 0.5
                for m in range(1, 1 + int(weights[0])):
                    at_x = x[i] + (left + points[m] / parts) * dx
                    for n in range(1, 1 + int(weights[0])):
                        at_y = y[j] + (low + points[n] / parts) * dy
                        r = math.sqrt(at_x**2 + at_y**2)
                        turned = _turned(at_x, at_y, kind) / (r * r + 4) ** (kind[0] / 2)
                        total += weights[m] * weights[n] * turned * _value(r, table)
            rows[i, j] = factor * total / parts**2
