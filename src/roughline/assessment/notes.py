"""What is told of bodies, loads and hardness, beside what was asked."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from roughline.assessment.assessment import Assessment
from roughline.contact.curve import SurfaceCurve
from roughline.engineering.coated import Coated
from roughline.engineering.formulas import ELASTIC_UP_TO
from roughline.engineering.pair import MaterialPair
from roughline.facts.fact import Fact
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


def facts_on_pull_off(question: Question) -> list[Fact]:
    """Say why bodies that stick have no pull-off where they have no answers."""
    if question.attraction is None or question.pair is not None:
        return []
    is_strip = isinstance(question.periodic, str)
    return [Fact("no_pull_off_of_strip" if is_strip else "no_pull_off_without_materials")]


def facts_on_yield(result: Assessment) -> Iterator[Fact]:
    """Say what yields at the largest load, with which hardness, and how far its scatter matters."""
    curve, pair, hardness = result.curve, result.question.pair, find_hardness(result.question)
    if curve.hardness is None or hardness is None or not isinstance(curve, SurfaceCurve):
        return
    share = float(curve.plastic_fraction[result.asked[result.largest]])
    if np.isnan(share):
        return
    bearer = None if pair is None or hardness.factor == 1 else pair.bearer
    known = {"hardness": hardness.value, "bearer": bearer}
    if share > 0:
        yield Fact("some_yields", share=share, **known)
    else:
        yield Fact("nothing_yields", **known)
    if hardness.factor > 1 and result.answers:
        yield _scatter(result, hardness.factor, is_yielding=share > 0)


def _scatter(result: Assessment, factor: float, *, is_yielding: bool) -> Fact:
    """Say how far the scatter of the hardness moves answers at the largest load."""
    load = result.largest
    moved = {
        each.name: tuple(float(end[load]) for end in result.hardness_scatter[key])
        for key, each in result.answers.items()
        if key in result.hardness_scatter
        and (each.leads or (each.is_of_larger and result.question.joint is None))
        and not each.rule.is_given
    }
    if not moved:
        return Fact("scatter_unknown", factor=factor)
    if np.isnan([*moved.values()]).any():
        return Fact("softest_does_not_bear", factor=factor)
    if np.allclose([*moved.values()], 1, rtol=0, atol=LEAST_CHANGE / 100):
        numbers = {"is_yielding": is_yielding, "least": LEAST_CHANGE}
        return Fact("scatter_changes_nothing", factor=factor, **numbers)
    most = max(moved, key=lambda each: max(moved[each][1], 1 / (moved[each][0] or math.inf)))
    changes = {name: Fact("answer_changes", name=name, ratios=each) for name, each in moved.items()}
    return Fact(
        "scatter_changes",
        factor=factor,
        changes=tuple(changes.values()),
        largest=changes[most],
        are_included=result.intervals is not None,
    )


def facts_on_hardness(pair: MaterialPair) -> list[Fact]:
    """Say of which body the hardness is not known, and what is taken for it."""
    lacking = pair.lacking("hardness")
    if not lacking:
        return []
    if pair.hardness is not None:
        return [Fact("hardness_of_softer_taken", material=lacking[0])]
    moduli = pair.first.surface.E, pair.second.surface.E
    is_softer = len(lacking) == 1 and not any(map(math.isinf, moduli))
    return [Fact("no_hardness", materials=tuple(lacking), is_softer=is_softer)]


def facts_on_materials(result: Assessment, pair: MaterialPair) -> Iterator[Fact]:
    """Say what a hardness is of coated bodies, and what is not known of materials and layers."""
    yield from facts_on_hardness(pair)
    for each in dict.fromkeys((*pair.first.materials, *pair.second.materials)):
        if of := each.layer_E:
            yield Fact("layer_modulus_differs", material=each.name, modulus=each.E, of_layers=of)
    if not pair.coated:
        return
    softer, question = pair.softer, result.question
    if isinstance(softer, Coated) and not question.elastic:
        top = softer.surface
        yield Fact("hardness_in_bulk", body=softer.name, top=top.name)
        yield from _facts_on_film(result)
        if (of := top.layer_hardness) and (hardness := top.hardness):
            numbers = {"hardness": hardness, "of_layers": of}
            yield Fact("layer_hardness_differs", material=top.name, **numbers)
    if pair.hardness is not None and result.curve.hardness is None:
        yield Fact("no_plasticity_index_of_layers")
    if is_map(result.body) or question.joint is not None:
        keys = {key: each.name for key, each in result.answers.items() if each.is_of_larger}
        fact = Fact("larger_surface_of_layers", answers=tuple(keys.values()))
        yield fact.concerning(*keys)
    yield from _facts_on_currents(result, pair)


def _facts_on_film(result: Assessment) -> Iterator[Fact]:
    """Say which hardness spots wider than a film is thick feel, and which way that goes."""
    if (found := film_that_spots_exceed(result.question, result.curve)) is None:
        return
    film, radius = found
    top, below = film.top.hardness, film.below.hardness
    is_harder = None if top is None or below is None else below > top
    yield Fact(
        "spots_wider_than_film",
        **{"radius": radius, "thickness": film.thickness},
        **{"top": film.top.name, "below": film.below.name},
        is_known=is_harder is not None,
        is_harder=is_harder,
        is_included=film.top.hardness_factor > 1,
    )


def _facts_on_currents(result: Assessment, pair: MaterialPair) -> Iterator[Fact]:
    """Say what is not known of currents through layers, and what layers add to them."""
    is_repeated, is_piece = result.question.is_repeated, result.larger is None
    flows = (("resistivity", "electricity", "Ω m²"), ("conductivity", "heat", "m² K/W"))
    added = tuple(
        Fact("added_by_layers", value=value, unit=unit, what=what)
        for quantity, what, unit in flows
        if (layers := pair.resistances(quantity))
        for value in [sum(rho * h for each in layers for rho, h in zip(*each, strict=False))]
    )
    if added and not is_repeated:
        is_of_map = not is_piece and result.question.joint is None
        yield Fact("currents_of_map_repeated" if is_of_map else "currents_of_the_piece")
    if added and (is_repeated or not is_piece):
        yield Fact("resistance_of_layers", added=added)


def line_scan_limits(question: Question, body: Body) -> list[Fact]:
    """Say up to which slopes a line, whose model has no yield, stands for metals.

    That is grave of a scan that is so steep that they yield.
    """
    pair = question.pair
    if pair is None or pair.hardness is None or not isinstance(body, Line):
        return []
    most = 2 * ELASTIC_UP_TO * pair.hardness / pair.E_star
    slope = body.rms_slope if body.kind == "profile" else None
    kind = "line_without_yield" if slope is None or slope <= most else "line_is_too_steep"
    return [Fact(kind, limit=ELASTIC_UP_TO, ratio=2 * ELASTIC_UP_TO, most=most, slope=slope)]


def facts_on_each(bodies: Sequence[Body], tell: Callable[[Body], Sequence[Fact]]) -> list[Fact]:
    """Say something of each topography, and of which of two it is."""
    if len(bodies) == 1:
        return list(tell(bodies[0]))
    return [
        fact.within(Fact("on_body", fact=fact, which=which))
        for which, body in zip(("first", "second"), bodies, strict=True)
        for fact in tell(body)
    ]


def what_was_prepared(body: Body) -> list[Fact]:
    """Say what was corrected, masked and filled, what spikes there are, and what steps did."""
    known = body.provenance
    found = list(grave_effects(body))
    if known.corrected:
        found.append(Fact("corrected", form=known.format, how=known.corrected))
    if mask := known.masked:
        found.append(Fact("masked", by=mask.by, share=mask.share, are_used=mask.are_used))
    if done := known.filled:
        found.append(Fact("filled", points=done.points, share=done.share, method=done.method))
    if between := filled_lines_note(body):
        found.append(between)
    for name in ("filled_before_crop", "outliers_kept", "outliers_removed"):
        if points := getattr(known, name):
            found.append(Fact(name, points=points))
    return found + [each.fact for each in effects(body) if not each.fact.is_grave]


def facts_on_loads(question: Question, body: Body) -> list[Fact]:
    """Say of each load what it is in all, and over which area."""
    area, joint, loading = nominal_area(body), question.joint, question.loading
    loads = loading.headings[: len(several(question.loads))]  # unloading speaks for itself
    found = []
    for load, force in dict(zip(loads, loading.forces(area), strict=False)).items():
        numbers = {"load": load, "pressure": force / area, "sides": side_lengths(body)}
        if force and joint is None:
            found.append(Fact("load_on_body", **numbers, force=force))
        elif force:
            on_joint = {"force": force * loading.scale(area), "joint": joint, "on_map": force}
            found.append(Fact("load_on_joint", **numbers, **on_joint))
    if has_forces(question.loads) and joint is None and is_map(body):
        found.append(Fact("forces_on_map_alone"))
    return found


def facts_on_borders(question: Question, body: Body) -> list[Fact]:
    """Say how far a map jumps across its borders where it is repeated.

    That is grave if it outweighs all other steps. Nothing is said of a surface that is no map: it
    may be meant to be repeated.
    """
    repeats = question.half_space.repeats
    if not any(repeats) or not is_map(body):
        return []
    return [border_jump(body if question.joint is None else body.detrended(), repeats).fact("m")]


def facts_on_facing(body: Body) -> Iterator[Fact]:
    """Say what was cropped and resampled when two surfaces were laid together."""
    both = body.provenance.facing
    if both is None or not isinstance(body, Surface):
        return
    for which, is_cropped in zip(("first", "second"), both.cropped, strict=True):
        if is_cropped:
            yield Fact("cropped_to_common", which=which, sides=body.sizes)
    if both.is_resampled:
        yield Fact("resampled_to_first", pixel=body.spacing)
