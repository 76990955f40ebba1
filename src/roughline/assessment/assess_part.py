"""One body, or several maps of a part: each pressed alone, and what they say together."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

import attrs
import numpy as np

from roughline.assessment.answers import ends_in_common
from roughline.assessment.assess import assess_body
from roughline.assessment.assessment import Assessment
from roughline.assessment.cost import Announce
from roughline.assessment.part import PartAnswer, PartAssessment
from roughline.assessment.part_facts import differ_in_size, facts_of_part
from roughline.errors import InputError
from roughline.errors.public import public
from roughline.facts.fact import Fact, by_weight
from roughline.margins.parts import BehindMaps, behind_maps
from roughline.question.arguments import has_forces
from roughline.question.assumptions import broken
from roughline.question.loads import LoadProgress
from roughline.question.maps import map_names, refuse_unlike
from roughline.question.question import Question

_MapProgress = Callable[[int, int], None]
"""Called with (maps done, maps in all)."""


@dataclass
class _PressedMaps:
    """What became of the maps so far, by their names."""

    assessments: dict[str, Assessment] = field(default_factory=dict)
    refused: dict[str, str] = field(default_factory=dict)
    left: list[str] = field(default_factory=list)


@public
def assess(
    question: Question,
    *,
    announce: Announce | None = None,
    progress: LoadProgress | None = None,
    map_progress: _MapProgress | None = None,
) -> Assessment | PartAssessment:
    """Answer a question of one body, or of several maps of a part.

    Parameters
    ----------
    question : Question
        What is asked.
    announce, progress
        As for :func:`assess_body`.
    map_progress : callable, optional
        Called with (maps done, maps in all).

    Returns
    -------
    Assessment or PartAssessment
        A PartAssessment for maps given as a list, even if it holds a single one.

    Raises
    ------
    InputError
        If a file cannot be read, or the question does not suit what it holds; for several maps,
        only if this is so for all of them.

    Examples
    --------
    >>> import roughline as rl
    >>> spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=2.5e4)
    >>> surface = spectrum.surface(64, rng=7)  # in metres
    >>> question = rl.Question(surface, materials="steel,copper", loads="10 N", elastic=True)
    >>> result = rl.assess(question)
    >>> stiffness = result.answers["contact_stiffness"]
    >>> print(stiffness.name, stiffness.values.round(-5), stiffness.unit)
    contact stiffness [23000000.] N/m
    >>> resistance = result.answers["constriction_resistance"]
    >>> print(f"{resistance.values[0]:.3g} {resistance.unit}")
    0.000346 ohm
    """
    if not question.is_of_several:
        return assess_body(question, announce=announce, progress=progress)
    return assess_part(
        question.one_by_one(), announce=announce, progress=progress, map_progress=map_progress
    )


@public
def assess_part(
    questions: Sequence[Question],
    *,
    names: Sequence[str] | None = None,
    announce: Announce | None = None,
    progress: LoadProgress | None = None,
    map_progress: _MapProgress | None = None,
    answer: Callable[[Question], Assessment] | None = None,
) -> PartAssessment:
    """Answer one question for several maps of a part.

    A map that cannot be used is listed as refused, and the others are pressed. On Ctrl-C the maps
    that were done before are kept.

    Parameters
    ----------
    questions : sequence of Question
        Of one map each, alike but for the map and how it is read.
    names : sequence of str, optional
        What the maps are called; default: as their files are.
    announce, progress
        As for :func:`assess_body`, map by map.
    map_progress : callable, optional
        Called with (maps done, maps in all).
    answer : callable, optional
        Answers the question of one map instead of :func:`assess_body`, such as from stored results.

    Raises
    ------
    InputError
        If the questions are not alike, or no map can be pressed.
    KeyboardInterrupt
        On Ctrl-C before the first map was done.
    """
    answer = answer or partial(assess_map, announce=announce, progress=progress)
    refuse_unlike(questions)
    done = _PressedMaps()
    todo = list(zip(names or map_names(questions), questions, strict=True))
    for i, (name, question) in enumerate(todo):
        if map_progress is not None:
            map_progress(i, len(todo))
        if not _press(done, name, question, answer):
            done.left = [each for each, _ in todo[i:]]
            break
    else:
        if map_progress is not None:
            map_progress(len(todo), len(todo))
    if not done.assessments:
        if done.left:
            raise KeyboardInterrupt
        names_by_reason: dict[str, list[str]] = {}
        for name, why in done.refused.items():
            names_by_reason.setdefault(why, []).append(name)
        reasons = "; ".join(f"{', '.join(some)}: {why}" for why, some in names_by_reason.items())
        raise InputError(f"none of the {len(todo)} maps can be pressed: {reasons}")
    return _combined(done)


def assess_map(
    question: Question, *, announce: Announce | None = None, progress: LoadProgress | None = None
) -> Assessment:
    """Answer a question of one of several maps, whose names stand beside what is said of them.

    So messages call its file "this file".
    """
    asked = question
    if isinstance(question.body, Path):
        asked = attrs.evolve(question, reading=replace(question.reading, name="this file"))
    return replace(assess_body(asked, announce=announce, progress=progress), question=question)


def _press(
    done: _PressedMaps, name: str, question: Question, answer: Callable[[Question], Assessment]
) -> bool:
    """Press one map; says whether it came to its end."""
    try:
        result = answer(question)
    except InputError as error:
        done.refused[name] = str(error)
        return True
    except KeyboardInterrupt:
        return False
    if result.interrupted:
        return False
    for other, earlier in done.assessments.items():
        if np.array_equal(earlier.body.heights, result.body.heights):
            done.refused[name] = (
                f"its heights are those of {other}, and each place counts only once"
            )
            return True
    done.assessments[name] = result
    return True


def _combined(done: _PressedMaps) -> PartAssessment:
    """What the maps that were pressed say together."""
    results = list(done.assessments.values())
    first = results[0].question
    behind = behind_maps(results)
    answers = _answers(results, behind)
    missing = [Fact("refused", name=name, why=why) for name, why in done.refused.items()]
    missing += [Fact("not_pressed", names=tuple(done.left))] if done.left else []
    return PartAssessment(
        question=first,
        names=list(done.assessments),
        assessments=results,
        refused=done.refused,
        left=done.left,
        answers=answers,
        elastic=_elastic(results, answers),
        facts=by_weight([*missing, *facts_of_part(done.assessments, behind, answers)]),
    )


def _answers(results: Sequence[Assessment], behind: BehindMaps | None) -> Mapping[str, PartAnswer]:
    """Averages of the answers that all maps have, and that belong to one and the same thing."""
    question = results[0].question
    keys = [key for key in results[0].answers if all(key in each.answers for each in results)]
    if question.joint is None and differ_in_size(results):
        forced = has_forces(question.loads)
        keys = [key for key in keys if not forced and not results[0].answers[key].rule.is_extensive]
    common = [ends_in_common(each, behind) for each in results] if behind is not None else []
    sides = list(zip(*common, strict=True))  # what all miss alike, and by sharing the load
    measured = not any(broken("grid", each.body) for each in results)
    answers = {}
    for key in keys:
        is_of_part = behind is not None and (
            question.joint is not None or any(each.answers[key].is_of_larger for each in results)
        )
        is_known = is_of_part and all(key in each for each in sides[0])
        answers[key] = PartAnswer.of(
            [each.answers[key] for each in results],
            *([[each[key] for each in side] for side in sides] if is_known else ()),
            is_supported=measured
            and not (is_of_part and behind is not None and behind.why_unknown),
        )
    return {key: _bounded(each, answers) for key, each in answers.items()}


def _elastic(
    results: Sequence[Assessment], answers: Mapping[str, PartAnswer]
) -> Mapping[str, PartAnswer]:
    """Averages of what elastic bodies would give; a map in which nothing yields gives its own."""
    if not any(each.elastic for each in results):
        return {}
    of_maps = [each.elastic or each.answers for each in results]
    keys = [key for key in answers if any(key in each.elastic for each in results)]
    return {key: PartAnswer.of([each[key] for each in of_maps]) for key in keys}


def _bounded(answer: PartAnswer, answers: Mapping[str, PartAnswer]) -> PartAnswer:
    """Lower the upper end of an answer to that of another which it never exceeds."""
    bounds = [each.under for each in answer.of_maps if each.under is not None]
    if not bounds or bounds[0][0] not in answers:
        return answer
    factor = math.exp(np.mean([math.log(factor) for _, factor in bounds]))
    most = factor * answers[bounds[0][0]].high
    high = np.where(np.isnan(answer.high), np.nan, np.fmin(answer.high, most))
    return replace(answer, high=high)
