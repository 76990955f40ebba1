"""The command that presses a topography."""

from __future__ import annotations

import os
import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

import roughline as rl
from roughline.cli import options
from roughline.cli.options import end_interrupted, interruptible, print_json, writable
from roughline.errors import InputError
from roughline.errors.checks import refuse
from roughline.question.fields import ANSWERS, BODIES, FILE, LOADS, PREPARATION, FieldValues

if TYPE_CHECKING:
    from roughline.question.question import Question


@options.with_fields(BODIES, LOADS, ANSWERS, FILE, PREPARATION)
def press_command(
    file: Annotated[
        list[Path],
        typer.Argument(
            help="A topography or line scan: an instrument's file, or one that roughline wrote; or "
            "several maps of one part, each of a different place."
        ),
    ],
    values: FieldValues,
    report: Annotated[
        Path | None,
        typer.Option(
            help="Folder for a report (HTML and PDF) with figures and the curve; needs "
            "--materials and --load.",
            rich_help_panel=ANSWERS,
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(help="Folder for the curve (NetCDF) and figures.", rich_help_panel=ANSWERS),
    ] = None,
    export_table: Annotated[
        str | None,
        typer.Option(
            help="File for finite elements with pressure over overclosure, stiffness and "
            "conductance: calculix:FILE, abaqus:FILE, moose:FILE or a FILE that ends in .csv; "
            "needs --periodic or --joint-area.",
            rich_help_panel=ANSWERS,
        ),
    ] = None,
    threads: Annotated[
        int | None, typer.Option(help="Number of threads [default: one for each core].")
    ] = None,
    everything: Annotated[
        bool,
        typer.Option("--all", help="Print all answers under all loads [default: one a group]."),
    ] = False,
    json: options.Json = False,
) -> None:
    """Press a topography into an elastic half-space, and print the contact quantities.

    A surface is solved with the full model: all elastic interactions, with certified residuals. A
    line scan is solved with the reduced model, through its spectrum. A load in newtons is the total
    force on the nominal area; one in pascals is the mean pressure over it. Depth counts from first
    touch.

    Where the hardness of the materials is known, points of the contact that reach it yield and are
    indented permanently; where yielding changes an answer, its elastic value is given as well.
    --elastic leaves yielding out.

    With two materials it prints contact stiffness, real contact area, contact pressure over
    hardness, electrical and thermal contact conductance and tangential stiffness; with --report it
    writes them with their formulas, the surface, the preparation, the assumptions and this command
    to a report, as one page of HTML and as PDF to be printed. A value is followed by ± or by both
    ends of its interval. The interval holds the uncertainty due to the grid, to filled points and
    to the scatter of a hardness, or to a single line scan. A star after a load marks fewer than ten
    points in contact: the grid decides there.

    For several maps it prints the answers of each map, their mean, their scatter between places and
    an interval for the part. With --joint-area the map stands for a joint that has the same
    roughness everywhere and is evenly loaded.

    Materials by name: {materials}. Other materials by their values, or by a name with some values
    changed: E, nu, hardness, resistivity, conductivity, density. Coated ones by their layers, each
    with its thickness, and what they lie on: "gold 0.5 um on nickel 2 um on copper".

    Exit codes: 0; 1 if a load was not solved to the tolerance, or if one of several maps was
    refused (it is named, and listed as refused); 2 for input that cannot be used; 130 after Ctrl-C,
    with the loads or maps solved until then.

    Examples
    --------
    roughline press scan.x3p --modulus "110 GPa"

    roughline press scan.x3p --materials steel,copper --load "10 N" --joint-area "1 cm^2"
    --report contact

    roughline press scans/*.x3p --materials steel,copper --load "10 N" --joint-area "2 cm^2"

    roughline press scan.x3p --modulus "110 GPa" --hardness "2 GPa" --load "10 N" --unload

    roughline press scan.sur --against other.sur --materials "E=3 GPa nu=0.38, rigid" --load "2 MPa"

    roughline press scan.x3p --materials "rubber 2 mm on steel, rigid" --load "0.1 MPa"

    roughline press scan.x3p --materials steel,copper --load "1 MPa" --load "10 MPa" --periodic
    --export-table abaqus:joint.inp

    roughline press map.npy --unit um --size "1 mm" --trend curvature --materials
    "steel hardness=6 GPa, gold" --load "10 N" --load "1 N" --theory persson --grid-error
    """
    from roughline.computing.fft import set_threads
    from roughline.question.from_fields import build_question

    if threads is not None:
        set_threads(threads)
    asks = report or values.get("frequency") or values.get("friction") is not None
    if values.get("periodic_along") and report is not None:
        raise InputError(
            "a report is one of answers, which are not known of a body repeated along one side "
            "alone (--periodic-along): write its curve with --out"
        )
    if values.get("materials") is None and asks and not values.get("periodic_along"):
        raise InputError("a report, reflection and friction need two --materials")
    if report is not None and not values.get("loads"):
        raise InputError('a report needs a --load, such as "10 N"')
    against = values.get("against")
    if against is not None and not os.path.isfile(against):  # noqa: PTH113 - of a name too long, too
        refuse("against", against, "no such file: give a file with a topography")
    question = build_question(
        file[0] if len(file) == 1 else file,
        {**values, "whole_curve": report is not None},
        fields=report is not None or out is not None,
    )
    unfolded_by = "" if everything else "--all"
    if export_table is not None:
        from roughline.report.finite_elements import checked_table

        checked_table(export_table, question)
    if question.is_of_several:
        _press_part(question, report, out, json=json, unfolded_by=unfolded_by)
    else:
        _press_body(question, report, out, export_table, json=json, unfolded_by=unfolded_by)


def _press_body(
    question: Question,
    report: Path | None,
    out: Path | None,
    table: str | None,
    *,
    json: bool,
    unfolded_by: str,
) -> None:
    """Press the body of a question, show what follows, and end with the exit code."""
    from roughline.assessment.assess import assess_body
    from roughline.report.json_output import assessment_json
    from roughline.report.progress import load_progress
    from roughline.report.terminal import announce, print_assessment, writing

    with interruptible("there is no result"):
        # a folder that cannot be written is refused before the work
        with writable(report, out), load_progress() as progress:
            result = assess_body(question, announce=announce, progress=progress)
        files: list[Path] = []
        if report or out:
            from roughline.report.contact_figures import write_contact
            from roughline.report.contact_report import write_contact_report

            with writing("the report" if report else "the curve"):
                if report and result.interrupted:
                    files += write_contact(result, report)  # a curve, but no answers to report yet
                elif report:
                    files += write_contact_report(result, report, _as_typed())
                files += write_contact(result, out) if out else []
        if table is not None and not result.interrupted:
            files.append(rl.export_table(result, table))
    if json:
        print_json(assessment_json(result, files))
    else:
        print_assessment(result, files, unfolded_by=unfolded_by)
    if result.interrupted:
        end_interrupted("the loads solved before are above")
    if not result.is_solved:
        raise typer.Exit(1)


def _press_part(
    question: Question, report: Path | None, out: Path | None, *, json: bool, unfolded_by: str
) -> None:
    """Press the maps of a question, show what they say together, and end with the exit code."""
    from roughline.assessment.assess_part import assess_part
    from roughline.report.json_output import part_json
    from roughline.report.progress import part_progress
    from roughline.report.terminal import announce, print_part, writing

    with interruptible("no map was done"):
        # a folder that cannot be written is refused before the work
        with writable(report, out), part_progress() as (maps, loads):
            part = assess_part(
                question.one_by_one(), announce=announce, progress=loads, map_progress=maps
            )
        files: list[Path] = []
        if report or out:
            from roughline.report.part_report import write_part, write_part_report

            with writing("the report" if report else "the curves"):
                files += write_part_report(part, report, _as_typed()) if report else []
                files += write_part(part, out) if out else []
    if json:
        print_json(part_json(part, files))
    else:
        print_part(part, files, unfolded_by=unfolded_by)
    if part.interrupted:
        end_interrupted("the maps done before are above")
    if part.refused or not all(each.is_solved for each in part.assessments):
        raise typer.Exit(1)


def _as_typed() -> str:
    """The command, without the folders of this machine."""
    return shlex.join(["roughline", *map(_without_folders, sys.argv[1:])])


def _without_folders(argument: str) -> str:
    """An argument as others may see it: of an absolute path, the last name alone."""
    option, sign, value = argument.rpartition("=")
    return f"{option}{sign}{Path(value).name}" if Path(value).is_absolute() else argument
