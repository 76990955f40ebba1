"""The report on several maps of one part, as HTML and PDF."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from roughline.plot.style import save, styled
from roughline.report.contact_figures import write_contact
from roughline.report.contact_report import assumptions_of, sentence, write_contact_report
from roughline.report.contact_tables import (
    UNRESOLVED,
    formula_table,
    material_in_words,
    symbol_table,
)
from roughline.report.document import write_document
from roughline.report.page import Headline, KeyFigure, Picture, Section, Table
from roughline.report.part_figures import MOST_HEIGHTS, answers_figure, heights_figure
from roughline.report.part_tables import (
    each_map_table,
    elastic_of_part_in_words,
    leading_keys_of,
    leading_table,
    maps_table,
    mean_and_interval,
    part_load_table,
    part_table,
    scatter_in_words,
    star_is_shown_of,
)
from roughline.units import engineering

if TYPE_CHECKING:
    from roughline.assessment.part import PartAssessment

ASSUMPTION_OF_PART = (
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
    title, lead = f"Contact of a part, {_count(part)}", _lead(part)
    sections = _sections(part, figures[0], figures[2], how_to_repeat)
    document = write_document(folder, title, lead, sections, _headline(part))
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


def _count(part: PartAssessment) -> str:
    """Number of maps on the page, and of all maps if some are missing."""
    count = len(part.names)
    text = f"{count} maps" if count > 1 else "a single map"
    missing = len(part.refused) + len(part.left)
    return f"{text} of {count + missing}" if missing else text


def _lead(part: PartAssessment) -> str:
    """What was asked: both materials, and the largest load."""
    i = part.largest
    pair, joint = part.question.pair, part.question.joint
    assert pair is not None
    under = part.headings[i] + (
        "" if joint is None else f" on a joint of {engineering(joint, 'm²')}"
    )
    count = len(part.headings)
    which = f", the largest of {count} loads" if count > 1 else ""
    text = f"{pair.first.name} on {pair.second.name} under {under}{which}"
    if not any(key in part.answers for key in leading_keys_of(part)):
        return sentence(f"{text}: the maps have no common mean")
    unsure = any(not each.curve_as_asked.resolved[i] for each in part.assessments)
    return sentence(text + (f" ({UNRESOLVED})" if unsure else ""))


def _headline(part: PartAssessment) -> Headline:
    """Means of the leading answers with their intervals, and how far places scatter."""
    i = part.largest
    leading = [part.answers[key] for key in leading_keys_of(part) if key in part.answers]
    below = [elastic_of_part_in_words(part)]
    if leading and len(part.names) > 1:
        below.insert(0, f"places scatter by {scatter_in_words(leading[0], i)} in {leading[0].name}")
    return Headline(
        [KeyFigure.of(each.name, mean_and_interval(each, i)) for each in leading],
        [*map(sentence, part.warnings)],
        " ".join(map(sentence, filter(None, below))),
    )


def _sections(
    part: PartAssessment, answers: Path, heights: Path, how_to_repeat: str
) -> list[Section]:
    pair, first = part.question.pair, part.assessments[0]
    assert pair is not None
    legend = [f"A star: {UNRESOLVED}."] if star_is_shown_of(part) else []
    notes = [*map(sentence, part.notes)]
    loads, maps = range(len(part.headings)), range(len(part.names))
    of_part = [
        part_table(part, loads[i : i + _LOADS_ABREAST], with_elastic=True)
        for i in loads[::_LOADS_ABREAST]
    ]
    if len(loads) > _LOADS_ABREAST:
        leading = [key for key in leading_keys_of(part) if key in part.answers]
        of_part.insert(0, part_load_table(part, leading))
    of_maps = [
        each_map_table(part, load, maps[i : i + _MAPS_ABREAST])
        for load in loads
        for i in maps[::_MAPS_ABREAST]
    ]
    formulas = formula_table(replace(first, hardness_scatter={}))  # it differs between maps
    return [
        Section(
            "The part",
            [
                f"Materials: {material_in_words(pair.first)}; {material_in_words(pair.second)}.",
                *legend,
            ],
            tables=[_with_numbers(*each) for each in of_part if part.answers],
        ),
        *([Section("Notes", notes=notes)] if notes else []),
        Section(
            "The maps",
            tables=[_with_numbers(*maps_table(part)), _with_numbers(*leading_table(part))],
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
            tables=[_with_numbers(*each) for each in of_maps],
        ),
        Section("Formulas and sources", tables=[Table(*formulas), Table(*symbol_table(first))]),
        Section("Assumptions", [*assumptions_of(first), ASSUMPTION_OF_PART]),
        Section("How to repeat it", [how_to_repeat]),
    ]


def _with_numbers(header: list[str], rows: list[list[str]]) -> Table:
    """A table whose columns are numbers, but for the first."""
    return Table(header, rows, numbers=range(1, len(header)))


def _caption_of_answers(part: PartAssessment) -> str:
    text = f"Answers at {part.headings[part.largest]} of each map, with its own interval"
    return f"{text}; red: their mean, and its interval over the places of the part."


def _caption_of_heights(part: PartAssessment) -> str:
    which = (
        "Each map" if len(part.names) <= MOST_HEIGHTS else f"The first {MOST_HEIGHTS} maps, each"
    )
    return f"{which} about its mean, in the same colours."
