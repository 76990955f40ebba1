"""From a question to an assessment: read, press, and work out what follows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from roughline.assessment.answers import surface_moments, with_answers
from roughline.assessment.assessment import Assessment
from roughline.assessment.grid import grid_error_is_estimated
from roughline.assessment.kinds import is_map
from roughline.assessment.larger_surface import LargerSurface
from roughline.assessment.line_scan import press_scan
from roughline.assessment.loads import LoadCase, LoadProgress, asked_loads, load_with_fields
from roughline.assessment.misfit import refuse_misfit
from roughline.assessment.notes import is_scan_that_yields
from roughline.assessment.question import Question
from roughline.assessment.remarks import notes_of, warnings_of
from roughline.assessment.slip import slip_at_largest_load
from roughline.assessment.solution import (
    interface_of_the_larger_surface,
    of_larger_surface,
    solved,
    with_other_filling,
)
from roughline.assessment.source import Topography, pressed_body, topographies
from roughline.assessment.tiles import PRESSED_WITH_TILES, coarse_shape
from roughline.assessment.uncertainty import Solution
from roughline.assessment.variants import (
    Variation,
    repeats,
    with_elastic_answers,
    with_scatter_of_hardness,
)
from roughline.computing.memory import refuse_beyond_memory
from roughline.contact.arguments import given_half_space, law_of
from roughline.contact.curve import Curve
from roughline.contact.estimates import (
    duration,
    estimate,
    expected_area_fraction,
    gigabytes,
    memory_for,
)
from roughline.contact.loads import Loads
from roughline.engineering.intervals import Intervals
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.errors.words import called
from roughline.theories.theory_curve import TheoryCurve
from roughline.topography.body import Body, Line, Surface

Announce = Callable[[str], None]
"""Called with the cost of a large run in words, before it starts."""

_LARGE = 2**20  # points from which on the cost is announced
_MANY = 1000  # loads from which on the cost is announced
# Memory of whole commands on 1024² and 2048² points, as measured. [bytes], and per point
_BYTES_TO_READ = 30_000_000  # beside that of a press
_BYTES_OF_OTHER_CURVES = 30  # with materials
_BYTES_TO_DRAW, _BYTES_OF_FIGURES = 410_000_000, 145  # once the press is over, of the process
_BYTES_TO_ANSWER = 45_000_000  # beside either, with materials


@public
def assess_body(
    question: Question, *, announce: Announce | None = None, progress: LoadProgress | None = None
) -> Assessment:
    """Answer a question of one body: read, prepare, press, and work out what follows.

    A load that fails is marked in the curve's status. On Ctrl-C the loads that were solved before
    are kept, and the result says that it was interrupted.

    Parameters
    ----------
    question : Question
        What is asked.
    announce : callable, optional
        Called with the cost of a large run in words, before it starts.
    progress : callable, optional
        Called with (loads done, loads in all).

    Returns
    -------
    Assessment
        The curve with its intervals, answers by key, notes and warnings.

    Raises
    ------
    InputError
        If a file cannot be read, or the question does not suit what the file holds.
    """
    parts = topographies(question)
    body = pressed_body([each.body for each in parts])
    refuse_misfit(question, body)
    case = LoadCase.of(question, body)
    case = replace(case, grid_error=grid_error_is_estimated(question, body, case))
    if isinstance(body, Line) and body.kind == "profile":
        solution, larger = _solved_scan(question, body, parts, case), None
    else:
        _tell_cost(question, body, case, announce)
        solution, larger = _solved_body(question, body, case, parts, progress)
        _refuse_all_at_the_hardness(question, case, solution.curve)
    result = Assessment(
        question,
        parts,
        body,
        _with_joint_recorded(solution.curve, question.joint),
        asked_loads(case, solution.curve.status.size),
        solution.intervals,
        solution.interrupted,
        theories=_theories(question, body, solution.curve),
    )
    spectrum = surface_moments(body) if question.materials is not None else None
    result = with_answers(result, larger, spectrum)
    if case.hardness is not None:
        solve = partial(_solved_body, replace(question, fields=False), parts=(), progress=progress)
        variation = Variation(case, larger, spectrum, solve)
        result = with_scatter_of_hardness(with_elastic_answers(result, variation), variation)
    slip, interrupted = slip_at_largest_load(question, case, result.curve, result.area)
    result = replace(result, partial_slip=slip, interrupted=result.interrupted or interrupted)
    warnings = warnings_of(result, spectrum, case.grid_error)
    return replace(result, warnings=warnings, notes=notes_of(result, solution.note))


def _refuse_all_at_the_hardness(question: Question, case: LoadCase, curve: Curve) -> None:
    """Refuse depths at which all of the area is at the hardness; of forces it is known before."""
    beyond = np.flatnonzero((curve.converged & ~case.borne(curve))[list(case.asked)])
    if case.depths and beyond.size:
        raise InputError(
            f"depth {question.headings[beyond[0]]} indents all of the body: its whole area is at "
            "the hardness, and bears no more at any larger depth; give smaller ones"
        )


def _with_joint_recorded(curve: Curve, joint: float | None) -> Curve:
    """Record the joint that the map of a curve is a part of; forces of the curve are the map's."""
    if joint is None:
        return curve
    recorded: dict[str, str | float] = {
        "joint_area": joint,
        "joint_area_units": "m^2",
        "curve_of": "map",
    }
    return replace(curve, settings={**curve.settings, **recorded})


