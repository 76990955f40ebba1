"""Stiffness of an interface alone: of a piece as it is, and of the surface that it was cut from."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from roughline.assessment.larger_measure import LargerMeasure
from roughline.assessment.tiles import MOST_DOUBLINGS, Extrapolation, Tiles, logit
from roughline.assessment.uncertainty import (
    area_fraction,
    combined,
    interval,
    loading_under_unloading,
    unloading_stiffness,
    widened,
)
from roughline.computing.arrays import Real
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.press import press
from roughline.contact.scaling import PUNCH_GRID_ERROR
from roughline.engineering.formulas import interface_stiffness
from roughline.engineering.intervals import Ends, Intervals
from roughline.engineering.pressed import InterfaceStiffness
from roughline.errors import InputError
from roughline.facts.answers import (
    joint_in_reach,
    joint_out_of_reach,
    larger_surface_behind,
    piece_alone,
    reduced_line_alone,
    some_larger_surface,
)
from roughline.facts.fact import Fact
from roughline.measurement.fit import SelfAffineFit, fitted
from roughline.topography.body import Body, Line, Surface

_PUNCH_MATTERS = 0.05
"""Share of 1 / k_s in 1 / k, up to which k_i of a piece is within 2 % of that of it repeated."""

_LEAST_SHARE = 1e-9  # of the area that is in contact, or is not; less counts as this


@dataclass(frozen=True, eq=False)
class Differences:
    """Ends of the differences between a larger surface and a map."""

    stiffness: Ends  # of its logarithm
    area: Ends  # of the logit of the area fraction
    measures: Mapping[str, Ends] = field(default_factory=dict)
    """Of logarithms of measures and their floors, by names."""


@dataclass(frozen=True, eq=False)
class LargerSurface:
    """The surface behind a piece, under the loads of the piece's curve."""

    stiffness: InterfaceStiffness  # of as much of it as the piece is large [N / m]
    area: Ends | None = None  # ends of its corrected area fraction [1]
    of_grid: tuple[Ends | None, Ends | None] = (None, None)
    """Ends of the piece's own stiffness [N / m] and area fraction [1], which the grid and filled
    points leave open."""

    tiles: tuple[Tiles, Tiles] | None = None
    """Logarithms of the stiffness, and logits of the contact area fraction."""

    measures: Mapping[str, LargerMeasure] = field(default_factory=dict)
    """What a larger surface has as well, by names; empty without tiles."""

    def from_many(self, area: Real, further: Differences, *, with_grid: bool) -> LargerSurface:
        """Give it the intervals that many pieces leave open; `area` is the piece's area fraction.

        With the grid, `further` is combined with what that leaves open, as independent.
        """
        k, shares = self.of_grid if with_grid else (None, None)
        values = self.stiffness.values
        stiffness = replace(self.stiffness, ends=widened(values, k, further.stiffness))
        share = _widened_share(area, shares or (area, area), further.area)
        return LargerSurface(stiffness, share, measures=self.measures)

    def intervals(self, curve: SurfaceCurve) -> Intervals | None:
        """Intervals of a periodic piece's curve that hold the larger surface as well.

        There are none where the piece does not tell of that. The stiffness on loading keeps its
        ratio to that on unloading. Where points yield, the error of its grid is combined with that,
        as independent.
        """
        ends = self.stiffness.ends
        if ends is None:
            return None
        with np.errstate(invalid="ignore"):  # bodies apart, and no upper end near full contact
            share = curve.stiffness / unloading_stiffness(curve)
            loading = share * ends[0], share * ends[1]
            if curve.stiffness_error is not None:
                further = (
                    np.log(ends[0] / self.stiffness.values),
                    np.log(ends[1] / self.stiffness.values),
                )
                own = interval(curve.stiffness, curve.stiffness_error)
                yields = share < 1
                with_own = loading_under_unloading(widened(curve.stiffness, own, further), ends)
                loading = (
                    np.where(yields, with_own[0], loading[0]),
                    np.where(yields, with_own[1], loading[1]),
                )
        area = self.area
        if area is not None and curve.hardness is not None:  # no area bears more than the hardness
            area = np.maximum(area[0], curve.force / (curve.hardness * curve.length**2)), area[1]
        return Intervals(loading, ends, area)


def roll_offs_along_a_side(surface: Surface) -> float | None:
    """Roll-off wavelengths along a side of a surface.

    None if the fitted interval of the roll-off reaches the longest waves, so that there may be
    none, or if there are too few points for a fit.
    """
    try:
        _, fit = fitted(surface)
    except InputError:
        return None
    return fitted_roll_offs(fit)


