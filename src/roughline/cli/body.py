"""One body, pressed and shown."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from roughline.cli.options import end_interrupted, interruptible, print_json, writable

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment
    from roughline.assessment.question import Question


def press_body(
    question: Question, report: Path | None, out: Path | None, json: bool, command: str
) -> None:
    """Press the body of a question, show what follows, and end with the exit code."""
    from roughline.assessment.assess import assess_body
    from roughline.report.json_output import of_assessment
    from roughline.report.progress import load_progress
    from roughline.report.terminal import announce, print_assessment

    with interruptible("there is no result"), load_progress() as progress:
        with writable(report, out):  # a folder that cannot be written is refused before the work
            result = assess_body(question, announce=announce, progress=progress)
        files = _written(result, report, out, command)
    if json:
        print_json(of_assessment(result, files))
    else:
        print_assessment(
            result,
            files,
            long_curves_by="--out DIR or --json",
            many_answers_by="--json and --report",
        )
    if result.interrupted:
        end_interrupted("the loads solved before are above")
    if not result.curve.converged.all():
        raise typer.Exit(1)


def _written(result: Assessment, report: Path | None, out: Path | None, command: str) -> list[Path]:
    """Write what is wanted; interrupted, a report gets the curve alone."""
    files: list[Path] = []
    if report is None and out is None:
        return files
    from roughline.report.contact_figures import write_contact
    from roughline.report.contact_report import write_contact_report

    if report is not None and result.interrupted:
        files += write_contact(result, report)  # a curve, but no answers to report yet
    elif report is not None:
        files += write_contact_report(result, report, command)
    if out is not None:
        files += write_contact(result, out)
    return files
