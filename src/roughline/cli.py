"""The command line: parse, call one function, print."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from roughline._version import __version__
from roughline.errors import ConvergenceError, InputError, RoughlineError

if TYPE_CHECKING:
    from roughline.spectra import SelfAffine

app = typer.Typer(
    name="roughline",
    help="The contact laboratory for rough surfaces.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)


campaign_app = typer.Typer(
    help="Ensembles of random bodies, on this machine or a Dask cluster.", no_args_is_help=True
)
app.add_typer(campaign_app, name="campaign")


class ExportFormat(StrEnum):
    """Which files to write."""

    netcdf = "netcdf"
    csv = "csv"


class Scale(StrEnum):
    """How large the paper's study is to be."""

    quick = "quick"
    full = "full"


_WORKERS = typer.Option(min=1, help="Processes on this machine [default: one for each core].")
_SCHEDULER = typer.Option(help="Address of a Dask scheduler, such as tcp://10.0.0.1:8786.")
_HURST = typer.Option(help="Hurst exponent, 0 to 1.")
_FRACTAL_DIMENSION = typer.Option(help="Fractal dimension, 2 to 3, instead.")
_POINTS = typer.Option("-n", "--points", help="Points along a side.")
_ROLL_OFF = typer.Option(help='Wavelength above which the spectrum is flat: "0.2 mm".')
_CUTOFF = typer.Option(help='Shortest wavelength, such as "5 um" [default: the grid].')
_UNIT = typer.Option(help="Unit of the lengths in a file that states none.")
_STORE = typer.Argument(help="A store, or the plan beside which it lies.")


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"roughline {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version."
        ),
    ] = False,
) -> None:
    pass


@app.command()
def paper(
    scale: Annotated[
        Scale, typer.Option(help="quick: minutes on two cores; full: the paper's sizes, days.")
    ] = Scale.quick,
    out: Annotated[Path, typer.Option(help="Folder for results and report.")] = Path(
        "roughline-paper"
    ),
    seed: Annotated[int, typer.Option(min=0, help="Root of all random seeds.")] = 2012,
    workers: Annotated[int | None, _WORKERS] = None,
    scheduler: Annotated[str | None, _SCHEDULER] = None,
) -> None:
    """Recompute the paper: both models, its figures, and a report with a verdict on each claim.

    Interrupt at any time with Ctrl-C: what is done is kept, and the same command goes on from it.
    """
    from roughline.report.paper import recompute
    from roughline.report.terminal import announce, campaign_progress

    with _interruptible(out), campaign_progress() as progress:
        page = recompute(
            scale.value,
            out,
            seed,
            workers=workers,
            scheduler=scheduler,
            progress=progress,
            announce=announce,
        )
    typer.echo(f"report: {page}")


@campaign_app.command("run")
def campaign_run(
    plan: Annotated[Path, typer.Argument(help="A plan in TOML.")],
    store: Annotated[
        Path | None, typer.Option(help="Folder for the results [default: the plan's name.zarr].")
    ] = None,
    scheduler: Annotated[str | None, _SCHEDULER] = None,
    workers: Annotated[int | None, _WORKERS] = None,
    threads: Annotated[
        int | None, typer.Option(help="Threads for each case [default: cores over workers].")
    ] = None,
) -> None:
    """Compute what a plan asks for, or what is left of it.

    Interrupt at any time with Ctrl-C: what is done is kept, and the same command goes on from it.
    A plan with more realisations or fractal dimensions adds to the same store. Cases that failed
    are recorded with their reasons, stop no others, and are tried again by the next run.
    """
    from roughline.campaign import read_plan, run
    from roughline.report.terminal import announce, campaign_progress, print_summary

    where = store or plan.with_suffix(".zarr")
    with _interruptible(where), campaign_progress() as progress:
        summary = run(
            read_plan(plan),
            where,
            scheduler=scheduler,
            workers=workers,
            threads=threads,
            progress=progress,
            announce=announce,
        )
    print_summary(summary, where)
    if sum(summary.failed.values()) or summary.unconverged:
        raise typer.Exit(1)


