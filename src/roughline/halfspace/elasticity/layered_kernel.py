"""The kernel of layers: that of the top material, and a smooth rest that is tabulated once."""

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
from roughline.halfspace.elasticity.kernel import love

_PIECE, _PIECES, _DEGREE = 0.5, 40, 15  # of the table, in asinh(r / 2); up to 5e8
# Gauss points along the side of a cell, from so many quarters of the side on between the cell and
# the nearest singularity, which is at the imaginary distance 2 from the axis
_POINTS = (2, 500.0), (3, 60.0), (4, 24.0), (5, 13.0), (6, 9.0), (7, 7.5), (8, 6.0)


def layered_kernel(
    body: HalfSpace,
    thickness: float,
    longest: float,
    first: int,
    spacing: tuple[float, float],
    rows: Real,
) -> None:
    """Fill rows of the table of displacements under unit pressure on one cell.

    It changes over the thickness of the top layer, and farther away over up to the longest length.
    """
    x, y, h = first + np.arange(rows.shape[0]), np.arange(rows.shape[1]), thickness
    love(x, y, *spacing, 1 / body.E_star, rows)
    rest = _beside_top_layer(body.in_units(body.E_star, h), longest / h)
    rest.add(x, y, (spacing[0] / h, spacing[1] / h), h / body.E_star, rows)


@lru_cache
def _beside_top_layer(body: HalfSpace, longest: float) -> SmoothKernel:
    """Tabulate what a body displaces beside its top layer's material, in units of that layer."""
    return SmoothKernel.of(lambda q: q / 2 * body.spectrum(q) - 1, longest)


@dataclass(frozen=True, eq=False)
class SmoothKernel:
    """Displacement by a unit force beside that of a half-space of the top layer.

    Lengths are over the thickness of the top layer, and E* is one. Times (r² + 4)^(1/2) it is
    smooth in asinh(r / 2), near and far. Pieces of it are polynomials.
    """

    table: Real  # Chebyshev coefficients of each piece
    rules: Real  # of Gauss: least distance, number, points and weights on a side of one

    @classmethod
    def of(cls, beside: Callable[[Real], Real], longest: float) -> SmoothKernel:
        """Tabulate ``(1 / pi) * integral of beside(q) J_0(q r) dq``, as `hankel` computes it."""
        cosines = np.cos(np.pi * (np.arange(_DEGREE + 1) + 0.5) / (_DEGREE + 1))
        table = np.empty((_PIECES, _DEGREE + 1))
        for piece, row in enumerate(table):
            r = 2 * np.sinh(_PIECE * (piece + (1 + cosines) / 2))
            found = hankel(beside, r, 1.0, longest) * np.hypot(r, 2) / np.pi
            row[:] = fft.dct(found) / (_DEGREE + 1)
            row[0] /= 2
        most = _POINTS[-1][0]
        rules = np.zeros((len(_POINTS), 2, 1 + most))
        for rule, (count, least) in zip(rules, _POINTS, strict=True):
            rule[:, 0] = least, count
            rule[:, 1 : 1 + count] = np.array(np.polynomial.legendre.leggauss(count)) / 2
        return cls(table, rules)

    def add(
        self, x: Integers, y: Integers, spacing: tuple[float, float], factor: float, rows: Real
    ) -> None:
        """Add what pressure on one cell displaces at distances in cells, times a factor."""
        dx, dy = spacing
        _add_cells(x * dx, y * dy, spacing, factor * dx * dy, self.table, self.rules, rows)


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
def _add_cells(
    x: Floats,
    y: Floats,
    spacing: tuple[float, float],
    factor: float,
    table: Real,
    rules: Real,
    rows: Real,
) -> None:
    """Add the mean over a cell at each distance, times a factor.

    Where the best rule is not enough, it is used on parts of the cell.
    """
    (dx, dy), side = spacing, max(spacing[0], spacing[1])
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
                        total += weights[m] * weights[n] * _value(r, table)
            rows[i, j] += factor * total / parts**2
