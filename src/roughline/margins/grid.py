"""The grid: finer ones would have other stiffness and area, as coarser ones tell."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.contact.curve import SurfaceCurve
from roughline.contact.quantities import RESOLVED_FROM
from roughline.engineering.intervals import Ends, Intervals
from roughline.facts.fact import Fact
from roughline.margins.cause import Cause
from roughline.margins.spread import Spread, Values, intervals_within
from roughline.margins.variant import Curves
from roughline.question.assumptions import broken
from roughline.question.case import COARSENED_FROM, Case

_UNSURE_RATIO = 5.0  # of both ends; above, a stiffness near full contact may be infinite


class FinerGrid(Cause):
    """A finer grid would show shorter waves; coarser ones are pressed with the body itself."""

    name = "grid"
    title = "the grid"
    remedy = "finer pixels"

    def spread(self, case: Case, curves: Curves, variant: str) -> Spread | None:
        """Both ends that finer grids leave open; None where their errors were not estimated."""
        curve = curves.get(variant)
        return None if curve is None or broken("grid", case.body) else spread_of_grid(curve)

    def facts(self, case: Case, curves: Curves) -> Sequence[Fact]:
        """Why its error is not known, and under which loads it resolves no gap, or few."""
        curve = curves.as_asked
        if not isinstance(curve, SurfaceCurve):
            return ()
        asked = case.loads.asked_loads(curve)
        names = case.question.loading.names_of_loads(asked.tolist())
        found = list(facts_on_full_contact(curve, case.body.heights.size, asked, names))
        if curve.stiffness_error is None:
            found.append(Fact("grid_error_unknown", why=_why_unknown(case), points=COARSENED_FROM))
        return found


def _why_unknown(case: Case) -> str:
    """Why the error of the grid is not known."""
    if case.loads.grid_error:
        return "interrupted"
    if case.question.grid_error is not None:
        return "switched off"
    return "few points" if min(case.body.heights.shape) < COARSENED_FROM else "takes long"


def facts_on_full_contact(
    curve: SurfaceCurve, points: int, loads: Indices, names: Sequence[str]
) -> Iterator[Fact]:
    """Say under which loads all points touch, or all but a few."""
    # what repeats along both axes, and whose mean is not free, stands on a rigid base
    stands = "on base" if all(curve.half_space.repeats) else "punch"
    stands = "free" if curve.half_space.mean_is_free else stands
    open_points = np.rint((1 - curve.area_fraction[loads]) * points)
    found = list(zip(names, open_points, strict=True))
    if full := tuple(name for name, n in found if n == 0):
        yield Fact("all_touch", loads=full, stands=stands)
    if nearly := tuple(name for name, n in found if 0 < n < RESOLVED_FROM):
        yield Fact("nearly_all_touch", loads=nearly, points=RESOLVED_FROM)


def spread_of_grid(curve: SurfaceCurve) -> Spread | None:
    """Both ends that finer grids leave open of a curve; None where that was not estimated."""
    area, of_area = curve.area_fraction_corrected, curve.area_fraction_error
    k, of_k = curve.stiffness, curve.stiffness_error
    k_u, of_k_u = curve.unloading_stiffness, curve.unloading_stiffness_error
    if of_area is None or of_k is None or of_k_u is None:
        return None
    low, high = _interval(area, of_area)
    stiffness, unloading = _interval(k, of_k), _interval(k_u, of_k_u)
    if curve.half_space.mean_is_free:  # a full contact is infinitely stiff
        stiffness, unloading = (_open(ends, high >= 1) for ends in (stiffness, unloading))
    # whole cells overstate an area under summits, and finer waves take away from it
    most = curve.area_fraction_most
    measures = {
        name: (each.low, each.high)
        for name, each in curve.measured.items()
        if each.low is not None and each.high is not None
    }
    return Spread(stiffness, unloading, (low, np.minimum(high, most)), measures)


def intervals_of_grid(curve: SurfaceCurve) -> Intervals | None:
    """Intervals of a curve that its grid leaves open; None where that was not estimated."""
    return intervals_within(Values.of(curve), [spread_of_grid(curve)])


def _interval(value: Real, error: Real) -> Ends:
    """Both ends of an interval, v / (1 + e / v) and v + e: nothing positive gets below zero."""
    with np.errstate(invalid="ignore"):
        return np.where(value == 0, 0.0, value / (1 + error / value)), value + error


def _open(ends: Ends, may_be_full: Mask) -> Ends:
    """Ends of a stiffness, without an upper one where contact may be full and little is known."""
    unsure = ends[1] > _UNSURE_RATIO * ends[0]
    return ends[0], np.where(may_be_full & unsure, np.inf, ends[1])
