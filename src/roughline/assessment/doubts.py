"""Warnings of an assessment: where assumptions break, and what is suspicious; gravest first."""

from __future__ import annotations

import numpy as np

from roughline.assessment.assessment import Assessment
from roughline.assessment.notes import (
    ABOUT_THE_BODY,
    facts_on_each,
    line_scan_limits,
    repeated_border_jump,
)
from roughline.contact.borders import border_warnings
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.quantities import RESOLVED_FROM
from roughline.engineering.formulas import plasticity_index
from roughline.engineering.rules.mechanical import (
    CONTACT_STIFFNESS,
    INTERFACE_STIFFNESS,
    UNLOADING_STIFFNESS,
)
from roughline.facts.fact import Fact
from roughline.facts.hardness import summits_yield
from roughline.facts.heights import steep
from roughline.facts.intervals import (
    WhyNot,
    departs,
    grid_error_unknown,
    theories_assume_isotropy,
    theories_without_adhesion,
    wide,
)
from roughline.facts.layers import layers_are_strained
from roughline.facts.loads import Stands, all_touch, nearly_all_touch, on_filled_points
from roughline.measurement.homogeneity import ISOTROPIC_FROM
from roughline.question.assumptions import Prediction, departures_behind, takes_down
from roughline.question.case import COARSENED_FROM
from roughline.question.kinds import is_map
from roughline.question.question import Question
from roughline.spectra.isotropic import isotropy
from roughline.spectra.moments import Moments
from roughline.topography.body import Line, Surface
from roughline.topography.effects import grave_effects
from roughline.topography.files.read import suspicions

_LARGE_STRAIN = 0.1  # mean pressure over E*, or depth over side, above which a warning says so
_STEEP_SLOPE = 0.5  # rms slope above which a warning says that half-spaces assume small slopes
_PRESSED = _STEEP_SLOPE / 2  # mean contact pressure over E*, as on such slopes; on layers it is not
_WARNED_FILLED_SHARE = 0.05  # share of the force on filled points from which on a warning says so
_GRAVE_FILLED_SHARE = 0.5  # from which on answers are of heights that nobody measured
_WIDE_RATIO = 4.0  # upper over lower end from which on the causes of an interval are said
_COUNTED_RATIO = 1.2  # upper over lower end of what counts as a cause


def collect_warnings(
    result: Assessment, spectrum: Moments | None, grid_error_was_tried: bool
) -> list[Fact]:
    """What is suspicious, where assumptions break, and why there is no interval."""
    bodies, body, curve = [each.body for each in result.topographies], result.body, result.curve
    of_curve = [each for each in curve.facts if each.kind not in ABOUT_THE_BODY]
    is_scan = isinstance(body, Line) and body.kind == "profile"
    warnings = [
        *(of_curve if is_scan else _departures(result)),
        *result.left_out,
        *facts_on_each(bodies, suspicions),
        *facts_on_each(bodies, grave_effects),
        *_broken_assumptions(result, spectrum),
        *_filled_points_warnings(result),
        *_full_contact_warnings(result),
        *_wide_interval_warnings(result),
        *line_scan_limits(result.question, body),
        *([] if is_scan else of_curve),
        *_at_borders(result),
        *repeated_border_jump(result.question, body),
    ]
    if isinstance(body, Surface) and not _knows_grid_error(curve):
        warnings.append(_without_grid_error(result.question, body, grid_error_was_tried))
    return [each for each in warnings if each.is_warning]


