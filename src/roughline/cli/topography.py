"""Commands on one topography: generate it, describe it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from roughline.cli import options
from roughline.cli.options import print_json, writable
from roughline.errors import InputError
from roughline.question.fields import FILE, PREPARATION, FieldValues


@options.with_fields(FILE, PREPARATION)
def info(
    file: Annotated[
        Path,
        typer.Argument(
            help="A topography: an instrument's file, or one that roughline wrote; or a curve that "
            "it wrote."
        ),
    ],
    values: FieldValues,
    out: Annotated[
        Path | None, typer.Option(help="Folder for a figure and the prepared topography.")
    ] = None,
    iso: Annotated[
        bool,
        typer.Option("--iso", help="Print the parameters of ISO 25178-2 or ISO 21920-2 as well."),
    ] = False,
    s_filter: Annotated[
        str | None,
        typer.Option(help='Cutoff of the S-filter before them, such as "2.5 um" [default: none].'),
    ] = None,
    l_filter: Annotated[
        str | None,
        typer.Option(help='Cutoff of the L-filter before them, such as "0.8 mm" [default: none].'),
    ] = None,
    prepared: Annotated[
        Path | None,
        typer.Option(
            help='File for the prepared topography, ending in ".nc" (NetCDF), ".x3p" or ".gsf".'
        ),
    ] = None,
    json: options.Json = False,
) -> None:
    """Describe a topography: sizes, missing points, roughness, and its self-affine spectrum.

    Of a curve that roughline wrote, it prints what was pressed and the loads.

    Intervals are 95 % intervals. The Hurst exponent, the roll-off and the cutoff are those of a
    plateau and a power law fitted to the spectrum; the last line says whether this fit describes
    the spectrum.
    """
    from roughline.question.description import describe, with_texture
    from roughline.question.from_fields import build_preparation, build_reading
    from roughline.report.curve_file import as_json, print_curve_file
    from roughline.report.description_table import print_description
    from roughline.report.json_output import description_json
    from roughline.topography.files.curves import curve_in
    from roughline.topography.files.write import checked_name, write
    from roughline.units import in_si

    cutoffs = {"s_filter": s_filter, "l_filter": l_filter}
    if not iso and (asked := [name for name, text in cutoffs.items() if text is not None]):
        raise InputError("is of the parameters of ISO alone; give --iso too", asked[0])
    if curve := curve_in(file):
        if iso:
            raise InputError("--iso is of topographies, and this file is a curve; leave it out")
        return print_json(as_json(curve)) if json else print_curve_file(curve)
    with writable(out, None if prepared is None else checked_name(prepared).parent):
        result = describe(file, build_reading(values), build_preparation(values))
        if iso:
            lengths = {
                name: None if text is None else in_si(text, "m", name)
                for name, text in cutoffs.items()
            }
            result = with_texture(result, **lengths)
        if prepared is not None and result.body is None:
            raise InputError(result.obstacles[0])
    files: list[Path] = []
    if prepared is not None and result.body is not None:
        write(result.body, prepared)
        files.append(prepared)
    if out is not None:
        from roughline.report.description_figures import write_description

        files += write_description(result, out)
    if json:
        print_json(description_json(result, files))
    else:
        print_description(result, files)


def generate(
    out: Annotated[
        Path, typer.Option(help='File to write, ending in ".nc" (NetCDF), ".x3p" or ".gsf".')
    ],
    length: Annotated[str, typer.Option(help='Side of the surface, such as "1 mm".')],
    rms_height: Annotated[str, typer.Option(help='Rms height, such as "1 um".')],
    hurst: options.Hurst = None,
    fractal_dimension: options.FractalDimension = None,
    n: options.PointsOption = 512,
    seed: options.SeedOption = 0,
    line: Annotated[
        bool, typer.Option("--line", help="Generate the reduced line instead of the surface.")
    ] = False,
    roll_off: options.RollOff = None,
    cutoff: options.Cutoff = None,
    gaussian: Annotated[
        bool,
        typer.Option(
            "--gaussian",
            help="Gaussian amplitudes and random phases [default: random phases alone].",
        ),
    ] = False,
    json: options.Json = False,
) -> None:
    """Generate a random self-affine surface, or its reduced line, and write it to a file."""
    from roughline.report.json_output import generated_json
    from roughline.report.terminal import print_generated
    from roughline.topography.files.write import write

    spectrum = options.described_spectrum(
        hurst, fractal_dimension, length, rms_height, roll_off, cutoff
    )
    make = spectrum.line if line else spectrum.surface
    body = replace(make(n, seed, "gaussian" if gaussian else "fixed"), unit="m")
    write(body, out)
    if json:
        print_json(generated_json(body, out))
    else:
        print_generated(body, out)
