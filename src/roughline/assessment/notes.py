"""Notes of an assessment: on the topographies, the loads, the hardness, and what is not known."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from roughline.assessment.arguments import has_forces, several
from roughline.assessment.assessment import Assessment
from roughline.assessment.border_of_flow import what_borders_do
from roughline.assessment.films import film_that_spots_exceed
from roughline.assessment.kinds import WITHOUT_YIELD, is_map, nominal_area
from roughline.assessment.loads import find_hardness
from roughline.assessment.question import Question
from roughline.contact.curve import SurfaceCurve
from roughline.engineering.coated import Coated
from roughline.engineering.formulas import ELASTIC_UP_TO
from roughline.engineering.pair import MaterialPair
from roughline.errors.remark import DATA, INTERVALS, Remark, remarks
from roughline.errors.words import called
from roughline.topography.body import Body, Line, Surface
from roughline.topography.effects import effects, grave_effects
from roughline.topography.repetition import border_jump
from roughline.topography.scan_lines import filled_lines_note
from roughline.units import LEAST_CHANGE, change_in_words, decimal, engineering

MOST_NAMED = 3
"""Answers that a sentence names one by one."""


def collect_notes(result: Assessment, filling_note: str) -> list[Remark]:
    """What is left out, what was filled, how the loads were meant, and what was cropped."""
    question, body, pair = result.question, result.body, result.question.pair
    of_line, is_grave = line_scan_limits(question, body)
    borders, are_grave = repeated_border_jump(question, body)
    notes = [*_yield_notes(result), _without_pull_off(question)]
    if pair is not None:
        notes += [] if is_grave else [of_line]
        notes += dict.fromkeys(each.note for each in result.answers.values() if each.note)
        notes += unknown_hardness_notes(pair)
        notes += remarks(_layer_modulus_notes(pair), INTERVALS)
        notes += remarks(what_borders_do(result), INTERVALS)
        above = not_answered(result)
        notes += [each for each in result.left_out if each not in above]
        notes += _layer_notes(result, pair)
        if not isinstance(result.curve, SurfaceCurve):
            notes.append("no contact area: the reduced model of a line does not predict it")
    bodies = [each.body for each in result.topographies]
    notes += remarks(texts_on_each(bodies, _filled_spikes_and_effects), DATA)
    notes += [Remark(filling_note, INTERVALS)]
    notes += [*remarks(loads_in_words(question, body), DATA), "" if are_grave else borders]
    notes += remarks([_pressures(question)], DATA)
    notes += remarks(_cropping_and_resampling(body), DATA)
    return remarks(filter(None, notes))


def _pressures(question: Question) -> str:
    """Repeat the pressures of a fluid, and that they are absolute."""
    sealing = question.sealing
    if sealing is None or sealing.inlet is None:
        return ""
    return (
        f"{sealing.medium.name} enters at {engineering(sealing.inlet, 'Pa')} and leaves at "
        f"{engineering(sealing.outlet, 'Pa')}, both absolute pressures"
    )


def _without_pull_off(question: Question) -> str:
    """Say why bodies that stick have no pull-off where they have no answers."""
    if question.attraction is None or question.pair is not None:
        return ""
    if isinstance(question.periodic, str):
        return "what it takes to draw a body apart that is repeated along one side is not known"
    return (
        "what it takes to draw the bodies apart is one of the answers, which need two materials "
        f"({called('materials')})"
    )


def not_answered(result: Assessment) -> list[Remark]:
    """Why something that was asked for beside the contact is not answered: no note, a warning."""
    return [each for each in remarks(result.left_out) if each.is_grave]


def _yield_notes(result: Assessment) -> list[str]:
    """Say what yields at the largest load, with which hardness, and how far its scatter matters."""
    curve, pair, hardness = result.curve, result.question.pair, find_hardness(result.question)
    if curve.hardness is None or hardness is None or not isinstance(curve, SurfaceCurve):
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
        known = f"the hardness of the table is known to a factor of {hardness.factor:g}"
        notes.append(Remark(f"{known}; {_scatter_in_words(result, share)}", INTERVALS))
    return notes


def _scatter_in_words(result: Assessment, yielded: float) -> str:
    """Say how far the scatter of the hardness moves answers at the largest load.

    `yielded` is the share of the contact that yields there.
    """
    load = result.largest
    moved = {
        each.name: [float(end[load]) for end in result.hardness_scatter[key]]
        for key, each in result.answers.items()
        if key in result.hardness_scatter
        and (each.leads or each.rule.is_of_interface)
        and not each.rule.is_given
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


def unknown_hardness_notes(pair: MaterialPair) -> list[str]:
    """Say of which body the hardness is not known, and what is taken for it."""
    lacking = pair.lacking("hardness")
    if not lacking:
        return []
    if pair.hardness is not None:
        return [
            f"the hardness of {lacking[0]} is not known; that of the other is taken as the softer's"
        ]
    softer = ""
    if len(lacking) == 1 and not any(
        map(math.isinf, (pair.first.surface.E, pair.second.surface.E))
    ):
        softer = ", and it is the softer one, as its modulus is below the other's hardness"
    return [
        f"the hardness of {' and of '.join(lacking)} is not known{softer}, so both bodies are "
        'taken as elastic, whatever the pressure; give it with the material, as "hardness=..."'
    ]


def _layer_modulus_notes(pair: MaterialPair) -> list[str]:
    """Say of which materials layers have another modulus than the table has."""
    found = dict.fromkeys((*pair.first.materials, *pair.second.materials))
    return [
        f"E of {each.name} is {engineering(each.E, 'Pa')} here, and layers of it have "
        f'{each.layer_E}, which no interval includes: give it with the material, as "E=..."'
        for each in found
        if each.layer_E
    ]


def _film_notes(result: Assessment) -> list[Remark]:
    """Say which hardness spots wider than a film is thick feel, and which way that goes."""
    found = film_that_spots_exceed(result.question, result.curve)
    if found is None:
        return []
    film, radius = found
    text = (
        f"contact spots have a mean radius of {engineering(radius, 'm', 2)}, and the layer of "
        f"{film.top.name} is {engineering(film.thickness, 'm')} thick: they feel {film.below.name} "
        "below it as well"
    )
    top, below = film.top.hardness, film.below.hardness
    if top is None or below is None:
        text += ", whose hardness is not known, and no interval includes that"
    else:
        than, size = ("harder", "large") if below > top else ("softer", "small")
        reach = "no interval includes that, as the hardness of the layer is given"
        if film.top.hardness_factor > 1:
            reach = "intervals reach to there"
        text += f", which is {than}, so area and conductance are too {size}; {reach}"
    return [Remark(text, INTERVALS)]


def _layer_notes(result: Assessment, pair: MaterialPair) -> list[str]:
    """Say what a hardness is of coated bodies, and what is not known of them."""
    if not pair.coated:
        return []
    notes, softer, question = [], pair.softer, result.question
    if isinstance(softer, Coated) and not question.elastic:
        notes.append(
            f"the hardness of {softer.name} is that of its top layer, {softer.surface.name}, in "
            "bulk: one that was measured through a thin layer is of what lies below as well, which "
            "may yield first"
        )
        notes += _film_notes(result)
        if (top := softer.surface).layer_hardness and top.hardness:
            text = (
                f"the hardness of {top.name} is {engineering(top.hardness, 'Pa')} here, of "
                f"annealed metal, and layers of it have {top.layer_hardness}, which no interval "
                'includes: give it with the material, as "hardness=..."'
            )
            notes.append(Remark(text, INTERVALS))
    if pair.hardness is not None and result.curve.hardness is None:
        notes.append(
            pair.refuses_layers("plasticity index", "it is of summits of one material each")
        )
    if is_map(result.body) or question.joint is not None:
        names = [each.name for each in result.answers.values() if each.rule.is_of_interface]
        text = (
            "how far a larger surface may be from its map is not known of coated bodies, so no "
            f"interval of {listed_in_short(names)} includes it"
        )
        notes.append(Remark(text, INTERVALS))
    return notes + _current_notes(result, pair)


def _current_notes(result: Assessment, pair: MaterialPair) -> list[str]:
    """Say what is not known of currents through layers, and what layers add to them."""
    is_repeated = result.question.is_repeated
    flows = (("resistivity", "electricity", "Ω m²"), ("conductivity", "heat", "m² K/W"))
    known = [(each, layers) for each in flows if (layers := pair.resistances(each[0]))]
    if not known:
        return []
    notes = []
    if result.larger is not None and result.question.joint is None and not is_repeated:
        notes.append(
            "currents through layers are solved in the map repeated, so that neither resistance "
            "nor conductance of the map alone is known: give the joint's area "
            f"({called('rl.Joint')})"
        )
    elif not is_repeated:
        notes.append(
            "currents through layers are solved from all of this piece, so that no conductance per "
            f"area of its interface alone is known: {called('periodic', True)} gives it"
        )
    if is_repeated or result.larger is not None:
        added = [
            f"{sum(rho * h for each in layers for rho, h in zip(*each, strict=False)):.3g} {unit} "
            f"of {what}"
            for (_, what, unit), layers in known
        ]
        notes.append(
            "resistance and conductance are those of the spots alone: the layers' own resistance "
            f"to an even current adds {' and '.join(added)}"
        )
    return notes


def line_scan_limits(question: Question, body: Body) -> tuple[str, bool]:
    """Say up to which slopes a line, whose model has no yield, stands for metals.

    The second result says whether it is a scan that is so steep that they yield.
    """
    pair = question.pair
    if pair is None or pair.hardness is None or not isinstance(body, Line):
        return "", False
    most = 2 * ELASTIC_UP_TO * pair.hardness / pair.E_star
    text = (
        f"the reduced model {WITHOUT_YIELD}; rms slopes over {2 * ELASTIC_UP_TO:g} H / E* = "
        f"{decimal(most, 2)} exceed that"
    )
    if body.kind == "profile":
        text += f"; the rms slope of the scan is {decimal(body.rms_slope, 2)}"
    if body.kind != "profile" or body.rms_slope <= most:
        return text, False
    return (
        f"{text}, so these elastic answers do not hold, and come without intervals: press a map, "
        "whose model has yield"
    ), True


def texts_on_each(bodies: Sequence[Body], say: Callable[[Body], Sequence[str]]) -> list[str]:
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
    return [*grave_effects(body), *_filled_spikes_and_effects(body)]


def _filled_spikes_and_effects(body: Body) -> list[str]:
    """Say what was filled, what spikes there are, and what the preparation did, unless grave."""
    notes, known = _file_notes(body), body.provenance
    if filled := known.filled:
        notes.append(f"{filled.points} missing points ({filled.share:.2%}) filled: {filled.method}")
    if text := filled_lines_note(body):
        notes.append(text)
    if known.filled_before_crop:
        notes.append(
            f"{known.filled_before_crop} missing points had been filled before this "
            "piece was cropped, and it is not known how many of them are in it"
        )
    if known.outliers_kept:
        notes.append(
            f"{known.outliers_kept} spikes kept; the highest point decides the depth of "
            "first touch, so check whether they are real, or remove them "
            f"({called('remove_outliers', True)})"
        )
    if known.outliers_removed:
        notes.append(f"{known.outliers_removed} spikes removed and filled")
    return notes + [each.text for each in effects(body) if not each.is_grave]


def _file_notes(body: Body) -> list[str]:
    """Say what was corrected as the file was read, and what became of points that it masks."""
    notes, known = [], body.provenance
    if known.corrected:
        notes.append(f"corrected as it was read ({known.format}): {known.corrected}")
    if masked := known.masked:
        rest = (
            f"their heights are used ({called('mask', 'leave-out')} leaves them out)"
            if masked.are_used
            else "they are left out, and filled like missing points"
        )
        notes.append(f"masked in {masked.by}: {masked.share:.1%} of the points; {rest}")
    return notes


def loads_in_words(question: Question, body: Body) -> list[str]:
    """Say of each load what it is in all, and over which area."""
    area = nominal_area(body)
    if isinstance(body, Surface):
        sides = " x ".join(engineering(s, "m") for s in body.sizes)
        nominal = f"the nominal area, {sides}"
    else:
        nominal = f"the square of the line's length, {engineering(body.length, 'm')}"
    loads = question.loading.headings[: len(several(question.loads))]  # unloading speaks for itself
    notes = []
    for text, force in dict(zip(loads, question.loading.forces(area), strict=False)).items():
        if force == 0:
            continue
        pressure = engineering(force / area, "Pa")
        if question.joint is None:
            notes.append(
                f"load {text}: {engineering(force, 'N')} in all, {pressure} over {nominal}"
            )
        else:
            on_joint = engineering(force * question.loading.scale(area), "N")
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


def repeated_border_jump(question: Question, body: Body) -> tuple[str, bool]:
    """Say how far a map jumps across its borders where it is repeated.

    The second result says whether that outweighs all other steps. Nothing is said of a surface
    that is no map: it may be meant to be repeated.
    """
    repeats = question.half_space.repeats
    if not any(repeats) or not is_map(body):
        return "", False
    found = border_jump(body if question.joint is None else body.detrended(), repeats)
    return found.in_words("m"), found.outweighs


def _cropping_and_resampling(body: Body) -> list[str]:
    """Say what was cropped and resampled when two surfaces were laid together."""
    both = body.provenance.facing
    if both is None or not isinstance(body, Surface):
        return []
    notes = []
    for name, is_cropped in zip(("first", "second"), both.cropped, strict=True):
        if is_cropped:
            sizes = " x ".join(engineering(size, "m") for size in body.sizes)
            notes.append(
                f"{name} body: cropped to what both have in common, {sizes}, from x = y = 0"
            )
    if both.is_resampled:
        pixel = " x ".join(engineering(size, "m") for size in body.spacing)
        notes.append(f"second body: resampled by cubic splines to pixels of {pixel}, the first's")
    return notes


def listed_in_short(names: Sequence[str]) -> str:
    """Write names one after the other; of many the first, and how many more there are."""
    further = len(names) - MOST_NAMED
    return listed([*names[:MOST_NAMED], f"{further} more"] if further > 0 else names)


def listed(names: Sequence[str]) -> str:
    """Write names one after the other."""
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
