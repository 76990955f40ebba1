"""Notes that go with the numbers: on the topographies, the loads, and what is not known."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from roughline.assessment.assessment import Assessment
from roughline.assessment.assumptions import Prediction, takes_down
from roughline.assessment.given import has_forces, several
from roughline.assessment.hardness import hardness_of
from roughline.assessment.kinds import WITHOUT_YIELD, is_map, nominal_area
from roughline.assessment.question import Question
from roughline.contact.quantities import RESOLVED_FROM
from roughline.engineering.formulas import ELASTIC_UP_TO, plasticity_index
from roughline.engineering.pair import MaterialPair
from roughline.engineering.rules.mechanical import (
    CONTACT_STIFFNESS,
    INTERFACE_STIFFNESS,
    UNLOADING_STIFFNESS,
)
from roughline.errors.words import called
from roughline.spectra.alike import ALIKE
from roughline.spectra.departures import departures
from roughline.spectra.isotropic import isotropy
from roughline.spectra.moments import Moments
from roughline.topography.body import Body, Line, Surface
from roughline.topography.effects import effects, grave_effects
from roughline.topography.repetition import border_jump
from roughline.units import LEAST_CHANGE, change_in_words, decimal, engineering

_STRAINED = 0.1  # mean pressure over E*, or depth over side, above which a warning says so
_STEEP = 0.5  # rms slope above which a warning says that half-spaces assume small slopes
_WIDE = 4.0  # upper over lower end from which on the causes of an interval are said
_COUNTS = 1.2  # upper over lower end of what counts as a cause


def of_each(bodies: Sequence[Body], say: Callable[[Body], Sequence[str]]) -> list[str]:
    """Say something of each topography, and of which of two it is."""
    if len(bodies) == 1:
        return list(say(bodies[0]))
    return [
        f"{which} body: {note}"
        for which, body in zip(("first", "second"), bodies, strict=True)
        for note in say(body)
    ]


def what_was_prepared(body: Body) -> list[str]:
    """Say what was filled, what spikes there are, and all that the preparation did."""
    return [*grave_effects(body), *filled_spikes_and_effects(body)]


def filled_spikes_and_effects(body: Body) -> list[str]:
    """Say what was filled, what spikes there are, and what the preparation did, unless grave."""
    notes = []
    if body.settings.get("missing_points"):
        count, share = body.settings["missing_points"], float(body.settings["missing_share"])
        notes.append(f"{count} missing points ({share:.2%}) filled: {body.settings['filled']}")
    if body.settings.get("filled_before_crop"):
        notes.append(
            f"{body.settings['filled_before_crop']} missing points had been filled before this "
            "piece was cropped, and it is not known how many of them are in it"
        )
    if body.settings.get("outliers_kept"):
        notes.append(
            f"{body.settings['outliers_kept']} spikes kept; the highest point decides the depth of "
            "first touch, so check whether they are real, or remove them"
        )
    if body.settings.get("outliers_removed"):
        notes.append(f"{body.settings['outliers_removed']} spikes removed and filled")
    return notes + [each.text for each in effects(body) if not each.is_grave]


def meaning_of_loads(question: Question, body: Body) -> list[str]:
    """Say of each load what it is in all, and over which area."""
    area = nominal_area(body)
    if isinstance(body, Surface):
        sides = " x ".join(engineering(s, "m") for s in body.sizes)
        nominal = f"the nominal area, {sides}"
    else:
        nominal = f"the square of the line's length, {engineering(body.length, 'm')}"
    loads = question.headings[: len(several(question.loads))]  # unloading speaks for itself
    notes = []
    for text, force in dict(zip(loads, question.forces(area), strict=False)).items():
        if force == 0:
            continue
        pressure = engineering(force / area, "Pa")
        if question.joint is None:
            notes.append(
                f"load {text}: {engineering(force, 'N')} in all, {pressure} over {nominal}"
            )
        else:
            on_joint = engineering(force * question.scale(area), "N")
            joint = engineering(question.joint, "m²")
            notes.append(
                f"load {text}: {on_joint} on the joint of {joint}, {pressure} everywhere; "
                f"{engineering(force, 'N')} of it on the map, {sides}"
            )
    if has_forces(question.loads) and question.joint is None and is_map(body):
        notes.append(
            "forces act on the map alone, not on the part that it was cut out of; if the area of "
            f"the joint is given ({called('rl.Joint')}), they act on the joint, and the "
            "answers are those of "
            "the joint"
        )
    return notes


def broken_assumptions(result: Assessment, spectrum: Moments | None) -> list[str]:
    """Say where an assumption breaks, and what is to be said with the answers."""
    question, body = result.question, result.body
    broken = []
    if body.rms_slope > _STEEP:
        broken.append(
            f"the rms slope is {decimal(body.rms_slope, 2)}, and half-spaces assume small slopes: "
            f"no interval includes the effect of slopes over {_STEEP:g}"
        )
    ratio, text = max(question.strains(body), default=(0.0, ""))
    if ratio > _STRAINED:
        broken.append(
            f"{text}: bodies that are strained so far are not linear elastic, and no interval "
            "includes that"
        )
    if (index := _plasticity(result, spectrum)) > 1:
        broken.append(
            f"the plasticity index is {decimal(index, 2)}, over 1: summits yield at first touch; "
            "under repeated loads they deform elastically about their flattened shape"
        )
    if question.theories and isinstance(body, Surface) and (alike := isotropy(body)) < ALIKE:
        broken.append(
            "theories assume an isotropic surface, and the rms slope depends on direction: the "
            f"least is {alike:.2f} of the largest"
        )
    return broken + [each.warning for each in result.answers.values() if each.warning]


def _plasticity(result: Assessment, spectrum: Moments | None) -> float:
    """Greenwood and Williamson's index, where summits are not given a hardness; else zero."""
    pair = result.question.pair
    if pair is None or pair.hardness is None or spectrum is None or result.curve.hardness:
        return 0.0
    summits = spectrum.summit_deviation, spectrum.summit_radius
    return plasticity_index(result.curve.E_star, pair.hardness, summits)