@campaign_app.command("status")
def campaign_status(store: Annotated[Path, _STORE]) -> None:
    """Say what is done of a campaign, and why cases failed."""
    from roughline.campaign import Store
    from roughline.report.terminal import print_status

    print_status(Store(_store_of(store)))


@campaign_app.command("export")
def campaign_export(
    store: Annotated[Path, _STORE],
    out: Annotated[Path, typer.Option(help="Folder for the files.")],
    formats: Annotated[
        list[ExportFormat] | None,
        typer.Option("--format", help="netcdf or csv; may be repeated [default: both]."),
    ] = None,
) -> None:
    """Write every ensemble to NetCDF and CSV, with a table of means and their intervals."""
    from roughline.campaign import Store
    from roughline.campaign.export import export
    from roughline.report.terminal import print_files

    chosen = [item.value for item in formats or ExportFormat]
    print_files(export(Store(_store_of(store)), out, chosen))


@app.command()
def press(
    file: Annotated[Path, typer.Argument(help="A topography: an instrument's file, or ours.")],
    modulus: Annotated[str, typer.Option(help='Contact modulus E*, such as "110 GPa".')],
    loads: Annotated[
        int | None,
        typer.Option(help="Number of loads from first touch to saturation [default: 20]."),
    ] = None,
    force: Annotated[
        list[str] | None, typer.Option(help='A total force, such as "10 N"; may be repeated.')
    ] = None,
    depth: Annotated[
        list[str] | None, typer.Option(help='A depth, such as "200 nm"; may be repeated.')
    ] = None,
    unit: Annotated[str | None, _UNIT] = None,
    keep_tilt: Annotated[bool, typer.Option(help="Keep a measured surface's tilt.")] = False,
    periodic: Annotated[bool, typer.Option(help="Repeat the surface periodically.")] = False,
    grid_error: Annotated[
        bool, typer.Option(help="Estimate discretisation errors from coarser grids.")
    ] = False,
    threads: Annotated[
        int | None, typer.Option(help="Threads [default: one for each core].")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="Folder for the curve (NetCDF) and figures.")
    ] = None,
) -> None:
    """Press a surface (full model) or a reduced line into an elastic half-space.

    Prints depth, force, stiffness and real contact area in SI units. Depth counts from first
    touch; force is the total force. The tilt of measured surfaces is removed.
    """
    from roughline.fft import set_threads
    from roughline.quantities import in_si
    from roughline.report.pressed import press_file
    from roughline.report.terminal import announce, load_progress, print_pressed

    if threads is not None:
        set_threads(threads)
    with load_progress() as progress:
        result = press_file(
            file,
            E_star=in_si(modulus, "Pa", "modulus"),
            n_loads=20 if loads is None and not force and not depth else loads,
            forces=[in_si(text, "N", "force") for text in force] if force else None,
            depths=[in_si(text, "m", "depth") for text in depth] if depth else None,
            unit=unit,
            keep_tilt=keep_tilt,
            periodic=periodic,
            grid_error=grid_error,
            out=out,
            announce=announce,
            progress=progress,
        )
    print_pressed(result)
    if not result.curve.converged.all():
        raise typer.Exit(1)


@app.command()
def compare(
    file: Annotated[Path | None, typer.Argument(help="A surface, instead of a spectrum.")] = None,
    hurst: Annotated[float | None, _HURST] = None,
    fractal_dimension: Annotated[float | None, _FRACTAL_DIMENSION] = None,
    length: Annotated[
        str | None, typer.Option(help='Side of the surface, such as "1 mm"; needed with cutoffs.')
    ] = None,
    roll_off: Annotated[str | None, _ROLL_OFF] = None,
    cutoff: Annotated[str | None, _CUTOFF] = None,
    n: Annotated[int, _POINTS] = 256,
    surfaces: Annotated[int, typer.Option(help="Surfaces of the spectrum.")] = 20,
    force_bar: Annotated[
        list[float] | None,
        typer.Option(help="A dimensionless force F / (E* h L); may be repeated."),
    ] = None,
    tolerance: Annotated[
        float, typer.Option(help="Relative difference that counts as agreement.")
    ] = 0.1,
    seed: Annotated[int, typer.Option(min=0, help="Root of all random seeds.")] = 0,
    unit: Annotated[str | None, _UNIT] = None,
    out: Annotated[Path | None, typer.Option(help="Folder for a table (CSV) and a figure.")] = None,
) -> None:
    """Say how far the reduced model is from the full one, for your own roughness.

    For a spectrum, random surfaces and random lines are pressed, and the map that comes with the
    package is read; for a surface in a file, that surface and lines of its spectrum.
    """
    from roughline.report.compared import compare_models
    from roughline.report.terminal import load_progress, print_compared

    body = file or _spectrum(hurst, fractal_dimension, length, "1 m", roll_off, cutoff)
    with load_progress() as progress:
        result = compare_models(
            body,
            n=n,
            surfaces=surfaces,
            force_bars=force_bar,
            tolerance=tolerance,
            seed=seed,
            unit=unit,
            out=out,
            progress=progress,
        )
    print_compared(result)


