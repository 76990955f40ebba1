"""Points that were missing, and filled: another way to fill them, and the force that they bear."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.contact.fields import Fields
from roughline.contact.measures import Measure
from roughline.facts.fact import Fact
from roughline.margins.cause import OtherBodies
from roughline.margins.sheared import ShearedBody
from roughline.margins.variant import AS_ASKED, Curves, Variant
from roughline.question.case import Case
from roughline.question.source import pressed_body
from roughline.topography.body import Surface

_ON_FILLED = "force_on_filled"  # name of the measure, among those of the curve as asked
_SHARE_IN_INTERVALS = 0.1  # of the force, from which on intervals hold that it stands elsewhere
_WARNED_SHARE = 0.05  # of the force, from which on a warning says so
_GRAVE_SHARE = 0.5  # from which on answers are of heights that nobody measured
_SMALLEST_CHANGE = 0.001  # changes below this are reported as less than this [%]


class FilledPoints(OtherBodies):
    """Missing points may be filled otherwise, and nobody measured what stands on them."""

    name = "filling"
    title = "the points that were missing, and filled"
    remedy = "a map with fewer missing points"
    takes = "with missing points filled otherwise"

    def presses(self, case: Case, pressed: Variant) -> Sequence[Variant]:
        """The same body filled otherwise, if points of it were missing."""
        return super().presses(case, pressed) if case.filled else ()

    def body(self, case: Case, i: int) -> Surface:
        """The same body with missing points filled by the other method."""
        method = case.parts[0].reading.missing.other
        found = pressed_body([each.filled_by(method) for each in case.filled])
        assert isinstance(found, Surface)
        return found

    def opens_shear(self, case: Case) -> bool:
        """Whether points were missing."""
        return bool(case.filled)

    def sheared(self, case: Case, asked: ShearedBody) -> ShearedBody:
        """The body filled otherwise, unless much of the force stands on what nobody measured."""
        other = self.body(case, 0)
        same = np.array_equal(other.heights, asked.body.heights)  # as where a file came filled
        return replace(asked, body=asked.body if same else other, tells=_stands_on_measured)

    def more(self, curves: Curves) -> Real | float:
        """What force that stands on filled points leaves open, relative to the values. [1]"""
        share = force_on_filled(curves)
        return 0.0 if share is None else _relative_error(share)

    def facts(self, case: Case, curves: Curves) -> Sequence[Fact]:
        """How much stands on filled points, and what another filling changes, if it is known."""
        return [*_on_filled_points(case, curves), *self._changes(case, curves)]

    def _changes(self, case: Case, curves: Curves) -> Sequence[Fact]:
        """What the other filling changes, or why that is not known."""
        curve, others = curves.get(AS_ASKED), self.pressed(curves, AS_ASKED)
        if curve is None or not case.filled or curves.stopped == AS_ASKED:
            return ()
        if others:
            method, loads = case.parts[0].reading.missing.other, case.loads.asked_loads(curve)
            stiffness, area = (
                _most_changed(getattr(curve, name), getattr(others[0], name), loads)
                for name in ("stiffness", "area_fraction_corrected")
            )
            changes = {"stiffness": stiffness, "area": area, "least": _SMALLEST_CHANGE}
            return [Fact("filling_matters", method=method, **changes)]
        if all(each.measurement is not None for each in case.parts if each.is_filled):
            return [Fact("no_filled_point_left")]
        return [Fact("filled_before", is_of_file=bool(case.parts[0].file))]


def _on_filled_points(case: Case, curves: Curves) -> list[Fact]:
    """Say under which load most of the force stands on points that nobody measured."""
    if (found := force_on_filled(curves)) is None:
        return []
    asked = case.loads.asked_loads(curves.as_asked)
    shares = found[asked]
    most = int(np.argmax(np.nan_to_num(shares)))
    if not (share := float(shares[most])) > _WARNED_SHARE:
        return []
    load = case.question.loading.names_of_loads(asked.tolist())[most]
    return [Fact("on_filled_points", load=load, share=share).grave(share > _GRAVE_SHARE)]


def force_on(points: Mask) -> Measure:
    """The share of the force that stands on some points, as a measure."""

    def share(fields: Fields) -> float:
        pushed = np.maximum(fields.pressure, 0.0)
        return float(pushed[points].sum() / pushed.sum()) if pushed.any() else 0.0

    meaning = "share of the force that stands on filled points"
    return Measure(_ON_FILLED, "s_f", "1", meaning, share, of_this_grid=True)


def force_on_filled(curves: Curves) -> Real | None:
    """Share of the force that stands on filled points; None where that is not known. [1]"""
    curve = curves.get(AS_ASKED)
    filled = None if curve is None else curve.measured.get(_ON_FILLED)
    return None if filled is None else filled.values


def _stands_on_measured(curves: Curves) -> bool:
    """Whether so little of the force stands on filled points that it is as if it stood on others.

    Where more of it does, what slips there is not known.
    """
    share = force_on_filled(curves)
    return share is not None and not (share > _SHARE_IN_INTERVALS).any()


def _relative_error(share: Real) -> Real:
    """By how much answers may differ if a share of the force stands elsewhere, relative to them.

    What was measured carries the rest, so that values are known to a factor 1 / (1 - s).
    """
    with np.errstate(divide="ignore"):
        return np.where(share > _SHARE_IN_INTERVALS, share / (1 - share), 0.0)


def _most_changed(before: Real, after: Real, loads: Indices) -> float | None:
    """By how many per cent the loads that were asked for change at most; None for next to none."""
    with np.errstate(invalid="ignore", divide="ignore"):  # infinite in full contact
        changed = np.where(after == before, 0.0, np.abs(after / before - 1))
        most = 100 * float(np.nanmax(changed[loads], initial=0.0))
    return most if most >= _SMALLEST_CHANGE else None
