"""What is sought beyond the loads: where a map seals, in all ways that it is pressed, or sticks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from roughline.assessment.separation import draw_apart
from roughline.contact.curve import SurfaceCurve
from roughline.contact.press import press
from roughline.engineering.pressed import Sought
from roughline.engineering.sealing import Closing
from roughline.fluid.gap import Along
from roughline.fluid.reopening import reopening
from roughline.fluid.sealing_pressure import sealing_pressure
from roughline.margins.hardness import WAYS
from roughline.margins.variant import AS_ASKED, Curves, larger_name
from roughline.question.case import Case

_RTOL = 0.02  # between both ends of a bracket


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
                found[AS_ASKED] = Sought(separation=draw_apart(case, of_pull))
        elif (fluid := case.question.fluid) is not None and fluid.closure:
            for name in (AS_ASKED, *WAYS):
                curve = curves.get(larger_name(case, name))
                if curve is not None:
                    with_interval = name == AS_ASKED
                    found[name] = Sought(closing=_closing(case, curve, fluid.along, with_interval))
    except KeyboardInterrupt:
        return found, True
    return found, False


def _closing(
    case: Case, curve: SurfaceCurve, along: Along | Literal["both"], with_interval: bool
) -> Closing:
    """Bisect the loads of the surface of a curve."""
    surface, law = curve.surface, curve.law
    interval = with_interval and case.loads.grid_error
    closes = sealing_pressure(
        surface,
        half_space=curve.half_space,
        law=law,
        along=along,
        rtol=_RTOL,
        interval=interval,
    )
    largest = case.loads.largest
    if not curve.converged[largest]:
        return Closing(closes)
    force = float(curve.force[largest])
    loaded = press(surface, half_space=curve.half_space, law=law, forces=[force])
    return Closing(closes, reopening(loaded, along=along, rtol=_RTOL, interval=interval))
