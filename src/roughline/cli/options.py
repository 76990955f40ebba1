"""Options that several commands share, and how their texts are read."""

from __future__ import annotations

import functools
import inspect
import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Annotated, Any, Literal, NoReturn

import typer

import roughline as rl
from roughline.cli import garbage
from roughline.errors import InputError, RoughlineError
from roughline.errors.checks import refuse
from roughline.question.fields import ANSWERS, BODIES, FIELDS, LOADS, Field


def with_fields(*groups: str) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Give a command the options of the fields in some groups, where it takes their `values`."""
    fields = [each for each in FIELDS if each.group in groups and each.flag]

    def with_options(command: Callable[..., None]) -> Callable[..., None]:
        declared = list(inspect.signature(command, eval_str=True).parameters.values())
        place = [each.name for each in declared].index("values")
        before, after = declared[:place], declared[place + 1 :]

        @functools.wraps(command)
        def run(**arguments: Any) -> None:
            values = {each.name: each.value(arguments.pop(each.name)) for each in fields}
            command(**arguments, values=values)

        options = [
            inspect.Parameter(
                each.name, before[0].kind, default=None, annotation=_field_option(each)
            )
            for each in fields
        ]
        parameters = [*before, *options, *after]
        run.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        run.__annotations__ = {each.name: each.annotation for each in parameters}
        return run

    return with_options


def _field_option(field: Field) -> Any:
    """The option of a field, as an annotation; where it is not given, its value is None."""
    kind: Any = field.kind
    text, otherwise = field.help.rstrip("."), field.otherwise
    flags = field.flag.split(",")
    words = [value for value, _ in field.choices.values()]
    if field.is_switch:
        kind = bool
        flags[0] += f"/--no-{flags[0].removeprefix('--')}" if None in words else ""
    elif words:
        kind = Literal[*(each for each in words if each is not None)]
        otherwise = otherwise or words[0]
    if field.separator:
        kind, text = list[kind], f"{text}; may be repeated"
    text += f" [default: {otherwise}]" if otherwise else ""
    option = typer.Option(*flags, help=f"{text}.", rich_help_panel=field.group, show_default=False)
    return Annotated[kind | None, option]


_spectrum_option = functools.partial(typer.Option, rich_help_panel="Spectrum")
of_bodies = functools.partial(typer.Option, rich_help_panel=BODIES)
of_loads = functools.partial(typer.Option, rich_help_panel=LOADS)


Hurst = Annotated[float | None, _spectrum_option(help="Hurst exponent, 0 to 1.")]
FractalDimension = Annotated[
    float | None, _spectrum_option(help="Fractal dimension, 2 to 3, instead of the Hurst exponent.")
]
RollOff = Annotated[
    str | None,
    _spectrum_option(help='Wavelength above which the spectrum is flat, such as "0.2 mm".'),
]
Cutoff = Annotated[
    str | None,
    _spectrum_option(help='Shortest wavelength, such as "5 um" [default: that of the grid].'),
]
Materials = Annotated[
    str | None,
    of_bodies(help='Both materials, such as "steel,copper" or "E=3 GPa nu=0.38, rigid".'),
]
Modulus = Annotated[
    str | None,
    of_bodies(help='Contact modulus E* instead of the materials, such as "110 GPa".'),
]
CurveFile = Annotated[
    Path | None,
    typer.Option(
        "--out",
        help='File for the curve, ending in ".nc" (NetCDF) or ".csv" (a table).',
        rich_help_panel=ANSWERS,
    ),
]
PointsOption = Annotated[int, typer.Option("-n", "--points", help="Points along a side.")]
SeedOption = Annotated[int, typer.Option(min=0, help="Root of all random seeds.")]
Workers = Annotated[
    int | None,
    typer.Option(min=1, help="Processes on this machine [default: one for each core]."),
]
Scheduler = Annotated[
    str | None, typer.Option(help="Address of a Dask scheduler, such as tcp://10.0.0.1:8786.")
]
Json = Annotated[bool, typer.Option("--json", help="Print JSON in SI units, for other programs.")]


def described_spectrum(
    hurst: float | None,
    fractal_dimension: float | None,
    length: str | None,
    rms_height: str,
    roll_off: str | None,
    cutoff: str | None,
) -> rl.SelfAffine:
    """The spectrum that the options describe; without a length, one without cutoffs."""
    if length is None and (roll_off or cutoff):
        raise InputError(
            "a roll-off or a cutoff is given without the length of the surface: give --length too"
        )
    side = _positive(length or "1 m", "length")
    longest = side if roll_off is None else _positive(roll_off, "q_roll")
    shortest = None if cutoff is None else _positive(cutoff, "q_high")
    if longest > side * (1 + 1e-12):
        refuse("q_roll", roll_off, f"a wavelength of at most the length, {length}, is needed")
    if shortest is not None and not shortest < longest:
        refuse("q_high", cutoff, f"a wavelength below {roll_off or length} is needed")
    return rl.SelfAffine(
        hurst=hurst,
        fractal_dimension=fractal_dimension,
        length=side,
        rms_height=_positive(rms_height, "rms_height"),
        q_roll=None if roll_off is None else 2 * math.pi / longest,
        q_high=None if shortest is None else 2 * math.pi / shortest,
    )


def _positive(text: str, name: str) -> float:
    """Read a positive length. [m]"""
    from roughline.units import in_si

    length = in_si(text, "m", name)
    if not 0 < length < math.inf:
        refuse(name, text, "a positive, finite length is needed")
    return length


def print_json(content: dict[str, Any]) -> None:
    """Print a result for other programs."""
    from roughline.report.json_output import to_json

    typer.echo(to_json(content))


def continuation(place: Path) -> str:
    """Say where what is done is kept, and how to go on from there."""
    return f"what is done is kept in {place}: run again to go on"


@contextmanager
def interruptible(remark: str) -> Iterator[None]:
    """Do long work; when interrupted, end with exit code 130 and a word on what is kept."""
    garbage.as_usual()
    try:
        yield
    except KeyboardInterrupt:
        end_interrupted(remark)


def end_interrupted(remark: str) -> NoReturn:
    """End with exit code 130 and a word on what is kept."""
    typer.echo(f"interrupted; {remark}", err=True)
    raise typer.Exit(130) from None


@contextmanager
def writable(*folders: Path | None) -> Iterator[None]:
    """Make the folders that results will be written to, so that none is refused after the work.

    Where the work is refused, those that were made for it and are empty are removed.
    """
    from roughline.report.folder import make_folder

    new = [folder for folder in folders if folder is not None and not folder.exists()]
    for folder in folders:
        if folder is not None:
            make_folder(folder)
    try:
        yield
    except RoughlineError:
        for folder in new:
            with suppress(OSError):  # it holds something
                folder.rmdir()
        raise


@contextmanager
def writable_file(file: Path | None) -> Iterator[None]:
    """Refuse a file that a curve cannot be written to before the work, and make its folder."""
    from roughline.contact.curve_files import checked_name

    with writable(None if file is None else checked_name(file).parent):
        yield
