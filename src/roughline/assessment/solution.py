"""What the curves of a case's variants say: its curve, intervals, and the surface behind it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from roughline.assessment.assumptions import broken
from roughline.assessment.case import Case
from roughline.assessment.filled import ON_FILLED, relative_error
from roughline.assessment.larger_measure import LargerMeasure
from roughline.assessment.larger_surface import LargerSurface, larger_surface, which_surface
from roughline.assessment.line_scan import press_scan
from roughline.assessment.notes import line_scan_limits
from roughline.assessment.slip import slip_at_largest_load
from roughline.assessment.tiles import TiledCurves, coarse_shape
from roughline.assessment.uncertainty import change, estimate_intervals
from roughline.assessment.variants import Curves, Way, filled_otherwise, periodic, tile
from roughline.computing.arrays import Indices, Real
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.fields import Fields
from roughline.contact.measures import Measured
from roughline.contact.selection import first_fields
from roughline.engineering.intervals import Intervals
from roughline.engineering.pressed import Sought
from roughline.facts.fact import Fact
from roughline.facts.intervals import filled_before, filling_matters, no_filled_point_left
from roughline.question.source import Topography
from roughline.topography.body import Body, Line, Surface

_SMALLEST_CHANGE = 0.001  # changes below this are reported as less than this [%]


@dataclass(frozen=True, eq=False)
class Solution:
    """A curve, its intervals, and the larger surface behind its body, over the loads of a case."""

    curve: Curve
    intervals: Intervals | None  # None where the grid's errors are not known
    larger: LargerSurface | None = None  # None where the answers are not about a larger surface
    measured: Mapping[str, Measured] = field(default_factory=dict)
    place: Fact | None = None  # the surface that these are of; None for the map alone
    sought: Sought = field(default_factory=Sought)
    on_filled: Real | None = None  # share of the force that stands on filled points, if known [1]
    note: Fact | None = None  # what another way to fill missing points changes, if that was tried


def combine_curves(case: Case, curves: Curves) -> Solution:
    """The solution of a case from the curves of its variants."""
    curve = curves.as_asked
    intervals, note = _with_filling(case, curves, Way.AS_ASKED, case.body)
    measured = variant_measures(case, curves, Way.AS_ASKED, are_known=intervals is not None)
    larger, place = larger_behind(case, curves, Way.AS_ASKED), None
    if larger is not None and larger.measures:
        extrapolation = case.gap_extrapolation if case.tells_of_larger else None
        of_larger = {
            key: each.with_larger_surface(extrapolation) for key, each in larger.measures.items()
        }
        measured, place = {**measured, **of_larger}, which_surface(case.gap_extrapolation, "gap")
    is_part = case.question.joint is not None and intervals is not None
    if larger is not None and is_part and isinstance(curve, SurfaceCurve):
        # the map is pressed as a part of the joint, and is uncertain as that is
        intervals = larger.intervals(curve)
    sought = replace(
        curves.sought.get(Way.AS_ASKED, Sought()), slip=slip_at_largest_load(case, curves)
    )
    return Solution(curve, intervals, larger, measured, place, sought, _on_filled(curves), note)


def solve_scan(case: Case, body: Line) -> Solution:
    """Press a line scan, of one or of two bodies, through its spectrum.

    There is no interval where it is so steep that metals yield.
    """
    second = case.parts[1].body if len(case.parts) > 1 else None
    against = second if isinstance(second, Line) else None
    scan = press_scan(
        body, E_star=case.loads.half_space.E_star, forces=case.loads.forces, against=against
    )
    ends = scan.low, scan.high
    is_too_steep = any(each.is_grave for each in line_scan_limits(case.question, body))
    known = not (is_too_steep or np.isnan(scan.low).any())
    sought = Sought(slip=slip_at_largest_load(case, Curves({Way.AS_ASKED: scan.curve})))
    return Solution(scan.curve, Intervals(ends, ends) if known else None, sought=sought)


def larger_behind(case: Case, curves: Curves, name: str) -> LargerSurface | None:
    """The larger surface behind the body of a variant."""
    body, curve = case.map, curves.by_name[name]
    if body is None or not isinstance(curve, SurfaceCurve):
        return None
    repeated = name if case.loads.periodic else periodic(name)
    map_curve = curves.get(repeated)
    intervals = tiled = None
    if map_curve is None:  # no load is borne, or Ctrl-C came before
        map_curve = replace(curve, unloading_stiffness=np.full(curve.status.size, np.nan))
    elif case.loads.grid_error:
        intervals, _ = _with_filling(case, curves, repeated, body)
        tiled = _tiled(curves, map_curve, body) if intervals is not None else None
    extrapolation = case.extrapolation
    ends = (intervals.unloading, intervals.area) if intervals else (None, None)
    tiles = tiled.stiffness_and_contact() if tiled is not None else None
    larger = larger_surface(map_curve, extrapolation, tiles, *ends)
    if tiled is not None:
        of_map = variant_measures(case, curves, name, are_known=True)
        names = [each.name for each in case.measures if each.intensive]
        measures = {each: LargerMeasure.of(of_map[each], tiled) for each in names}
        larger = replace(larger, measures=measures)
    if extrapolation.is_supported and case.tells_of_larger:
        return larger
    return replace(larger, stiffness=larger.stiffness.without_interval, area=None)


def variant_measures(
    case: Case, curves: Curves, name: str, *, are_known: bool = False
) -> Mapping[str, Measured]:
    """Measures of a variant, or of the same pressed periodically, with intervals if `are_known`.

    These are what the grid and the other filling of missing points leave open.
    """
    name = _measured_on(case, name)
    curve, other = curves.get(name), curves.get(filled_otherwise(name))
    if curve is None:
        return {}
    taken = {each.name: curve.measured[each.name] for each in case.measures}
    if not are_known:
        return {key: replace(each, low=None, high=None) for key, each in taken.items()}
    moved, unsure = curve.measured if other is None else other.measured, _unsure(curves)
    return {key: _beside(each, moved[key].values, unsure) for key, each in taken.items()}


def fields_of_gap(case: Case, curves: Curves) -> Fields | None:
    """Fields of one load of the contact that the measures of the body as asked are of."""
    curve = curves.get(_measured_on(case, Way.AS_ASKED))
    return None if curve is None else first_fields(curve)


def _measured_on(case: Case, name: str) -> str:
    """Name of the variant whose gap answers for a variant: itself, or the same periodically."""
    return periodic(name) if case.is_repeated_for_interface else name


def _unsure(curves: Curves) -> Real | float:
    """By how much all values may differ, as force stands on points that nobody measured. [1]"""
    share = _on_filled(curves)
    return 0.0 if share is None else relative_error(share)


def _on_filled(curves: Curves) -> Real | None:
    """Share of the force that stands on filled points; None where that is not known. [1]"""
    curve = curves.get(Way.AS_ASKED)
    filled = None if curve is None else curve.measured.get(ON_FILLED)
    return None if filled is None else filled.values


def _beside(measured: Measured, other: Real, unsure: Real | float) -> Measured:
    """A measure with both ends so much wider as another choice moves its values, independently.

    Relative to the values, they are unsure by more.
    """
    if measured.low is None or measured.high is None:
        return measured
    values, moved = measured.values, change(measured.values, other, unsure)
    least = np.minimum(measured.low, other)
    low = np.maximum(values - np.hypot(values - measured.low, moved), np.minimum(least, 0.0))
    return replace(measured, low=low, high=values + np.hypot(measured.high - values, moved))


def _with_filling(
    case: Case, curves: Curves, name: str, body: Body
) -> tuple[Intervals | None, Fact | None]:
    """Intervals of a variant with the effect of the other filling, and a note on that."""
    curve, other, note = curves.get(name), curves.get(filled_otherwise(name)), None
    if curve is None:
        return None, note
    if other is not None:
        loads = case.loads.asked_loads(curve)
        stiffness = _most_changed(curve.stiffness, other.stiffness, loads)
        area = _most_changed(curve.area_fraction_corrected, other.area_fraction_corrected, loads)
        method = case.parts[0].reading.missing.other
        note = filling_matters(method, stiffness, area, _SMALLEST_CHANGE)
    elif case.filled and curves.stopped != name:
        note = _why_filling_changes_nothing(case.filled)
    if broken("grid", body):
        return None, note
    return estimate_intervals(curve, other, _unsure(curves)), note


def _most_changed(before: Real, after: Real, loads: Indices) -> float:
    """By how many per cent the loads that were asked for change at most."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return 100 * float(np.nanmax((change(before, after) / before)[loads], initial=0.0))


def _tiled(curves: Curves, map_curve: SurfaceCurve | None, body: Surface) -> TiledCurves | None:
    """Curves of a map and of its tiles, from its periodic curve; None if one is not known."""
    shape = coarse_shape(body.shape)
    if shape != body.shape:
        map_curve = curves.complete(Way.COARSE)
    halves, quarters = (
        [each for i in range(count**2) if (each := curves.complete(tile(count, i))) is not None]
        for count in (2, 4)
    )
    if map_curve is None or len(halves) < 4 or len(quarters) < 16:
        return None
    border = curves.complete(Way.BORDER)
    return TiledCurves(map_curve, halves, quarters, shape[0] * shape[1], border)


def _why_filling_changes_nothing(topographies: Sequence[Topography]) -> Fact:
    """Say why the other filling gives the same body."""
    if all(each.measurement is not None for each in topographies if each.is_filled):
        return no_filled_point_left()
    return filled_before(is_of_file=bool(topographies[0].file))
