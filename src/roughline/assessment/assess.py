"""From a question to an assessment: read, press, and work out what follows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from roughline.assessment import notes as say
from roughline.assessment.answers import (
    broken_assumptions,
    surface_moments,
    with_answers,
)
from roughline.assessment.assessment import Assessment, PartialSlip
from roughline.assessment.grid import grid_error_is_estimated, why_without_grid_error
from roughline.assessment.larger_surface import LargerSurface
from roughline.assessment.line_scan import press_scan
from roughline.assessment.loads import LoadCase, LoadProgress, asked_loads, load_with_fields
from roughline.assessment.misfit import refuse_misfit
from roughline.assessment.nominal import nominal_area
from roughline.assessment.question import Question
from roughline.assessment.solution import (
    interface_of_the_larger_surface,
    of_larger_surface,
    solved,
    with_other_filling,
)
from roughline.assessment.source import Topography, pressed_body, topographies
from roughline.assessment.uncertainty import Solution
from roughline.assessment.variants import with_elastic_answers, with_scatter_of_hardness
from roughline.computing.memory import refuse_beyond_memory
from roughline.contact.curve import Curve
from roughline.contact.estimates import estimate, memory_for
from roughline.contact.press import press
from roughline.engineering.formulas import partial_slip
from roughline.engineering.limits import left_out
from roughline.files.read import suspicions
from roughline.spectra.moments import Moments
from roughline.theories.theory_curve import TheoryCurve
from roughline.topography.body import Body, Line, Surface

Announce = Callable[[str], None]
"""Told what a large run will cost, before it starts."""

_LARGE = 2**20  # points from which on the cost is told
_LIGHTEST, _SLIP_LOADS = 1e-3, 16  # first of the loads of partial slip, and their number
_MANY = 1000  # loads from which on the cost is told


def assess_body(
    question: Question,
    *,
    announce: Announce | None = None,
    progress: LoadProgress | None = None,
) -> Assessment:
    """Answer a question of one body: read, prepare, press, and work out what follows.

    A load that fails is marked in the curve's status. On Ctrl-C the loads that were solved before
    are kept, and the result says that it was interrupted.

    Parameters
    ----------
    question : Question
        What is asked.
    announce : callable, optional
        Told what a large run will cost, before it starts.
    progress : callable, optional
        Called with (loads done, loads in all).

    Returns
    -------
    Assessment
        The curve with its intervals, answers by key, notes and warnings.

    Raises
    ------
    InputError
        If a file cannot be read, or what is asked does not suit what it holds.
    """
    parts = topographies(question)
    body = pressed_body([each.body for each in parts])
    refuse_misfit(question, body)
    case = LoadCase.of(question, body)
    case = replace(case, grid_error=grid_error_is_estimated(question, body, case))
    if isinstance(body, Line) and body.kind == "profile":
        solution, larger = _solved_scan(body, parts, case), None
    else:
        _tell_cost(question, body, case, announce)
        solution, larger = _solved_body(question, body, parts, case, progress)
    result = Assessment(
        question,
        parts,
        body,
        solution.curve,
        asked_loads(case, solution.curve.status.size),
        solution.stiffness_interval,
        solution.unloading_interval,
        solution.area_interval,
        solution.interrupted,
        theories=_theories(question, body, solution.curve),
        partial_slip=_partial_slip(question, solution.curve, nominal_area(body)),
    )
    spectrum = surface_moments(body) if question.materials is not None else None
    result = with_answers(result, larger, spectrum)
    if case.hardness is not None:
        solve = partial(_solved_again, question, body, parts, progress=progress)
        result = with_elastic_answers(result, case, spectrum, solve)
        result = with_scatter_of_hardness(result, case, spectrum, solve)
    return replace(
        result,
        warnings=_warnings(result, spectrum, case.grid_error),
        notes=_notes(result, solution.note),
    )


def _solved_again(
    question: Question,
    body: Body,
    parts: Sequence[Topography],
    case: LoadCase,
    *,
    progress: LoadProgress | None,
) -> tuple[Solution, LargerSurface | None]:
    """Press a body with another hardness: without fields, and filled in one way."""
    whole = [replace(each, measurement=None) for each in parts]
    question = replace(
        question, fields=False, elastic=case.hardness is None, hardness=case.hardness
    )
    return _solved_body(question, body, whole, case, progress)


def _needs_larger_surface(question: Question, body: Body) -> bool:
    """Whether answers are about the larger surface that a body was cut out of."""
    if question.materials is None or not isinstance(body, Surface):
        return False
    return body.is_cut_out or question.joint is not None


def _tell_cost(question: Question, body: Body, case: LoadCase, announce: Announce | None) -> None:
    """Refuse what does not fit into memory, and tell what a large run will cost."""
    if not isinstance(body, Surface):
        return
    twice = _needs_larger_surface(question, body) and not case.periodic
    if twice:
        refuse_beyond_memory(
            memory_for(body.shape, True, 0),
            f"pressing {body.shape[0]} x {body.shape[1]} points periodically, for the "
            "interface alone,",
            "take a smaller piece or every other point, or E_star= instead of materials",
        )
    if announce is not None and (body.heights.size >= _LARGE or case.count >= _MANY):
        cost = str(estimate(body.shape, case.count, periodic=case.periodic))
        if twice:
            cost += f", then {estimate(body.shape, case.count, periodic=True)} for the interface"
        announce(f"{body.shape[0]} x {body.shape[1]} points, {case.count} loads: {cost}")


def _solved_scan(body: Line, parts: Sequence[Topography], case: LoadCase) -> Solution:
    """Press a line scan, of one or of two bodies, through its spectrum."""
    second = parts[1].body if len(parts) > 1 else None
    assert second is None or isinstance(second, Line)
    scan = press_scan(body, E_star=case.E_star, forces=case.forces, against=second)
    return Solution(scan.curve, stiffness_interval=(scan.low, scan.high))


def _solved_body(
    question: Question,
    body: Body,
    parts: Sequence[Topography],
    case: LoadCase,
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
    larger, interrupted = interface_of_the_larger_surface(solution, case, body, filled, progress)
    solution = replace(solution, interrupted=interrupted)
    return (solution if question.joint is None else of_larger_surface(solution, larger)), larger


def _theories(question: Question, body: Body, curve: Curve) -> list[TheoryCurve]:
    """Theories at the mean pressures of the loads that were solved."""
    if not question.theories or not isinstance(body, Surface) or not curve.converged.any():
        return []
    from roughline.theories.theory import theory  # here because it loads slowly

    pressures = curve.force[curve.converged] / body.area
    return [theory(name, body, curve.E_star, pressures) for name in question.theories]


def _partial_slip(question: Question, curve: Curve, area: float) -> PartialSlip | None:
    """Partial slip at the largest load, if it was solved and friction is known.

    Parameters
    ----------
    question : Question
        With friction and the joint, if there is one.
    curve : Curve
        Of the body.
    area : float
        Nominal area of the body. [m²]
    """
    pair, friction = question.pair, question.friction
    if pair is None or friction is None:
        return None
    largest = int(np.nanargmax(np.where(np.isnan(curve.force), 0.0, curve.force)))
    if not curve.converged[-1] or not curve.converged[largest]:
        return None
    if curve.hardness is not None:
        # under a shear the contact slides back along its unloading, which is elastic
        curve = press(
            curve.surface_after(largest),
            E_star=curve.E_star,
            forces=curve.force[largest] * np.geomspace(_LIGHTEST, 1.0, _SLIP_LOADS),
            periodic=curve.settings["boundary"] == "periodic",
            throw=False,
        )
    rising = np.argsort(curve.force[curve.converged])
    depth, force = (each[curve.converged][rising] for each in (curve.depth, curve.force))
    force = force * question.scale(area)
    return PartialSlip(friction, *partial_slip(depth, force, pair.E_star, pair.G_star, friction))


def _warnings(
    result: Assessment, spectrum: Moments | None, grid_error_was_tried: bool
) -> list[str]:
    """What is suspicious, where assumptions break, and why there is no interval."""
    bodies, body, curve = [each.body for each in result.topographies], result.body, result.curve
    warnings = [
        *say.of_each(bodies, suspicions),
        *broken_assumptions(result, spectrum),
        *curve.warnings,
    ]
    warnings += say.of_joint_and_borders(result, grave=True)
    if isinstance(body, Surface) and curve.stiffness_error is None:
        warnings.append(why_without_grid_error(result.question, body, grid_error_was_tried))
    return warnings


def _notes(result: Assessment, of_filling: str) -> list[str]:
    """What is left out, what was filled, how the loads were meant, and what was cropped."""
    question, body = result.question, result.body
    bodies = [each.body for each in result.topographies]
    notes = say.of_yield(result)
    if isinstance(body, Line) and question.pair is not None and question.pair.hardness is not None:
        notes.append(
            "the reduced model has no yield: it may serve while mean contact pressures stay below "
            "some 0.4 of the hardness, which rms slopes over 0.8 H / E* exceed"
        )
    if question.pair is not None:
        notes += left_out(question.pair, question.frequency_in_hertz)
        if result.curve.area_fraction is None:
            notes.append("no contact area: the reduced model of a line does not predict it")
    notes += say.of_each(bodies, say.filled_points_and_spikes)
    notes += [of_filling] if of_filling else []
    notes += say.meaning_of_loads(question, body)
    return notes + say.of_joint_and_borders(result, grave=False) + say.cropping_and_resampling(body)