def _knows_grid_error(curve: Curve) -> bool:
    """Whether the discretisation errors of a curve were estimated."""
    return isinstance(curve, SurfaceCurve) and curve.stiffness_error is not None


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
    made: dict[Prediction, bool] = {
        "grid": _knows_grid_error(result.curve),
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
            is_of_larger = "larger surface" in down
            fact = departs(
                departure.fact,
                takes_all="grid" in down,
                takes_theories="theories" in down,
                answers=names if is_of_larger else (),
                whole=whole,
            ).grave("grid" in down)
            found.append(fact.concerning(*unbounded) if down == {"larger surface"} else fact)
    return found


def _without_interval(result: Assessment) -> tuple[list[str], str]:
    """Keys of the answers of the joint or the larger surface that come without an interval.

    The second result names what they are all of, if that is so.
    """
    is_joint = result.question.joint is not None
    meant = {
        key: each
        for key, each in result.answers.items()
        if (is_joint or each.rule.is_of_interface) and not each.rule.is_given
    }
    unbounded = [key for key, each in meant.items() if each.low is None]
    whole = "joint" if is_joint else "larger surface"
    return unbounded, whole if len(unbounded) == len(meant) else ""


def _filled_points_warnings(result: Assessment) -> list[Fact]:
    """Say how much of the force stands on points that nobody measured."""
    if result.on_filled is None:
        return []
    shares = result.on_filled[result.asked]
    most = int(np.argmax(np.nan_to_num(shares)))
    if not shares[most] > _WARNED_FILLED_SHARE:
        return []
    fact = on_filled_points(result.headings[most], float(shares[most]))
    return [fact.grave(bool(shares[most] > _GRAVE_FILLED_SHARE))]


def _broken_assumptions(result: Assessment, spectrum: Moments | None) -> list[Fact]:
    """Say where an assumption breaks, and what is to be said with the answers."""
    question, body = result.question, result.body
    found = []
    if body.rms_slope > _STEEP_SLOPE:
        found.append(steep(body.rms_slope, _STEEP_SLOPE))
    found += _strained(result)
    hardness = None if question.pair is None or result.curve.hardness else question.pair.hardness
    if hardness is not None and spectrum is not None and not question.coated:  # summits have none
        summits = spectrum.summit_deviation, spectrum.summit_radius
        index = plasticity_index(result.curve.E_star, hardness, summits)
        if index > 1:
            found.append(summits_yield(index))
    if (
        question.theories
        and isinstance(body, Surface)
        and (ratio := isotropy(body)) < ISOTROPIC_FROM
    ):
        found.append(theories_assume_isotropy(ratio))
    if question.theories and question.attraction is not None:
        found.append(theories_without_adhesion())
    return found + [fact for each in result.answers.values() for fact in each.facts]


def _strained(result: Assessment) -> list[Fact]:
    """Say how far bodies are strained beyond what is linear elastic, by what strains them most."""
    question = result.question
    found = [each for each in question.strains(result.body) if each[0] > _LARGE_STRAIN]
    pressed = result.answers.get("contact_pressure")
    if question.coated and pressed is not None:
        ratio = float(np.nanmax(pressed.values, initial=0.0)) / question.half_space.softest
        if ratio > _PRESSED:
            found.append((ratio, layers_are_strained(ratio)))
    return [max(found, key=lambda each: each[0])[1]] if found else []


def _full_contact_warnings(result: Assessment) -> list[Fact]:
    """Say under which loads all points touch, or all but a few."""
    curve, body = result.curve_as_asked, result.body
    if not isinstance(curve, SurfaceCurve):
        return []
    # what repeats along both axes, and whose mean is not free, stands on a rigid base
    k_of: Stands = "on base" if all(curve.half_space.repeats) else "punch"
    k_of = "free" if curve.half_space.mean_is_free else k_of
    found = []
    open_points = np.rint((1 - curve.area_fraction) * body.heights.size)
    loads = list(zip(result.headings, open_points, strict=True))
    if full := tuple(name for name, n in loads if n == 0):
        found.append(all_touch(full, k_of))
    if nearly := tuple(name for name, n in loads if 0 < n < RESOLVED_FROM):
        found.append(nearly_all_touch(nearly, RESOLVED_FROM))
    return found


def _wide_interval_warnings(result: Assessment) -> list[Fact]:
    """Say why the interval of a stiffness is wide: its causes, the largest first, and a remedy."""
    rules = (INTERFACE_STIFFNESS, UNLOADING_STIFFNESS, CONTACT_STIFFNESS)
    answer = next((result.answers[each.key] for each in rules if each.key in result.answers), None)
    curve, points = result.curve_as_asked, result.body.heights.size
    if answer is None or answer.ends is None or not isinstance(curve, SurfaceCurve):
        return []
    with np.errstate(divide="ignore", invalid="ignore"):
        factors = np.nan_to_num(answer.ends[1] / answer.ends[0], posinf=0.0)
    load = int(np.argmax(factors))
    causes = [each for each in answer.why(load) if each.factor > _COUNTED_RATIO]
    if factors[load] < _WIDE_RATIO or not causes:
        return []
    found = tuple((each.title, each.remedy, each.factor) for each in causes)
    cells = round(float(curve.area_fraction[load]) * points)
    heading, factor = result.headings[load], float(factors[load])
    fact = wide(answer.name, heading, factor, found, cells, points)
    return [fact.concerning(answer.key)]


def _without_grid_error(question: Question, body: Surface, tried: bool) -> Fact:
    """Say that values come without an interval, and why; `tried` if Ctrl-C stopped the estimate."""
    why: WhyNot = "takes long"
    if tried:
        why = "interrupted"
    elif question.grid_error is not None:
        why = "switched off"
    elif min(body.shape) < COARSENED_FROM:
        why = "few points"
    return grid_error_unknown(why, COARSENED_FROM)
