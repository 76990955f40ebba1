"""Output on the terminal for one body: its curve or answers, its description, the comparison."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from rich.console import Console
from rich.table import Table

from roughline.assessment.given import several
from roughline.contact.status import Status
from roughline.report.comparison_table import comparison_table, verdict_in_words
from roughline.report.contact_tables import (
    UNRESOLVED,
    answer_table,
    curve_table,
    elastic_in_words,
    star_is_shown,
)
from roughline.report.description_table import description_table, missing_map
from roughline.report.values import value_and_interval
from roughline.topography.body import Body, Surface
from roughline.units import engineering

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment
    from roughline.assessment.comparison import ModelComparison
    from roughline.assessment.description import Description
    from roughline.theories.theory_curve import TheoryCurve

_MOST_SHOWN = 200  # loads that are printed as a table
_MOST_ANSWERED = 3  # loads whose answers fit on a screen
_SHORTEST_NAME = 20  # columns that the name of an answer needs at least


def print_assessment(
    assessment: Assessment,
    files: Iterable[Path] = (),
    *,
    long_curves_by: str,
    many_answers_by: str,
) -> None:
    """Print what was pressed, its curve or its answers, and the files written.

    Parameters
    ----------
    assessment : Assessment
        What is shown.
    files : iterable of Path
        What was written.
    long_curves_by, many_answers_by : str
        Options of the caller that give the curve, or the answers, that are too long for a screen.
    """
    console = Console()
    console.print(_described(assessment.body), highlight=False, soft_wrap=True)
    curve, pair = assessment.curve, assessment.question.pair
    model = "reduced model, exact" if curve.area_fraction is None else "full model"
    boundary = curve.settings.get("boundary")
    where = f", {boundary} half-space, residuals below {curve.settings['rtol']}" if boundary else ""
    of = f" of {pair.first.name} and {pair.second.name}" if pair else ""
    console.print(f"E*{of} = {engineering(curve.E_star, 'Pa')}; {model}{where}", highlight=False)
    count = assessment.asked.size
    many, typed = count > _MOST_SHOWN, len(several(assessment.question.loads)) or count
    answered = typed if pair is not None and typed <= _MOST_ANSWERED else 0
    if many:
        console.print(_in_one_line(assessment, long_curves_by), highlight=False, soft_wrap=True)
    elif answered < count:
        print_table(console, *curve_table(assessment))
    if answered:  # formulas are for the report
        print_table(console, *answer_table(assessment, slice(answered)))
    if elastic := elastic_in_words(assessment):
        where = " (at the largest load)" if count > 1 else ""
        console.print(elastic + where, highlight=False, soft_wrap=not console.is_terminal)
    if star_is_shown(assessment) and not many:
        console.print(f"* {UNRESOLVED}", highlight=False)
    if pair is not None and answered < count:
        which = "under the falling loads" if answered else f"at more than {_MOST_ANSWERED} loads"
        console.print(f"answers {which}: use {many_answers_by}")
    for failure in _failures(assessment) if not many else ():
        console.print(failure, highlight=False)
    for theory in assessment.theories:
        console.print(_theory_line(theory, assessment), highlight=False, soft_wrap=True)
    for note in assessment.remarks:
        console.print(f"note: {note}", highlight=False, soft_wrap=not console.is_terminal)
    print_files(files)


def _in_one_line(assessment: Assessment, long_curves_by: str) -> str:
    """Both ends of a curve that is too long for a screen."""
    curve, solved = assessment.curve, assessment.curve.converged
    text = f"{solved.size} loads"
    if solved.any():
        ends = (
            " to ".join(engineering(values[solved][end], unit) for end in (0, -1))
            for values, unit in ((curve.force, "N"), (curve.depth, "m"), (curve.stiffness, "N/m"))
        )
        text += " from {}: depth {}, stiffness {}".format(*ends)
    for status, count in Counter(curve.status[~solved].tolist()).items():
        text += f"; {count} not solved ({Status(status).reason})"
    return f"{text}; for each load use {long_curves_by}"


def _failures(assessment: Assessment) -> list[str]:
    """Say which loads were not solved, and why."""
    curve = assessment.curve
    asked = dict(zip(assessment.asked.tolist(), assessment.headings, strict=True))
    failures = (
        f"load {asked.get(int(i), 'of the curve')}: {Status(curve.status[i]).reason}"
        for i in np.flatnonzero(~curve.converged)
    )
    return list(dict.fromkeys(failures))  # loads of the curve alone share a line


def _theory_line(theory: TheoryCurve, assessment: Assessment) -> str:
    """A theory at the largest load."""
    text = f"{theory.name} at the largest load: area {theory.area_fraction[-1]:.3%}"
    if theory.stiffness is not None:
        stiffness = theory.stiffness[-1] * assessment.area * assessment.scale
        text += f", interface stiffness {engineering(stiffness, 'N/m')}"
    return f"{text} ({theory.validity})"


def print_description(description: Description, files: Iterable[Path] = ()) -> None:
    """Print what a topography is like."""
    console = Console()
    table = Table(box=None, show_header=False)
    for row in description_table(description):
        table.add_row(*row)
    console.print(table, highlight=False)
    for line in missing_map(description):
        console.print(line, highlight=False, soft_wrap=True)
    for obstacle in description.obstacles:
        console.print(f"it cannot be pressed as it is: {obstacle}", highlight=False, soft_wrap=True)
    remarks = description.roughness.remarks if description.roughness else []
    for note in (*description.notes, *remarks):
        console.print(f"note: {note}", highlight=False, soft_wrap=True)
    print_files(files)


def print_comparison(compared: ModelComparison, files: Iterable[Path] = ()) -> None:
    """Print both curves, their difference, and where the reduced model may be trusted."""
    console = Console()
    console.print(compared.what, highlight=False, soft_wrap=True)
    console.print(table(*comparison_table(compared)))
    if not compared.comparison.resolved.all():
        console.print("* fewer than ten cells in contact: the grid decides, not the surface")
    console.print(verdict_in_words(compared), highlight=False, soft_wrap=True)
    for warning in compared.comparison.warnings:
        console.print(f"note: {warning}", highlight=False, soft_wrap=True)
    print_files(files)


def print_table(console: Console, header: list[str], rows: list[list[str]]) -> None:
    """Print a table of names and values; where it is too wide, intervals stand below values."""
    if _width(header, rows) > console.width:
        rows = [[_stacked(cell) for cell in row] for row in rows]
    shown = table(header, rows)
    shown.columns[0].justify = "left"
    if _width(header, [["", *row[1:]] for row in rows]) + _SHORTEST_NAME <= console.width:
        for column in shown.columns[1:]:
            column.no_wrap = True  # the names are broken in lines instead
    console.print(shown)


def _stacked(cell: str) -> str:
    """A value, and its interval without brackets below it."""
    value, *interval = value_and_interval(cell)
    return "\n".join([value, *(each.strip("()") for each in interval)])


def _width(header: list[str], rows: list[list[str]]) -> int:
    """Columns of the screen that a table takes, with two between its own."""
    columns = zip(header, *rows, strict=True)
    return sum(
        2 + max(len(line) for cell in cells for line in cell.split("\n")) for cells in columns
    )


def table(header: list[str], rows: list[list[str]]) -> Table:
    """A table of texts without lines, numbers to the right."""
    made = Table(box=None, header_style="bold", pad_edge=False, padding=(0, 2, 0, 0))
    for name in header:
        made.add_column(name, justify="right", overflow="fold")
    for row in rows:
        made.add_row(*row)
    return made


def print_files(files: Iterable[Path]) -> None:
    """Print which files were written."""
    console = Console()
    for file in files:
        console.print(f"wrote {file}", highlight=False, soft_wrap=True)


def announce(text: str) -> None:
    """Print a line on standard error."""
    Console(stderr=True).print(text, highlight=False, soft_wrap=True)


def print_generated(body: Body, file: Path) -> None:
    """Print what was generated and where it is."""
    console = Console()
    console.print(_described(body), highlight=False)
    print_files([file])


def _described(body: Body) -> str:
    if isinstance(body, Surface):
        points = f"surface of {body.shape[0]} x {body.shape[1]} points"
        size = " x ".join(engineering(size, "m") for size in body.sizes)
    else:
        points = f"line of {body.heights.size} points"
        size = engineering(body.length, "m")
    removed = body.settings.get("detrended")
    trend = f", {removed} removed" if removed else ""
    slope = f"rms slope {body.rms_slope:.3g}"
    return f"{points}, {size}; rms height {engineering(body.rms_height, 'm')}, {slope}{trend}"
