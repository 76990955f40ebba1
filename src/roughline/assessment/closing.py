"""At which pressure a map seals, and down to which load it stays so, in all ways it is pressed."""

from __future__ import annotations

from collections.abc import Mapping

from roughline.assessment.case import Case
from roughline.assessment.variants import Curves, Way, periodic
from roughline.contact.curve import Curve
from roughline.contact.press import press
from roughline.engineering.sealing import Closing
from roughline.fluid.reopening import reopening
from roughline.fluid.sealing_pressure import sealing_pressure

_RTOL = 0.02  # between both ends of a bracket
_WAYS = (Way.AS_ASKED, Way.ELASTIC, Way.AS_HARD, Way.SOFTEST, Way.HARDEST)


def closings_of(case: Case, curves: Curves) -> tuple[Mapping[str, Closing], bool]:
    """Closings by the names of variants, if they are asked for, and whether Ctrl-C came before all.

    What grid and size leave open is found of the body as it was asked for.
    """
    found: dict[str, Closing] = {}
    if not case.question.finds_closing or curves.stopped:
        return found, False
    for name in _WAYS:
        curve = curves.get(periodic(name) if case.is_repeated_for_interface else name)
        if curve is None or curve.surface is None:
            continue
        try:
            found[name] = _closing(case, curve, is_judged=name == Way.AS_ASKED)
        except KeyboardInterrupt:
            return found, True
    return found, False


def _closing(case: Case, curve: Curve, *, is_judged: bool) -> Closing:
    """Bisect the loads of the surface of a curve."""
    surface, along = curve.surface, case.question.flow_along
    assert surface is not None
    interval = is_judged and case.loads.grid_error
    closes = sealing_pressure(
        surface,
        half_space=curve.half_space,
        law=curve.law,
        along=along,
        rtol=_RTOL,
        interval=interval,
    )
    largest = case.loads.largest
    if not curve.converged[largest]:
        return Closing(closes)
    force = float(curve.force[largest])
    loaded = press(surface, half_space=curve.half_space, law=curve.law, forces=[force])
    return Closing(closes, reopening(loaded, along=along, rtol=_RTOL, interval=interval))