@app.command()
def generate(
    out: Annotated[Path, typer.Option(help='File to write, ending in ".nc".')],
    length: Annotated[str, typer.Option(help='Side of the surface, such as "1 mm".')],
    rms_height: Annotated[str, typer.Option(help='Rms height, such as "1 um".')],
    hurst: Annotated[float | None, _HURST] = None,
    fractal_dimension: Annotated[float | None, _FRACTAL_DIMENSION] = None,
    n: Annotated[int, _POINTS] = 512,
    seed: Annotated[int, typer.Option(min=0, help="Random seed.")] = 0,
    line: Annotated[bool, typer.Option(help="The reduced line instead of the surface.")] = False,
    roll_off: Annotated[str | None, _ROLL_OFF] = None,
    cutoff: Annotated[str | None, _CUTOFF] = None,
    gaussian: Annotated[
        bool, typer.Option(help="Gaussian amplitudes instead of random phases alone.")
    ] = False,
) -> None:
    """Generate a random self-affine surface, or its reduced line, and write it to a file."""
    from roughline.measured import write
    from roughline.report.terminal import print_generated

    spectrum = _spectrum(hurst, fractal_dimension, length, rms_height, roll_off, cutoff)
    make = spectrum.line if line else spectrum.surface
    body = replace(make(n, seed, "gaussian" if gaussian else "fixed"), unit="m")
    write(body, out)
    print_generated(body, out)


def _spectrum(
    hurst: float | None,
    fractal_dimension: float | None,
    length: str | None,
    rms_height: str,
    roll_off: str | None,
    cutoff: str | None,
) -> SelfAffine:
    """The spectrum that the options describe; without a length, one without cutoffs."""
    from roughline.quantities import in_si
    from roughline.spectra import SelfAffine

    if length is None and (roll_off or cutoff):
        raise InputError("a roll-off or a cutoff is given without the length of the surface")
    return SelfAffine(
        hurst=hurst,
        fractal_dimension=fractal_dimension,
        length=in_si(length or "1 m", "m", "length"),
        rms_height=in_si(rms_height, "m", "rms-height"),
        q_roll=2 * math.pi / in_si(roll_off, "m", "roll-off") if roll_off else None,
        q_high=2 * math.pi / in_si(cutoff, "m", "cutoff") if cutoff else None,
    )


def _store_of(path: Path) -> Path:
    return path.with_suffix(".zarr") if path.suffix == ".toml" else path


@contextmanager
def _interruptible(place: Path) -> Iterator[None]:
    """End with exit code 130 and a word on what is kept, when interrupted."""
    try:
        yield
    except KeyboardInterrupt:
        typer.echo(f"interrupted; what is done is kept in {place}: run again to go on", err=True)
        raise typer.Exit(130) from None


def main() -> None:
    """Run the command line; errors are one line, exit code 2 for input and 1 for numerics."""
    try:
        app()
    except ConvergenceError as error:
        sys.exit(_say(error, 1))
    except RoughlineError as error:
        sys.exit(_say(error, 2))


def _say(error: RoughlineError, code: int) -> int:
    typer.echo(f"roughline: {error}", err=True)
    return code
