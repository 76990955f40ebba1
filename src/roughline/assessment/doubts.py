"""Warnings of an assessment: where assumptions break, and what is suspicious; gravest first."""

from __future__ import annotations

import numpy as np

from roughline.assessment.assessment import Assessment
from roughline.assessment.assumptions import Prediction, departures_behind, takes_down
from roughline.assessment.case import COARSENED_FROM
from roughline.assessment.kinds import is_map
from roughline.assessment.notes import (
    MOST_NAMED,
    line_scan_limits,
    listed_in_short,
    not_answered,
    repeated_border_jump,
    texts_on_each,
)
from roughline.assessment.question import Question
from roughline.computing.arrays import Indices
from roughline.contact.borders import border_warnings
from roughline.contact.curve import Curve, SurfaceCurve
from roughline.contact.quantities import RESOLVED_FROM
from roughline.engineering.formulas import plasticity_index
from roughline.engineering.rules.mechanical import (
    CONTACT_STIFFNESS,
    INTERFACE_STIFFNESS,
    UNLOADING_STIFFNESS,
)
from roughline.errors.remark import INTERVALS, Remark, remarks
from roughline.errors.words import called
from roughline.spectra.homogeneity import ISOTROPIC_FROM
from roughline.spectra.isotropic import isotropy
from roughline.spectra.moments import Moments
from roughline.topography.body import Line, Surface
from roughline.topography.effects import grave_effects
from roughline.topography.files.read import suspicions
from roughline.units import decimal

_LARGE_STRAIN = 0.1  # mean pressure over E*, or depth over side, above which a warning says so
_STEEP_SLOPE = 0.5  # rms slope above which a warning says that half-spaces assume small slopes
_PRESSED = _STEEP_SLOPE / 2  # mean contact pressure over E*, as on such slopes; on layers it is not
_WARNED_FILLED_SHARE = 0.05  # share of the force on filled points from which on a warning says so
_GRAVE_FILLED_SHARE = 0.5  # from which on answers are of heights that nobody measured
_WIDE_RATIO = 4.0  # upper over lower end from which on the causes of an interval are said
_COUNTED_RATIO = 1.2  # upper over lower end of what counts as a cause


def collect_warnings(
    result: Assessment, spectrum: Moments | None, grid_error_was_tried: bool
) -> list[Remark]:
    """What is suspicious, where assumptions break, and why there is no interval."""
    bodies, body, curve = [each.body for each in result.topographies], result.body, result.curve
    borders, are_grave = repeated_border_jump(result.question, body)
    of_line, is_grave = line_scan_limits(result.question, body)
    # what a curve says of where it is repeated is said below, as a warning or as a note
    warned_below = {
        borders,
        *grave_effects(body),
        *_border_texts(result, np.arange(curve.status.size)),
    }
    of_curve = [text for text in curve.warnings if text not in warned_below]
    is_scan = isinstance(body, Line) and body.kind == "profile"
    warnings = [
        *(of_curve if is_scan else _departures_in_words(result)),
        *not_answered(result),
        *remarks(texts_on_each(bodies, suspicions), is_grave=True),
        *remarks(texts_on_each(bodies, grave_effects), is_grave=True),
        *_broken_assumptions(result, spectrum),
        *_filled_points_warnings(result),
        *remarks(_full_contact_warnings(result), is_grave=True),
        *remarks(_wide_interval_warnings(result), INTERVALS),
        *remarks([of_line] if is_grave else [], is_grave=True),
        *([] if is_scan else of_curve),
        *_border_texts(result, result.asked),
        *remarks([borders] if are_grave else [], is_grave=True),
    ]
    if isinstance(body, Surface) and not _knows_grid_error(curve):
        why = _why_without_grid_error(result.question, body, grid_error_was_tried)
        warnings.append(Remark(why, INTERVALS))
    return remarks(warnings)


def _knows_grid_error(curve: Curve) -> bool:
    """Whether the discretisation errors of a curve were estimated."""
    return isinstance(curve, SurfaceCurve) and curve.stiffness_error is not None


def _border_texts(result: Assessment, loads: Indices) -> tuple[str, ...]:
    """Say what the border carries under some loads, which need not be all that were pressed."""
    curve = result.curve
    if not isinstance(curve, SurfaceCurve):
        return ()
    return border_warnings(curve.surface, curve.force[loads], curve.border_share[loads])


