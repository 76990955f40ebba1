"""Peaks of a surface: how many there are after Wolf pruning, and how curved they are."""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Indices, Real
from roughline.texture.found import Found
from roughline.texture.parameters import LEAST_HILL

_SEVEN = np.array([2.0, -27.0, 270.0, -490.0, 270.0, -27.0, 2.0]) / 180.0
"""Second derivative from seven points, exact for polynomials up to the seventh degree."""

_HILL_ROUNDING = 1e-9  # of the height of the least hill; steps of heights may be as high
_NONE = "there is no peak: the tops of all hills meet the border or run around the surface"


def peak_parameters(heights: Real, sizes: tuple[float, float], *, is_periodic: bool) -> Found:
    """Return Spd and Spc of the peaks of hills that are higher than 5 % of the maximum height.

    Neighbours are all eight. The curvature of a peak is minus half the Laplacian, from seven points
    along each side; a peak closer than three points to a border counts for Spd alone.
    """
    from roughline.texture.loops import peaks_of_hills  # here because numba loads slowly

    height = float(np.ptp(heights))
    if height == 0:
        return {"Spd": 0.0, "Spc": "all heights are equal"}
    order = np.argsort(-heights, axis=None, kind="stable")
    grid = np.ascontiguousarray(heights)
    least = LEAST_HILL * height * (1 - _HILL_ROUNDING)
    peaks = peaks_of_hills(grid, order, is_periodic, least)
    density = peaks.size / (sizes[0] * sizes[1])
    if not peaks.size:
        return {"Spd": 0.0, "Spc": _NONE}
    if min(heights.shape) < _SEVEN.size:
        return {"Spd": density, "Spc": "curvatures need seven points along each side"}
    spacings = tuple(side / n for side, n in zip(sizes, heights.shape, strict=True))
    places = np.array(np.unravel_index(peaks, heights.shape))
    if not is_periodic:
        from_border = np.minimum(places, np.array(heights.shape)[:, None] - 1 - places)
        places = places[:, (from_border >= _SEVEN.size // 2).all(axis=0)]
        if not places.size:
            return {"Spd": density, "Spc": "all peaks are closer than three points to the border"}
    return {"Spd": density, "Spc": float(np.mean(_curvatures(heights, places, spacings)))}


def _curvatures(heights: Real, places: Indices, spacings: tuple[float, ...]) -> Real:
    """Minus half the Laplacian at some points. [1 / length]"""
    curvature = np.zeros(places.shape[1])
    for axis, step in enumerate(spacings):
        for weight, shift in zip(_SEVEN, range(-3, 4), strict=True):
            moved = list(places)
            moved[axis] = (moved[axis] + shift) % heights.shape[axis]
            curvature -= weight / (2 * step**2) * heights[tuple(moved)]
    return curvature
