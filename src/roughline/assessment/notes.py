"""Notes of an assessment: on the topographies, the loads, the hardness, and what is not known."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from roughline.assessment.assessment import Assessment
from roughline.assessment.border_of_flow import what_borders_do
from roughline.contact.curve import SurfaceCurve
from roughline.engineering.coated import Coated
from roughline.engineering.formulas import ELASTIC_UP_TO
from roughline.engineering.pair import MaterialPair
from roughline.facts.borders import border_carries, map_jumps_at_borders
from roughline.facts.fact import Fact
from roughline.facts.hardness import (
    hardness_of_softer_taken,
    line_is_too_steep,
    line_without_yield,
    no_hardness,
    nothing_yields,
    scatter_changes,
    scatter_changes_nothing,
    scatter_unknown,
    softest_does_not_bear,
    some_yields,
)
from roughline.facts.heights import (
    corrected,
    cropped_to_common,
    filled,
    filled_before_crop,
    masked,
    resampled_to_first,
    spikes_kept,
    spikes_removed,
    step_changes,
)
from roughline.facts.intervals import (
    no_area_of_line,
    no_pull_off_of_strip,
    no_pull_off_without_materials,
)
from roughline.facts.layers import (
    currents_of_map_repeated,
    currents_of_the_piece,
    hardness_in_bulk,
    larger_surface_of_layers,
    layer_hardness_differs,
    layer_modulus_differs,
    resistance_of_layers,
    spots_wider_than_film,
)
from roughline.facts.loads import (
    absolute_pressures,
    forces_on_map_alone,
    load_on_body,
    load_on_joint,
)
from roughline.facts.own_words import in_own_words, on_body
from roughline.question.arguments import has_forces, several
from roughline.question.films import film_that_spots_exceed
from roughline.question.kinds import is_map, nominal_area
from roughline.question.loads import find_hardness
from roughline.question.question import Question
from roughline.topography.body import Body, Line, Surface, side_lengths
from roughline.topography.effects import effects, grave_effects
from roughline.topography.repetition import border_jump
from roughline.topography.scan_lines import filled_lines_note
from roughline.units import LEAST_CHANGE

ABOUT_THE_BODY = (step_changes, map_jumps_at_borders, border_carries)
"""What a curve says of its body and its borders, which is told of all bodies and loads."""


def collect_notes(result: Assessment, of_causes: Sequence[Fact]) -> list[Fact]:
    """What is left out, what was filled, how the loads were meant, and what was cropped."""
    question, body, pair = result.question, result.body, result.question.pair
    notes = [*_yield_notes(result), *_without_pull_off(question)]
    if pair is not None:
        notes += line_scan_limits(question, body)
        notes += [fact for each in result.answers.values() for fact in each.facts]
        notes += unknown_hardness_notes(pair)
        notes += _layer_modulus_notes(pair)
        notes += what_borders_do(result)
        notes += result.left_out
        notes += _layer_notes(result, pair)
        if not isinstance(result.curve, SurfaceCurve):
            notes.append(no_area_of_line())
    notes += facts_on_each([each.body for each in result.topographies], _filled_and_effects)
    notes += [each for each in result.curve.facts if each.kind not in ABOUT_THE_BODY]
    notes += of_causes
    notes += facts_on_loads(question, body)
    notes += repeated_border_jump(question, body)
    notes += _pressures(question)
    notes += _cropping_and_resampling(body)
    return [each for each in dict.fromkeys(notes) if not each.is_warning]


def _pressures(question: Question) -> list[Fact]:
    """Repeat the pressures of a fluid, and that they are absolute."""
    sealing = question.sealing
    if sealing is None or sealing.inlet is None:
        return []
    return [absolute_pressures(sealing.medium.name, sealing.inlet, sealing.outlet)]


def _without_pull_off(question: Question) -> list[Fact]:
    """Say why bodies that stick have no pull-off where they have no answers."""
    if question.attraction is None or question.pair is not None:
        return []
    if isinstance(question.periodic, str):
        return [no_pull_off_of_strip()]
    return [no_pull_off_without_materials()]


def _yield_notes(result: Assessment) -> list[Fact]:
    """Say what yields at the largest load, with which hardness, and how far its scatter matters."""
    curve, pair, hardness = result.curve, result.question.pair, find_hardness(result.question)
    if curve.hardness is None or hardness is None or not isinstance(curve, SurfaceCurve):
        return []
    whose = "given" if pair is None or hardness.factor == 1 else f"of {pair.bearer}"
    share = float(curve.plastic_fraction[result.asked[result.largest]])
    notes = []
    if share > 0:
        notes.append(some_yields(share, hardness.value, whose))
    elif not np.isnan(share):
        notes.append(nothing_yields(hardness.value, whose))
    if hardness.factor > 1 and result.answers and not np.isnan(share):
        notes.append(_scatter(result, hardness.factor, share))
    return notes


def _scatter(result: Assessment, factor: float, yielded: float) -> Fact:
    """Say how far the scatter of the hardness moves answers at the largest load.

    `yielded` is the share of the contact that yields there.
    """
    load = result.largest
    moved = {
        each.name: tuple(float(end[load]) for end in result.hardness_scatter[key])
        for key, each in result.answers.items()
        if key in result.hardness_scatter
        and (each.leads or each.rule.is_of_interface)
        and not each.rule.is_given
    }
    if not moved:
        return scatter_unknown(factor)
    if np.isnan([*moved.values()]).any():
        return softest_does_not_bear(factor)
    if np.allclose([*moved.values()], 1, rtol=0, atol=LEAST_CHANGE / 100):
        return scatter_changes_nothing(factor, yielded > 0)
    changes = tuple((name, low, high) for name, (low, high) in moved.items())
    return scatter_changes(factor, changes, result.intervals is not None)


def unknown_hardness_notes(pair: MaterialPair) -> list[Fact]:
    """Say of which body the hardness is not known, and what is taken for it."""
    lacking = pair.lacking("hardness")
    if not lacking:
        return []
    if pair.hardness is not None:
        return [hardness_of_softer_taken(lacking[0])]
    moduli = pair.first.surface.E, pair.second.surface.E
    is_softer = len(lacking) == 1 and not any(map(math.isinf, moduli))
    return [no_hardness(tuple(lacking), is_softer)]


def _layer_modulus_notes(pair: MaterialPair) -> list[Fact]:
    """Say of which materials layers have another modulus than the table has."""
    found = dict.fromkeys((*pair.first.materials, *pair.second.materials))
    return [
        layer_modulus_differs(each.name, each.E, each.layer_E) for each in found if each.layer_E
    ]


def _film_notes(result: Assessment) -> list[Fact]:
    """Say which hardness spots wider than a film is thick feel, and which way that goes."""
    found = film_that_spots_exceed(result.question, result.curve)
    if found is None:
        return []
    film, radius = found
    top, below = film.top.hardness, film.below.hardness
    is_harder = None if top is None or below is None else below > top
    is_included = film.top.hardness_factor > 1
    names = film.top.name, film.below.name
    return [spots_wider_than_film(radius, film.thickness, *names, is_harder, is_included)]


def _layer_notes(result: Assessment, pair: MaterialPair) -> list[Fact]:
    """Say what a hardness is of coated bodies, and what is not known of them."""
    if not pair.coated:
        return []
    notes, softer, question = list[Fact](), pair.softer, result.question
    if isinstance(softer, Coated) and not question.elastic:
        notes.append(hardness_in_bulk(softer.name, softer.surface.name))
        notes += _film_notes(result)
        if (top := softer.surface).layer_hardness and top.hardness:
            notes.append(layer_hardness_differs(top.name, top.hardness, top.layer_hardness))
    if pair.hardness is not None and result.curve.hardness is None:
        text = pair.refuses_layers("plasticity index", "it is of summits of one material each")
        notes.append(in_own_words(text).as_("note"))
    if is_map(result.body) or question.joint is not None:
        of = {key: each for key, each in result.answers.items() if each.rule.is_of_interface}
        names = tuple(each.name for each in of.values())
        notes.append(larger_surface_of_layers(names).concerning(*of))
    return notes + _current_notes(result, pair)


def _current_notes(result: Assessment, pair: MaterialPair) -> list[Fact]:
    """Say what is not known of currents through layers, and what layers add to them."""
    is_repeated = result.question.is_repeated
    flows = (("resistivity", "electricity", "Ω m²"), ("conductivity", "heat", "m² K/W"))
    known = [(each, layers) for each in flows if (layers := pair.resistances(each[0]))]
    if not known:
        return []
    notes = []
    if result.larger is not None and result.question.joint is None and not is_repeated:
        notes.append(currents_of_map_repeated())
    elif not is_repeated:
        notes.append(currents_of_the_piece())
    if is_repeated or result.larger is not None:
        added = tuple(
            (sum(rho * h for each in layers for rho, h in zip(*each, strict=False)), unit, what)
            for (_, what, unit), layers in known
        )
        notes.append(resistance_of_layers(added))
    return notes


def line_scan_limits(question: Question, body: Body) -> list[Fact]:
    """Say up to which slopes a line, whose model has no yield, stands for metals.

    That is grave of a scan that is so steep that they yield.
    """
    pair = question.pair
    if pair is None or pair.hardness is None or not isinstance(body, Line):
        return []
    most = 2 * ELASTIC_UP_TO * pair.hardness / pair.E_star
    slope = body.rms_slope if body.kind == "profile" else None
    if slope is None or slope <= most:
        return [line_without_yield(ELASTIC_UP_TO, most, slope)]
    return [line_is_too_steep(ELASTIC_UP_TO, most, slope)]


def facts_on_each(bodies: Sequence[Body], tell: Callable[[Body], Sequence[Fact]]) -> list[Fact]:
    """Say something of each topography, and of which of two it is."""
    if len(bodies) == 1:
        return list(tell(bodies[0]))
    return [
        fact.within(on_body(fact, which))
        for which, body in zip(("first", "second"), bodies, strict=True)
        for fact in tell(body)
    ]


def what_was_prepared(body: Body) -> list[Fact]:
    """Say what was filled, what spikes there are, and all that the preparation did."""
    return [*grave_effects(body), *_filled_and_effects(body)]


def _filled_and_effects(body: Body) -> list[Fact]:
    """Say what was filled, what spikes there are, and what the preparation did, unless grave."""
    notes, known = _file_notes(body), body.provenance
    if done := known.filled:
        notes.append(filled(done.points, done.share, done.method))
    if between := filled_lines_note(body):
        notes.append(between)
    if known.filled_before_crop:
        notes.append(filled_before_crop(known.filled_before_crop))
    if known.outliers_kept:
        notes.append(spikes_kept(known.outliers_kept))
    if known.outliers_removed:
        notes.append(spikes_removed(known.outliers_removed))
    return notes + [each.fact for each in effects(body) if not each.fact.is_grave]


def _file_notes(body: Body) -> list[Fact]:
    """Say what was corrected as the file was read, and what became of points that it masks."""
    notes, known = [], body.provenance
    if known.corrected:
        notes.append(corrected(known.format, known.corrected))
    if mask := known.masked:
        notes.append(masked(mask.by, mask.share, mask.are_used))
    return notes


def facts_on_loads(question: Question, body: Body) -> list[Fact]:
    """Say of each load what it is in all, and over which area."""
    area, sides = nominal_area(body), side_lengths(body)
    loads = question.loading.headings[: len(several(question.loads))]  # unloading speaks for itself
    notes = []
    for text, force in dict(zip(loads, question.loading.forces(area), strict=False)).items():
        if force == 0:
            continue
        pressure = force / area
        if question.joint is None:
            notes.append(load_on_body(text, force, pressure, sides))
        else:
            on_joint = force * question.loading.scale(area)
            notes.append(load_on_joint(text, on_joint, question.joint, pressure, force, sides))
    if has_forces(question.loads) and question.joint is None and is_map(body):
        notes.append(forces_on_map_alone())
    return notes


def repeated_border_jump(question: Question, body: Body) -> list[Fact]:
    """Say how far a map jumps across its borders where it is repeated.

    That is grave if it outweighs all other steps. Nothing is said of a surface that is no map: it
    may be meant to be repeated.
    """
    repeats = question.half_space.repeats
    if not any(repeats) or not is_map(body):
        return []
    return [border_jump(body if question.joint is None else body.detrended(), repeats).fact("m")]


def _cropping_and_resampling(body: Body) -> list[Fact]:
    """Say what was cropped and resampled when two surfaces were laid together."""
    both = body.provenance.facing
    if both is None or not isinstance(body, Surface):
        return []
    notes = [
        cropped_to_common(name, body.sizes)
        for name, is_cropped in zip(("first", "second"), both.cropped, strict=True)
        if is_cropped
    ]
    return notes + ([resampled_to_first(body.spacing)] if both.is_resampled else [])
