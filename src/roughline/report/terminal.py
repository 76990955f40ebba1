"""Output on the terminal: the curve or the answers of a body or a part, and how lines are set."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import AbstractContextManager
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.text import Text

from roughline.assessment.assessment import Assessment
from roughline.assessment.part import PartAssessment
from roughline.contact.curve import SurfaceCurve
from roughline.contact.status import Status
from roughline.facts.listed import listed
from roughline.report.answers import (
    MOST_WARNINGS,
    UNRESOLVED,
    answer_table,
    elastic_in_words,
    figure_keys,
    groups,
    headline,
    lead_sentence,
    leading_keys,
    load_table,
    quantity,
    starred,
)
from roughline.report.columns import blocks, paragraph
from roughline.report.contact_tables import curve_table, modulus_in_words
from roughline.report.part_tables import count_in_words, leading_table, maps_table
from roughline.report.why import TITLE, why_in_words
from roughline.topography.body import Body, Surface
from roughline.units import engineering

MOST_PRINTED = 1000
"""Loads that are printed as a table, unless all are wanted."""

_MOST_ABREAST = 3  # loads of a body whose answers stand beside each other
_MOST_PART_ABREAST = 2  # and of a part, whose answers have two columns
_MOST_NAMED = 5  # loads that were not solved, or maps, that are named


def print_assessment(
    assessment: Assessment,
    files: Iterable[Path] = (),
    *,
    unfolded_by: str = "",
    console: Console | None = None,
) -> None:
    """Print what was pressed, and its curve or its answers as far as they are not folded.

    Of two materials that is what was asked in words and large figures, and an answer of each group.
    The last line names the caller's option `unfolded_by`, which shows what is folded; without one
    everything is printed.
    """
    console = console or Console(markup=False)
    console.print(described(assessment.body), highlight=False, soft_wrap=True)
    curve, pair = assessment.curve, assessment.question.pair
    model = "reduced model, exact"
    if isinstance(curve, SurfaceCurve):
        boundary = curve.half_space.boundary
        model = f"full model, {boundary} half-space, residuals below {curve.settings['rtol']}"
    console.print(f"{modulus_in_words(assessment)}; {model}", highlight=False, soft_wrap=True)
    folded: list[str] = []
    if pair is not None:
        folded = _print_answers(console, assessment, _MOST_ABREAST, unfolded_by)
    else:
        _print_warnings(console, assessment, unfolded_by)
        if unfolded_by and assessment.asked.size > MOST_PRINTED:
            ends = f"{_ends_of_curve(assessment)}; for each load use {unfolded_by}"
            console.print(ends, highlight=False, soft_wrap=True)
        else:
            print_table(console, *curve_table(assessment))
            _explain_star(console, starred(assessment))
    for failure in _failures(assessment):
        console.print(failure, highlight=False, soft_wrap=not console.is_terminal)
    for line in _theory_lines(assessment):
        console.print(line, highlight=False, soft_wrap=True)
    _print_end(console, assessment, files, folded, unfolded_by)


def print_part(
    part: PartAssessment,
    files: Iterable[Path] = (),
    *,
    unfolded_by: str = "",
    console: Console | None = None,
) -> None:
    """Print the mean answers of several maps with scatter and interval, folded as those of one."""
    console = console or Console(markup=False)
    some = ", ".join(part.names) if len(part.names) <= _MOST_NAMED else ""
    console.print(": ".join(filter(None, (count_in_words(part), some))), highlight=False)
    folded = _print_answers(console, part, _MOST_PART_ABREAST, unfolded_by)
    if not unfolded_by or not leading_keys(part):
        console.print()
        print_table(console, *maps_table(part))
        console.print()
        print_table(console, *leading_table(part))
    _print_end(console, part, files, folded, unfolded_by)


def _print_answers(
    console: Console, result: Assessment | PartAssessment, abreast: int, unfolded_by: str
) -> list[str]:
    """Print the answers of two materials; returns which of them are folded, if any are.

    Folded, a group has what was asked of it or else one answer, a curve of which no load was named
    has its ends, and a body under one load has the large figures alone.
    """
    _print_headline(console, result, unfolded_by)
    headings = starred(result)
    loads = list(range(len(headings)))
    if unfolded_by and not result.question.loading.headings:
        loads = sorted({0, result.largest})
    keys = list(result.answers)
    if unfolded_by:
        keys = [key for each in groups(result) for key in each.headlines]
    if unfolded_by and isinstance(result, Assessment) and len(headings) == 1:
        keys, loads = figure_keys(result), []  # are printed, and a table would repeat them
    elif len(loads) > abreast:
        print_table(console, *load_table(result, keys))
    else:
        table = (_folded_table if unfolded_by else _unfolded_table)(result, loads)
        print_table(console, *table)
    if not unfolded_by and (elastic := elastic_in_words(result)):
        where = " (at the largest load)" if len(headings) > 1 else ""
        console.print(elastic + where, highlight=False, soft_wrap=not console.is_terminal)
    _explain_star(console, [headings[i] for i in loads])
    if not unfolded_by and isinstance(result, Assessment):
        _print_why(console, result)
    loads_left = len(headings) - len(loads) if loads else 0
    further = {"answers": len(result.answers) - len(keys), "loads": loads_left}
    counts = [f"{count} further {name}" for name, count in further.items() if count]
    return counts + (
        ["those of each map"] if unfolded_by and isinstance(result, PartAssessment) else []
    )


def _print_why(console: Console, result: Assessment) -> None:
    """Print what leaves the answers that lead open, the most first: a line for each answer."""
    rows = why_in_words(result, leading_keys(result))
    if rows:
        where = " (at the largest load)" if len(result.headings) > 1 else ""
        console.print(f"{TITLE}, as multiples of the value{where}:", highlight=False)
        print_rows(console, [(f"  {name}", causes) for name, causes in rows])


def _folded_table(
    result: Assessment | PartAssessment, loads: Sequence[int]
) -> tuple[list[str], list[list[str]]]:
    """What stands for each group, and how many more answers the group has."""
    headlines = {key: group for group in groups(result) for key in group.headlines}
    header, rows = answer_table(result, loads, list(headlines))
    if not result.question.loading.headings:  # loads that nobody named are called by their numbers
        force = result.answers["normal_force"]
        header[1:] = [
            heading.replace(str(i + 1), quantity(force, i), 1)
            for i, heading in zip(loads, header[1:], strict=True)
        ]
    return [*header, "further"], [
        [
            f"{group.name}: {name}",
            *cells,
            str(len(group.keys) - len(group.headlines) or "") if key == group.headlines[-1] else "",
        ]
        for (key, group), (name, *cells) in zip(headlines.items(), rows, strict=True)
    ]


def _unfolded_table(
    result: Assessment | PartAssessment, loads: Sequence[int]
) -> tuple[list[str], list[list[str]]]:
    """All answers, each group but the first below a row with its name."""
    header, _ = answer_table(result, loads, ())
    rows: list[list[str]] = []
    for each in groups(result):
        rows += [[each.name.upper(), *[""] * (len(header) - 1)]] if rows else []
        rows += answer_table(result, loads, each.keys)[1]
    return header, rows


def _print_headline(
    console: Console, result: Assessment | PartAssessment, unfolded_by: str
) -> None:
    """Print what was asked in words, the answers that lead, and warnings."""
    figures = headline(result).figures
    console.print()
    console.print(Text(lead_sentence(result), "bold"), soft_wrap=not console.is_terminal)
    width = max((len(each.name) for each in figures), default=0)
    for each in figures:
        interval = f"  ({each.interval})" if each.interval else ""
        console.print(Text(f"  {each.name:<{width}}  {each.value}{interval}"), soft_wrap=True)
    console.print()
    if _print_warnings(console, result, unfolded_by):
        console.print()


def _print_warnings(
    console: Console, result: Assessment | PartAssessment, unfolded_by: str
) -> bool:
    """Print warnings, grave ones first; folded the first few in short. Says whether any are."""
    first = [each.in_short for each in result.facts[:MOST_WARNINGS] if each.is_warning]
    print_remarks(console, "warning", first if unfolded_by else result.warnings)
    return bool(first)


def print_remarks(console: Console, kind: str, remarks: Iterable[str]) -> None:
    """Print remarks, a line each: warnings stand above what they are about, notes below."""
    for remark in remarks:
        console.print(f"{kind}: {remark}", highlight=False, soft_wrap=not console.is_terminal)


def _explain_star(console: Console, headings: Sequence[str]) -> None:
    """Say what the star after a load means, if there is one."""
    if any(each.endswith("*") for each in headings):
        console.print(f"* {UNRESOLVED}", highlight=False)


def _print_end(
    console: Console,
    result: Assessment | PartAssessment,
    files: Iterable[Path],
    folded: Sequence[str],
    unfolded_by: str,
) -> None:
    """Print notes, the files written, and how much of what is folded."""
    are_folded = bool(unfolded_by) and result.question.pair is not None
    print_remarks(console, "note", [] if are_folded else result.notes)
    print_files(files)
    counts = {"note": len(result.notes) if are_folded else 0}
    if unfolded_by:
        counts = {"further warning": len(result.warnings) - MOST_WARNINGS, **counts}
    remarks = [f"{n} {name}{'' if n == 1 else 's'}" for name, n in counts.items() if n > 0]
    if further := [*remarks, *folded]:
        text = f"{listed(further)}: {unfolded_by} shows them"
        console.print(text, highlight=False, soft_wrap=True)


def _ends_of_curve(assessment: Assessment) -> str:
    """Both ends of a curve that is too long for a screen."""
    curve = assessment.curve_as_asked
    solved = np.flatnonzero(curve.converged)
    text = f"{curve.status.size} loads"
    if solved.size:
        force, depth, stiffness = (
            " to ".join(engineering(values[end], unit) for end in solved[[0, -1]])
            for values, unit in (
                (assessment.scale * assessment.load_on(curve.force), "N"),
                (curve.depth, "m"),
                (curve.stiffness, "N/m"),
            )
        )
        text += f" from {force}: depth {depth}, stiffness {stiffness}"
    return text


def _failures(assessment: Assessment) -> list[str]:
    """Say which loads were not solved, and why: a line for each reason."""
    curve = assessment.curve
    asked = dict(zip(assessment.asked.tolist(), assessment.headings, strict=True))
    failed: dict[str, list[str]] = {}
    for i in np.flatnonzero(~curve.converged & (curve.status != Status.LIFTED)).tolist():
        failed.setdefault(Status(curve.status[i]).reason, []).append(asked.get(i, ""))
    lines = []
    for reason, loads in failed.items():
        count = f"{len(loads)} of {curve.status.size} loads"
        named = list(dict.fromkeys(filter(None, loads)))
        which = f" ({', '.join(named)})" if 0 < len(named) <= _MOST_NAMED else ""
        lines.append(f"{count}{which}: {reason}")
    return lines


def _theory_lines(assessment: Assessment) -> list[str]:
    """Theories at the largest load."""
    lines = []
    for theory in assessment.theories:
        text = f"{theory.name} at the largest load: area {theory.area_fraction[-1]:.3%}"
        if theory.stiffness is not None:
            stiffness = theory.stiffness[-1] * assessment.area * assessment.scale
            text += f", interface stiffness {engineering(stiffness, 'N/m')}"
        lines.append(f"{text} ({theory.validity})")
    return lines


def print_table(console: Console, header: list[str], rows: list[list[str]]) -> None:
    """Print a table of names and values, in as many blocks as the width of the screen needs."""
    for i, block in enumerate(blocks(header, rows, console.width)):
        if i:
            console.print()
        for lines, style in ((block.header, "bold"), (block.body, "")):
            for line in lines:
                console.print(Text(line, style), soft_wrap=True)


def print_rows(console: Console, rows: Sequence[tuple[str, str]]) -> None:
    """Print names, and beside them texts that are broken between words."""
    indent = 2 + max(len(name) for name, _ in rows)
    for name, value in rows:
        console.print(Text(paragraph(name, value, indent, console.width)), soft_wrap=True)


def print_files(files: Iterable[Path]) -> None:
    """Print which files were written."""
    console = Console(markup=False)
    for file in files:
        console.print(f"wrote {file}", highlight=False, soft_wrap=True)


def announce(text: str) -> None:
    """Print a line on standard error."""
    Console(stderr=True, markup=False).print(text, highlight=False, soft_wrap=True)


def writing(what: str) -> AbstractContextManager[object]:
    """Say on a terminal that something is written, for as long as it is."""
    return Console(stderr=True, markup=False).status(f"writing {what}")


def print_generated(body: Body, file: Path) -> None:
    """Print what was generated and where it is."""
    console = Console(markup=False)
    console.print(described(body), highlight=False)
    print_files([file])


def described(body: Body) -> str:
    """Say what a body is: points, sizes, roughness, and the trend that was removed."""
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
