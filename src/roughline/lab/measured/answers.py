"""The answers for a page: its question assessed once and kept, and both models compared."""

from __future__ import annotations

from dataclasses import asdict, replace
from functools import partial
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
from attrs import evolve

from roughline.assessment.assess import assess_body
from roughline.assessment.assess_part import assess_map, assess_part
from roughline.assessment.assessment import Assessment
from roughline.assessment.part import PartAssessment
from roughline.comparison.compared import ModelComparison, NamedBody, compare_models
from roughline.errors.words import speaking
from roughline.facts.fact import own_words
from roughline.facts.kinds import DATA, INTERVALS, LIMITS
from roughline.lab.frames import drawn
from roughline.lab.measured.cache import cached
from roughline.lab.measured.controls import at
from roughline.lab.measured.part import part_in_words
from roughline.lab.measured.pictures import contact_pictures, curve_panels, model_panels
from roughline.lab.measured.state import (
    PAGE_WORDS,
    control_texts,
    first_source,
    page_question,
    page_reading,
    page_sources,
)
from roughline.lab.server.tasks import Arguments, Progress, without_paths
from roughline.question.question import Question
from roughline.question.source import Topography
from roughline.report.answers import (
    IF_ELASTIC,
    MOST_WARNINGS,
    UNRESOLVED,
    answer_table,
    counted,
    has_star,
    headline,
    in_full,
    lead_sentence,
)
from roughline.report.comparison import verdict_in_words
from roughline.report.contact_tables import curve_table, formula_table, modulus_in_words
from roughline.report.page import sentence
from roughline.report.values import up_to_three_digits
from roughline.report.why import bars
from roughline.units import engineering

_SLIP_ROWS = 12


@speaking(PAGE_WORDS)
def answer(arguments: Arguments, progress: Progress) -> bytes:
    """Assess the question of the page; the result is kept for the report.

    Of several maps, `map` says by its number which of them is shown alone.
    """
    result = assessed(arguments, progress)
    parts = [_remarks(result, arguments)]
    if isinstance(result, PartAssessment):
        wanted = arguments.get("map")
        chosen = wanted if isinstance(wanted, int) else 0
        chosen = chosen if chosen in range(len(result.assessments)) else 0
        parts += [_in_words(result, "part"), part_in_words(result, chosen)]
        result = result.assessments[chosen]
    parts += [_in_words(result, "answers"), _body_header(result)]
    header: dict[str, Any] = {}
    for key, value in chain.from_iterable(each.items() for each in parts):
        header[key] = {**header.get(key, {}), **value} if isinstance(value, dict) else value
    return drawn(header, curve_panels(result), contact_pictures(result))


def _in_words(result: Assessment | PartAssessment, place: str) -> dict[str, Any]:
    """What was asked, the answers that lead, and all answers in a table with groups."""
    write, has_elastic = up_to_three_digits, isinstance(result, Assessment)
    star = f"* {UNRESOLVED}" if has_star(result) else ""
    table: tuple[Any, ...] = (["the maps have no common answers"], [])
    if result.answers:
        table = answer_table(result, with_elastic=has_elastic, write=write)
        table += (counted(result, with_elastic=has_elastic, write=write), IF_ELASTIC)
    elif isinstance(result, Assessment):
        table = curve_table(result)
    at = "part-answers" if place == "part" else place
    return {
        "words": {f"{place}-lead": lead_sentence(result), f"{place}-star": star},
        "figures": {place: [vars(each) for each in headline(result, write).figures]},
        "tables": {f"measured-{at}": table},
    }


def _remarks(result: Assessment | PartAssessment, arguments: Arguments) -> dict[str, Any]:
    """The first warnings in short, as on every screen, and all facts by what they are about."""
    bodies = result.assessments[:1] if isinstance(result, PartAssessment) else [result]
    theories = [own_words(f"{each.name}: {each.validity}", "note") for each in bodies[0].theories]
    groups: dict[str, list[str]] = {DATA: [], INTERVALS: [], LIMITS: []}
    for each in (*result.facts, *theories):
        groups[each.about].append(without_paths(in_full(each), arguments))
    first = [each.brief for each in result.facts[:MOST_WARNINGS] if each.is_warning]
    short = [sentence(without_paths(each, arguments)) for each in first]
    return {"lists": {"grave": short}, "remarks": groups}


def _body_header(result: Assessment) -> dict[str, Any]:
    """What is told of one body alone: its modulus, why, formulas and partial slip."""
    nothing = (["no answers follow from a contact modulus alone"], list[list[str]]())
    tables = {"measured-formulas": formula_table(result) if result.answers else nothing}
    slip, rows = result.partial_slip, list[list[str]]()
    if slip is not None:
        some = np.unique(np.linspace(0, slip.force.size - 1, _SLIP_ROWS).astype(int))
        columns = ((slip.displacement, "m"), (slip.force, "N"))
        rows = [[engineering(float(each[i]), unit, 3) for each, unit in columns] for i in some]
    tables["measured-slip"] = (["displacement", "tangential force"], rows)
    modulus = modulus_in_words(result, up_to_three_digits(result.curve.E_star, None, "Pa"))
    why = bars(result, result.answers)
    return {
        "words": {"modulus": modulus},
        "tables": tables,
        "bars": {"answers": None if why is None else {**asdict(why), "header": why.header}},
    }


def assessed(arguments: Arguments, progress: Progress) -> Assessment | PartAssessment:
    """The assessment of the page's question: as it was kept, or else solved.

    Of several maps each is kept as soon as it is done.
    """
    texts, session = control_texts(arguments), arguments["session"]
    sources = page_sources(texts, session)
    questions = [page_question(texts, each) for each in sources]
    keys, of_maps = {each.path: each.key for each in sources}, [0, 1]  # done, and in all

    def steps(done: int, total: int) -> None:  # of the loads of one map
        progress(of_maps[0] * total + done, of_maps[1] * total)

    def begin_map(*of: int) -> None:
        of_maps[:] = of

    def solve(question: Question) -> Assessment:
        assert isinstance(question.body, Path)
        asked = sorted({**texts, "file": keys[question.body]}.items())
        made = partial(assess_body if len(sources) == 1 else assess_map, question, progress=steps)
        return cached(session, "assessment", asked, made, most=len(sources))

    with at("answers"):
        if len(sources) == 1:
            return solve(questions[0])
        # what cannot be asked of a part is refused here
        evolve(questions[0], body=list(keys), reading=replace(questions[0].reading, name=None))
        names = [each.name for each in sources]
        return assess_part(questions, names=names, map_progress=begin_map, answer=solve)


@speaking(PAGE_WORDS)
def compare(arguments: Arguments, progress: Progress) -> bytes:
    """Compare the models on the surface as the file has it, without its tilt."""
    texts = control_texts(arguments)
    source = first_source(texts, arguments["session"])
    reading = page_reading(texts, source.name)

    def made() -> ModelComparison:
        body = Topography.of(source.path, reading, None).body
        return compare_models(NamedBody(body, source.name), progress=progress)

    with at("compare"):
        found = cached(arguments["session"], "comparison", (source.key, reading), made)
    result = found.comparison
    star = "" if result.resolved.all() else "* fewer than ten cells in contact: the grid decides"
    words = {"what": found.what, "verdict": sentence(verdict_in_words(found)), "compare-star": star}
    lists = {"compare-notes": result.warnings}
    return drawn({"words": words, "lists": lists}, model_panels(found), {})