def of_borders(result: Assessment, *, grave: bool) -> list[str]:
    """Say how far a repeated map jumps across its borders, where that is grave or else."""
    text, is_grave = borders_of_repeated(result.question, result.body)
    return [text] if text and is_grave == grave else []


def borders_of_repeated(question: Question, body: Body) -> tuple[str, bool]:
    """Say how far a map jumps across its borders where it is repeated.

    The second result says whether that outweighs all other steps. Nothing is said of a surface
    that is no map: it may be meant to be repeated.
    """
    if not question.is_repeated or not is_map(body):
        return "", False
    found = border_jump(body if question.joint is None else body.detrended())
    return found.in_words("m"), found.outweighs


def cropping_and_resampling(body: Body) -> list[str]:
    """Say what was cropped and resampled when two surfaces were laid together."""
    if not isinstance(body, Surface):
        return []
    notes = []
    for name in ("first", "second"):
        if f"{name}_cropped_to" in body.settings:
            sizes = " x ".join(engineering(size, "m") for size in body.sizes)
            notes.append(
                f"{name} body: cropped to what both have in common, {sizes}, from x = y = 0"
            )
    if "second_resampled_to" in body.settings:
        pixel = " x ".join(engineering(size, "m") for size in body.spacing)
        notes.append(f"second body: resampled by cubic splines to pixels of {pixel}, the first's")
    return notes


def _largest_elastic_slope(question: Question, body: Body) -> float | None:
    """Rms slope up to which a line, whose model has no yield, stands for metals."""
    pair = question.pair
    if pair is None or pair.hardness is None or not isinstance(body, Line):
        return None
    return 2 * ELASTIC_UP_TO * pair.hardness / pair.E_star


def is_scan_that_yields(question: Question, body: Body) -> bool:
    """Whether a scan is so steep that metals yield, of which its model knows nothing."""
    most = _largest_elastic_slope(question, body)
    is_scan = isinstance(body, Line) and body.kind == "profile"
    return is_scan and most is not None and body.rms_slope > most


