"""The command that compares the models."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from roughline.cli import options
from roughline.cli.options import interruptible, print_json, writable
from roughline.errors.checks import refuse
from roughline.question.fields import FILE, FieldValues

if TYPE_CHECKING:
    from roughline.comparison.compared import NamedBody
    from roughline.question.reading import Reading


@options.with_fields(FILE)
def compare_command(
    file: Annotated[
        Path | None, typer.Argument(help="File with a surface, instead of a spectrum.")
    ] = None,
    *,
    values: FieldValues,
    hurst: options.Hurst = None,
    fractal_dimension: options.FractalDimension = None,
    length: Annotated[
        str | None,
        typer.Option(
            help='Side of the surface, such as "1 mm"; needed with --roll-off or --cutoff.'
        ),
    ] = None,
    roll_off: options.RollOff = None,
    cutoff: options.Cutoff = None,
    n: options.PointsOption = 256,
    surfaces: Annotated[int, typer.Option(help="Number of random surfaces of the spectrum.")] = 20,
    force_bar: Annotated[
        list[float] | None,
        typer.Option(help="A dimensionless force F / (E* h L); may be repeated."),
    ] = None,
    tolerance: Annotated[
        float, typer.Option(help="Relative difference that counts as agreement.")
    ] = 0.1,
    seed: options.SeedOption = 0,
    out: Annotated[Path | None, typer.Option(help="Folder for a table (CSV) and a figure.")] = None,
    json: options.Json = False,
) -> None:
    """Compare the stiffness of the reduced model with that of the full one, for your own roughness.

    For a spectrum, random surfaces and random lines are pressed, and the trust map that comes with
    the package is read as well. For a surface in a file, that surface and random lines of its
    spectrum are pressed.
    """
    from roughline.comparison.compared import compare_models
    from roughline.question.from_fields import build_reading
    from roughline.report.comparison import print_comparison, write_comparison
    from roughline.report.json_output import comparison_json
    from roughline.report.progress import load_progress

    if file is None:
        _refuse(values, "it says how a FILE is read, and there is none: leave it out")
        spectrum = options.described_spectrum(
            hurst, fractal_dimension, length, "1 m", roll_off, cutoff
        )
    else:
        of_spectrum = {"hurst": hurst, "fractal_dimension": fractal_dimension, "length": length}
        of_spectrum |= {"q_roll": roll_off, "q_high": cutoff}
        _refuse(of_spectrum, "it belongs to a spectrum, and a FILE is given: leave one of them out")
        reading = build_reading(values)
    with interruptible("nothing is written"), load_progress() as progress:
        with writable(out):
            result = compare_models(
                spectrum if file is None else _read(file, reading),
                n=n,
                surfaces=surfaces,
                force_bars=force_bar,
                tolerance=tolerance,
                seed=seed,
                progress=progress,
            )
        files: list[Path] = []
        if out is not None:
            files = write_comparison(result, out)
    if json:
        print_json(comparison_json(result, files))
    else:
        print_comparison(result, files)


def _read(file: Path, reading: Reading) -> NamedBody:
    """The surface of a file."""
    from roughline.comparison.compared import NamedBody
    from roughline.question.source import Topography

    return NamedBody(Topography.of(file, reading, None).body, reading.name or str(file))


def _refuse(by_name: Mapping[str, Any], why: str) -> None:
    """Refuse the first of the options that is given."""
    for name, value in by_name.items():
        if value is not None:
            refuse(name, value, why)
