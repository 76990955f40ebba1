"""Tilt and curvature: least-squares polynomials of the coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any, Literal

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors.checks import allowed_choice

Trend = Literal["none", "mean", "tilt", "curvature"]

_DEGREES = {"none": -1, "mean": 0, "tilt": 1, "curvature": 2}  # of the polynomial of each

_BLOCK = 2**16  # heights changed together
_SINGULAR = 1e-10  # of the largest moment of the known points, below which they tell no coefficient
_HEIGHT_ROUNDING = 1e-13  # of the largest height, below which what is left is of rounding alone


def without_trend(heights: Real, trend: Trend) -> Real:
    """Return heights less their least-squares polynomial of a total degree."""
    rest = np.array(heights)
    remove_trend(rest, trend)
    return rest


def remove_trend(heights: Real, trend: Trend) -> None:
    """Subtract the least-squares polynomial from heights in place, without a second copy of them.

    Heights that are such a polynomial become zero, without the rounding of the subtraction.
    """
    degree = _DEGREES[trend]
    if degree < 0:
        return
    if not heights.flags.c_contiguous:
        heights = heights.T  # the polynomials of x and y change places
    largest = max(float(heights.max()), -float(heights.min()))
    heights -= heights.mean()
    # the polynomials are orthonormal along each side, so that projections give the coefficients
    bases = [polynomials(n, min(degree, n - 1)) for n in heights.shape]
    shares = heights
    for basis in bases:
        shares = np.tensordot(shares, basis, axes=(0, 0))
    along = np.where(np.indices(shares.shape).sum(axis=0) <= degree, shares, 0.0)
    for basis in bases[1:]:
        along = along @ basis.T
    rows = max(1, _BLOCK * len(heights) // heights.size)
    for start in range(0, len(heights), rows):
        block = slice(start, start + rows)
        heights[block] -= bases[0][block] @ along
    if max(float(heights.max()), -float(heights.min())) <= _HEIGHT_ROUNDING * largest:
        heights[...] = 0.0


def trend_of_known(heights: np.ma.MaskedArray[Any, Any], trend: Trend) -> Real:
    """Return the least-squares polynomial through masked heights, at all points.

    Where the known points do not tell all of its coefficients, as on one row, the others are zero.
    """
    degree, known = _DEGREES[trend], ~np.ma.getmaskarray(heights)
    middle = float(heights.mean())
    moments, shares = known.astype(np.float64), np.ma.filled(heights, middle) - middle
    bases = [polynomials(n, min(degree, n - 1)) for n in heights.shape]
    for basis in bases:
        products = np.einsum("ni,nj->nij", basis, basis).reshape(len(basis), -1)
        moments = np.tensordot(moments, products, axes=(0, 0))
        shares = np.tensordot(shares, basis, axes=(0, 0))
    counts = shares.shape
    pairs = moments.reshape([n for count in counts for n in (count, count)])
    first, second = range(0, 2 * len(counts), 2), range(1, 2 * len(counts), 2)
    normal = pairs.transpose([*first, *second]).reshape(shares.size, shares.size)
    terms = np.flatnonzero(np.indices(counts).sum(axis=0).ravel() <= degree)
    along = np.zeros(shares.size)
    along[terms], *_ = np.linalg.lstsq(
        normal[np.ix_(terms, terms)], shares.ravel()[terms], _SINGULAR
    )
    found = along.reshape(counts)
    for basis in bases:
        found = np.tensordot(found, basis, axes=(0, 1))
    return found + middle


def slopes_of_plane(heights: Real, spacings: Sequence[float]) -> tuple[float, ...]:
    """Return the slopes of the least-squares plane along each side. [1]"""
    slopes = []
    for axis, (n, spacing) in enumerate(zip(heights.shape, spacings, strict=True)):
        x = np.arange(n) - (n - 1) / 2
        others = tuple(each for each in range(heights.ndim) if each != axis)
        across = heights.mean(axis=others) if others else heights
        spread = float(x @ x) * spacing
        slopes.append(float(x @ (across - across.mean())) / spread if spread else 0.0)
    return tuple(slopes)


def refuse_unknown_trend(trend: str) -> None:
    """Refuse an unknown name of a trend."""
    allowed_choice("trend", trend, _DEGREES)


@lru_cache(maxsize=32)
def polynomials(n: int, degree: int) -> Real:
    """Return orthonormal polynomials on n even points, one a column, of all degrees up to one."""
    x = np.linspace(-1.0, 1.0, n)
    basis, _ = np.linalg.qr(np.polynomial.legendre.legvander(x, degree))
    basis.flags.writeable = False  # it is kept
    return np.asarray(basis)
