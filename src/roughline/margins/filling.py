"""Points that were missing, and filled: another way to fill them, and the force that they bear."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from roughline.assessment.case import Case
from roughline.assessment.loads import LoadCase
from roughline.computing.arrays import Indices, Mask, Real
from roughline.contact.curve import Curve
from roughline.contact.fields import Fields
from roughline.contact.measures import Measure
from roughline.facts.fact import Fact
from roughline.facts.intervals import filled_before, filling_matters, no_filled_point_left
from roughline.margins.cause import Cause
from roughline.margins.spread import Spread, Values
from roughline.margins.variant import AS_ASKED, Curves, Variant
from roughline.question.source import pressed_body
from roughline.topography.body import Surface

_ON_FILLED = "force_on_filled"  # name of the measure, among those of the curve as asked
_SHARE_IN_INTERVALS = 0.1  # of the force, from which on intervals hold that it stands elsewhere
_SMALLEST_CHANGE = 0.001  # changes below this are reported as less than this [%]


class FilledPoints(Cause):
    """Missing points may be filled otherwise, and nobody measured what stands on them."""

    name = "filling"
    title = "the points that were missing, and filled"
    remedy = "a map with fewer missing points"
    takes = "with missing points filled otherwise"

    def presses(self, case: Case, pressed: Variant) -> Sequence[Variant]:
        """The same body with missing points filled by the other method."""
        if not case.filled or not isinstance(case.body, Surface):
            return ()
        needed = partial(_filled_otherwise, case, pressed)
        name = _filled(pressed.name)
        return [replace(pressed, name=name, purpose=self.name, needed=needed)]

    def spread(self, case: Case, curves: Curves, variant: str) -> Spread | None:
        """How far the other filling is away, and what force on filled points leaves open."""
        curve, other = curves.get(variant), curves.get(_filled(variant))
        if curve is None:
            return None
        share, values = force_on_filled(curves), Values.of(curve)
        more = 0.0 if share is None else _relative_error(share)
        return Spread.between(values, [values if other is None else Values.of(other)], more=more)

    def facts(self, case: Case, curves: Curves) -> Sequence[Fact]:
        """What the other filling changes, or why that is not known."""
        curve, other = curves.get(AS_ASKED), curves.get(_filled(AS_ASKED))
        if curve is not None and other is not None:
            loads = case.loads.asked_loads(curve)
            stiffness = _most_changed(curve.stiffness, other.stiffness, loads)
            area = _most_changed(
                curve.area_fraction_corrected, other.area_fraction_corrected, loads
            )
            method = case.parts[0].reading.missing.other
            return [filling_matters(method, stiffness, area, _SMALLEST_CHANGE)]
        if curve is None or not case.filled or curves.stopped == AS_ASKED:
            return ()
        if all(each.measurement is not None for each in case.parts if each.is_filled):
            return [no_filled_point_left()]
        return [filled_before(is_of_file=bool(case.parts[0].file))]


def force_on(points: Mask) -> Measure:
    """The share of the force that stands on some points, as a measure."""

    def share(fields: Fields) -> float:
        pushed = np.maximum(fields.pressure, 0.0)
        if pushed.shape != points.shape:  # coarser, to judge the grid
            return math.nan
        return float(pushed[points].sum() / pushed.sum()) if pushed.any() else 0.0

    return Measure(_ON_FILLED, "s_f", "1", "share of the force that stands on filled points", share)


def force_on_filled(curves: Curves) -> Real | None:
    """Share of the force that stands on filled points; None where that is not known. [1]"""
    curve = curves.get(AS_ASKED)
    filled = None if curve is None else curve.measured.get(_ON_FILLED)
    return None if filled is None else filled.values


def _filled(name: str) -> str:
    """Name of the variant that is pressed as another, but with missing points filled otherwise."""
    return f"{name}, filled otherwise"


def _filled_otherwise(case: Case, variant: Variant, curves: Curves) -> LoadCase | Curve | None:
    """Press with missing points filled by the other method, if that changes something."""
    first, curve = variant.needed(curves), curves.get(variant.name)
    if not isinstance(first, LoadCase) or curve is None:
        return None
    method = case.parts[0].reading.missing.other
    other = pressed_body([each.filled_by(method) for each in case.filled])
    if np.array_equal(other.heights, case.body.heights):
        return None
    if first.n_loads is not None and curve.converged.all():
        first = first.under_forces_from(curve)  # the same forces, not new ones
    return replace(first, body=other, fields=(), grid_error=False)


def _relative_error(share: Real) -> Real:
    """By how much answers may differ if a share of the force stands elsewhere, relative to them.

    What was measured carries the rest, so that values are known to a factor 1 / (1 - s).
    """
    with np.errstate(divide="ignore"):
        return np.where(share > _SHARE_IN_INTERVALS, share / (1 - share), 0.0)


def _most_changed(before: Real, after: Real, loads: Indices) -> float:
    """By how many per cent the loads that were asked for change at most."""
    with np.errstate(invalid="ignore", divide="ignore"):  # infinite in full contact
        changed = np.where(after == before, 0.0, np.abs(after / before - 1))
        return 100 * float(np.nanmax(changed[loads], initial=0.0))
