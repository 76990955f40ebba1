"""Commands on contact: press a topography, compare the models."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import Annotated

import typer

from roughline.cli import options
from roughline.cli.options import end_interrupted, interruptible, print_json

LOADS = "Loads"
BODIES = "Bodies"
ANSWERS = "Answers"


def press(
    file: Annotated[
        Path, typer.Argument(help="A topography or line scan: an instrument's file, or ours.")
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
        typer.Option(help='Contact modulus E* instead: "110 GPa".', rich_help_panel=BODIES),
    ] = None,
    against: Annotated[
        Path | None,
        typer.Option(
            help="Topography of the second body, read and prepared like the first "
            "[default: it is smooth].",
            rich_help_panel=BODIES,
        ),
    ] = None,
    load: Annotated[
        list[str] | None,
        typer.Option(
            "--load",
            "--force",
            help='A total force, "10 N", or a mean pressure, "2 MPa"; may be repeated.',
            rich_help_panel=LOADS,
        ),
    ] = None,
    depth: Annotated[
        list[str] | None,
        typer.Option(help='A depth, such as "200 nm"; may be repeated.', rich_help_panel=LOADS),
    ] = None,
    loads: Annotated[
        int | None,
        typer.Option(
            help="Number of loads from first touch to saturation [default: 20].",
            rich_help_panel=LOADS,
        ),
    ] = None,
    periodic: Annotated[
        bool,
        typer.Option(
            "--periodic",
            help="Repeat the surface: results per nominal area.",
            rich_help_panel=BODIES,
        ),
    ] = False,
    friction: Annotated[
        float | None,
        typer.Option(
            help="Coefficient of friction: adds partial slip to the report.",
            rich_help_panel=ANSWERS,
        ),
    ] = None,
    frequency: Annotated[
        str | None,
        typer.Option(help='Of ultrasound, "5 MHz": adds reflection.', rich_help_panel=ANSWERS),
    ] = None,
    theory: Annotated[
        list[str] | None,
        typer.Option(
            help="persson, bush-gibson-thomas or greenwood-williamson; may be repeated.",
            rich_help_panel=ANSWERS,
        ),
    ] = None,
    grid_error: Annotated[
        bool | None,
        typer.Option(
            "--grid-error/--no-grid-error",
            help="Estimate discretisation errors from coarser grids [default: where that takes "
            "some seconds, and for a report].",
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
    fill: options.Fill = options.Filling.harmonic,
    max_missing: options.MaxMissing = 0.1,
    trend: options.TrendOption = None,
    crop: options.Crop = None,
    low_pass: options.LowPass = None,
    resample: options.Resample = None,
    remove_outliers: options.RemoveOutliers = False,
    threads: Annotated[
        int | None, typer.Option(help="Threads [default: one for each core].")
    ] = None,
    json: options.Json = False,
) -> None:
    """Press a topography into an elastic half-space, and say what follows.

    A surface is solved with the full model: every interaction, residuals certified. A line scan
    goes through its spectrum to the reduced model. A load in newtons is the total force on the
    nominal area; one in pascals is the mean pressure over it. Depth counts from first touch.

    With two materials it prints contact stiffness, real contact area, contact pressure over
    hardness, electrical and thermal contact conductance and tangential stiffness; with --report it
    writes them with their formulas, the surface, the preparation, the assumptions and this command
    on one page, as HTML and PDF. A value is followed by ± or by both ends of its interval: what
    the grid and filled points, or a single line scan, leave open. A star behind a load marks fewer
    than ten points in contact, where the grid decides.

    Materials by name: alumina, aluminium, brass, copper, fused-silica, glass, gold, nickel, pmma,
    ptfe, rigid, silicon, silver, stainless-steel, steel, tin, titanium, tungsten, zinc. Others by
    value, or a name with some values changed: E, nu, hardness, resistivity, conductivity, density.

    Exit codes: 0; 1 if a load was not solved to the tolerance, which is said and shown as missing;
    2 for input that cannot be used; 130 after Ctrl-C, with the loads solved until then.

    Examples
    --------
    roughline press scan.x3p --modulus "110 GPa"

    roughline press scan.x3p --materials steel,copper --load "10 N" --report contact

    roughline press scan.sur --against other.sur --materials "E=3 GPa nu=0.38, rigid" --load "2 MPa"

    roughline press map.npy --unit um --size "1 mm" --trend curvature --materials
    "steel hardness=6 GPa, gold" --load "10 N" --load "1 N" --theory persson --grid-error
    """
    from roughline.assessment.questions import ask
    from roughline.computing.fft import set_threads
    from roughline.report.json_output import of_pressed
    from roughline.report.terminal import announce, load_progress, print_pressed

    if threads is not None:
        set_threads(threads)
    source = options.source_of(file, unit, channel, size, fill, max_missing, trend)
    with interruptible("there is no result"), load_progress() as progress:
        result = ask(
            source,
            loads=load or [],
            depths=depth or [],
            count=loads,
            modulus=modulus,
            materials=materials,
            against=against,
            preparation=options.preparation_of(trend, crop, low_pass, resample, remove_outliers),
            periodic=periodic,
            grid_error=grid_error,
            friction=friction,
            frequency=frequency,
            theories=theory or [],
            report=report,
            out=out,
            command=shlex.join(["roughline", *map(_without_folders, sys.argv[1:])]),
            announce=announce,
            progress=progress,
        )
    if json:
        print_json(of_pressed(result))
    else:
        print_pressed(result)
    if result.interrupted:
        end_interrupted("the loads solved before are above")
    if not result.curve.converged.all():
        raise typer.Exit(1)


def _without_folders(argument: str) -> str:
    """An argument as others may see it: of an absolute path, the last name alone."""
    option, sign, value = argument.rpartition("=")
    return f"{option}{sign}{Path(value).name}" if Path(value).is_absolute() else argument


def compare(
    file: Annotated[Path | None, typer.Argument(help="A surface, instead of a spectrum.")] = None,
    hurst: options.Hurst = None,
    fractal_dimension: options.FractalDimension = None,
    length: Annotated[
        str | None, typer.Option(help='Side of the surface, such as "1 mm"; needed with cutoffs.')
    ] = None,
    roll_off: options.RollOff = None,
    cutoff: options.Cutoff = None,
    n: options.Points = 256,
    surfaces: Annotated[int, typer.Option(help="Surfaces of the spectrum.")] = 20,
    force_bar: Annotated[
        list[float] | None,
        typer.Option(help="A dimensionless force F / (E* h L); may be repeated."),
    ] = None,
    tolerance: Annotated[
        float, typer.Option(help="Relative difference that counts as agreement.")
    ] = 0.1,
    seed: options.Seed = 0,
    unit: options.Unit = None,
    channel: options.Channel = None,
    size: options.Size = None,
    fill: options.Fill = options.Filling.harmonic,
    max_missing: options.MaxMissing = 0.1,
    out: Annotated[Path | None, typer.Option(help="Folder for a table (CSV) and a figure.")] = None,
    json: options.Json = False,
) -> None:
    """Say how far the reduced model is from the full one, for your own roughness.

    For a spectrum, random surfaces and random lines are pressed, and the map that comes with the
    package is read; for a surface in a file, that surface and lines of its spectrum.
    """
    from roughline.assessment.compared import compare_models
    from roughline.report.json_output import of_compared
    from roughline.report.terminal import load_progress, print_compared

    body = (
        options.source_of(file, unit, channel, size, fill, max_missing)
        if file
        else options.spectrum_of(hurst, fractal_dimension, length, "1 m", roll_off, cutoff)
    )
    with interruptible("nothing is written"), load_progress() as progress:
        result = compare_models(
            body,
            n=n,
            surfaces=surfaces,
            force_bars=force_bar,
            tolerance=tolerance,
            seed=seed,
            out=out,
            progress=progress,
        )
    if json:
        print_json(of_compared(result))
    else:
        print_compared(result)
