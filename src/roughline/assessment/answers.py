"""What follows from curves for two materials."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from attrs import evolve

from roughline.assessment.assessment import Assessment
from roughline.assessment.solution import LeftOpen, Solution, combine_curves
from roughline.computing.arrays import Real
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.selection import at_loads, first_fields
from roughline.contact.status import Status
from roughline.engineering.intervals import Ends, Intervals, taken
from roughline.engineering.margin import MATTERS, Margin
from roughline.engineering.pair import MaterialPair
from roughline.engineering.pressed import InterfaceStiffness, Pressed
from roughline.engineering.rule import Answer
from roughline.engineering.rules import rules
from roughline.engineering.rules.friction import SHEAR_ANSWERS
from roughline.engineering.slip import ShearCycles
from roughline.facts.fact import Fact
from roughline.margins.causes import HARDNESS, causes
from roughline.margins.larger_surface import Differences, stiffness_of_the_piece
from roughline.margins.parts import BehindMaps
from roughline.margins.scans import ONE_SCAN
from roughline.margins.spread import measured_within
from roughline.margins.variant import Curves
from roughline.question.case import Case
from roughline.question.films import hardness_ends
from roughline.question.kinds import has_spectrum, nominal_area
from roughline.question.question import Question
from roughline.spectra.moments import Moments, moments
from roughline.topography.body import Body, Surface


def work_out_answers(
    case: Case, solution: Solution, *, body: Body | None = None, hardness: float | None = None
) -> tuple[Mapping[str, Answer], Sequence[Fact]]:
    """Answers at the loads that were asked for, by their keys, and which are left out, and why.

    The solution is that of the case, or of a variant of it with another body or hardness [Pa].
    """
    question, body = case.question, case.body if body is None else body
    if hardness is not None:
        question = evolve(question, hardness=hardness)
    if question.pair is None:
        return {}, []
    loads = case.loads.asked_loads(solution.curve)
    curve = at_loads(solution.curve, loads)
    intervals = taken(solution.intervals, loads)
    interface = None
    if solution.larger is not None:
        interface = taken(solution.larger.stiffness, loads)
        # what one piece leaves open is narrower than what is unknown without the grid's error
        interface = interface.without_interval if intervals is None else interface
    elif not question.periodic:
        ends = intervals.unloading if intervals else None
        is_layered = bool(question.coated)
        interface = stiffness_of_the_piece(body, curve, solution.punch, ends, is_layered=is_layered)
    pressed = _pressed(question, question.pair, body, curve, interface, intervals, case.moments)
    found = replace(
        pressed,
        measured=taken(solution.measured, loads),
        is_repeated=case.is_repeated_for_interface or case.loads.periodic is True,
        place=solution.place,
        sought=solution.sought,
        fields=first_fields(solution.curve),
    )
    answers, left_out = rules.answers(found)
    if found.lifted.all():  # what a fluid lifts has no answers of its contact
        answers = {key: each for key, each in answers.items() if np.isfinite(each.values).any()}
    return answers, left_out


def margins_by_cause(
    case: Case,
    curves: Curves,
    left_open: LeftOpen | None,
    answers: Mapping[str, Answer],
    scatter: Mapping[str, Ends],
    sheared: ShearCycles | None = None,
) -> Mapping[str, Sequence[Margin]]:
    """How far each cause alone leaves each answer open; its ends are NaN where that is not known.

    An answer that is sought brings an interval of its own, of its half grid and its quarters.
    """
    found: dict[str, list[Margin]] = {key: [] for key in answers}
    if left_open is None:  # of a line scan, whose lines are all that leaves it open
        for key, answer in answers.items():
            if answer.ends is not None and _is_open(answer):
                found[key].append(Margin(*ONE_SCAN, *answer.ends))
    else:

        def answered(left_open: LeftOpen, cause: str) -> Mapping[str, Answer]:
            solution = combine_curves(case, curves, left_open)
            path = None if sheared is None else sheared.by(cause)
            sought = replace(solution.sought, sheared=path)
            return work_out_answers(case, replace(solution, sought=sought))[0]

        own = answered(left_open.by(""), "")
        open_alone = {key for key in answers if _is_open(own.get(key))}
        for each in causes:
            if each.is_bound or (each.is_of_shear and sheared is None):
                continue
            by_cause, text = left_open.by(each.name), (each.name, each.title, each.remedy)
            moved = alone = answered(by_cause, each.name)
            if not by_cause.is_known:  # what it moves is seen as something else moves as much
                moved = answered(by_cause.probed(case, curves), each.name)
            for key, answer in answers.items():
                is_of_shear = answer.rule in SHEAR_ANSWERS
                is_moved = _is_open(moved.get(key))
                if is_of_shear and sheared is not None and each.name in sheared.others:
                    is_moved = is_moved or sheared.others[each.name] is None
                if key in open_alone or answer.rule.is_given or not is_moved:
                    continue
                ends = alone[key].ends if _is_open(alone[key]) else None
                ends = ends or (np.full_like(answer.values, np.nan),) * 2
                of_larger = each.is_of_larger and not is_of_shear
                margin = Margin(*text, *ends, is_of_larger=of_larger)
                found[key].append(margin)
    for key, (least, most) in scatter.items():
        if answers[key].rule.is_given:
            continue
        values = answers[key].values
        low, high = (np.where(values == 0, 0.0, values * each) for each in (least, most))
        found[key].append(
            Margin(HARDNESS.name, HARDNESS.title, HARDNESS.remedy, low, high, is_bound=True)
        )
    return {key: [each for each in margins if each.matters] for key, margins in found.items()}


def _is_open(answer: Answer | None) -> bool:
    """Whether an answer has an interval that is more than its value, but for rounding."""
    if answer is None or answer.ends is None:
        return False
    return not np.isclose(
        answer.ends, answer.values, rtol=MATTERS - 1, atol=0, equal_nan=True
    ).all()


def ends_from_many(
    result: Assessment, further: Differences, *, with_grid: bool
) -> Mapping[str, Ends]:
    """Ends of the answers of one of many maps, by their keys, over the loads that were asked for.

    `with_grid` says whether they hold what the grid leaves open as well.
    """
    larger, curve, pair = result.larger, result.curve_as_asked, result.question.pair
    if larger is None or pair is None or not isinstance(curve, SurfaceCurve):
        return {}
    own = [each.name for each in causes.independent if not each.is_of_larger]
    larger = larger.from_many(further, own if with_grid else [])
    intervals = result.intervals_as_asked if with_grid else None
    if result.question.joint is not None:  # the map is pressed as a part of the larger one
        intervals = larger.intervals
    body = result.body
    spectrum = moments(body) if has_spectrum(body) else None
    pressed = _pressed(result.question, pair, body, curve, larger.stiffness, intervals, spectrum)
    measured = dict(taken(result.measured, result.asked))
    if not with_grid:
        measured = {
            key: replace(each, low=each.values, high=each.values) for key, each in measured.items()
        }
    of_many = {key: measured[key] for key in further.measures}
    measured |= measured_within(of_many, larger.spreads.values())
    found_answers, _ = rules.answers(
        replace(
            pressed, measured=measured, is_repeated=True, sought=result.sought, fields=result.fields
        )
    )
    return {key: each.ends for key, each in found_answers.items() if each.ends is not None}


def ends_in_common(result: Assessment, behind: BehindMaps) -> tuple[Mapping[str, Ends], ...]:
    """What a map misses as all others do of each answer, and how sharing its load changes it."""
    common = ends_from_many(result, behind.common, with_grid=True)
    moved = result.hardness_scatter
    with np.errstate(invalid="ignore"):  # nothing, times infinity
        common = {
            key: (ends[0] * moved[key][0], ends[1] * moved[key][1]) if key in moved else ends
            for key, ends in common.items()
        }
    return common, ends_from_many(result, behind.sharing, with_grid=False)


def _pressed(
    question: Question,
    pair: MaterialPair,
    body: Body,
    curve: Curve,
    interface: InterfaceStiffness | None,
    intervals: Intervals | None,
    spectrum: Moments | None,
) -> Pressed:
    """What the rules of the answers are given."""
    ends = hardness_ends(question, curve)
    return Pressed(
        curve,
        nominal_area(body),
        pair,
        joint=question.joint,
        interface=interface,
        rms_height=body.rms_height,
        rms_slope=spectrum.rms_slope if spectrum else None,
        frequency=question.frequency_in_hertz,
        intervals=intervals,
        hardest=ends[1] if ends and isinstance(body, Surface) else None,
        has_depths=bool(question.depths),
        sealing=question.sealing,
        load_on_body=_load_on(question, curve, nominal_area(body)),
        attraction=question.attraction,
    )


def _load_on(question: Question, curve: Curve, area: float) -> Real | None:
    """Forces on a body of an area [m²]; of a body that a fluid lifts, those that were asked. [N]"""
    sealing = question.sealing
    if sealing is None:
        return None
    lifted, load = curve.status == Status.LIFTED, sealing.load_on(curve.force, area)
    return np.where(lifted, question.loading.forces(area), load) if lifted.any() else load
