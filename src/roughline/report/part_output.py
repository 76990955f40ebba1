"""What several maps of a part gave, on the terminal and as JSON."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.console import Console

from roughline.report.contact_tables import UNRESOLVED
from roughline.report.groups import grouped_rows
from roughline.report.json_output import of_assessment
from roughline.report.part_tables import (
    elastic_of_part_in_words,
    groups_of_part,
    headline_of_part,
    lead_of_part,
    leading_keys_of,
    leading_table,
    maps_table,
    part_load_table,
    part_table,
    star_is_shown_of,
)
from roughline.report.terminal import (
    MOST_WITH_ALL,
    print_files,
    print_headline,
    print_remarks,
    print_table,
)

if TYPE_CHECKING:
    from roughline.assessment.part import PartAssessment

_MOST_ABREAST = 2  # loads whose answers stand beside each other


def print_part(part: PartAssessment, files: Iterable[Path] = (), *, many_answers_by: str) -> None:
    """Print the maps, their mean answers with scatter and interval, and the files written.

    `many_answers_by` is the caller's option that gives answers that are too many for a screen.
    """
    console = Console(markup=False)
    print_table(console, *maps_table(part))
    console.print()
    print_remarks(console, "warning", part.warnings)
    if part.answers:
        print_headline(console, lead_of_part(part), headline_of_part(part))
    print_table(console, *leading_table(part))
    count = len(part.headings)
    if part.answers:
        console.print()
    if part.answers and count <= _MOST_ABREAST:
        header, _ = part_table(part, range(count), keys=())
        rows = grouped_rows(
            groups_of_part(part),
            lambda keys: part_table(part, range(count), keys=keys)[1],
            len(header),
        )
        print_table(console, header, rows)
    elif part.answers:
        leading = [key for key in leading_keys_of(part) if key in part.answers]
        keys = leading if count > MOST_WITH_ALL else dict.fromkeys((*leading, *part.answers))
        print_table(console, *part_load_table(part, list(keys)))
    if elastic := elastic_of_part_in_words(part):
        where = " (at the largest load)" if count > 1 else ""
        console.print(elastic + where, highlight=False, soft_wrap=not console.is_terminal)
    if star_is_shown_of(part):
        console.print(f"* {UNRESOLVED}", highlight=False)
    if count > MOST_WITH_ALL:
        console.print(f"other answers at more than {MOST_WITH_ALL} loads: use {many_answers_by}")
    print_remarks(console, "note", part.notes)
    print_files(files)


def of_part(part: PartAssessment, files: Sequence[Path] = ()) -> dict[str, Any]:
    """What several maps gave, in SI units, over the loads that were asked for.

    Answers are listed by their symbols; each map has the same content as a single one.
    """
    return {
        "loads": part.headings,
        "joint_area": part.question.joint,
        "part": {
            each.symbol: {
                "key": each.key,
                "name": each.name,
                "unit": each.unit,
                "mean": each.mean,
                "scatter": each.scatter,
                "low": each.low,
                "high": each.high,
                "maps": each.count,
                "if_elastic": (elastic := part.elastic.get(each.key)) and elastic.mean,
            }
            for each in part.answers.values()
        },
        "maps": {
            name: of_assessment(each)
            for name, each in zip(part.names, part.assessments, strict=True)
        },
        "refused": part.refused,
        "not_pressed": part.left,
        "notes": part.remarks,
        "files": list(files),
    }