def how_far_a_line_serves(result: Assessment, *, grave: bool) -> list[str]:
    """Say up to which slopes a line, whose model has no yield, stands for metals.

    It is grave where the slopes of a scan are larger.
    """
    body = result.body
    most = _largest_elastic_slope(result.question, body)
    if most is None or not isinstance(body, Line):
        return []
    said = (
        f"the reduced model {WITHOUT_YIELD}; rms slopes over {2 * ELASTIC_UP_TO:g} H / E* = "
        f"{decimal(most, 2)} exceed that"
    )
    if body.kind == "profile":
        said += f"; the rms slope of the scan is {decimal(body.rms_slope, 2)}"
    is_grave = is_scan_that_yields(result.question, body)
    if is_grave:
        said += (
            ", so these elastic answers do not hold, and come without intervals: press a map, "
            "whose model has yield"
        )
    return [said] if is_grave == grave else []


def of_yield(result: Assessment) -> list[str]:
    """Say what yields at the largest load, with which hardness, and how far its scatter matters."""
    curve, pair, hardness = result.curve, result.question.pair, hardness_of(result.question)
    if curve.hardness is None or hardness is None or curve.plastic_fraction is None:
        return []
    whose = "given" if pair is None or hardness.factor == 1 else f"of {pair.bearer}"
    known = f"{engineering(hardness.value, 'Pa')}, {whose}"
    share = float(curve.plastic_fraction[result.asked[result.largest]])
    notes = []
    if share > 0:
        notes.append(
            f"{100 * share:.3g}% of the contact yields at the largest load: it bears the hardness, "
            f"{known}"
        )
    elif not np.isnan(share):
        notes.append(f"nothing yields at the largest load: no point reaches the hardness, {known}")
    if hardness.factor > 1 and result.answers and not np.isnan(share):
        notes.append(
            f"the hardness of the table is known to a factor of {hardness.factor:g}; "
            f"{_scatter_in_words(result, share)}"
        )
    return notes


def of_unknown_hardness(pair: MaterialPair) -> list[str]:
    """Say of which body the hardness is not known, and what is taken for it."""
    lacking = pair.lacking("hardness")
    if not lacking:
        return []
    if pair.hardness is not None:
        return [
            f"the hardness of {lacking[0]} is not known; that of the other is taken as the softer's"
        ]
    softer = ""
    if len(lacking) == 1 and not any(map(math.isinf, (pair.first.E, pair.second.E))):
        softer = ", and it is the softer one, as its modulus is below the other's hardness"
    return [
        f"the hardness of {' and of '.join(lacking)} is not known{softer}, so both bodies are "
        'taken as elastic, whatever the pressure; give it with the material, as "hardness=..."'
    ]


def _scatter_in_words(result: Assessment, yielded: float) -> str:
    """Say how far the scatter of the hardness moves answers at the largest load.

    `yielded` is the share of the contact that yields there.
    """
    load = result.largest
    moved = {
        each.name: [float(end[load]) for end in result.hardness_scatter[key]]
        for key, each in result.answers.items()
        if key in result.hardness_scatter and (each.leads or each.rule.is_of_interface)
    }
    if not moved:
        return (
            "interrupted before the effect of that on the answers was known, so values come "
            "without intervals"
        )
    if np.isnan([*moved.values()]).any():
        return (
            "the softest such body does not bear the largest load, so how far the answers change "
            "there is not known, and they come without intervals"
        )
    if np.allclose([*moved.values()], 1, rtol=0, atol=LEAST_CHANGE / 100):
        except_for = "p_c/H and the estimates that are made with the hardness"
        if yielded > 0:
            return (
                f"with the softest and the hardest such body, the answers at the largest load "
                f"change by less than {LEAST_CHANGE:g}%, except for {except_for}"
            )
        return (
            "as nothing yields at the largest load, this changes no answer there except "
            f"{except_for}"
        )
    changes = [f"{name} {change_in_words(low, high)}" for name, (low, high) in moved.items()]
    return (
        "with the softest and the hardest such body, the answers at the largest load change by: "
        f"{', '.join(changes)}; "
        + (
            "that is in no interval, as values come without"
            if result.intervals is None
            else "the intervals include that"
        )
    )


def departures_in_words(result: Assessment) -> list[str]:
    """Say how what was pressed departs from assumptions, gravest first, and what that takes down.

    Nothing is said of a departure on which no answer to the question rests. What a line scan
    shows is said where it is pressed.
    """
    said = []
    for departure in departures(result.body):
        down = [
            _without_interval(result, prediction)
            for prediction in _predictions(result)
            if takes_down(departure, prediction, result.body)
        ]
        if down:
            said.append("; ".join([departure.text, *filter(None, dict.fromkeys(down))]))
    return said


