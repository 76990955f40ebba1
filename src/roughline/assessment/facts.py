"""All that is told with an assessment: what was found, and what its answers show together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from roughline.assessment.assessment import Assessment
from roughline.contact.borders import border_warnings
from roughline.contact.curve import SurfaceCurve
from roughline.engineering.conduction import facts_on_currents
from roughline.engineering.rules.friction import SHEAR_ANSWERS
from roughline.engineering.rules.mechanical import (
    CONTACT_STIFFNESS,
    INTERFACE_STIFFNESS,
    UNLOADING_STIFFNESS,
)
from roughline.facts.fact import Fact, by_weight
from roughline.facts.listed import MOST_NAMED
from roughline.margins.border_of_flow import COUNTED_RATIO, what_borders_do
from roughline.margins.scans import limits_of_line
from roughline.measurement.homogeneity import ISOTROPIC_FROM
from roughline.question.assumptions import Prediction, departures_behind, takes_down
from roughline.question.kinds import is_map
from roughline.question.meant import facts_on_loads, facts_on_strain
from roughline.question.question import Question
from roughline.spectra.isotropic import isotropy
from roughline.topography.body import Body, Line, Surface
from roughline.topography.effects import what_was_prepared
from roughline.topography.files.read import suspicions
from roughline.topography.two_bodies import facts_on_facing

_WIDE_RATIO = 4.0  # upper over lower end from which on the causes of an interval are said


def collect_facts(result: Assessment, of_causes: Sequence[Fact]) -> list[Fact]:
    """All that is worth telling, each once, the gravest first."""
    question, body, curve, pair = result.question, result.body, result.curve, result.question.pair
    is_scan = isinstance(body, Line) and body.kind == "profile"  # which tells of departures itself
    return by_weight(
        [
            *([] if is_scan else _departures(result)),
            *(each for each in curve.facts if each.kind != "border_carries"),
            *result.left_out,
            *_on_bodies([each.body for each in result.topographies]),
            *facts_on_facing(body),
            *facts_on_strain(body, question.strains(body)),
            *_on_theories(question, body),
            *(fact for each in result.answers.values() for fact in each.facts),
            *_on_wide_intervals(result),
            *_on_shear(result),
            *limits_of_line(question, body),
            *(() if pair is None else pair.facts),
            *_on_layers(result),
            *what_borders_do(question.sealing, result.larger, result.answers, result.headings),
            *_at_borders(result),
            *of_causes,
            *facts_on_loads(question, body),
        ]
    )


def _on_bodies(bodies: Sequence[Body]) -> Iterator[Fact]:
    """Say what is suspicious in each topography and how it was prepared, and of which that is."""
    for which, body in zip(("first", "second"), bodies, strict=False):
        for fact in (*suspicions(body), *what_was_prepared(body)):
            is_one = len(bodies) == 1
            yield fact if is_one else fact.within(Fact("on_body", fact=fact, which=which))


def _on_theories(question: Question, body: Body) -> Iterator[Fact]:
    """Say what theories leave out."""
    if question.theories and isinstance(body, Surface):
        if (ratio := isotropy(body)) < ISOTROPIC_FROM:
            yield Fact("theories_assume_isotropy", ratio=ratio)
        if question.attraction is not None:
            yield Fact("theories_without_adhesion")


def _on_layers(result: Assessment) -> list[Fact]:
    """Say what is not known of a larger surface of layers, and of currents through them."""
    question, pair, is_piece = result.question, result.question.pair, result.larger is None
    if pair is None or not pair.coated:
        return []
    is_joint, is_repeated = question.joint is not None, question.is_repeated
    found = facts_on_currents(pair, is_repeated=is_repeated, is_piece=is_piece, is_joint=is_joint)
    if is_joint or is_map(result.body):
        keys = {key: each.name for key, each in result.answers.items() if each.is_of_larger}
        fact = Fact("larger_surface_of_layers", answers=tuple(keys.values()))
        found.append(fact.concerning(*keys))
    return found


def _at_borders(result: Assessment) -> tuple[Fact, ...]:
    """Say what the border carries under the loads that were asked for, of all that were pressed."""
    curve, loads = result.curve, result.asked
    if not isinstance(curve, SurfaceCurve):
        return ()
    return border_warnings(curve.surface, curve.force[loads], curve.border_share[loads])


def _departures(result: Assessment) -> list[Fact]:
    """Say how what was pressed departs from assumptions, gravest first, and what that takes down.

    Nothing is said of a departure on which no answer to the question rests. What a line scan
    shows is said where it is pressed.
    """
    curve = result.curve
    made: dict[Prediction, bool] = {
        "grid": isinstance(curve, SurfaceCurve) and curve.stiffness_error is not None,
        "larger surface": is_map(result.body) and bool(result.answers),
        "theories": bool(result.theories),
    }
    predictions = [prediction for prediction, is_made in made.items() if is_made]
    unbounded, whole = _without_interval(result)
    names = tuple(result.answers[key].name for key in unbounded)
    found = []
    for departure in departures_behind(predictions, result.body):
        down = {each for each in predictions if takes_down(departure, each, result.body)}
        if down:
            lost = {"takes_all": "grid" in down, "takes_theories": "theories" in down}
            of = names if "larger surface" in down else ()
            fact = Fact("departs", fact=departure.fact, answers=of, whole=whole, **lost)
            fact = fact.grave("grid" in down)
            found.append(fact.concerning(*unbounded) if down == {"larger surface"} else fact)
    return found


def _without_interval(result: Assessment) -> tuple[list[str], str]:
    """Keys of the answers of the joint or the larger surface that come without an interval.

    The second result names what they are all of, if that is so and they are many.
    """
    is_joint = result.question.joint is not None
    meant = {
        key: each
        for key, each in result.answers.items()
        if (is_joint or each.is_of_larger) and not each.rule.is_given
    }
    unbounded = [key for key, each in meant.items() if each.low is None]
    whole = "joint" if is_joint else "larger surface"
    return unbounded, whole if MOST_NAMED < len(unbounded) == len(meant) else ""


def _on_shear(result: Assessment) -> Iterator[Fact]:
    """Say what is not known of the answers of a shear force, or that there are none."""
    question, sheared = result.question, result.sought.sheared
    if question.shear is None:
        return
    if sheared is None:
        yield Fact("shear_not_solved", interrupted=result.interrupted).grave()
        return
    of_shear = [each for each in result.answers.values() if each.rule in SHEAR_ANSWERS]
    margins = (each for answer in of_shear for each in answer.margins)
    unknown = {each.cause: each.title for each in margins if not each.factor[-1] >= 1}
    if unknown:
        why = {name: name in unknown for name in ("place", "filling", "grid")}
        fact = Fact("shear_left_open", causes=tuple(unknown.values()), **why)
        yield fact.concerning(*(each.key for each in of_shear))


def _on_wide_intervals(result: Assessment) -> Iterator[Fact]:
    """Say why the interval of a stiffness is wide: its causes, the largest first, and a remedy."""
    rules = (INTERFACE_STIFFNESS, UNLOADING_STIFFNESS, CONTACT_STIFFNESS)
    answer = next((result.answers[each.key] for each in rules if each.key in result.answers), None)
    curve, points = result.curve_as_asked, result.body.heights.size
    if answer is None or answer.ends is None or not isinstance(curve, SurfaceCurve):
        return
    with np.errstate(divide="ignore", invalid="ignore"):
        factors = np.nan_to_num(answer.ends[1] / answer.ends[0], posinf=0.0)
    i = int(np.argmax(factors))
    causes = [each for each in answer.why(i) if each.factor > COUNTED_RATIO]
    if factors[i] < _WIDE_RATIO or not causes:
        return
    yield Fact(
        "wide",
        answer=answer.name,
        load=result.headings[i],
        factor=float(factors[i]),
        cells=round(float(curve.area_fraction[i]) * points),
        points=points,
        causes=tuple(Fact("left_open", title=each.title, factor=each.factor) for each in causes),
        remedy=causes[0].remedy,
    ).concerning(answer.key)
