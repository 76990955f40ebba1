"""By how much the scatter of the hardness moves answers, and the answers without yield."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughline.assessment.answers import work_out_answers
from roughline.assessment.solution import Solution, combine_curves
from roughline.computing.arrays import Real
from roughline.contact.curve import Curve
from roughline.engineering.intervals import Ends, Intervals
from roughline.engineering.rule import Answer, Limits, within
from roughline.margins.causes import HARDNESS
from roughline.margins.hardness import ELASTIC, OfHardness
from roughline.margins.sheared import cycles_as
from roughline.margins.variant import Curves, periodic
from roughline.question.case import Case


@dataclass(frozen=True, eq=False)
class _AtHardness:
    """The body with another hardness: its curve over all loads, and its answers."""

    curve: Curve
    answers: Mapping[str, Answer]


_Widened = tuple[Mapping[str, Ends], Mapping[str, Answer], Intervals | None]
"""The least and the largest ratio of each answer to its value, and answers by their keys and
intervals of the curve that include that."""


def elastic_answers(case: Case, curves: Curves) -> Mapping[str, Answer]:
    """The answers of elastic bodies; none where nothing yields, and before they were pressed."""
    if curves.stopped in (ELASTIC, periodic(ELASTIC)) or curves.get(ELASTIC) is None:
        return {}
    return _answer_at_hardness(case, curves, OfHardness(ELASTIC, case.body, None)).answers


def widen_by_scatter(
    case: Case, curves: Curves, solution: Solution, answers: Mapping[str, Answer]
) -> _Widened:
    """Widen all intervals by the effect of the scatter of the hardness.

    The body is pressed again as soft and as hard as it may be. A large one is pressed on half as
    many points a side, and only the ratios to the answers for the hardness itself are taken. An
    interval then reaches from its lower end times the least ratio to its upper end times the
    largest: the errors of the grid and of the hardness are added, not taken as independent. Under
    loads that the softest body does not bear, the ends are not known. On Ctrl-C there are no
    intervals, as those without the scatter would be too narrow.
    """
    hardness = case.hardness
    if hardness is None or hardness.factor == 1:
        return {}, answers, solution.intervals
    if curves.stopped:
        return {}, {key: each.without_interval for key, each in answers.items()}, None
    moved = [_answer_at_hardness(case, curves, each) for each in HARDNESS.ends(case, curves)]
    nominal = _AtHardness(solution.curve, answers)
    if (compared := HARDNESS.nominal(case)) is not None:
        nominal = _answer_at_hardness(case, curves, compared)
    return _widened(solution.intervals, answers, nominal, moved)


def _answer_at_hardness(case: Case, curves: Curves, way: OfHardness) -> _AtHardness:
    """Answer the same of a body of another hardness, or elastic; without intervals."""
    solution = combine_curves(case, curves, None, way.variant)
    sought = replace(solution.sought, sheared=cycles_as(case, curves, way.variant))
    solution = replace(solution, sought=sought)
    answers, _ = work_out_answers(case, solution, body=way.body, hardness=way.hardness)
    return _AtHardness(solution.curve, answers)


def _widened(
    known: Intervals | None,
    answers: Mapping[str, Answer],
    nominal: _AtHardness,
    moved: Sequence[_AtHardness],
) -> _Widened:
    """Widen the intervals of answers by the ratios of others to nominal ones."""
    scatter = {
        key: _ratios(_values(nominal, each), [_values(way, each) for way in moved])
        for key, each in answers.items()
    }
    widened = {}
    for key, each in answers.items():
        ends, can_be = each.ends, each.limits
        if each.under is not None and each.under[0] in answers:
            upper, factor = each.under
            bound = answers[upper].ends
            if bound is not None:
                can_be = can_be[0], factor * _times(bound, scatter[upper])[1]
        low, high = (None, None) if ends is None else _times(ends, scatter[key], can_be)
        if high is not None:  # what is zero is opened by no ratio
            others = np.stack([high, *(_values(way, each) for way in moved)])
            opened = np.minimum(np.fmax.reduce(others), can_be[1])
            high = np.where(_values(nominal, each) == 0, opened, high)
        widened[key] = replace(each, low=low, high=high)

    def scaled(ends: Ends, name: str, most: Real | float = np.inf) -> Ends:
        values = [getattr(each.curve, name) for each in (nominal, *moved)]
        return _times(ends, _ratios(values[0], values[1:]), (0.0, most))

    if known is not None:
        unloading = scaled(known.unloading, "unloading_stiffness")
        known = Intervals(
            scaled(known.stiffness, "stiffness", unloading[1]),
            unloading,
            None if known.area is None else scaled(known.area, "area_fraction_corrected", 1.0),
        )
    return scatter, widened, known


def _values(way: _AtHardness, answer: Answer) -> Real:
    """Values of an answer with another hardness; NaN where it is left out there."""
    of_way = way.answers.get(answer.key)
    return np.full_like(answer.values, np.nan) if of_way is None else of_way.values


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
