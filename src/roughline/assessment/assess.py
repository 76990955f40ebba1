"""From a question to an assessment: read, press in all ways, and work out what follows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from roughline.assessment.answers import margins_by_cause, work_out_answers
from roughline.assessment.assessment import Assessment
from roughline.assessment.bounds import elastic_answers, widen_by_scatter
from roughline.assessment.cost import Announce, announce_cost
from roughline.assessment.facts import collect_facts
from roughline.assessment.presses import list_presses
from roughline.assessment.slip import slip_at_largest_load
from roughline.assessment.solution import (
    LeftOpen,
    Solution,
    combine_curves,
    fields_of_gap,
    solve_scan,
)
from roughline.assessment.sought import find_sought
from roughline.computing.linear_algebra import on_one_thread
from roughline.contact.curve import Curve
from roughline.engineering.intervals import taken
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.facts.fact import Fact
from roughline.margins.causes import causes
from roughline.margins.filling import force_on_filled
from roughline.margins.sheared import shear_cycles
from roughline.margins.variant import AS_ASKED, Curves, Stopped, press_all
from roughline.question.case import Case
from roughline.question.kinds import nominal_area
from roughline.question.loads import LoadProgress
from roughline.question.question import Question
from roughline.theories.theory_curve import TheoryCurve
from roughline.topography.body import Body, Surface


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
        Called with (loads done, loads in all), over all the ways in which the body is pressed.

    Returns
    -------
    Assessment
        The curve with its intervals, answers by key, notes and warnings.

    Raises
    ------
    InputError
        If a file cannot be read, or the question does not suit what the file holds.
    """
    case = Case.of(question)
    curves, left_open, solution = _solved(case, announce, progress)
    answers, left_out = work_out_answers(case, solution)
    theories, others = _theories(question, case.body, solution.curve)
    scatter, widened, intervals = widen_by_scatter(case, curves, solution, answers)
    path = solution.sought.sheared
    margins = margins_by_cause(case, curves, left_open, answers, scatter, path)
    loads = case.loads.asked_loads(solution.curve)
    result = Assessment(
        question,
        case.parts,
        case.body,
        _with_fluid_recorded(case, _with_joint_recorded(solution.curve, question.joint)),
        loads,
        intervals=intervals,
        interrupted=bool(curves.stopped),
        answers={key: replace(each, margins=margins[key]) for key, each in widened.items()},
        left_out=[*left_out, *others],
        elastic=elastic_answers(case, curves),
        hardness_scatter=scatter,
        larger=taken(solution.larger, loads),
        measured=solution.measured,
        on_filled=force_on_filled(curves),
        fields_of_gap=fields_of_gap(case, curves),
        sought=solution.sought,
        theories=theories,
    )
    of_causes = [fact for each in causes for fact in each.facts(case, curves)]
    if titles := tuple(each.title for each in causes if each.name in curves.missing):
        of_causes.append(Fact("causes_missing", titles=titles))
    facts = collect_facts(result, of_causes)
    return replace(result, facts=facts)


def _solved(
    case: Case, announce: Announce | None, progress: LoadProgress | None
) -> tuple[Curves, LeftOpen | None, Solution]:
    """Press a body, or a line scan through its spectrum; with what causes leave open."""
    if case.scan is not None:
        solution = solve_scan(case, case.scan)
        return Curves({AS_ASKED: solution.curve}), None, solution
    curves = _pressed(case, announce, progress)
    left_open = LeftOpen.of(case, curves)
    solution = combine_curves(case, curves, left_open)
    slip, path = (
        slip_at_largest_load(case, curves),
        shear_cycles(case, curves, causes.sheared_otherwise(case)),
    )
    sought = replace(solution.sought, slip=slip, sheared=path)
    _refuse_all_at_the_hardness(case, solution.curve)
    return curves, left_open, replace(solution, sought=sought)


def _pressed(case: Case, announce: Announce | None, progress: LoadProgress | None) -> Curves:
    """Press the body in all ways that are needed, until Ctrl-C comes."""
    presses = list_presses(case)
    announce_cost(case, presses, announce)
    try:
        fluid = case.question.fluid
        keep_dents = fluid is not None and fluid.closure
        with on_one_thread():  # as each press is: once for all of them
            curves = press_all(presses, case.loads.count, progress, keep_dents=keep_dents)
            sought, is_stopped = find_sought(case, curves)
    except Stopped as stop:
        return stop.curves
    return replace(curves, sought=sought, stopped="sought" if is_stopped else "")


def _refuse_all_at_the_hardness(case: Case, curve: Curve) -> None:
    """Refuse depths at which all of the area is at the hardness; of forces it is known before."""
    all_at_hardness = np.flatnonzero(
        (curve.converged & ~case.loads.solved_loads(curve))[list(case.loads.asked)]
    )
    if case.loads.depths and all_at_hardness.size:
        heading = case.question.loading.headings[all_at_hardness[0]]
        raise InputError(
            f"depth {heading} indents all of the body: its whole area "
            "is at the hardness, and bears no more at any larger depth; give smaller ones"
        )


def _with_joint_recorded(curve: Curve, joint: float | None) -> Curve:
    """Record the joint that the map of a curve is a part of; forces of the curve are the map's."""
    if joint is None:
        return curve
    settings = {**curve.settings, "joint_area": joint, "joint_area_units": "m^2"}
    return replace(curve, settings={**settings, "curve_of": "map"})


def _with_fluid_recorded(case: Case, curve: Curve) -> Curve:
    """Record that a fluid carries a part of loads; forces of the curve are the bodies' own."""
    sealing = case.question.sealing
    if sealing is None:
        return curve
    load = sealing.load_on(curve.force, nominal_area(case.body))
    if not (load > curve.force).any():
        return curve
    settings = {**curve.settings, "fluid_pressure_above_outside": sealing.excess}
    units = {"fluid_pressure_above_outside_units": "Pa", "force_of": "bodies alone"}
    return replace(curve, settings={**settings, **units})


def _theories(question: Question, body: Body, curve: Curve) -> tuple[list[TheoryCurve], list[Fact]]:
    """Theories that are asked for, at the loads of a curve, and which are left out, and why."""
    if not question.theories or not isinstance(body, Surface):
        return [], []
    from roughline.theories.at_loads import theories_at_loads  # here because it loads slowly

    return theories_at_loads(question.theories, body, curve)
