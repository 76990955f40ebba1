"""What the curves of a case say: values, what causes leave open of them, and the larger surface."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from roughline.assessment.slip import slip_at_largest_load
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.fields import Fields
from roughline.contact.measures import Measured
from roughline.contact.selection import first_fields
from roughline.engineering.intervals import Intervals
from roughline.engineering.pressed import Sought
from roughline.facts.fact import Fact
from roughline.margins.causes import causes
from roughline.margins.larger_surface import LargerSurface, punch_name, which_surface
from roughline.margins.place import measures_of_tiles, tiled_curves
from roughline.margins.scans import limits_of_line, press_scan
from roughline.margins.spread import Spread, Values, intervals_within, measured_within
from roughline.margins.variant import AS_ASKED, Curves, larger_name
from roughline.question.case import Case
from roughline.topography.body import Line


@dataclass(frozen=True, eq=False)
class LeftOpen:
    """What independent causes leave open, by their names; None where that is not known."""

    of_map: Mapping[str, Spread | None]  # of the body as it was asked for, alone
    of_larger: Mapping[str, Spread | None]  # of the surface that it was cut out of

    @classmethod
    def of(cls, case: Case, curves: Curves) -> LeftOpen:
        """Ask all causes."""
        repeated = larger_name(case, AS_ASKED)
        of_map = {
            each.name: each.spread(case, curves, AS_ASKED)
            for each in causes.independent
            if not each.is_of_larger
        }
        return cls(
            of_map, {each.name: each.spread(case, curves, repeated) for each in causes.independent}
        )

    def by(self, name: str) -> LeftOpen:
        """What one cause leaves open alone."""
        of_map, of_larger = (
            {name: each[name]} if name in each else {} for each in (self.of_map, self.of_larger)
        )
        return LeftOpen(of_map, of_larger)

    def probed(self, case: Case, curves: Curves) -> LeftOpen:
        """The same causes as if each moved all that they are of by a little."""
        found = []
        for name, spreads in (
            (AS_ASKED, self.of_map),
            (larger_name(case, AS_ASKED), self.of_larger),
        ):
            curve = curves.by_name.get(name)
            probe = None if curve is None else Spread.probe(Values.of(curve))
            found.append(dict.fromkeys(spreads, probe))
        return LeftOpen(*found)

    @property
    def is_known(self) -> bool:
        """Whether all that they leave open is known, under some load at least."""
        spreads = [*self.of_map.values(), *self.of_larger.values()]
        return all(each is not None and each.is_known for each in spreads)


@dataclass(frozen=True, eq=False)
class Solution:
    """A curve, its intervals, and the larger surface behind its body, over the loads of a case."""

    curve: Curve
    intervals: Intervals | None  # None where a cause is not known
    larger: LargerSurface | None = None  # None where the answers are not about a larger surface
    punch: float = math.nan  # stiffness of the flat punch of a surface, where it is known [N / m]
    measured: Mapping[str, Measured] = field(default_factory=dict)
    place: Fact | None = None  # the surface that these are of; None for the map alone
    sought: Sought = field(default_factory=Sought)


def combine_curves(
    case: Case, curves: Curves, left_open: LeftOpen | None, name: str = AS_ASKED
) -> Solution:
    """The solution of a case from the curves of a variant; without intervals if nothing is told."""
    curve, intervals = curves.by_name[name], None
    larger = _larger_behind(case, curves, left_open, name)
    if left_open is not None:
        intervals = intervals_within(Values.of(curve), left_open.of_map.values())
    if larger is not None and case.question.joint is not None and intervals is not None:
        # the map is pressed as a part of the joint, and is uncertain as that is
        intervals = larger.intervals
    place = None if larger is None or not larger.measures else case.gap_extrapolation
    return Solution(
        curve,
        intervals,
        larger,
        _punch(curves, curve),
        _measured(case, curves, left_open, larger, name),
        None if place is None else which_surface(place, "gap"),
        curves.sought.get(name, Sought()),
    )


def _punch(curves: Curves, curve: Curve) -> float:
    """Stiffness of the flat punch with the outline and grid of a curve's surface. [N / m]"""
    if not isinstance(curve, SurfaceCurve):
        return math.nan
    punch = curves.get(punch_name(curve.surface))
    return math.nan if punch is None else float(punch.stiffness[0])


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
    is_too_steep = any(each.is_grave for each in limits_of_line(case.question, body))
    known = not (is_too_steep or np.isnan(scan.low).any())
    sought = Sought(slip=slip_at_largest_load(case, Curves({AS_ASKED: scan.curve})))
    return Solution(scan.curve, Intervals(ends, ends) if known else None, sought=sought)


def _larger_behind(
    case: Case, curves: Curves, left_open: LeftOpen | None, name: str
) -> LargerSurface | None:
    """The larger surface behind the body of a variant."""
    body, curve = case.map, curves.by_name[name]
    if body is None or not isinstance(curve, SurfaceCurve):
        return None
    repeated = larger_name(case, name)
    map_curve = curves.get(repeated)
    if map_curve is None:  # no load is borne, or Ctrl-C came before
        map_curve = replace(curve, unloading_stiffness=np.full(curve.status.size, np.nan))
    larger = LargerSurface(
        Values.of(map_curve),
        {"": None} if left_open is None else left_open.of_larger,
        which_surface(case.extrapolation),
    )
    tiled = None if left_open is None else tiled_curves(case, curves, repeated)
    if tiled is None:
        return larger
    measures = measures_of_tiles(case, map_curve, tiled)
    return replace(larger, tiles=tiled.stiffness_and_contact(), measures=measures)


def _measured(
    case: Case,
    curves: Curves,
    left_open: LeftOpen | None,
    larger: LargerSurface | None,
    name: str,
) -> Mapping[str, Measured]:
    """Measures of a variant, or of the same pressed periodically, with what causes leave open.

    These are the causes of the map alone, but for what its tiles tell of a larger surface.
    """
    curve = curves.get(larger_name(case, name))
    if curve is None:
        return {}
    taken = {each.name: curve.measured[each.name] for each in case.measures}
    if left_open is None:
        return measured_within(taken, [None])
    spreads = left_open.of_larger
    own = [spread for key, spread in spreads.items() if not causes[key].is_of_larger]
    probed = any(causes[key].is_of_larger and spread for key, spread in spreads.items())
    tells = larger is not None and (bool(larger.measures) or probed)
    of_larger = {each.name: taken[each.name] for each in case.measures if each.intensive and tells}
    return measured_within(taken, own) | measured_within(of_larger, spreads.values())


def fields_of_gap(case: Case, curves: Curves) -> Fields | None:
    """Fields of one load of the contact that the measures of the body as asked are of."""
    curve = curves.get(larger_name(case, AS_ASKED))
    return None if curve is None else first_fields(curve)