def _departures_in_words(result: Assessment) -> list[Remark]:
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
    texts = []
    for departure in departures_behind(predictions, result.body):
        down = {
            prediction: _without_interval(result, prediction)
            for prediction in predictions
            if takes_down(departure, prediction, result.body)
        }
        if down:
            text = "; ".join([departure.text, *filter(None, dict.fromkeys(down.values()))])
            texts.append(Remark(text, INTERVALS, is_grave="grid" in down))
    return texts


def _without_interval(result: Assessment, prediction: Prediction) -> str:
    """Say which answers come without an interval, as far as there are any."""
    if prediction == "theories":
        return "theories assume otherwise"
    if prediction == "grid":
        return "all values come without an interval"
    is_joint = result.question.joint is not None
    meant = [
        each
        for each in result.answers.values()
        if (is_joint or each.rule.is_of_interface) and not each.rule.is_given
    ]
    unbounded = [each.name for each in meant if each.low is None]
    if not unbounded:
        return ""
    names = listed_in_short(unbounded)
    if MOST_NAMED < len(unbounded) == len(meant):
        names = f"all answers of the {'joint' if is_joint else 'larger surface'}"
    return f"{names} {'comes' if len(unbounded) == 1 else 'come'} without an interval"


def _filled_points_warnings(result: Assessment) -> list[Remark]:
    """Say how much of the force stands on points that nobody measured."""
    if result.on_filled is None:
        return []
    shares = result.on_filled[result.asked]
    most = int(np.argmax(np.nan_to_num(shares)))
    if not shares[most] > _WARNED_FILLED_SHARE:
        return []
    text = (
        f"{shares[most]:.0%} of the force of load {result.headings[most]} stands on points that "
        "were missing and filled, which nobody measured: measure them, or crop to where points are "
        f"known ({called('crop')})"
    )
    return [Remark(text, INTERVALS, is_grave=bool(shares[most] > _GRAVE_FILLED_SHARE))]


def _broken_assumptions(result: Assessment, spectrum: Moments | None) -> list[Remark]:
    """Say where an assumption breaks, and what is to be said with the answers."""
    question, body = result.question, result.body
    broken: list[str] = []
    if body.rms_slope > _STEEP_SLOPE:
        broken.append(
            f"the rms slope is {decimal(body.rms_slope, 2)}, and half-spaces assume small slopes: "
            f"no interval includes the effect of slopes over {_STEEP_SLOPE:g}"
        )
    broken += _strained(result)
    hardness = None if question.pair is None or result.curve.hardness else question.pair.hardness
    if hardness is not None and spectrum is not None and not question.coated:  # summits have none
        summits = spectrum.summit_deviation, spectrum.summit_radius
        index = plasticity_index(result.curve.E_star, hardness, summits)
        if index > 1:
            broken.append(
                f"the plasticity index is {decimal(index, 2)}, over 1: summits yield at first "
                "touch; under repeated loads they deform elastically about their flattened shape"
            )
    found = remarks(broken, is_grave=True)
    if (
        question.theories
        and isinstance(body, Surface)
        and (ratio := isotropy(body)) < ISOTROPIC_FROM
    ):
        text = (
            "theories assume an isotropic surface, and the rms slope depends on direction: the "
            f"least is {ratio:.2f} of the largest"
        )
        found.append(Remark(text))
    if question.theories and question.attraction is not None:
        found.append(Remark("theories leave out that the bodies stick"))
    return found + remarks(each.warning for each in result.answers.values() if each.warning)


def _strained(result: Assessment) -> list[str]:
    """Say how far bodies are strained beyond what is linear elastic, by what strains them most."""
    question, texts = result.question, []
    ratio, text = max(question.strains(result.body), default=(0.0, ""))
    if ratio > _LARGE_STRAIN:
        so_far = "bodies that are strained so far are not linear elastic"
        texts.append((ratio, f"{text}: {so_far}, and no interval includes that"))
    pressed = result.answers.get("contact_pressure")
    if question.coated and pressed is not None:
        ratio = float(np.nanmax(pressed.values, initial=0.0)) / question.half_space.softest
        if ratio > _PRESSED:
            text = (
                f"the mean contact pressure reaches {decimal(ratio, 2)} times the contact modulus "
                "of the softest materials: unless a layer of these is too thin to move aside, or "
                "lies deep, it is strained beyond what is linear elastic, and no interval includes "
                "that"
            )
            texts.append((ratio, text))
    return [max(texts)[1]] if texts else []


