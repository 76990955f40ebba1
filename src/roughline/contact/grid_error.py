"""How far a curve may differ from its limit on ever finer grids, judged from coarser ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.curve import Curve
from roughline.contact.scaling import EXACT_PUNCH
from roughline.errors import InputError
from roughline.topography.body import Surface, with_heights
from roughline.topography.preparation import resampled

# Factors on the difference between the last two grids and on the one to be expected next, chosen so
# that the errors cover grids four times finer (benchmarks/grid_error.py). For areas at the scale of
# the cells, the differences of the grids are smaller than the error.
_SAFETY_OF_LAST = 1.5
_SAFETY_OF_YIELD = 2.0  # more where all of the contact yields: finer waves cut up its spots further
_SAFETY_OF_NEXT_STIFFNESS = 1.15
_SAFETY_OF_NEXT_AREA = 3.25
_SHARE_OF_AREA = 0.25  # of the area's error is in the stiffness where something yields, at least
_SHARE_OF_YIELD = 0.3  # of what yield takes from the stiffness on loading is uncertain, at least
_LEAST_GROWTH = 0.5  # at contact edges the order is one: differences halve at best grid by grid
_MOST_GROWTH = 2.0  # and double at worst, where noise of the pixels prevails
_FEWEST_POINTS = 4  # along a side of the coarsest grid


def with_grid_error(
    curve: Curve, surface: Surface, press_coarse: Callable[[Surface], Curve]
) -> Curve:
    """Add to a curve the discretisation errors estimated from grids of n / 2 and n / 4 points.

    The coarse grids hold the means of two by two points, or of equal pieces where a side has an odd
    number of points. Differences between grids are those of logarithms, or of compliances where a
    coarser grid is in full contact. They are taken to grow from grid to grid as those of the rms
    slope do, by a factor between a half and two, which belongs to the surface and not to a load.
    Since a difference is small at times by chance, the last one is drawn twice: as it is, and as
    the one before times the growth. The error is the larger draw and the difference to be expected
    next, the growth times the root mean square of both, each times a safety factor: a grid
    convergence index [1]_. The error under a load does not depend on the other loads. An area is at
    least as uncertain as its perimeter correction, also on plateaus, where none is made.

    Yield adds to this. The safety factor of stiffnesses grows with the share of the contact that
    yields. There the error of the logarithm of a stiffness is at least a part of that of the area,
    a smaller one near the stiffness of the flat punch, because waves which only a finer grid
    resolves let more of the body yield, and their effects can cancel on the coarser grids. The
    stiffness on loading depends on single cells: the error of its logarithm is at least that of the
    stiffness on unloading, and a part of the difference between both.

    The errors cover grids four times finer, but no noise that begins at the spacing.

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
        With ``stiffness_error``, ``unloading_stiffness_error`` and ``area_fraction_error``: a value
        v with error e lies between v / (1 + e / v) and v + e. NaN where a grid did not converge,
        and where the surface is in full contact and coarser grids are not.

    References
    ----------
    .. [1] P. J. Roache, "Perspective: a method for uniform reporting of grid refinement studies",
       J. Fluids Eng. 116, 405-413 (1994).
    """
    half = _halved(surface)
    grids = _halved(half), half, surface
    growth, curves = _growth(grids), [*map(press_coarse, grids[:2]), curve]
    areas = [_area(each) for each in curves]
    most = curve.area_fraction_most
    assert most is not None
    area_error = np.maximum(_error(areas, growth, _SAFETY_OF_NEXT_AREA), most - areas[-1])
    with np.errstate(invalid="ignore"):  # bodies apart
        loading, unloading = _stiffness_errors(curves, growth, np.log1p(area_error / areas[-1]))
    return replace(
        curve,
        stiffness_error=loading,
        unloading_stiffness_error=unloading,
        area_fraction_error=area_error,
    )


def _growth(grids: Sequence[Surface]) -> float:
    """Return by what differences of the rms slope's logarithm grow; the least if there are none."""
    slopes = np.array([grid.rms_slope for grid in grids])
    slopes = np.maximum(slopes, np.finfo(float).eps * slopes[-1])  # coarser grids may be flat
    with np.errstate(invalid="ignore", divide="ignore"):
        first, second = np.abs(np.diff(np.log(slopes)))
        growth = np.nan_to_num(second / first)
    return float(np.clip(growth, _LEAST_GROWTH, _MOST_GROWTH))


