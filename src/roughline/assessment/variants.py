"""What the scatter of hardness moves, and what the answers would be without yield."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from roughline.assessment.answers import with_answers
from roughline.assessment.assessment import Assessment
from roughline.assessment.hardness import hardness_of
from roughline.assessment.larger_surface import LargerSurface
from roughline.assessment.loads import LoadCase
from roughline.assessment.uncertainty import Solution
from roughline.computing.arrays import Real
from roughline.engineering.answer import Ends
from roughline.spectra.moments import Moments

Solve = Callable[[LoadCase], tuple[Solution, LargerSurface | None]]
"""Presses the body of an assessment; the second result is the larger surface behind it."""


def with_scatter_of_hardness(
    result: Assessment, case: LoadCase, spectrum: Moments | None, solve: Solve
) -> Assessment:
    """Widen all intervals by what the scatter of the hardness moves.

    The body is pressed again as soft and as hard as it may be. An interval then reaches from its
    lower end times the least ratio to its upper end times the largest: what the grid leaves open
    and what the hardness leaves open are added, not taken as independent. Where a load is more
    than the softest body bears, the ends are not known.

    Parameters
    ----------
    result : Assessment
        With the answers for the hardness itself.
    case : LoadCase
        How its curve was made.
    spectrum : Moments or None
        Of the body.
    solve : callable
        Presses the body under a load case.
    """
    hardness, curve = hardness_of(result.question), result.curve
    if hardness is None or hardness.factor == 1 or not curve.converged.all():
        return result
    moved, interrupted = [], result.interrupted
    for value in hardness.ends:
        if interrupted:
            break
        again = _case(case, result, value)
        if curve.force.max() >= value * result.area:
            moved.append(_unknown(result))
            continue
        solution, larger = solve(again)
        interrupted = solution.interrupted
        moved.append(_answered(result, solution, larger, spectrum, hardness=value))
    if interrupted:
        return _without_intervals(result)
    return _widened(result, moved)


def with_elastic_answers(
    result: Assessment, case: LoadCase, spectrum: Moments | None, solve: Solve
) -> Assessment:
    """Add the answers of elastic bodies, where some of the contact yields."""
    curve = result.curve
    if curve.plastic_fraction is None or not result.answers or result.interrupted:
        return result
    if not np.nan_to_num(curve.plastic_fraction).any():
        return result
    solution, larger = solve(_case(case, result, None))
    if solution.interrupted or not solution.curve.converged.all():
        return replace(result, interrupted=result.interrupted or solution.interrupted)
    elastic = _answered(result, solution, larger, spectrum, elastic=True)
    return replace(result, elastic=elastic.answers)


def _case(case: LoadCase, result: Assessment, hardness: float | None) -> LoadCase:
    """Return the same loads on a body of another hardness, without the grid's errors."""
    if case.n_loads is not None:
        case = case.under_forces_of(result.curve)
    return replace(case, hardness=hardness, grid_error=False)


def _answered(
    result: Assessment,
    solution: Solution,
    larger: LargerSurface | None,
    spectrum: Moments | None,
    *,
    hardness: float | None = None,
    elastic: bool = False,
) -> Assessment:
    """Return the assessment of another solution of its body, without intervals."""
    question = replace(result.question, hardness=hardness, elastic=elastic)
    other = replace(_without_intervals(result), question=question, curve=solution.curve)
    return with_answers(other, larger, spectrum)


def _without_intervals(result: Assessment) -> Assessment:
    answers = {
        key: replace(each, low=None, high=None, shared=None) for key, each in result.answers.items()
    }
    return replace(
        result,
        stiffness_interval=None,
        unloading_interval=None,
        area_interval=None,
        answers=answers,
    )


def _unknown(result: Assessment) -> Assessment:
    """Return the assessment with nothing known."""
    curve = result.curve
    nothing = np.full(curve.status.size, np.nan)
    curve = replace(
        curve, stiffness=nothing, unloading_stiffness=nothing, area_fraction_corrected=nothing
    )
    answers = {
        key: replace(each, values=np.full(each.values.size, np.nan))
        for key, each in result.answers.items()
    }
    return replace(result, curve=curve, answers=answers)


def _widened(result: Assessment, moved: list[Assessment]) -> Assessment:
    """Widen the intervals of an assessment by the ratios of others to it."""

    def of_curve(ends: Ends | None, name: str) -> Ends | None:
        ratios = _ratios(getattr(result.curve, name), [getattr(each.curve, name) for each in moved])
        return None if ends is None else (ends[0] * ratios[0], ends[1] * ratios[1])

    answers, scatter = {}, {}
    for key, each in result.answers.items():
        ratios = _ratios(each.values, [other.answers[key].values for other in moved])
        scatter[key] = ratios
        low = None if each.low is None else each.low * ratios[0]
        high = None if each.high is None else each.high * ratios[1]
        shared = each.shared and (each.shared[0] * ratios[0], each.shared[1] * ratios[1])
        answers[key] = replace(each, low=low, high=high, shared=shared)
    return replace(
        result,
        stiffness_interval=of_curve(result.stiffness_interval, "stiffness"),
        unloading_interval=of_curve(result.unloading_interval, "unloading_stiffness"),
        area_interval=of_curve(result.area_interval, "area_fraction_corrected"),
        answers=answers,
        hardness_scatter=scatter,
    )


def _ratios(values: Real, moved: list[Real]) -> Ends:
    """Return the least and the largest of moved values over values, and one among them.

    Where a value is zero, nothing moves it; one that is not known leaves both ends unknown.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        ratios = np.stack([np.ones_like(values), *(each / values for each in moved)])
    ratios = np.where((values == 0) | ~np.isfinite(values), 1.0, ratios)
    return ratios.min(axis=0), ratios.max(axis=0)
