"""By how much the scatter of the hardness changes answers, and the answers without yield."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughline.assessment.answers import with_answers
from roughline.assessment.assessment import Assessment
from roughline.assessment.hardness import hardness_of
from roughline.assessment.larger_surface import LargerSurface
from roughline.assessment.loads import LoadCase
from roughline.assessment.question import Question
from roughline.assessment.uncertainty import Solution
from roughline.computing.arrays import Mask, Real
from roughline.contact.arguments import law_of
from roughline.contact.curve import Curve
from roughline.contact.selection import among_loads, at_loads
from roughline.engineering.intervals import Ends, Intervals
from roughline.engineering.rule import Limits, within
from roughline.spectra.moments import Moments
from roughline.topography.body import Body, Surface

Solve = Callable[[Body, LoadCase], tuple[Solution, LargerSurface | None]]
"""Presses a body; the second result is the larger surface behind it."""

HALVED_FROM = 2**20
"""Points from which on the scatter of the hardness is judged on half as many points a side."""


@dataclass(frozen=True, eq=False)
class Variation:
    """How the body of an assessment is pressed again, with another hardness.

    Attributes
    ----------
    case : LoadCase
        How its curve was made.
    larger : LargerSurface or None
        The larger surface behind the body, over the loads of the curve.
    spectrum : Moments or None
        Of the body.
    solve : callable
        Presses a body under a load case.
    """

    case: LoadCase
    larger: LargerSurface | None
    spectrum: Moments | None
    solve: Solve

    def assessed(self, result: Assessment, hardness: float | None, body: Body) -> Assessment:
        """Answer the same of a body of another hardness, elastic if None; without intervals.

        Loads that this body does not bear are not solved.
        """
        question = result.question
        if hardness is not None:
            question = replace(question, hardness=hardness)
        other = replace(_without_intervals(result), question=question, body=body)
        curve, same = result.curve, body is result.body and not _yields(result.curve)
        if same and hardness is not None and hardness >= (curve.hardness or 0):
            law, settings = law_of(hardness), {**curve.settings, "hardness": hardness}
            curve = replace(curve, law=law, settings=settings)
            return with_answers(replace(other, curve=curve), self.larger, self.spectrum)
        loads = _borne(result, self.case, hardness)
        if not loads.any():
            none = np.flatnonzero(loads)
            nothing = among_loads(at_loads(curve, none), loads)
            larger = self.larger.at(none).among(loads) if self.larger else None
            return with_answers(replace(other, curve=nothing), larger, self.spectrum)
        solution, larger = self.solve(body, self.case.of_hardness(hardness, loads, curve))
        curve = among_loads(solution.curve, loads)
        other = replace(other, curve=curve, interrupted=solution.interrupted)
        return with_answers(other, larger.among(loads) if larger else None, self.spectrum)


def repeats(question: Question, body: Body) -> float:
    """Time of all variants of a body over that of the body alone, at most."""
    hardness = hardness_of(question)
    if hardness is None or question.materials is None or not isinstance(body, Surface):
        return 0.0
    if hardness.factor == 1:
        return 1.0
    return 3.0 if _judged_on(body) is body else 1.75


def with_elastic_answers(result: Assessment, variation: Variation) -> Assessment:
    """Add the answers of elastic bodies, where some of the contact yields."""
    if result.interrupted or not result.answers or not _yields(result.curve):
        return result
    elastic = variation.assessed(result, None, result.body)
    if elastic.interrupted:
        return replace(result, interrupted=True)
    return replace(result, elastic=elastic.answers)


def with_scatter_of_hardness(result: Assessment, variation: Variation) -> Assessment:
    """Widen all intervals by the effect of the scatter of the hardness.

    The body is pressed again as soft and as hard as it may be. A large one is pressed on half as
    many points a side, and only the ratios to the answers for the hardness itself are taken. An
    interval then reaches from its lower end times the least ratio to its upper end times the
    largest: the errors of the grid and of the hardness are added, not taken as independent. Under
    loads that the softest body does not bear, the ends are not known. On Ctrl-C there are no
    intervals, as those without the scatter would be too narrow.

    Parameters
    ----------
    result : Assessment
        With the answers for the hardness itself.
    variation : Variation
        How its body is pressed again.
    """
    hardness = hardness_of(result.question)
    if hardness is None or hardness.factor == 1:
        return result
    body = _judged_on(result.body)
    values = [*hardness.ends] if body is result.body else [hardness.value, *hardness.ends]
    assessed: list[Assessment] = []
    for value in values:
        if not result.interrupted:
            assessed.append(variation.assessed(result, value, body))
            result = replace(result, interrupted=assessed[-1].interrupted)
    if result.interrupted:
        return _without_intervals(result)
    if body is result.body:
        return _widened(result, result, assessed)
    return _widened(result, assessed[0], assessed[1:])


def _judged_on(body: Body) -> Body:
    """Return the body itself, or a large one on half as many points a side."""
    if not isinstance(body, Surface) or body.heights.size < HALVED_FROM:
        return body
    return body if body.shape[0] % 2 or body.shape[1] % 2 else body.coarsened()


def _yields(curve: Curve) -> bool:
    """Whether some of the contact is at the hardness, under any load."""
    return curve.plastic_fraction is not None and bool(np.nan_to_num(curve.plastic_fraction).any())


def _borne(result: Assessment, case: LoadCase, hardness: float | None) -> Mask:
    """Which loads of the curve were solved, and are borne by a body of a hardness.

    What a load leaves that is too large is not known, nor are those after it.
    """
    curve = result.curve
    if hardness is None or case.depths:
        return curve.converged
    largest = np.maximum.accumulate(np.nan_to_num(curve.force))
    return curve.converged & (largest < hardness * result.area)


def _without_intervals(result: Assessment) -> Assessment:
    """Return the assessment as if the error of its grid were not known."""
    answers = {key: each.bare for key, each in result.answers.items()}
    return replace(result, intervals=None, answers=answers, larger=None)


def _widened(result: Assessment, nominal: Assessment, moved: Sequence[Assessment]) -> Assessment:
    """Widen the intervals of an assessment by the ratios of others to a nominal one."""
    scatter = {
        key: _ratios(nominal.answers[key].values, [other.answers[key].values for other in moved])
        for key in result.answers
    }
    answers = {}
    for key, each in result.answers.items():
        ends, can_be = each.ends, each.limits
        if each.rule.is_of_hardness_alone and result.intervals is not None:
            ends = each.values, each.values  # nothing else leaves them open
        if each.under is not None and each.under[0] in result.answers:
            upper, factor = each.under
            bound = result.answers[upper].ends
            if bound is not None:
                can_be = can_be[0], factor * _times(bound, scatter[upper])[1]
        low, high = (None, None) if ends is None else _times(ends, scatter[key], can_be)
        answers[key] = replace(each, low=low, high=high)

    def of_curve(ends: Ends, name: str, most: Real | float = np.inf) -> Ends:
        values = [getattr(each.curve, name) for each in (nominal, *moved)]
        return _times(ends, _ratios(values[0], values[1:]), (0.0, most))

    known = result.intervals
    if known is not None:
        unloading = of_curve(known.unloading, "unloading_stiffness")
        known = Intervals(
            of_curve(known.stiffness, "stiffness", unloading[1]),
            unloading,
            None if known.area is None else of_curve(known.area, "area_fraction_corrected", 1.0),
        )
    return replace(result, intervals=known, answers=answers, hardness_scatter=scatter)


def _ratios(values: Real, moved: Sequence[Real]) -> Ends:
    """Return the least and the largest of moved values over values, and of one.

    Where a value is zero or not known, nothing moves it; a moved one that is not known leaves both
    ends unknown.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        ratios = np.stack([np.ones_like(values), *(each / values for each in moved)])
    ratios = np.where((values == 0) | ~np.isfinite(values), 1.0, ratios)
    return ratios.min(axis=0), ratios.max(axis=0)


def _times(ends: Ends, ratios: Ends, can_be: Limits = (0.0, np.inf)) -> Ends:
    """Ends times ratios, within what can be."""
    with np.errstate(invalid="ignore"):  # nothing, times infinity
        return within((ends[0] * ratios[0], ends[1] * ratios[1]), can_be)
