"""What is sought beyond the loads: where a map seals, in all ways that it is pressed, or sticks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

from roughline.contact.curve import SurfaceCurve
from roughline.contact.separation import draw_apart
from roughline.engineering.pressed import Sought
from roughline.engineering.sealing import Closing
from roughline.fluid.gap import Along
from roughline.fluid.reopening import reopening, reopening_about
from roughline.fluid.sealing_pressure import sealing_pressure, sealing_pressure_about
from roughline.margins.hardness import ELASTIC, WAYS
from roughline.margins.variant import AS_ASKED, Curves, larger_name
from roughline.question.case import Case

_RTOL = 0.02  # between both ends of a bracket
_ANSWERING = (AS_ASKED, ELASTIC)  # others tell only how much the hardness moves these


def find_sought(case: Case, curves: Curves) -> tuple[Mapping[str, Sought], bool]:
    """What is sought, by the names of variants, and whether Ctrl-C came before all of it.

    What grid and size leave open is found of the body as it was asked for.
    """
    found: dict[str, Sought] = {}
    if curves.stopped:
        return found, False
    try:
        if case.loads.attraction is not None:
            of_pull = curves.get(AS_ASKED)
            if of_pull is not None:
                # other places of a joint, and other fillings, leave these open as well
                has_ends = case.loads.grid_error and case.question.joint is None and not case.filled
                separation = draw_apart(of_pull, case.loads.largest, grid_error=has_ends)
                found[AS_ASKED] = Sought(separation=separation)
        elif (fluid := case.question.fluid) is not None and fluid.closure:
            for name in (AS_ASKED, *WAYS):
                curve = curves.get(larger_name(case, name))
                if curve is None:
                    continue
                known = [each.closing for each in found.values() if each.closing is not None]
                if name in _ANSWERING or not known:
                    closing = _closing(case, curve, fluid.along, with_interval=not known)
                else:
                    closing = _closing_about(case, curve, fluid.along, known)
                found[name] = Sought(closing=closing)
    except KeyboardInterrupt:
        return found, True
    return found, False


def _closing(
    case: Case, curve: SurfaceCurve, along: Along | Literal["both"], *, with_interval: bool
) -> Closing:
    """Bisect the loads of the surface of a curve."""
    interval, largest = with_interval and case.loads.grid_error, case.loads.largest
    closes = sealing_pressure(
        curve.surface,
        half_space=curve.half_space,
        law=curve.law,
        along=along,
        rtol=_RTOL,
        interval=interval,
    )
    if not curve.converged[largest]:
        return Closing(closes)
    return Closing(closes, reopening(curve, largest, along=along, rtol=_RTOL, interval=interval))


def _closing_about(
    case: Case, curve: SurfaceCurve, along: Along | Literal["both"], known: Sequence[Closing]
) -> Closing:
    """Where the surface of a curve closes, from where it does as asked and elastic.

    Where most of the contact yields, that is in proportion to the hardness.
    """
    as_asked, largest = known[0], case.loads.largest
    expected = as_asked.pressure.value
    if case.hardness is not None and curve.hardness is not None:
        expected *= curve.hardness / case.hardness.value
    expected = min(expected, max(each.pressure.value for each in known))
    closes = sealing_pressure_about(
        curve.surface, expected, half_space=curve.half_space, law=curve.law, along=along
    )
    opens = as_asked.reopening
    if opens is None or not curve.converged[largest]:
        return Closing(closes)
    return Closing(closes, reopening_about(curve, largest, opens.value, along=along))
