"""The grid: finer ones would have other stiffness and area, as coarser ones tell."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from roughline.computing.arrays import Indices, Mask, Real
from roughline.contact.curve import SurfaceCurve
from roughline.contact.grid_error import (
    AS_STEEP,
    COARSER,
    STAGES,
    GridStudy,
    halved,
    refuse_few_points,
)
from roughline.contact.pressing import Pressing
from roughline.contact.quantities import RESOLVED_FROM
from roughline.engineering.intervals import Ends, Intervals
from roughline.facts.fact import Fact
from roughline.margins.cause import Cause
from roughline.margins.sheared import ShearedBody
from roughline.margins.spread import Spread, Values, intervals_within
from roughline.margins.variant import Curves, Variant
from roughline.question.assumptions import broken
from roughline.question.case import COARSENED_FROM, Case
from roughline.question.loads import LoadCase
from roughline.topography.body import Surface

_SHARES = {COARSER: 9 / 16, AS_STEEP: 1 / 2}
"""Points of what is pressed in these stages over those of the surface; of others, as many."""

_UNSURE_RATIO = 5.0  # of both ends; above, a stiffness near full contact may be infinite


class FinerGrid(Cause):
    """A finer grid would show shorter waves, as coarser ones and steeper bodies tell."""

    name = "grid"
    title = "the grid"
    remedy = "finer pixels"
    takes = "for coarser grids"

    def presses(self, case: Case, pressed: Variant) -> Sequence[Variant]:
        """What tells how far the curve of a variant may differ; then that curve, with its errors.

        Raises
        ------
        InputError
            If the body has too few points.
        """
        if not case.loads.grid_error or not isinstance(case.body, Surface):
            return ()
        refuse_few_points(case.body)
        of_grid = replace(pressed, purpose=self.name)
        listed = [
            replace(
                of_grid,
                name=_staged(pressed, stage),
                needed=partial(_pressed_in_stage, pressed, stage),
                share=_SHARES.get(stage, 1.0),
            )
            for stage in STAGES
        ]
        return [*listed, replace(of_grid, needed=partial(_with_errors, pressed), share=0.0)]

    def opens_shear(self, case: Case) -> bool:
        """Always: spots of few points do not slip bit by bit."""
        return True

    def sheared(self, case: Case, asked: ShearedBody) -> ShearedBody | None:
        """The path on half as many points a side, which need not resolve a layer.

        Where other causes leave the same open and are not known, it would not tell how far.
        """
        body, question = asked.body, case.question
        is_known = question.joint is None and not broken("grid", body)
        if not (case.loads.grid_error and is_known) or question.coated:
            return None
        return replace(asked, body=halved(body))

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


def _staged(pressed: Variant, stage: str) -> str:
    """Name of what is pressed in a stage."""
    return f"{pressed.name}, {stage}"


def _study(pressed: Variant, curves: Curves) -> tuple[LoadCase, GridStudy, SurfaceCurve] | None:
    """Loads of a variant, its study and its curve under these; None if nothing presses it."""
    loads, curve = pressed.needed(curves), curves.get(pressed.name)
    if not isinstance(loads, LoadCase) or curve is None:
        return None
    alone = loads.alone(curve)
    return (loads, GridStudy(loads.pressing()), alone) if alone.force.size else None


def _found(pressed: Variant, curves: Curves) -> dict[str, Sequence[SurfaceCurve]]:
    """Curves of the stages that are done."""
    return {stage: curves.of_pieces.get(_staged(pressed, stage), ()) for stage in STAGES}


def _pressed_in_stage(pressed: Variant, stage: str, curves: Curves) -> Sequence[Pressing] | None:
    """What is pressed in a stage."""
    if (study := _study(pressed, curves)) is None:
        return None
    return study[1].presses(stage, study[2], _found(pressed, curves))


def _with_errors(pressed: Variant, curves: Curves) -> SurfaceCurve | None:
    """The curve of a variant with its errors, which are not known of loads that lift the body."""
    if (curve := curves.get(pressed.name)) is None:
        return None
    if (study := _study(pressed, curves)) is None:
        unknown = np.full(curve.force.shape, np.nan)
        return replace(
            curve,
            stiffness_error=unknown,
            unloading_stiffness_error=unknown,
            area_fraction_error=unknown,
        )
    loads, of_grid, alone = study
    found = loads.spread(of_grid.concluded(alone, _found(pressed, curves)))
    return replace(found, fields=curve.fields, dents=curve.dents, residual_of=curve.residual_of)


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
