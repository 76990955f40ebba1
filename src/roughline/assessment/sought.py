"""What is sought beyond the loads: where a map seals, in all ways that it is pressed, or sticks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Literal

from roughline.contact.curve import SurfaceCurve
from roughline.contact.separation import draw_apart
from roughline.engineering.pressed import Sought
from roughline.engineering.sealing import Closing
from roughline.fluid.gap import Along
from roughline.fluid.reopening import reopening, reopenings_about
from roughline.fluid.sealing_pressure import sealing_pressure, sealing_pressures_about
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
            known = {name: curves.get(larger_name(case, name)) for name in (AS_ASKED, *WAYS)}
            pressed = {name: each for name, each in known.items() if each is not None}
            for name in _ANSWERING:
                if name in pressed:
                    closing = _closing(case, pressed[name], fluid.along, with_interval=not found)
                    found[name] = Sought(closing=closing)
            others = {name: each for name, each in pressed.items() if name not in found}
            found |= _closing_about(case, others, fluid.along, found)
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
    case: Case,
    curves: Mapping[str, SurfaceCurve],
    along: Along | Literal["both"],
    found: Mapping[str, Sought],
) -> dict[str, Sought]:
    """Where the surfaces of curves close, side by side, from where they do as asked and elastic.

    Where most of the contact yields, that is in proportion to the hardness.
    """
    known = [each.closing for each in found.values() if each.closing is not None]
    if not known or not curves:
        return {}
    as_asked, largest = known[0], case.loads.largest
    most = max(each.pressure.value for each in known)
    expected = []
    for curve in curves.values():
        harder = 1.0
        if case.hardness is not None and curve.hardness is not None:
            harder = curve.hardness / case.hardness.value
        expected.append(min(as_asked.pressure.value * harder, most))
    closes = sealing_pressures_about([*curves.values()], expected, along=along)
    closings = {name: Closing(each) for name, each in zip(curves, closes, strict=True)}
    loaded = {name: each for name, each in curves.items() if each.converged[largest]}
    if as_asked.reopening is not None and loaded:
        share = as_asked.reopening.value
        opens = reopenings_about([*loaded.values()], largest, share, along=along)
        for name, each in zip(loaded, opens, strict=True):
            closings[name] = replace(closings[name], reopening=each)
    return {name: Sought(closing=each) for name, each in closings.items()}
