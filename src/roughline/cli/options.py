"""Options that several commands share, and how their texts are read."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer

import roughline as rl
from roughline.errors import InputError, RoughlineError
from roughline.errors.checks import refuse

FILE = "A file"
PREPARATION = "Preparation"
SPECTRUM = "Spectrum"


class FillingChoice(StrEnum):
    """How missing points are filled."""

    harmonic = "harmonic"
    nearest = "nearest"


class TiltChoice(StrEnum):
    """Whose the tilt of a measured topography is."""

    unknown = "unknown"
    mounting = "mounting"


class PixelsChoice(StrEnum):
    """What the heights of a map are."""

    means = "means"
    points = "points"


class TrendChoice(StrEnum):
    """What is removed from the heights."""

    none = "none"
    mean = "mean"
    tilt = "tilt"
    curvature = "curvature"


Unit = Annotated[
    str | None,
    typer.Option(help="Unit of the lengths in a file that states none.", rich_help_panel=FILE),
]
Channel = Annotated[
    str | None,
    typer.Option(help="Channel of the file: its name, or its number from 0.", rich_help_panel=FILE),
]
Size = Annotated[
    str | None,
    typer.Option(
        help='Sides of a file that states none, such as "1 mm, 0.5 mm".', rich_help_panel=FILE
    ),
]
Fill = Annotated[
    FillingChoice, typer.Option(help="How missing points are filled.", rich_help_panel=FILE)
]
MaxMissing = Annotated[
    float,
    typer.Option(
        help="Largest share of missing points, 0 to below 1, that is filled; a file with more is "
        "refused.",
        rich_help_panel=FILE,
    ),
]
Tilt = Annotated[
    TiltChoice,
    typer.Option(
        help="Whose the tilt of measured heights is: the mounting's alone, or also that of waves "
        "longer than the topography.",
        rich_help_panel=FILE,
    ),
]
Pixels = Annotated[
    PixelsChoice | None,
    typer.Option(
        help="Whether heights are means over pixels or those of points [default: means for files "
        "of optical instruments, else not known].",
        rich_help_panel=FILE,
    ),
]
Blur = Annotated[
    str | None,
    typer.Option(
        help='Standard deviation of the instrument\'s blur, such as "0.3 um"; 0 for none '
        "[default: not known].",
        rich_help_panel=FILE,
    ),
]
TipRadius = Annotated[
    str | None,
    typer.Option(help='Radius of the tip, such as "2 um".', rich_help_panel=FILE),
]
TrendOption = Annotated[
    TrendChoice | None,
    typer.Option(
        help="Trend that is removed from the heights [default: the tilt of measured ones].",
        rich_help_panel=PREPARATION,
    ),
]
Crop = Annotated[
    str | None,
    typer.Option(
        help='Piece to keep, from and to along x and y, such as "0 um, 50 um, 0 um, 40 um".',
        rich_help_panel=PREPARATION,
    ),
]
LowPass = Annotated[
    str | None,
    typer.Option(
        help='Cutoff wavelength of a Gaussian filter, such as "2 um".',
        rich_help_panel=PREPARATION,
    ),
]
Resample = Annotated[
    int | None,
    typer.Option(help="Points along the longer side to resample to.", rich_help_panel=PREPARATION),
]
RemoveOutliers = Annotated[
    bool,
    typer.Option(
        "--remove-outliers",
        help="Remove spikes and fill their points [default: they are only counted].",
        rich_help_panel=PREPARATION,
    ),
]
Hurst = Annotated[
    float | None, typer.Option(help="Hurst exponent, 0 to 1.", rich_help_panel=SPECTRUM)
]
FractalDimension = Annotated[
    float | None,
    typer.Option(
        help="Fractal dimension, 2 to 3, instead of the Hurst exponent.", rich_help_panel=SPECTRUM
    ),
]
RollOff = Annotated[
    str | None,
    typer.Option(
        help='Wavelength above which the spectrum is flat, such as "0.2 mm".',
        rich_help_panel=SPECTRUM,
    ),
]
Cutoff = Annotated[
    str | None,
    typer.Option(
        help='Shortest wavelength, such as "5 um" [default: that of the grid].',
        rich_help_panel=SPECTRUM,
    ),
]
Points = Annotated[int, typer.Option("-n", "--points", help="Points along a side.")]
SeedOption = Annotated[int, typer.Option(min=0, help="Root of all random seeds.")]
Workers = Annotated[
    int | None,
    typer.Option(min=1, help="Processes on this machine [default: one for each core]."),
]
Scheduler = Annotated[
    str | None, typer.Option(help="Address of a Dask scheduler, such as tcp://10.0.0.1:8786.")
]
Json = Annotated[bool, typer.Option("--json", help="Print JSON in SI units, for other programs.")]


def reading_of(
    unit: str | None,
    channel: str | None,
    size: str | None,
    fill: FillingChoice,
    max_missing: float,
    tilt: TiltChoice,
    pixels: PixelsChoice | None,
    blur: str | None,
    tip_radius: str | None,
) -> rl.Reading:
    """How the options say that files are read."""
    from roughline.units import in_si

    return rl.Reading(
        unit,
        channel,
        size,
        fill.value,
        max_missing,
        tilt=tilt.value,
        pixels=pixels.value if pixels else None,
        blur=None if blur is None else in_si("0 m" if blur == "0" else blur, "m", "blur"),
        tip_radius=None if tip_radius is None else _positive(tip_radius, "tip_radius"),
    )


def preparation_of(
    trend: TrendChoice | None,
    crop: str | None,
    low_pass: str | None,
    resample: int | None,
    remove_outliers: bool,
) -> rl.Preparation | None:
    """The preparation that the options describe; None where none is given."""
    from roughline.units import lengths

    given = (trend, crop, low_pass, resample)
    if all(each is None for each in given) and not remove_outliers:
        return None
    return rl.Preparation(
        crop=tuple(lengths(crop, "crop")) if crop is not None else None,
        remove_outliers=remove_outliers,
        trend=trend.value if trend else None,
        low_pass=_positive(low_pass, "low_pass") if low_pass is not None else None,
        points=resample,
    )


def spectrum_of(
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


@contextmanager
def interruptible(kept: str) -> Iterator[None]:
    """End with exit code 130 and a word on what is kept, when interrupted."""
    try:
        yield
    except KeyboardInterrupt:
        end_interrupted(kept)


def end_interrupted(kept: str) -> NoReturn:
    """End with exit code 130 and a word on what is kept."""
    typer.echo(f"interrupted; {kept}", err=True)
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
