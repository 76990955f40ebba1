"""Tilt and curvature: least-squares polynomials of the coordinates."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]
Trend = Literal["none", "mean", "tilt", "curvature"]

DEGREES: dict[str, int] = {"none": -1, "mean": 0, "tilt": 1, "curvature": 2}
"""Degree of the polynomial that goes by each name."""


def without_trend(heights: Real, trend: Trend) -> Real:
    """Return heights less their least-squares polynomial of a total degree.

    Parameters
    ----------
    heights : ndarray, shape (nx, ny) or (n,)
        Heights on an even grid. [length]
    trend : {"none", "mean", "tilt", "curvature"}
        Which.
    """
    degree = DEGREES[trend]
    if degree < 0:
        return heights
    # orthonormal along each side, so each term is a projection: there are no equations to solve
    bases = [_polynomials(n, min(degree, n - 1)) for n in heights.shape]
    centred = heights - heights.mean()
    shares = centred
    for basis in bases:
        shares = np.tensordot(shares, basis, axes=(0, 0))
    orders = np.indices(shares.shape).sum(axis=0)
    fitted = np.where(orders <= degree, shares, 0.0)
    for basis in bases:
        fitted = np.tensordot(fitted, basis, axes=(0, 1))
    return centred - fitted


def _polynomials(n: int, degree: int) -> Real:
    """Orthonormal polynomials on n even points, one a column."""
    x = np.linspace(-1.0, 1.0, n)
    basis, _ = np.linalg.qr(np.polynomial.legendre.legvander(x, degree))
    return np.asarray(basis)
