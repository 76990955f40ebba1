"""How far a curve may be from that of an ever finer grid, judged from coarser ones."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from roughline.curve import Curve
from roughline.errors import InputError
from roughline.topography import Surface

Real = NDArray[np.float64]

_SAFETY = 2.0  # between the 1.25 of [1]_ for smooth problems on three grids and its 3 for two
# Differences between successive grids shrink by this at best (contact edges are first order) and
# are taken to shrink by that at worst (roughness down to the grid).
_FASTEST, _SLOWEST = 0.5, 0.9
_FEWEST = 4  # points along a side of the coarsest grid


def with_grid_error(
    curve: Curve, surface: Surface, press_coarse: Callable[[Surface], Curve]
) -> Curve:
    """Add to a curve the discretisation errors estimated from grids of n / 2 and n / 4 points.

    The coarse grids see the means of two by two points. The differences between the three grids
    are summed as a geometric series, times a safety factor (the grid convergence index of [1]_,
    with the order limited to one). An area is at least as uncertain as its perimeter correction.

    Parameters
    ----------
    curve : Curve
        Curve of the surface.
    surface : Surface
        Its surface.
    press_coarse : callable
        Presses another surface under the same loads.

    Returns
    -------
    Curve
        With ``stiffness_error`` and ``area_fraction_error``; NaN where a grid did not converge.

    References
    ----------
    .. [1] P. J. Roache, "Perspective: a method for uniform reporting of grid refinement studies",
       J. Fluids Eng. 116, 405-413 (1994).
    """
    half = surface.coarsened()
    curves = [press_coarse(grid) for grid in (half.coarsened(), half)] + [curve]
    areas = [_area(each) for each in curves]
    raw = curve.area_fraction
    assert raw is not None
    return replace(
        curve,
        stiffness_error=_uncertainty(*(each.stiffness for each in curves)),
        area_fraction_error=np.maximum(_uncertainty(*areas), raw - areas[-1]),
    )


def refuse_indivisible(surface: Surface) -> None:
    """Refuse a surface that cannot be halved twice."""
    if any(n % 4 or n // 4 < _FEWEST for n in surface.shape):
        raise InputError(
            f"grid_error needs grids of n / 2 and n / 4 points, and the surface has "
            f"{surface.shape[0]} x {surface.shape[1]}: crop it to multiples of 4, at least "
            f"{4 * _FEWEST}"
        )


def _area(curve: Curve) -> Real:
    assert curve.area_fraction_corrected is not None
    return curve.area_fraction_corrected


def _uncertainty(quarter: Real, half: Real, full: Real) -> Real:
    first, second = np.abs(half - quarter), np.abs(full - half)
    # a second difference that is small by chance is not believed
    second = np.maximum(second, _FASTEST * first)
    shrinking = np.clip(second / np.maximum(first, 1e-300), _FASTEST, _SLOWEST)
    return _SAFETY * second * shrinking / (1 - shrinking)