def _needs_larger_surface(question: Question, body: Body) -> bool:
    """Whether answers are about the larger surface that a body was cut out of."""
    is_of_a_larger_one = question.joint is not None or is_map(body)
    return question.materials is not None and is_of_a_larger_one


def _tell_cost(question: Question, body: Body, case: LoadCase, announce: Announce | None) -> None:
    """Refuse what does not fit into memory, and tell what a large run will cost."""
    if not isinstance(body, Surface):
        return
    large = body.heights.size >= _LARGE
    share = _expected_share(body, case) if large else None
    yielding = case.hardness is not None
    twice = _needs_larger_surface(question, body) and not case.periodic
    if twice:
        refuse_beyond_memory(
            memory_for(body.shape, True, 0, yielding=yielding, area_fraction=share),
            f"pressing {body.shape[0]} x {body.shape[1]} points periodically, for the "
            "interface alone,",
            f"take a smaller piece or every other point, or {called('E_star')} instead of "
            "materials",
        )
    if announce is not None and (large or case.count >= _MANY):
        cost_of = partial(estimate, n_loads=case.count, yielding=yielding, area_fraction=share)
        told = cost_of(body.shape, periodic=case.periodic, fields=[0] if question.fields else False)
        then = cost_of(body.shape, periodic=True) if twice else told
        memory = _most_memory(question, body, max(told.memory, then.memory))
        cost = f"about {gigabytes(memory)} and {duration(told.seconds)}"
        if twice:
            cost += f", then {duration(then.seconds)} for the interface"
        if case.grid_error and _needs_larger_surface(question, body):
            of_tiles = PRESSED_WITH_TILES * cost_of(coarse_shape(body.shape), periodic=True).seconds
            cost += f", and {duration(of_tiles)} for the surface around the map"
        if more := repeats(question, body):
            cost += (
                f"; where points yield, up to {more:g} times as long in addition, for elastic "
                "bodies and for the scatter of the hardness"
            )
        announce(f"{body.shape[0]} x {body.shape[1]} points, {case.count} loads: {cost}")


def _most_memory(question: Question, body: Surface, pressing: int) -> int:
    """Return the most memory of the process: while it presses, or while it draws. [bytes]"""
    points, answers = body.heights.size, question.materials is not None
    most = pressing + _BYTES_TO_READ + (_BYTES_OF_OTHER_CURVES * points if answers else 0)
    if question.fields:
        most = max(most, _BYTES_TO_DRAW + _BYTES_OF_FIGURES * points)
    return most + (_BYTES_TO_ANSWER if answers else 0)


def _expected_share(body: Surface, case: LoadCase) -> float | None:
    """Return about what share comes into contact at most; None for spaced loads."""
    if case.n_loads is not None:
        return None
    loads = Loads("forces" if case.forces else "depths", np.array(case.forces or case.depths))
    return expected_area_fraction(
        body, given_half_space(None, case.E_star, case.periodic), loads, law_of(case.hardness)
    )


def _solved_scan(
    question: Question, body: Line, parts: Sequence[Topography], case: LoadCase
) -> Solution:
    """Press a line scan, of one or of two bodies, through its spectrum."""
    second = parts[1].body if len(parts) > 1 else None
    assert second is None or isinstance(second, Line)
    scan = press_scan(body, E_star=case.E_star, forces=case.forces, against=second)
    ends = scan.low, scan.high
    known = not (np.isnan(scan.low).any() or is_scan_that_yields(question, body))
    return Solution(scan.curve, intervals=Intervals(ends, ends) if known else None)


def _solved_body(
    question: Question,
    body: Body,
    case: LoadCase,
    parts: Sequence[Topography],
    progress: LoadProgress | None,
) -> tuple[Solution, LargerSurface | None]:
    """Press a body, filled in both ways, and periodically where a larger surface is behind it."""
    kept = [load_with_fields(case)] if question.fields else []
    solution = solved(case, body, kept, progress)
    if not isinstance(body, Surface):
        return solution, None
    filled = parts if any(each.is_filled for each in parts) else []
    if filled and not solution.interrupted:
        solution = with_other_filling(solution, case, body, filled, progress)
    if not _needs_larger_surface(question, body):
        return solution, None
    larger, interrupted = interface_of_the_larger_surface(
        solution, case, body, filled, question.joint, progress
    )
    solution = replace(solution, interrupted=interrupted)
    return (solution if question.joint is None else of_larger_surface(solution, larger)), larger


def _theories(question: Question, body: Body, curve: Curve) -> list[TheoryCurve]:
    """Theories at the mean pressures of the loads that were solved, rising, each once."""
    solved = np.unique(curve.force[curve.converged & (curve.force > 0)])
    if not question.theories or not isinstance(body, Surface) or not solved.size:
        return []
    from roughline.theories.theory import theory  # here because it loads slowly

    pressures = solved / body.area
    return [theory(name, body, curve.E_star, pressures) for name in question.theories]