def fitted_roll_offs(fit: SelfAffineFit) -> float | None:
    """Roll-off wavelengths along a side of the surface that a law was fitted to."""
    return fit.q_roll / fit.q_low if fit.q_roll and fit.shows_roll_off else None


def stiffness_of_the_piece(
    body: Body, curve: Curve, interval: Ends | None = None, *, is_layered: bool = False
) -> InterfaceStiffness:
    """Interface stiffness of a free body as it is, 1 / k_i = 1 / k - 1 / k_s.

    Where the stiffness differs from the punch's by less than the grid's error of the punch, the
    upper end of the interval is infinite; `interval` is that of the stiffness on unloading. [N / m]
    """
    k = unloading_stiffness(curve)
    if isinstance(body, Line):
        saturated, error, warned_from = curve.E_star * body.length, 0.0, 0.0
        place = reduced_line_alone()
    else:
        saturated, warned_from = saturated_stiffness(body, curve), _PUNCH_MATTERS
        # as a share of k_s, which is a little more
        error = PUNCH_GRID_ERROR / math.sqrt(body.heights.size)
        place = piece_alone(is_layered)
    low, high = interval or np.full((2, k.size), np.nan)
    close = k > saturated * (1 - error)
    low = np.where(close, np.fmin(low, k * (1 - error)), low)
    high = np.where(close, np.inf, high)
    known = interval is not None or bool(close.any())
    ends = interface_stiffness(low, saturated), interface_stiffness(high, saturated)
    formula = "1/k_i = 1/k_u - 1/k_s, on unloading; k_s of the flat punch"
    return InterfaceStiffness(
        interface_stiffness(k, saturated), ends if known else None, place, formula, warned_from
    )


def saturated_stiffness(surface: Surface, curve: Curve) -> float:
    """Stiffness of the flat punch with the outline and grid of a surface. [N / m]

    It is pressed into what the curve is of.
    """
    flat = Surface(np.zeros(surface.shape), surface.sizes, surface.unit, is_cut_out=False)
    depth = math.sqrt(surface.area) * 1e-6
    return float(press(flat, half_space=curve.half_space, depths=[depth]).stiffness[0])


def larger_surface(
    curve: Curve,
    extrapolation: Extrapolation,
    tiles: tuple[Tiles, Tiles] | None,
    stiffness: Ends | None = None,
    area: Ends | None = None,
) -> LargerSurface:
    """Stiffness and area of the part of a large surface that a piece was cut out of.

    The curve is that of the piece in the periodic half-space, with ends of its stiffness on
    unloading [N / m] and of its corrected area fraction [1]. The intervals are those of the large
    surface under the same mean pressure: they combine the curve's with what the piece's tiles say
    of the large surface, as independent. Without tiles there are none.
    """
    touching, k = area_fraction(curve), unloading_stiffness(curve)
    formula = "dF/dd of the map in a periodic half-space under the same force, on unloading"
    grid = stiffness, area
    if tiles is None:
        return LargerSurface(
            InterfaceStiffness(k, None, which_surface(extrapolation), formula), of_grid=grid
        )
    of_stiffness, of_area = tiles
    ends = widened(k, stiffness, of_stiffness.extrapolated(extrapolation))
    interface = InterfaceStiffness(k, ends, which_surface(extrapolation), formula)
    share = (
        None
        if area is None
        else _widened_share(touching, area, of_area.extrapolated(extrapolation))
    )
    return LargerSurface(interface, share, grid, tiles)


def which_surface(
    extrapolation: Extrapolation, of: Literal["stiffness", "gap"] = "stiffness"
) -> Fact:
    """Say which larger surface is meant, and how much of its waves the map holds."""
    if extrapolation.roll_offs is not None:
        return larger_surface_behind(extrapolation.roll_offs)
    times = 2**extrapolation.doublings
    if extrapolation.assembly is None:
        return some_larger_surface(times, of)
    if extrapolation.is_supported:
        return joint_in_reach(times, extrapolation.assembly)
    return joint_out_of_reach(times, extrapolation.assembly, 2**MOST_DOUBLINGS)


def _widened_share(values: Real, ends: Ends, further: Ends) -> Ends:
    """Widen shares of the area by ends of the differences of their logits."""
    logits, *own = (
        logit(np.clip(each, _LEAST_SHARE, 1 - _LEAST_SHARE)) for each in (values, *ends)
    )
    further = combined(further, (own[0] - logits, own[1] - logits))
    with np.errstate(over="ignore"):
        low, high = (1 / (1 + np.exp(-(logits + each))) for each in further)
    return np.where(values == 0, 0.0, low), np.where(values == 0, 0.0, high)
