"""Surface displacement of the elastic half-space under a uniformly loaded rectangle.

References
----------
.. [1] A. E. H. Love, "The stress produced in a semi-infinite solid by pressure on part of the
   boundary", Phil. Trans. R. Soc. A 228, 377-420 (1929).
.. [2] K. L. Johnson, *Contact Mechanics*, Cambridge (1985), eq. 3.25.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from roughline.computing.arrays import Real

# Love's closed form loses digits with the distance (its four terms grow like r, their sum decays
# like 1/r), quadrature of 1/r over the cell gains them: from each distance on, in cell sides, so
# many Gauss points per direction leave a relative error of a few 1e-15.
_GAUSS_FROM_DISTANCE = ((3.0, 8), (16.0, 5), (64.0, 3))


def love(x: ArrayLike, y: ArrayLike, dx: float, dy: float) -> Real:
    """Displacement per unit pressure on one cell, for E* = 1.

    Parameters
    ----------
    x, y : array_like
        Offsets from the centre of the loaded cell; broadcast together. [length]
    dx, dy : float
        Sides of the loaded cell. [length]

    Returns
    -------
    ndarray
        ``(1 / pi) * integral of 1/r over the cell``, accurate to about 1e-14. [length]
    """
    x, y = np.broadcast_arrays(np.abs(x).astype(np.float64), np.abs(y).astype(np.float64))
    distance = np.hypot(x, y) / max(dx, dy)
    result = np.empty(x.shape)
    near = distance < _GAUSS_FROM_DISTANCE[0][0]
    result[near] = _closed_form(x[near], y[near], dx, dy)
    limits = [start for start, _ in _GAUSS_FROM_DISTANCE[1:]] + [np.inf]
    for (start, points), end in zip(_GAUSS_FROM_DISTANCE, limits, strict=True):
        ring = (distance >= start) & (distance < end)
        result[ring] = _quadrature(x[ring], y[ring], dx, dy, points)
    return result / np.pi


def _closed_form(x: Real, y: Real, dx: float, dy: float) -> Real:
    """Integrate 1/r over the cell as four corner terms, each odd in both offsets."""
    left, right = x - dx / 2, x + dx / 2
    low, high = y - dy / 2, y + dy / 2
    return _corner(right, high) - _corner(left, high) - _corner(right, low) + _corner(left, low)


def _corner(x: Real, y: Real) -> Real:
    """Integral of 1/r over the rectangle between the origin and (x, y), with the sign of x y."""
    a, b = np.abs(x), np.abs(y)
    positive = (a > 0) & (b > 0)
    a, b = np.where(positive, a, 1.0), np.where(positive, b, 1.0)
    area = np.sign(x) * np.sign(y)  # 0 on an edge, where the rectangle is empty
    return area * (a * np.arcsinh(b / a) + b * np.arcsinh(a / b))


def _quadrature(x: Real, y: Real, dx: float, dy: float, points: int) -> Real:
    nodes, weights = np.polynomial.legendre.leggauss(points)
    total = np.zeros_like(x)
    for node_x, weight_x in zip(nodes, weights, strict=True):
        for node_y, weight_y in zip(nodes, weights, strict=True):
            total += weight_x * weight_y / np.hypot(x + node_x * dx / 2, y + node_y * dy / 2)
    return total * (dx * dy / 4)
