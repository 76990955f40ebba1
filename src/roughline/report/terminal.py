"""Output on the terminal for one body: its curve or answers, its description, the comparison."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from rich.console import Console
from rich.text import Text

from roughline.contact.status import Status
from roughline.report.columns import blocks, paragraph
from roughline.report.comparison_table import comparison_table, verdict_in_words
from roughline.report.contact_tables import (
    UNRESOLVED,
    answer_table,
    curve_table,
    elastic_in_words,
    groups,
    headline,
    keys_at_many_loads,
    lead_of,
    leading_keys,
    load_table,
    quantity,
    star_is_shown,
)
from roughline.report.curve_file import loads_table, settings_table
from roughline.report.description_table import description_table, missing_map
from roughline.report.groups import grouped_rows
from roughline.report.page import Headline
from roughline.topography.body import Body, Surface
from roughline.units import engineering

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment
    from roughline.assessment.comparison import ModelComparison
    from roughline.assessment.description import Description
    from roughline.theories.theory_curve import TheoryCurve
    from roughline.topography.files.curves import CurveInFile

MOST_WITH_ALL = 20
"""Loads of which all answers are printed."""

_MOST_SHOWN = 1000  # loads that are printed as a table
_MOST_ABREAST = 3  # loads whose answers stand beside each other
_MOST_NAMED = 5  # loads that were not solved and are named


def print_assessment(
    assessment: Assessment,
    files: Iterable[Path] = (),
    *,
    long_curves_by: str,
    many_answers_by: str,
) -> None:
    """Print what was pressed, its curve or its answers, and the files written.

    The caller's options `long_curves_by` and `many_answers_by` give the curve, or the answers, that
    are too long for a screen.
    """
    console = Console(markup=False)
    console.print(_described(assessment.body), highlight=False, soft_wrap=True)
    curve, pair = assessment.curve, assessment.question.pair
    model = "reduced model, exact" if curve.area_fraction is None else "full model"
    boundary = curve.settings.get("boundary")
    where = f", {boundary} half-space, residuals below {curve.settings['rtol']}" if boundary else ""
    of = f" of {pair.first.name} and {pair.second.name}" if pair else ""
    console.print(f"E*{of} = {engineering(curve.E_star, 'Pa')}; {model}{where}", highlight=False)
    print_remarks(console, "warning", assessment.warnings)
    count = assessment.asked.size
    if count > _MOST_SHOWN:
        console.print(_in_one_line(assessment, long_curves_by), highlight=False, soft_wrap=True)
    elif pair is None:
        print_table(console, *curve_table(assessment))
    elif count <= _MOST_ABREAST:  # formulas are for the report
        print_headline(console, lead_of(assessment), headline(assessment))
        header, _ = answer_table(assessment, slice(None), keys=())
        rows = grouped_rows(
            groups(assessment),
            lambda keys: answer_table(assessment, slice(None), keys=keys)[1],
            len(header),
        )
        print_table(console, header, rows)
    else:
        print_headline(console, lead_of(assessment), headline(assessment))
        many = count > MOST_WITH_ALL
        keys = keys_at_many_loads(assessment) if many else list(assessment.answers)
        print_table(console, *load_table(assessment, keys))
    if elastic := elastic_in_words(assessment):
        where = " (at the largest load)" if count > 1 else ""
        console.print(elastic + where, highlight=False, soft_wrap=not console.is_terminal)
    if star_is_shown(assessment) and count <= _MOST_SHOWN:
        console.print(f"* {UNRESOLVED}", highlight=False)
    if pair is not None and MOST_WITH_ALL < count <= _MOST_SHOWN:
        console.print(f"other answers at more than {MOST_WITH_ALL} loads: use {many_answers_by}")
    for failure in _failures(assessment):
        console.print(failure, highlight=False, soft_wrap=not console.is_terminal)
    for theory in assessment.theories:
        console.print(_theory_line(theory, assessment), highlight=False, soft_wrap=True)
    print_remarks(console, "note", assessment.notes)
    print_files(files)


def print_headline(console: Console, lead: str, told: Headline) -> None:
    """Print what was asked in words, and the answers that lead."""
    console.print()
    console.print(Text(lead, "bold"), soft_wrap=not console.is_terminal)
    width = max((len(each.name) for each in told.figures), default=0)
    for each in told.figures:
        interval = f"  ({each.interval})" if each.interval else ""
        console.print(Text(f"  {each.name:<{width}}  {each.value}{interval}"), soft_wrap=True)
    console.print()


def print_remarks(console: Console, kind: str, remarks: Iterable[str]) -> None:
    """Print remarks, a line each: warnings stand above the answers, notes below."""
    for remark in remarks:
        console.print(f"{kind}: {remark}", highlight=False, soft_wrap=not console.is_terminal)


def _in_one_line(assessment: Assessment, long_curves_by: str) -> str:
    """Both ends of a curve that is too long for a screen."""
    curve = assessment.curve_as_asked
    solved = np.flatnonzero(curve.converged)
    text = f"{curve.status.size} loads"
    if solved.size:
        ends = solved[[0, -1]]
        force, depth = (
            " to ".join(engineering(values[end], unit) for end in ends)
            for values, unit in ((assessment.scale * curve.force, "N"), (curve.depth, "m"))
        )
        text += f" from {force}: depth {depth}"
        if assessment.answers:
            shown = (assessment.answers[key] for key in leading_keys(assessment))
            told = {each.name: [quantity(each, int(end)) for end in ends] for each in shown}
        else:
            told = {"stiffness": [engineering(curve.stiffness[end], "N/m") for end in ends]}
        text += "".join(f", {name} {' to '.join(values)}" for name, values in told.items())
    return f"{text}; for each load use {long_curves_by}"


def _failures(assessment: Assessment) -> list[str]:
    """Say which loads were not solved, and why: a line for each reason."""
    curve = assessment.curve
    asked = dict(zip(assessment.asked.tolist(), assessment.headings, strict=True))
    failed: dict[str, list[str]] = {}
    for i in np.flatnonzero(~curve.converged).tolist():
        failed.setdefault(Status(curve.status[i]).reason, []).append(asked.get(i, ""))
    lines = []
    for reason, loads in failed.items():
        count = f"{len(loads)} of {curve.status.size} loads"
        named = list(dict.fromkeys(filter(None, loads)))
        which = f" ({', '.join(named)})" if 0 < len(named) <= _MOST_NAMED else ""
        lines.append(f"{count}{which}: {reason}")
    return lines


def _theory_line(theory: TheoryCurve, assessment: Assessment) -> str:
    """A theory at the largest load."""
    text = f"{theory.name} at the largest load: area {theory.area_fraction[-1]:.3%}"
    if theory.stiffness is not None:
        stiffness = theory.stiffness[-1] * assessment.area * assessment.scale
        text += f", interface stiffness {engineering(stiffness, 'N/m')}"
    return f"{text} ({theory.validity})"


def print_description(description: Description, files: Iterable[Path] = ()) -> None:
    """Print what a topography is like."""
    console = Console(markup=False)
    if description.roughness is not None:
        print_remarks(console, "warning", description.roughness.remarks)
    rows = description_table(description)
    indent = 2 + max(len(name) for name, _ in rows)
    for name, value in rows:
        console.print(Text(paragraph(name, value, indent, console.width)), soft_wrap=True)
    for line in missing_map(description):
        console.print(line, highlight=False, soft_wrap=True)
    for obstacle in description.obstacles:
        console.print(f"it cannot be pressed as it is: {obstacle}", highlight=False, soft_wrap=True)
    print_remarks(console, "note", description.notes)
    print_files(files)


def print_curve_file(curve: CurveInFile) -> None:
    """Print what a file with a curve is of, and its loads."""
    console = Console(markup=False)
    rows = settings_table(curve)
    indent = 2 + max(len(name) for name, _ in rows)
    for name, value in rows:
        console.print(Text(paragraph(name, value, indent, console.width)), soft_wrap=True)
    header, loads = loads_table(curve)
    print_table(console, header, loads[:_MOST_SHOWN])
    if len(loads) > _MOST_SHOWN:
        console.print(f"{len(loads) - _MOST_SHOWN} more loads: use --json", highlight=False)
    opened = f'xarray.open_dataset("{curve.file}", engine="h5netcdf")'
    console.print(f"all of it in Python: {opened}", highlight=False, soft_wrap=True)


def print_comparison(compared: ModelComparison, files: Iterable[Path] = ()) -> None:
    """Print both curves, their difference, and where the reduced model may be trusted."""
    console = Console(markup=False)
    console.print(compared.what, highlight=False, soft_wrap=True)
    print_remarks(console, "warning", compared.comparison.warnings)
    print_table(console, *comparison_table(compared))
    if not compared.comparison.resolved.all():
        console.print("* fewer than ten cells in contact: the grid decides, not the surface")
    console.print(verdict_in_words(compared), highlight=False, soft_wrap=True)
    print_files(files)


def print_table(console: Console, header: list[str], rows: list[list[str]]) -> None:
    """Print a table of names and values, in as many blocks as the width of the screen needs."""
    for i, block in enumerate(blocks(header, rows, console.width)):
        if i:
            console.print()
        for lines, style in ((block.header, "bold"), (block.body, "")):
            for line in lines:
                console.print(Text(line, style), soft_wrap=True)


def print_files(files: Iterable[Path]) -> None:
    """Print which files were written."""
    console = Console(markup=False)
    for file in files:
        console.print(f"wrote {file}", highlight=False, soft_wrap=True)


def announce(text: str) -> None:
    """Print a line on standard error."""
    Console(stderr=True, markup=False).print(text, highlight=False, soft_wrap=True)


def print_generated(body: Body, file: Path) -> None:
    """Print what was generated and where it is."""
    console = Console(markup=False)
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