def _full_contact_warnings(result: Assessment) -> list[str]:
    """Say under which loads all points touch, or all but a few."""
    curve, body = result.curve_as_asked, result.body
    if not isinstance(curve, SurfaceCurve):
        return []
    if curve.half_space.mean_is_free:
        rest = "stiffness is infinite"
    else:  # what repeats along both axes nevertheless stands on a rigid base
        on_base = all(curve.half_space.repeats)
        rest = f"k is that of {'even pressure on the rigid base' if on_base else 'a flat punch'}"
    notes = []
    open_points = np.rint((1 - curve.area_fraction) * body.heights.size)
    full = [name for name, n in zip(result.headings, open_points, strict=True) if n == 0]
    nearly = [
        name for name, n in zip(result.headings, open_points, strict=True) if 0 < n < RESOLVED_FROM
    ]
    if full:
        notes.append(f"all points touch under {', '.join(full)}: no gap is left, and {rest}")
    if nearly:
        notes.append(
            f"fewer than {RESOLVED_FROM} points do not touch under {', '.join(nearly)}: the "
            "stiffness of the interface is that of these last gaps, which the grid decides, and "
            "without them it is infinite"
        )
    return notes


def _wide_interval_warnings(result: Assessment) -> list[str]:
    """Say why the interval of a stiffness is wide: its causes, the largest first, and a remedy."""
    curve, points = result.curve_as_asked, result.body.heights.size
    rules = (INTERFACE_STIFFNESS, UNLOADING_STIFFNESS, CONTACT_STIFFNESS)
    answer = next((result.answers[each.key] for each in rules if each.key in result.answers), None)
    ends = None if answer is None else answer.ends
    if answer is None or ends is None or not isinstance(curve, SurfaceCurve):
        return []
    error, k = curve.unloading_stiffness_error, curve.unloading_stiffness
    if error is None:
        return []
    with np.errstate(divide="ignore", invalid="ignore"):
        widths, of_grid = np.log(ends[1] / ends[0]), 2 * np.log1p(error / k)
        scatter = result.hardness_scatter.get(answer.key)
        of_hardness = 0 * widths if scatter is None else np.log(scatter[1] / scatter[0])
        of_piece = np.sqrt(np.maximum((widths - of_hardness) ** 2 - of_grid**2, 0))
    widths = np.where(np.isfinite(widths), widths, 0)
    i = int(np.argmax(widths))
    if widths[i] < np.log(_WIDE_RATIO):
        return []
    cells = round(float(curve.area_fraction[i]) * points)
    causes = [
        (of_grid[i], f"the grid, with {cells} of {points} points in contact", "finer pixels"),
        (of_hardness[i], "the scatter of the hardness", "a measured hardness"),
    ]
    if answer.rule is INTERFACE_STIFFNESS:
        causes.append((of_piece[i], "what one map does not show", "a larger map, or several maps"))
    causes = sorted((each for each in causes if each[0] > np.log(_COUNTED_RATIO)), reverse=True)
    if not causes:
        return []
    texts = [f"{what} (a factor of {decimal(float(np.exp(w)), 2)})" for w, what, _ in causes]
    return [
        f"the {answer.name} under {result.headings[i]} is known to a factor of "
        f"{decimal(float(np.exp(widths[i])), 2)} between both ends; it is left open by "
        f"{', then by '.join(texts)}: {causes[0][2]} would narrow it most"
    ]


def _why_without_grid_error(question: Question, body: Surface, tried: bool) -> str:
    """Say that values come without an interval, and why; `tried` if Ctrl-C stopped the estimate."""
    option = called("grid_error", True)
    if tried:
        why = "interrupted before"
    elif question.grid_error is not None:
        why = "switched off"
    elif min(body.shape) < COARSENED_FROM:
        why = (
            f"fewer than {COARSENED_FROM} points a side; with {option} it is estimated nevertheless"
        )
    else:
        why = f"that takes about twice as long; with {option} it is estimated"
    return f"grid error not estimated, so values come without intervals ({why})"