def _stiffness_errors(curves: Sequence[Curve], growth: float, area: Real) -> tuple[Real, Real]:
    """Return the errors of both stiffnesses from that of the area's logarithm."""
    plastic = curves[-1].plastic_fraction
    assert plastic is not None
    safety = _SAFETY_OF_NEXT_STIFFNESS, _SAFETY_OF_LAST + _SAFETY_OF_YIELD * plastic
    loading, unloading = [each.stiffness for each in curves], [_unloading(each) for each in curves]
    k, k_u = loading[-1], unloading[-1]
    with np.errstate(invalid="ignore", divide="ignore"):  # bodies apart, or in full contact
        least = np.where(plastic > 0, _SHARE_OF_AREA * area * _open_share(curves[-1]), 0.0)
        error = np.maximum(_error(unloading, growth, *safety), _times(k_u, np.expm1(least)))
        # where all of the contact yields, nothing is left of k
        taken = np.fmax(_SHARE_OF_YIELD * np.log(k_u / k), np.log1p(error / k_u))
        taken = np.where((plastic > 0) & (k > 0), taken, 0.0)
        return np.maximum(_error(loading, growth, *safety), _times(k, np.expm1(taken))), error


def _times(stiffness: Real, share: Real) -> Real:
    """Return a share of a stiffness; none of an infinite one, which has no error of its own."""
    return np.where(np.isinf(stiffness), 0.0, stiffness * share)


def _open_share(curve: Curve) -> Real | float:
    """Return how far the stiffness on unloading is below that of a flat punch of the same area."""
    if curve.settings["boundary"] == "periodic":  # a flat one is infinitely stiff
        return 1.0
    punch = EXACT_PUNCH * curve.E_star * curve.length
    return np.clip(1 - _unloading(curve) / punch, 0.0, 1.0)


def refuse_few_points(surface: Surface) -> None:
    """Refuse a surface that has too few points to be halved twice."""
    if min(surface.shape) < 4 * _FEWEST_POINTS:
        raise InputError(
            f"grid_error needs grids of n / 2 and n / 4 points, and the surface has "
            f"{surface.shape[0]} x {surface.shape[1]}: give at least {4 * _FEWEST_POINTS} a side"
        )


def _halved(surface: Surface) -> Surface:
    """Return the surface on half as many points a side, over the same sides."""
    nx, ny = surface.shape
    if nx % 2 == 0 and ny % 2 == 0:
        return surface.coarsened()
    # heights count from the highest point, so that rounding leaves a flat punch flat
    return resampled(
        with_heights(surface, surface.heights - surface.heights.max()), (nx // 2, ny // 2)
    )


def _area(curve: Curve) -> Real:
    """Return the corrected area of a surface's curve, which has one."""
    assert curve.area_fraction_corrected is not None
    return curve.area_fraction_corrected


def _unloading(curve: Curve) -> Real:
    """Return the unloading stiffness of a surface's curve, which has one."""
    assert curve.unloading_stiffness is not None
    return curve.unloading_stiffness


def _error(
    values: Sequence[Real], growth: float, of_next: float, of_last: float | Real = _SAFETY_OF_LAST
) -> Real:
    """Return the error of the last of three grids, from safety factors of two differences."""
    quarter, half, full = values
    with np.errstate(invalid="ignore", divide="ignore"):  # of nothing, and of full contact
        last, drawn = np.abs(np.log(full / half)), growth * np.abs(np.log(half / quarter))
        following = growth * np.sqrt((last**2 + drawn**2) / 2)
        error = full * np.expm1(of_last * np.maximum(last, drawn) + of_next * following)
        # compliances over that of the last grid; nothing is left of them in full contact, so that
        # the one difference that is seen there is not small by chance
        last, drawn = np.abs(1 - full / half), growth * np.abs(full / half - full / quarter)
        closed = (np.isinf(quarter) | np.isinf(half)) & np.isfinite(full)
        error = np.where(
            closed, full * (of_last + of_next * growth) * np.maximum(last, drawn), error
        )
        error = np.where(np.isinf(full), np.nan, error)
    return np.where((quarter == half) & (half == full), 0.0, error)
