"""A report on a body or on a part, as two files: a page, and the same as PDF to be printed."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

from roughline._version import __version__
from roughline.assessment.part import PartAssessment
from roughline.facts.listed import listed, listed_in_short
from roughline.report.answers import (
    UNRESOLVED,
    answer_in_words,
    answer_table,
    groups,
    has_star,
    headline,
    in_full,
    lead_sentence,
    leading_keys,
    load_table,
)
from roughline.report.contact_tables import formula_table, solid_in_words, symbol_table
from roughline.report.page import Section, Table, render
from roughline.report.pdf import write_pdf
from roughline.report.why import bars
from roughline.topography.body import Line

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment

_LOADS_ABREAST, _PART_LOADS_ABREAST = 3, 2  # those of a part have scatter

_ASSUMPTION_ON_HEIGHTS = (
    "Heights as measured: the filter, the probe and the grid decide the finest waves, and with "
    "them the real contact area; stiffness and conductance depend on them less."
)
_ASSUMPTION_ON_JOINT = (
    "The joint is alike everywhere, and evenly loaded: each place carries the mean pressure and "
    "has the roughness of the map. The map is pressed at that pressure in a periodic half-space, "
    "and quantities per area are multiplied by the joint's area. Answers are those of the "
    "interface; waviness longer than the map, bending, and the constriction of the bodies to the "
    "joint's outline are left out."
)
_ASSUMPTION_ON_LAYERS = (
    "Layers are bonded to each other and to their base, which is as deep as one wishes. The "
    "hardness of a coated body is that of its top layer, and what lies below does not yield. No "
    "interval of a coated body holds what a map does not show of the surface around it."
)
_ASSUMPTION_ON_SHEAR = (
    "A shear force goes to and fro under the load, slowly. Each point bears at most the "
    "coefficient of friction times its pressure, however far it has slipped; pressure and shear "
    "are solved together where they move each other. The bodies do not turn, and nothing wears or "
    "heats up."
)
_ASSUMPTION_ON_PART = (
    "Intervals of the part hold the scatter between its places as well. They assume that the "
    "places were chosen at random, and that quantities scatter by factors."
)


def write_document(
    result: Assessment | PartAssessment,
    folder: Path,
    title: str,
    own: Sequence[Section],
    how_to_repeat: Sequence[str],
) -> list[Path]:
    """Write ``report.html`` and ``report.pdf``, with the date and version that made them.

    The sections of its `own`, which only such a report has, stand between the notes and the
    formulas.

    Raises
    ------
    StoreError
        If the PDF cannot be written.
    """
    made = f"Computed on {date.today().isoformat()} with roughline {__version__}."
    sections = _sections(result, own, how_to_repeat)
    lead, first = lead_sentence(result), headline(result)
    page, sheets = folder / "report.html", folder / "report.pdf"
    page.write_text(render(title, lead, sections, made, first), encoding="utf-8")
    write_pdf(sheets, title, lead, sections, made, first)
    return [page, sheets]


def _sections(
    result: Assessment | PartAssessment, own: Sequence[Section], how_to_repeat: Sequence[str]
) -> list[Section]:
    """What the page holds: answers, notes, its own sections, formulas and assumptions."""
    is_part = isinstance(result, PartAssessment)
    body = result.assessments[0] if isinstance(result, PartAssessment) else result
    star = f"A star{'' if is_part else ' after a load'}: {UNRESOLVED}."
    return [
        Section(
            "The part" if is_part else "Answers",
            [*_materials(body), *([star] if has_star(result) else [])],
            tables=_many_loads(result),
        ),
        *_groups(result),
        *_on_all_answers(result),
        *own,
        Section(
            "Formulas and sources",
            tables=[Table(*formula_table(body)), Table(*symbol_table(body))],
            behind="how each answer follows, where that holds, and whose result it is",
        ),
        Section(
            "Assumptions",
            [*_assumptions(body), *([_ASSUMPTION_ON_PART] if is_part else [])],
            behind="what all answers and their intervals rest on",
        ),
        Section(
            "How to repeat it", verbatim=how_to_repeat, behind="what gives the same numbers again"
        ),
    ]


def _materials(assessment: Assessment) -> list[str]:
    """A sentence on both materials."""
    pair = assessment.question.pair
    if pair is None:
        return []
    return [f"Materials: {solid_in_words(pair.first)}; {solid_in_words(pair.second)}."]


def _abreast(result: Assessment | PartAssessment) -> int:
    return _PART_LOADS_ABREAST if isinstance(result, PartAssessment) else _LOADS_ABREAST


def _many_loads(result: Assessment | PartAssessment) -> list[Table]:
    """Of many loads, the leading answers of each; of a body, others that belong beside them."""
    if len(result.headings) <= _abreast(result) or not result.answers:
        return []
    keys = leading_keys(result)
    if not isinstance(result, PartAssessment):
        beside = [key for key, each in result.answers.items() if each.rule.is_shown_at_many_loads]
        keys = [key for key in result.answers if key in {*keys, *beside}]
    return [Table.with_numbers(*load_table(result, keys))]


def _groups(result: Assessment | PartAssessment) -> list[Section]:
    """A section for each group, folded behind its headline; a few loads stand beside each other."""
    loads, abreast = range(len(result.headings)), _abreast(result)
    return [
        Section(
            each.name.capitalize(),
            tables=[
                Table.with_numbers(
                    *answer_table(result, loads[i : i + abreast], each.keys, with_elastic=True)
                )
                for i in loads[::abreast]
            ],
            notes=[
                in_full(fact) for fact in result.facts if not set(each.keys).isdisjoint(fact.of)
            ],
            behind=answer_in_words(result, each.headline),
            bars=None if isinstance(result, PartAssessment) else bars(result, each.keys),
        )
        for each in groups(result)
    ]


def _on_all_answers(result: Assessment | PartAssessment) -> list[Section]:
    """Warnings and notes that concern all answers, folded behind how many there are."""
    found = [each for each in result.facts if result.answers.keys().isdisjoint(each.of)]
    if not found:
        return []
    warnings = sum(each.is_warning for each in found)
    counts = {"warning": warnings, "note": len(found) - warnings}
    words = [f"{n} {name}{'' if n == 1 else 's'}" for name, n in counts.items() if n]
    behind = f"{listed(words)} on all answers, in full"
    return [Section("Warnings and notes", notes=[*map(in_full, found)], behind=behind)]


def _assumptions(assessment: Assessment) -> list[str]:
    """Assumptions of the answers, by what was pressed, and of theories beside them."""
    pair = assessment.question.pair
    return [
        f"Both bodies are half-spaces, {assessment.curve.assumption}; small slopes, no friction in "
        "the normal problem, static loads.",
        _ASSUMPTION_ON_HEIGHTS,
        *([] if assessment.question.joint is None else [_ASSUMPTION_ON_JOINT]),
        *([] if assessment.question.shear is None else [_ASSUMPTION_ON_SHEAR]),
        *_interval_assumptions(assessment),
        *([_ASSUMPTION_ON_LAYERS] if pair is not None and pair.coated else []),
        *(f"{theory.name}: {theory.validity}." for theory in assessment.theories),
    ]


def _interval_assumptions(assessment: Assessment) -> list[str]:
    """Say what the intervals hold, and what they do not; nothing where there are none."""
    if assessment.intervals is None:
        return []
    is_scan, is_of_joint = isinstance(assessment.body, Line), assessment.question.joint is not None
    causes = [
        "a single line scan" if is_scan else "the grid",
        *(["filled points"] if any(each.is_filled for each in assessment.topographies) else []),
        *(["the scatter of the hardness"] if assessment.hardness_scatter else []),
    ]
    held = f"what {listed(causes)} {'leaves' if len(causes) == 1 else 'leave'} open"
    unseen = "one map does not show of the surface around it"
    if is_of_joint:
        held += f", and what {unseen}"
    else:
        ours = [each.name for each in assessment.answers.values() if each.is_of_larger]
        if ours:
            held += f"; those of {listed_in_short(ours)} hold what {unseen} as well"
    other = "other material data" if assessment.hardness_scatter else "material data"
    places = "of places which are not alike" if is_of_joint else "between places on the part"
    return [
        f"Intervals, where given, hold {held}. They do not hold the scatter of {other}, nor that "
        f"{places}."
    ]
