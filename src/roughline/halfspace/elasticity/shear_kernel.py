"""Surface displacement of the half-space along and across a shear that is even over a rectangle.

Beside 1/r of the normal kernel there are three more: x²/r³ and x y/r³ between shear and the
displacement along the surface, and x/r² between shear and pressure.

References
----------
.. [1] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), eqs. 3.84 to 3.88 (a force along the
   surface) and 3.23 (rectangles).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Floats, Real
from roughline.computing.compiled import compiled

# The closed forms lose digits with the distance, as Love's does. So they are used up to this
# distance from the cell, in its shorter sides. Beyond, the integral along the longer side is exact
# and eight Gauss points across it are enough.
_CLOSED_FORM_UP_TO = 2.5
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)
# From these distances on, in longer sides, so few Gauss points along each side are enough.
_RULES = (5, 16.0), (3, 64.0), (2, 800.0)
_TABLE = np.zeros((len(_RULES), 2, 5))
for _rule, (_count, _) in zip(_TABLE, _RULES, strict=True):
    _rule[:, :_count] = np.array(np.polynomial.legendre.leggauss(_count)) / 2
_COUNTS = np.array([count for count, _ in _RULES])
_FROM = np.array([distance for _, distance in _RULES])

_ALONG, _SKEW, _COUPLING = 0, 1, 2


def along_shear(x: ArrayLike, y: ArrayLike, dx: float, dy: float, factor: float = 1.0) -> Real:
    """Return ``(1 / pi) * integral of x² / r³ over the cell``, times a factor.

    Offsets from the centre of the cell are in cells and not negative; its sides are lengths. The
    shape is (x.size, y.size). [length]
    """
    return _table(_ALONG, x, y, (dx, dy), factor)


def across_shear(x: ArrayLike, y: ArrayLike, dx: float, dy: float, factor: float = 1.0) -> Real:
    """Return the same of ``x y / r³``, which is odd in x and in y."""
    return _table(_SKEW, x, y, (dx, dy), factor)


def by_pressure(x: ArrayLike, y: ArrayLike, dx: float, dy: float, factor: float = 1.0) -> Real:
    """Return the same of ``x / r²``, which is odd in x and even in y."""
    return _table(_COUPLING, x, y, (dx, dy), factor)


def _table(
    kind: int, x: ArrayLike, y: ArrayLike, sides: tuple[float, float], factor: float
) -> Real:
    x, y, unit = np.asarray(x, np.float64), np.asarray(y, np.float64), max(sides)
    dx, dy = sides[0] / unit, sides[1] / unit
    out = np.empty((x.size, y.size))
    _fill(kind, x * dx, y * dy, dx, dy, factor * unit / np.pi, out)
    return out


@compiled
def _fill(
    kind: int, x: Floats, y: Floats, dx: float, dy: float, factor: float, rows: Floats
) -> None:
    for i in range(x.size):
        for j in range(y.size):
            if (kind == 1 and y[j] == 0) or (kind > 0 and x[i] == 0):
                rows[i, j] = 0.0
            else:
                rows[i, j] = factor * _cell(kind, x[i], y[j], dx, dy)


@compiled
def _cell(kind: int, x: float, y: float, dx: float, dy: float) -> float:
    """Return the integral over a cell, whose longer side is one."""
    distance = math.sqrt(x * x + y * y)
    if distance >= _FROM[0]:
        rule = _FROM.size - 1
        while distance < _FROM[rule]:
            rule -= 1
        points, weights = _TABLE[rule]
        total = 0.0
        for m in range(_COUNTS[rule]):
            for n in range(_COUNTS[rule]):
                at = _kernel(kind, x + points[m] * dx, y + points[n] * dy)
                total += weights[m] * weights[n] * at
        return total * dx * dy
    left, right, low, high = x - dx / 2, x + dx / 2, y - dy / 2, y + dy / 2
    if max(left, 0.0) ** 2 + max(low, 0.0) ** 2 < (_CLOSED_FORM_UP_TO * min(dx, dy)) ** 2:
        return (
            _corner(kind, right, high)
            - _corner(kind, left, high)
            - _corner(kind, right, low)
            + _corner(kind, left, low)
        )
    total = 0.0
    if dx < dy:
        for i in range(_NODES.size):
            total += _WEIGHTS[i] * _line_along_y(kind, x + _NODES[i] * dx / 2, low, high)
        return total * dx / 2
    for i in range(_NODES.size):
        total += _WEIGHTS[i] * _line_along_x(kind, left, right, y + _NODES[i] * dy / 2)
    return total * dy / 2


@compiled
def _kernel(kind: int, x: float, y: float) -> float:
    square = x * x + y * y
    if kind == 2:
        return x / square
    return x * (x if kind == 0 else y) / (square * math.sqrt(square))


@compiled
def _corner(kind: int, x: float, y: float) -> float:
    """Return an integral whose mixed derivative by x and y is the kernel."""
    if kind == 0:
        return 0.0 if x == 0 or y == 0 else y * math.asinh(x / abs(y))
    if kind == 1:
        return -math.sqrt(x * x + y * y)
    square = x * x + y * y
    return 0.0 if square == 0 else 0.5 * y * math.log(square) + _arc(x, y)


@compiled
def _arc(x: float, y: float) -> float:
    """Return x atan(y / x), which is zero where x is."""
    return 0.0 if x == 0 else x * math.atan(y / x)


@compiled
def _line_along_x(kind: int, left: float, right: float, y: float) -> float:
    """Return the integral of the kernel from left to right, at y."""
    far, near = math.sqrt(right * right + y * y), math.sqrt(left * left + y * y)
    rise = (right - left) * (right + left)
    if kind == 0:  # asinh(x / |y|) - x / r
        both = right * near + abs(left) * far
        size = math.asinh(both / y**2 if left < 0 else rise / both)
        return size - right / far + left / near
    if kind == 1:  # -y / r
        return y * rise / (far * near * (far + near))
    return 0.5 * math.log1p(rise / near**2)


@compiled
def _line_along_y(kind: int, x: float, low: float, high: float) -> float:
    """Return the integral of the kernel from low to high, at x."""
    far, near = math.sqrt(x * x + high * high), math.sqrt(x * x + low * low)
    if kind == 0:
        return high / far - low / near
    if kind == 1:
        return x * (high - low) * (high + low) / (far * near * (far + near))
    return math.atan2(x * (high - low), x * x + low * high)
