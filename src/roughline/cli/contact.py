"""The command that presses a topography."""

from __future__ import annotations

import os
import shlex
import sys
from pathlib import Path
from typing import Annotated

import typer

from roughline.cli import options
from roughline.cli.body import press_body
from roughline.cli.part import press_part
from roughline.errors import InputError
from roughline.errors.checks import refuse

LOADS = "Loads"
BODIES = "Bodies"
ANSWERS = "Answers"


def press_command(
    file: Annotated[
        list[Path],
        typer.Argument(
            help="A topography or line scan: an instrument's file, or one that roughline wrote; or "
            "several maps of one part, each of a different place."
        ),
    ],
    materials: Annotated[
        str | None,
        typer.Option(
            help='Both materials, such as "steel,copper" or "E=70 GPa nu=0.33, rigid".',
            rich_help_panel=BODIES,
        ),
    ] = None,
    modulus: Annotated[
        str | None,
        typer.Option(
            help='Contact modulus E* instead of the materials, such as "110 GPa".',
            rich_help_panel=BODIES,
        ),
    ] = None,
    against: Annotated[
        Path | None,
        typer.Option(
            help="Topography of the second body, read and prepared like the first "
            "[default: a smooth body].",
            rich_help_panel=BODIES,
        ),
    ] = None,
    hardness: Annotated[
        str | None,
        typer.Option(
            help='Hardness of the softer body, such as "2 GPa", taken as exact [default: that of '
            "the materials, with its scatter].",
            rich_help_panel=BODIES,
        ),
    ] = None,
    elastic: Annotated[
        bool,
        typer.Option(
            "--elastic",
            help="Take both bodies as elastic, whatever their hardness.",
            rich_help_panel=BODIES,
        ),
    ] = False,
    load: Annotated[
        list[str] | None,
        typer.Option(
            "--load",
            "--force",
            help='A total force, such as "10 N", or a mean pressure, such as "2 MPa"; may be '
            "repeated.",
            rich_help_panel=LOADS,
        ),
    ] = None,
    depth: Annotated[
        list[str] | None,
        typer.Option(help='A depth, such as "200 nm"; may be repeated.', rich_help_panel=LOADS),
    ] = None,
    joint_area: Annotated[
        str | None,
        typer.Option(
            help='Area of the joint that the map is a part of, such as "2 cm^2": forces then act '
            "on the joint, and the answers are those of the joint.",
            rich_help_panel=LOADS,
        ),
    ] = None,
    loads: Annotated[
        int | None,
        typer.Option(
            help="Number of loads from first touch to saturation [default: 20].",
            rich_help_panel=LOADS,
        ),
    ] = None,
    history: Annotated[
        bool,
        typer.Option(
            "--history",
            help="Apply several --load in the order given, rising and falling, each to the surface "
            "as the load before it left it.",
            rich_help_panel=LOADS,
        ),
    ] = False,
    unload: Annotated[
        bool,
        typer.Option(
            "--unload",
            help="Remove the largest --load again, in steps down to zero.",
            rich_help_panel=LOADS,
        ),
    ] = False,
    periodic: Annotated[
        bool,
        typer.Option(
            "--periodic",
            help="Repeat the surface periodically: it has no borders, and the stiffness is that of "
            "the interface.",
            rich_help_panel=BODIES,
        ),
    ] = False,
    friction: Annotated[
        float | None,
        typer.Option(
            help="Coefficient of friction, above 0 and up to 5: adds partial slip to the report "
            "and to JSON.",
            rich_help_panel=ANSWERS,
        ),
    ] = None,
    frequency: Annotated[
        str | None,
        typer.Option(
            help='Frequency of ultrasound, such as "5 MHz": adds its reflection by the interface.',
            rich_help_panel=ANSWERS,
        ),
    ] = None,
    theory: Annotated[
        list[str] | None,
        typer.Option(
            help="Theory to compare with: {theories}; may be repeated.",
            rich_help_panel=ANSWERS,
        ),
    ] = None,
    grid_error: Annotated[
        bool | None,
        typer.Option(
            "--grid-error/--no-grid-error",
            help="Estimate discretisation errors from coarser grids [default: where that takes "
            "only a few seconds, and for a report].",
            show_default=False,
            rich_help_panel=ANSWERS,
        ),
    ] = None,
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
    unit: options.Unit = None,
    channel: options.Channel = None,
    size: options.Size = None,
    fill: options.Fill = options.FillingChoice.harmonic,
    max_missing: options.MaxMissing = 0.1,
    tilt: options.Tilt = options.TiltChoice.unknown,
    pixels: options.Pixels = None,
    blur: options.Blur = None,
    tip_radius: options.TipRadius = None,
    trend: options.TrendOption = None,
    crop: options.Crop = None,
    low_pass: options.LowPass = None,
    resample: options.Resample = None,
    remove_outliers: options.RemoveOutliers = False,
    threads: Annotated[
        int | None, typer.Option(help="Number of threads [default: one for each core].")
    ] = None,
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
    changed: E, nu, hardness, resistivity, conductivity, density.

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

    roughline press map.npy --unit um --size "1 mm" --trend curvature --materials
    "steel hardness=6 GPa, gold" --load "10 N" --load "1 N" --theory persson --grid-error
    """
    from roughline.assessment.question import Question
    from roughline.computing.fft import set_threads

    if threads is not None:
        set_threads(threads)
    if materials is None and (report or frequency or friction is not None):
        raise InputError("a report, reflection and partial slip need two --materials")
    if report is not None and not load:
        raise InputError('a report needs a --load, such as "10 N"')
    if friction is not None and report is None and not json:
        raise InputError(
            "partial slip (--friction) is written to the report and to JSON only: give --report or "
            "--json"
        )
    if against is not None and not os.path.isfile(against):  # noqa: PTH113 - of a name too long, too
        refuse("against", str(against), "no such file: give a file with a topography")
    question = Question(
        file[0] if len(file) == 1 else file,
        materials=materials,
        E_star=modulus,
        loads=load or (),
        joint_area=joint_area,
        depths=depth or (),
        hardness=hardness,
        elastic=elastic,
        history=history,
        unload=unload,
        n_loads=loads,
        against=against,
        periodic=periodic,
        friction=friction,
        frequency=frequency,
        theories=theory or (),
        grid_error=grid_error,
        reading=options.reading_of(
            unit, channel, size, fill, max_missing, tilt, pixels, blur, tip_radius
        ),
        preparation=options.preparation_of(trend, crop, low_pass, resample, remove_outliers),
        whole_curve=report is not None,
        fields=report is not None or out is not None,
    )
    if question.is_of_several:
        return press_part(question, report, out, json, _as_typed())
    press_body(question, report, out, json, _as_typed())


def _as_typed() -> str:
    """The command, without the folders of this machine."""
    return shlex.join(["roughline", *map(_without_folders, sys.argv[1:])])


def _without_folders(argument: str) -> str:
    """An argument as others may see it: of an absolute path, the last name alone."""
    option, sign, value = argument.rpartition("=")
    return f"{option}{sign}{Path(value).name}" if Path(value).is_absolute() else argument
