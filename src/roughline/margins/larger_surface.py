"""Stiffness of an interface alone: of a piece as it is, and of the surface that it was cut from."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from roughline.contact.curve import Curve
from roughline.contact.scaling import PUNCH_GRID_ERROR
from roughline.engineering.formulas import interface_stiffness
from roughline.engineering.intervals import Ends, Intervals
from roughline.engineering.pressed import InterfaceStiffness
from roughline.facts.fact import Fact
from roughline.margins.larger_measure import LargerMeasure
from roughline.margins.place import spread_of_differences
from roughline.margins.spread import Spread, Values, intervals_within
from roughline.margins.tiles import Tiles
from roughline.question.extrapolation import MOST_DOUBLINGS, Extrapolation
from roughline.topography.body import Body, Line, Surface

_PUNCH_MATTERS = 0.05
"""Share of 1 / k_s in 1 / k, up to which k_i of a piece is within 2 % of that of it repeated."""


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

    values: Values  # of the piece in the periodic half-space
    spreads: Mapping[str, Spread | None]  # what causes leave open of that surface, by their names
    of_which: Fact  # which surface it is
    tiles: tuple[Tiles, Tiles] | None = None
    """Logarithms of the stiffness, and logits of the contact area fraction."""

    measures: Mapping[str, LargerMeasure] = field(default_factory=dict)
    """What a larger surface has as well, by names; empty without tiles."""

    @property
    def intervals(self) -> Intervals | None:
        """Intervals that hold the larger surface; None where the piece does not tell of that."""
        found = intervals_within(self.values, self.spreads.values())
        unknown = found is None or np.isnan(found.unloading).all()
        return None if unknown else found

    @property
    def stiffness(self) -> InterfaceStiffness:
        """Stiffness of as much of it as the piece is large."""
        found = self.intervals
        return InterfaceStiffness(
            self.values.unloading,
            None if found is None else found.unloading,
            self.of_which,
            "dF/dd of the map in a periodic half-space under the same force, on unloading",
        )

    def from_many(self, further: Differences, causes: Iterable[str]) -> LargerSurface:
        """What many pieces leave open, beside some causes of each that are known of it."""
        measures, floors = {}, {}
        for name, ends in further.measures.items():
            measures[name] = self.measures[name].moved(ends)
            floors[name] = self.measures[name].floor
        spreads = {name: self.spreads[name] for name in causes if self.spreads[name] is not None}
        others = spread_of_differences(
            self.values, further.stiffness, further.area, measures, floors
        )
        return replace(self, spreads={**spreads, "places": others})


def stiffness_of_the_piece(
    body: Body,
    curve: Curve,
    punch: float = math.nan,
    interval: Ends | None = None,
    *,
    is_layered: bool = False,
) -> InterfaceStiffness:
    """Interface stiffness of a free body as it is, 1 / k_i = 1 / k - 1 / k_s.

    k_s is that of the flat punch of a surface; without it nothing is known. Where the stiffness
    differs from the punch's by less than the grid's error of the punch, the upper end of the
    interval is infinite; `interval` is that of the stiffness on unloading. [N / m]
    """
    k = Values.of(curve).unloading
    if isinstance(body, Line):
        saturated, error, warned_from = curve.E_star * body.length, 0.0, 0.0
        place = Fact("reduced_line_alone")
    else:
        saturated, warned_from = punch, _PUNCH_MATTERS
        # as a share of k_s, which is a little more
        error = PUNCH_GRID_ERROR / math.sqrt(body.heights.size)
        place = Fact("piece_alone", is_layered=is_layered)
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


def flat_punch(surface: Surface) -> tuple[Surface, float]:
    """Return the flat punch with the outline and grid of a surface, and a depth to press it to."""
    flat = Surface(np.zeros(surface.shape), surface.sizes, surface.unit, is_cut_out=False)
    return flat, math.sqrt(surface.area) * 1e-6


def punch_name(surface: Surface) -> str:
    """Name of the variant that is the flat punch with the outline and grid of a surface."""
    return f"flat punch of {surface.shape[0]} x {surface.shape[1]} points"


def which_surface(
    extrapolation: Extrapolation, of: Literal["stiffness", "gap"] = "stiffness"
) -> Fact:
    """Say which larger surface is meant, and how much of its waves the map holds."""
    if extrapolation.roll_offs is not None:
        return Fact("larger_surface_behind", roll_offs=extrapolation.roll_offs)
    times = 2**extrapolation.doublings
    if extrapolation.assembly is None:
        return Fact("some_larger_surface", times=times, of=of)
    if extrapolation.is_supported:
        return Fact("joint_in_reach", times=times, assembly=extrapolation.assembly)
    least = 2**MOST_DOUBLINGS
    return Fact("joint_out_of_reach", times=times, assembly=extrapolation.assembly, least=least)
