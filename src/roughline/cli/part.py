"""Several maps of one part, pressed and shown."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from roughline.cli.options import end_interrupted, interruptible, print_json, writable

if TYPE_CHECKING:
    from roughline.assessment.part import PartAssessment
    from roughline.assessment.question import Question


def press_part(
    question: Question, report: Path | None, out: Path | None, json: bool, command: str
) -> None:
    """Press the maps of a question, show what they say together, and end with the exit code."""
    from roughline.assessment.assess_part import assess_part
    from roughline.report.part_output import of_part, print_part
    from roughline.report.progress import part_progress
    from roughline.report.terminal import announce

    with interruptible("no map was done"), part_progress() as (maps, loads):
        with writable(report, out):  # a folder that cannot be written is refused before the work
            part = assess_part(
                question.of_each(), announce=announce, progress=loads, map_progress=maps
            )
        files = _written(part, report, out, command)
    if json:
        print_json(of_part(part, files))
    else:
        print_part(part, files, many_answers_by="--json and --report")
    if part.interrupted:
        end_interrupted("the maps done before are above")
    if part.refused or not all(each.curve.converged.all() for each in part.assessments):
        raise typer.Exit(1)


def _written(
    part: PartAssessment, report: Path | None, out: Path | None, command: str
) -> list[Path]:
    """Write what is wanted."""
    files: list[Path] = []
    if report is None and out is None:
        return files
    from roughline.report.part_report import write_part, write_part_report

    if report is not None:
        files += write_part_report(part, report, command)
    if out is not None:
        files += write_part(part, out)
    return files
