"""The report on several maps of one part, as HTML and PDF."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from roughline.plot.style import save, styled
from roughline.report.answers import (
    UNRESOLVED,
    headline,
    lead_of,
    leading_keys,
    load_table,
    sections_of,
    star_is_shown,
)
from roughline.report.contact_figures import write_contact
from roughline.report.contact_report import (
    OF_ASSUMPTIONS,
    OF_FORMULAS,
    OF_REPEATING,
    assumptions_of,
    materials_in_words,
    write_contact_report,
)
from roughline.report.contact_tables import formula_table, symbol_table
from roughline.report.document import write_document
from roughline.report.page import Picture, Section, Table, sentence
from roughline.report.part_figures import MOST_HEIGHTS, answers_figure, heights_figure
from roughline.report.part_tables import (
    count_in_words,
    each_map_table,
    leading_table,
    maps_table,
)

if TYPE_CHECKING:
    from roughline.assessment.part import PartAssessment

_ASSUMPTION_OF_PART = (
    "Intervals of the part hold the scatter between its places as well. They assume that the "
    "places were chosen at random, and that quantities scatter by factors."
)
_LOADS_ABREAST = 2  # each has two columns
_MAPS_ABREAST = 3


def write_part_report(part: PartAssessment, folder: Path, how_to_repeat: str) -> list[Path]:
    """Write ``report.html``, ``report.pdf``, figures, and each map's report in a folder of its own.

    Parameters
    ----------
    part : PartAssessment
        With the fields of one load of each map.
    folder : Path
        Made if it does not exist.
    how_to_repeat : str
        The command, or the lines of Python, that give the same report.

    Raises
    ------
    StoreError
        If the folder cannot be written.
    """
    written = []
    for of_map, each in zip(_folders(part, folder), part.assessments, strict=True):
        written.append(write_contact_report(each, of_map, how_to_repeat)[0])
    figures = _figures(part, folder)
    title, lead = f"Contact of a part, {count_in_words(part)}", lead_of(part)
    sections = _sections(part, figures[0], figures[2], how_to_repeat)
    document = write_document(folder, title, lead, sections, headline(part))
    return [*document, *figures, *written]


def write_part(part: PartAssessment, folder: Path) -> list[Path]:
    """Write figures of the part, and each map's curve and figures in a folder of its own.

    Raises
    ------
    StoreError
        If the folder cannot be written.
    """
    written = []
    for of_map, each in zip(_folders(part, folder), part.assessments, strict=True):
        written += write_contact(each, of_map)
    return [*_figures(part, folder), *written]


def _folders(part: PartAssessment, folder: Path) -> list[Path]:
    """A folder for each map, with its number and its name."""
    return [folder / f"map-{i:02d}-{Path(name).stem}" for i, name in enumerate(part.names, 1)]


def _figures(part: PartAssessment, folder: Path) -> list[Path]:
    """Draw the answers and the heights of all maps, each as PNG and PDF."""
    with styled():
        return [
            *save(answers_figure(part), folder, "answers"),
            *save(heights_figure(part), folder, "maps"),
        ]


def _sections(
    part: PartAssessment, answers: Path, heights: Path, how_to_repeat: str
) -> list[Section]:
    first = part.assessments[0]
    legend = [f"A star: {UNRESOLVED}."] if star_is_shown(part) else []
    notes = [*map(sentence, part.notes)]
    loads, maps = range(len(part.headings)), range(len(part.names))
    several = part.answers and len(loads) > _LOADS_ABREAST
    of_maps = [
        each_map_table(part, load, maps[i : i + _MAPS_ABREAST])
        for load in loads
        for i in maps[::_MAPS_ABREAST]
    ]
    formulas = formula_table(replace(first, hardness_scatter={}))  # it differs between maps
    return [
        Section(
            "The part",
            [*materials_in_words(part.question.pair), *legend],
            tables=[Table.of_numbers(*load_table(part, leading_keys(part)))] if several else [],
        ),
        *sections_of(part, _LOADS_ABREAST),
        *([Section("Notes", notes=notes)] if notes else []),
        Section(
            "The maps",
            tables=[Table.of_numbers(*maps_table(part)), Table.of_numbers(*leading_table(part))],
            pictures=[
                Picture(answers, "Answers", _caption_of_answers(part)),
                Picture(heights, "Heights", _caption_of_heights(part)),
            ],
        ),
        Section(
            "Each map",
            [
                "Values and intervals of each map alone; its own report lies in a folder beside "
                "this page."
            ],
            tables=[Table.of_numbers(*each) for each in of_maps],
            behind="values and intervals of each map alone",
        ),
        Section(
            "Formulas and sources",
            tables=[Table(*formulas), Table(*symbol_table(first))],
            behind=OF_FORMULAS,
        ),
        Section(
            "Assumptions", [*assumptions_of(first), _ASSUMPTION_OF_PART], behind=OF_ASSUMPTIONS
        ),
        Section("How to repeat it", [how_to_repeat], behind=OF_REPEATING),
    ]


def _caption_of_answers(part: PartAssessment) -> str:
    text = f"Answers at {part.headings[part.largest]} of each map, with its own interval"
    return f"{text}; red: their mean, and its interval over the places of the part."


def _caption_of_heights(part: PartAssessment) -> str:
    which = (
        "Each map" if len(part.names) <= MOST_HEIGHTS else f"The first {MOST_HEIGHTS} maps, each"
    )
    return f"{which} about its mean, in the same colours."
