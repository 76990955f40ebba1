"""How far a curve may differ from that of ever finer grids, judged from coarser ones."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughline.computing.arrays import Real
from roughline.contact.curve import Curve
from roughline.contact.loads import Loads
from roughline.contact.selection import among_loads
from roughline.errors import InputError
from roughline.topography.body import Surface, with_heights
from roughline.topography.preparation import resampled

# On the difference to be expected, so that errors cover grids four times finer: 95 % of all kinds
# of surfaces, and at least 90 % of each (benchmarks/grid_error.py).
_SAFETY = 1.4
# White noise has the fastest growth of all surfaces: means over two by two points halve its
# heights, so that its mean square slope is 16 times as large from grid to grid.
_GROWTH_OF_NOISE = 16.0
# Means of points of a rougher self-affine surface steepen the last step so much, because the points
# hold the shorter waves folded into them.
_FASTEST_OF_POINTS = 4 / 3
# Of what yield takes from the stiffness on loading, which few cells decide, so much is uncertain.
_SHARE_OF_YIELD = 0.3
_NEARLY_ALL = 0.9  # of a softer body at the hardness: as far as it is loaded at most
_FEWEST_POINTS = 4  # along a side of the coarsest grid

Press = Callable[[Surface, Loads, float | None], Curve]
"""Presses another surface under some loads, with a hardness or as elastic bodies."""


@dataclass(frozen=True, eq=False)
class _Grids:
    """A surface and its coarser selves.

    Attributes
    ----------
    quarter, half : Surface
        Means of four by four and of two by two points.
    thinned : Surface
        Every other point along both sides.
    full : Surface
        The surface.
    """

    quarter: Surface
    half: Surface
    thinned: Surface
    full: Surface

    @classmethod
    def of(cls, surface: Surface) -> _Grids:
        """The coarser selves of a surface."""
        half = _halved(surface)
        return cls(_halved(half), half, _thinned(surface), surface)

    @property
    def steepening(self) -> float:
        """How much larger the rms slope of a grid four times finer will be.

        What a grid of means adds to the mean square slope changes by one factor from grid to grid.
        Slopes that grow faster than those of self-affine surfaces do are those of white noise.
        """
        means = np.square([each.rms_slope for each in (self.quarter, self.half, self.full)])
        points = [each.rms_slope**2 for each in (_thinned(self.thinned), self.thinned)]
        before, last = np.maximum(np.diff(means), 0.0)
        if last == 0:
            return 1.0
        growth = min(last / before, _GROWTH_OF_NOISE) if before > 0 else _GROWTH_OF_NOISE
        noise = max(
            _excess([*points, means[2]], 1.0), _excess(means.tolist(), _FASTEST_OF_POINTS), 0.0
        )
        more = last / means[2] * (growth + growth**2) + noise * _GROWTH_OF_NOISE**2
        return float(np.sqrt(1 + more))

    @property
    def step(self) -> float:
        """How much larger the rms slope is than that of the means of two by two points."""
        half = self.half.rms_slope
        return max(1.0, self.full.rms_slope / half) if half > 0 else 1.0


def with_grid_error(curve: Curve, surface: Surface, loads: Loads, press: Press) -> Curve:
    """Add to a curve the discretisation errors estimated from coarser grids.

    Differences between grids change from grid to grid as the heights of the waves that are added
    do, half the square root of the steepening m: the error is that of the next two grids, a grid
    convergence index [1]_. Added to it is what waves do that no grid here has. They steepen the
    surface, so that Persson's theory tells the area of elastic bodies [2]_, and a body with the
    hardness H / m tells what yield does. Parts that are independent add as squares; those of an
    area are not, as differences between grids are those of their slopes.

    The error under a load does not depend on the other loads. The errors cover grids four times
    finer, but no noise that begins at the spacing.

    Parameters
    ----------
    curve : Curve
        Curve of the surface.
    surface : Surface
        Its surface.
    loads : Loads
        Its loads.
    press : callable
        Presses another surface.

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
    .. [2] B. N. J. Persson, "Theory of rubber friction and contact mechanics", J. Chem. Phys. 115,
       3840-3861 (2001).
    """
    grids = _Grids.of(surface)
    coarser = [
        press(each, loads, curve.hardness) for each in (grids.quarter, grids.half, grids.thinned)
    ]
    steepening = grids.steepening
    softer = _softer(grids, steepening, coarser[1], press)
    with np.errstate(invalid="ignore", divide="ignore"):  # bodies apart, or in full contact
        return _with_errors(curve, coarser, softer, steepening)


def _with_errors(
    curve: Curve, coarser: Sequence[Curve], softer: tuple[Curve, Curve], steepening: float
) -> Curve:
    """Add the errors to a curve, from the curves of coarser grids and of softer bodies."""
    k, k_u = curve.stiffness, curve.unloading_stiffness
    area, most = curve.area_fraction_corrected, curve.area_fraction_most
    assert k_u is not None
    assert area is not None
    assert most is not None
    of_k, of_k_u, of_area = (
        _difference(name, coarser, curve, math.sqrt(steepening) / 2)
        for name in ("stiffness", "unloading_stiffness", "area_fraction_corrected")
    )
    of_k_u = np.hypot(of_k_u, _change("unloading_stiffness", *softer))
    of_k = np.maximum(np.hypot(of_k, _change("stiffness", *softer)), of_k_u)
    if curve.hardness is not None:  # nothing is left of k where all of the contact yields
        taken = np.where((k > 0) & (k < k_u), _SHARE_OF_YIELD * np.log(k_u / k), 0.0)
        of_k = np.maximum(of_k, of_k_u + taken)
    yielding = area * np.exp(_change("area_fraction_corrected", *softer))
    of_area = of_area + np.abs(_steeper(yielding, steepening, area))
    return replace(
        curve,
        stiffness_error=_times(k, of_k),
        unloading_stiffness_error=_times(k_u, of_k_u),
        # as uncertain as its perimeter correction, also on plateaus, where none is made
        area_fraction_error=np.maximum(_times(area, of_area), most - area),
    )


def refuse_few_points(surface: Surface) -> None:
    """Refuse a surface that has too few points to be halved twice."""
    if min(surface.shape) < 4 * _FEWEST_POINTS:
        raise InputError(
            f"grid_error needs grids of n / 2 and n / 4 points, and the surface has "
            f"{surface.shape[0]} x {surface.shape[1]}: give at least {4 * _FEWEST_POINTS} a side"
        )


def _difference(name: str, coarser: Sequence[Curve], curve: Curve, growth: float) -> Real:
    """Return the error of the logarithm of a quantity from its differences between grids.

    Parameters
    ----------
    name : str
        The quantity.
    coarser : sequence of Curve
        Of n / 4 and n / 2 points, and of every other point.
    curve : Curve
        Of the surface.
    growth : float
        Factor of differences from grid to grid.
    """
    quarter, half, thinned = values = np.array([getattr(each, name) for each in coarser])
    full = getattr(curve, name)
    logs = np.abs(np.log([full / half, half / quarter, full / thinned])).max(axis=0)
    # compliances over that of the surface; full contact has none, and the difference from it is
    # the least that the last one can be
    compliances = np.abs([1 - full / half, full / half - full / quarter, 1 - full / thinned])
    following = _SAFETY * (growth + growth**2)
    closed = np.log1p((_SAFETY + following) * compliances.max(axis=0))
    error = np.where(np.isinf(values).any(axis=0) & np.isfinite(full), closed, following * logs)
    error = np.where(np.isinf(full), np.nan, error)
    return np.where((values == full).all(axis=0), 0.0, error)


def _excess(squares: Sequence[float], acceleration: float) -> float:
    """Return the share of the last of three mean square slopes that is beyond a steady growth.

    The logarithm of a slope then grows by `acceleration` times what it did from grid to grid.
    """
    first, second, last = squares
    return 1 - (second / first) ** acceleration * second / last if first > 0 else 0.0


def _softer(grids: _Grids, steepening: float, curve: Curve, press: Press) -> tuple[Curve, Curve]:
    """Return curves of n / 2 points that yield as the surface does, and as a finer grid will.

    Contact depends on hardness and slope as H / (E* slope) does. Without yield, or where no slope
    is added, both are the curve of n / 2 points.
    """
    if curve.hardness is None or steepening == 1:
        return curve, curve
    alike, softer = (
        _pressed_softer(curve, grids.half, curve.hardness / times, press)
        for times in (grids.step, grids.step * steepening)
    )
    return alike, softer


def _pressed_softer(curve: Curve, surface: Surface, hardness: float, press: Press) -> Curve:
    """Press a surface softer under the forces of its curve, as far as it bears them."""
    known = np.isfinite(curve.force) & (np.maximum.accumulate(np.nan_to_num(curve.force)) > 0)
    if not known.any():
        return curve
    forces = np.minimum(curve.force[known], _NEARLY_ALL * hardness * surface.area)
    return among_loads(press(surface, Loads("forces", forces), hardness), known)


def _change(name: str, before: Curve, after: Curve) -> Real:
    """Return the change of the logarithm of a quantity; none where both are equal."""
    old, new = getattr(before, name), getattr(after, name)
    return np.where(new == old, 0.0, np.log(new / old))


def _steeper(yielding: Real, steepening: float, area: Real) -> Real:
    """Return the change of the logarithm of an area where yield and steeper slopes change it."""
    from scipy.special import erf, erfinv  # here because they load slowly

    # Persson: the error function of the pressure over the slope, times a constant
    steeper = erf(erfinv(np.minimum(yielding, 1.0)) / steepening)
    return np.where(area == 0, 0.0, np.log(steeper / area))


def _times(value: Real, error: Real) -> Real:
    """Return the error of a value from that of its logarithm; none where that is none."""
    return np.where(error == 0, 0.0, value * np.expm1(error))


def _halved(surface: Surface) -> Surface:
    """Return the surface on half as many points a side, over the same sides."""
    nx, ny = surface.shape
    if nx % 2 == 0 and ny % 2 == 0:
        return surface.coarsened()
    # heights count from the highest point, so that rounding leaves a flat punch flat
    return resampled(
        with_heights(surface, surface.heights - surface.heights.max()), (nx // 2, ny // 2)
    )


def _thinned(surface: Surface) -> Surface:
    """Return every other point along both sides; splines between points of odd numbers."""
    if surface.shape[0] % 2 == 0 and surface.shape[1] % 2 == 0:
        return with_heights(surface, surface.heights[::2, ::2])
    from scipy import ndimage

    # from the highest point, as above
    heights = surface.heights - surface.heights.max()
    zoom = [(n // 2) / n for n in surface.shape]
    return with_heights(surface, ndimage.zoom(heights, zoom, mode="nearest", grid_mode=True))