def _predictions(result: Assessment) -> Sequence[Prediction]:
    """What is predicted beyond the body itself."""
    found: list[Prediction] = []
    if result.curve.stiffness_error is not None:
        found.append("grid")
    if is_map(result.body) and result.answers:
        found.append("larger surface")
    if result.theories:
        found.append("theories")
    return found


def _without_interval(result: Assessment, prediction: Prediction) -> str:
    """Say which answers come without an interval, as far as there are any."""
    if prediction == "theories":
        return "theories assume otherwise"
    if prediction == "grid":
        return "all values come without an interval"
    names = [
        each.symbol
        for each in result.answers.values()
        if (result.question.joint or each.rule.is_of_interface)
        and each.low is None
        and not each.rule.is_given
    ]
    if not names:
        return ""
    verb = "comes" if len(names) == 1 else "come"
    return f"{listed(names)} {verb} without an interval"


def listed(names: Sequence[str]) -> str:
    """Write names one after the other."""
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last


def of_full_contact(result: Assessment) -> list[str]:
    """Say under which loads all points touch, or all but a few."""
    curve, body = result.curve_as_asked, result.body
    if curve.area_fraction is None or not isinstance(body, Surface):
        return []
    repeated = curve.settings.get("boundary") == "periodic"
    rest = "stiffness is infinite" if repeated else "k is that of a flat punch"
    notes = []
    apart = np.rint((1 - curve.area_fraction) * body.heights.size)
    full = [name for name, n in zip(result.headings, apart, strict=True) if n == 0]
    nearly = [name for name, n in zip(result.headings, apart, strict=True) if 0 < n < RESOLVED_FROM]
    if full:
        notes.append(f"all points touch under {', '.join(full)}: no gap is left, and {rest}")
    if nearly:
        notes.append(
            f"fewer than {RESOLVED_FROM} points do not touch under {', '.join(nearly)}: the "
            "stiffness of the interface is that of these last gaps, which the grid decides, and "
            "without them it is infinite"
        )
    return notes


def of_wide_interval(result: Assessment) -> list[str]:
    """Say why the interval of a stiffness is wide: its causes, the largest first, and a remedy."""
    curve, points = result.curve_as_asked, result.body.heights.size
    error, k = curve.unloading_stiffness_error, curve.unloading_stiffness
    rules = (INTERFACE_STIFFNESS, UNLOADING_STIFFNESS, CONTACT_STIFFNESS)
    shown = next((result.answers[each.key] for each in rules if each.key in result.answers), None)
    ends = None if shown is None else shown.ends
    if shown is None or ends is None or error is None or k is None or curve.area_fraction is None:
        return []
    with np.errstate(divide="ignore", invalid="ignore"):
        widths, of_grid = np.log(ends[1] / ends[0]), 2 * np.log1p(error / k)
        scatter = result.hardness_scatter.get(shown.key)
        of_hardness = 0 * widths if scatter is None else np.log(scatter[1] / scatter[0])
        of_piece = np.sqrt(np.maximum((widths - of_hardness) ** 2 - of_grid**2, 0))
    widths = np.where(np.isfinite(widths), widths, 0)
    i = int(np.argmax(widths))
    if widths[i] < np.log(_WIDE):
        return []
    cells = round(float(curve.area_fraction[i]) * points)
    causes = [
        (of_grid[i], f"the grid, with {cells} of {points} points in contact", "finer pixels"),
        (of_hardness[i], "the scatter of the hardness", "a measured hardness"),
    ]
    if shown.rule is INTERFACE_STIFFNESS:
        causes.append((of_piece[i], "what one map does not show", "a larger map, or several maps"))
    causes = sorted((each for each in causes if each[0] > np.log(_COUNTS)), reverse=True)
    if not causes:
        return []
    told = [f"{what} (a factor of {decimal(float(np.exp(w)), 2)})" for w, what, _ in causes]
    return [
        f"the {shown.name} under {result.headings[i]} is known to a factor of "
        f"{decimal(float(np.exp(widths[i])), 2)} between both ends; it is left open by "
        f"{', then by '.join(told)}: {causes[0][2]} would narrow it most"
    ]
