"""What the curves of a case's variants say: its curve, intervals, and the surface behind it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughline.assessment.assumptions import broken
from roughline.assessment.case import Case
from roughline.assessment.larger_surface import LargerSurface, larger_surface
from roughline.assessment.line_scan import press_scan
from roughline.assessment.loads import LoadCase, asked_loads
from roughline.assessment.notes import is_scan_that_yields
from roughline.assessment.source import Topography
from roughline.assessment.tiles import Tiles, coarse_shape, has_tiles, tiles_from
from roughline.assessment.uncertainty import Changes, change, intervals_of
from roughline.assessment.variants import (
    AS_ASKED,
    COARSE,
    Curves,
    filled_otherwise,
    periodic,
    tile,
)
from roughline.contact.curve import Curve
from roughline.contact.selection import among_loads
from roughline.engineering.intervals import Intervals
from roughline.topography.body import Body, Line, Surface
from roughline.topography.missing import Missing

_SMALL = 0.001  # changes below this are reported as less than this [%]


@dataclass(frozen=True, eq=False)
class Solution:
    """A curve, its intervals, and the larger surface behind its body.

    Attributes
    ----------
    curve : Curve
        Loads that failed are marked.
    intervals : Intervals or None
        Of the curve; None where the grid's errors are not known.
    larger : LargerSurface or None
        Over the loads of the curve; None where the answers are not about a larger surface.
    note : str
        What another way to fill missing points changes, if that was tried.
    """

    curve: Curve
    intervals: Intervals | None
    larger: LargerSurface | None = None
    note: str = ""


def solution_of(case: Case, curves: Curves) -> Solution:
    """The solution of a case from the curves of its variants."""
    curve = curves.as_asked
    intervals, note = _with_filling(case, curves, AS_ASKED, case.body)
    larger = larger_behind(case, curves, AS_ASKED, case.loads)
    if larger is not None and case.question.joint is not None and intervals is not None:
        # the map is pressed as a part of the joint, and is uncertain as that is
        intervals = larger.intervals(curve)
    return Solution(curve, intervals, larger, note)


def solution_of_scan(case: Case, body: Line) -> Solution:
    """Press a line scan, of one or of two bodies, through its spectrum.

    There is no interval where it is so steep that metals yield.
    """
    second = case.parts[1].body if len(case.parts) > 1 else None
    against = second if isinstance(second, Line) else None
    scan = press_scan(body, E_star=case.loads.E_star, forces=case.loads.forces, against=against)
    ends = scan.low, scan.high
    known = not (np.isnan(scan.low).any() or is_scan_that_yields(case.question, body))
    return Solution(scan.curve, Intervals(ends, ends) if known else None)


def larger_behind(case: Case, curves: Curves, name: str, loads: LoadCase) -> LargerSurface | None:
    """The larger surface behind the body of a variant, over the loads that it was pressed under."""
    body, curve = case.map, curves.by_name[name]
    if body is None:
        return None
    borne, repeated = loads.borne(curve), name if loads.periodic else periodic(name)
    whole = curves.get(repeated)
    intervals = tiles = None
    if whole is None:  # no load is borne, or Ctrl-C came before
        whole = replace(curve, unloading_stiffness=np.full(borne.size, np.nan))
    elif loads.grid_error:
        intervals, _ = _with_filling(case, curves, repeated, body)
        tiles = _tiles(case, curves, whole, body) if intervals is not None else None
    beyond = case.beyond
    ends = (intervals.unloading, intervals.area) if intervals else (None, None)
    larger = larger_surface(whole, beyond, tiles, *ends)
    if not beyond.is_told or broken("larger surface", body):
        larger = larger.without_interval
    if larger.stiffness.values.size < borne.size:  # loads that failed before have no force
        larger = larger.among(borne)
    return larger


def _with_filling(
    case: Case, curves: Curves, name: str, body: Body
) -> tuple[Intervals | None, str]:
    """Intervals of a variant with the effect of the other filling, and a note on that."""
    curve, other = curves.by_name[name], curves.get(filled_otherwise(name))
    changes, note = Changes(), ""
    if other is not None:
        asked = asked_loads(case.loads, curve.status.size)
        stiffness, share = change(curve.stiffness, other.stiffness, asked)
        unloading, _ = change(curve.unloading_stiffness, other.unloading_stiffness, asked)
        area, area_share = change(
            curve.area_fraction_corrected, other.area_fraction_corrected, asked
        )
        changes = Changes(stiffness, unloading, area)
        method = Missing(case.parts[0].reading.missing).other
        note = (
            f"with missing points filled by {method} instead, stiffness changes by "
            f"{_at_most(share)}, area by {_at_most(area_share)}"
        )
    elif case.filled and curves.stopped != name:
        note = _why_filling_changes_nothing(case.filled)
    return None if broken("grid", body) else intervals_of(curve, changes), note


def _tiles(case: Case, curves: Curves, curve: Curve, body: Surface) -> tuple[Tiles, Tiles] | None:
    """What the tiles of a map say, over the loads of its periodic curve; None if not known."""
    if not has_tiles(body):
        return None
    shape = coarse_shape(body.shape)
    borne = case.loads.borne(curve)

    def spread(name: str) -> Curve | None:
        found = curves.whole(name)
        return None if found is None else among_loads(found, borne)

    whole = curve if shape == body.shape else spread(COARSE)
    halves, quarters = (
        [each for i in range(count**2) if (each := spread(tile(count, i))) is not None]
        for count in (2, 4)
    )
    if whole is None or len(halves) < 4 or len(quarters) < 16:
        return None
    return tiles_from(whole, halves, quarters, shape[0] * shape[1])


def _why_filling_changes_nothing(topographies: Sequence[Topography]) -> str:
    """Say why the other filling gives the same body."""
    if all(each.measurement is not None for each in topographies if each.is_filled):
        return "no filled point is left in the piece that is pressed"
    before = "before the file was written" if topographies[0].file else "before"
    return f"the points were filled {before}: the effect of their filling is not known"


def _at_most(per_cent: float) -> str:
    return f"up to {per_cent:.2g}%" if per_cent >= _SMALL else f"less than {_SMALL}%"
