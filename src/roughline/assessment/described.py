"""A topography file, described."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughline.assessment.source import Source, notes_on_body
from roughline.errors import InputError
from roughline.files.measurement import Measurement
from roughline.files.netcdf import write
from roughline.report.folder import make_folder
from roughline.spectra.roughness import Roughness, roughness
from roughline.topography.body import Body, Surface
from roughline.topography.missing import MissingPattern, missing_pattern
from roughline.topography.preparation import Preparation, prepared
from roughline.units import engineering, metres_per

_MAPPED_FROM = 0.01  # share of missing points from which on a coarse map shows more than words
_SHADES = ".+#"


@dataclass(frozen=True, eq=False)
class Described:
    """What is known of a file.

    Attributes
    ----------
    source : Source
        The file.
    measurement : Measurement
        What the file holds.
    missing : MissingPattern
        Where points are missing in the file.
    obstacles : list of str
        Why it cannot be pressed as it is; empty if it can.
    body : Surface or Line or None
        Prepared, in metres; None if there is too little in the file.
    roughness : Roughness or None
        Its parameters; None without a body, and for a reduced line, which is no topography.
    notes : list of str
        What was filled, what is suspicious.
    files : list of Path
        What was written.
    """

    source: Source
    measurement: Measurement
    missing: MissingPattern
    obstacles: list[str]
    body: Body | None
    roughness: Roughness | None
    notes: list[str]
    files: list[Path]


def describe_file(source: Source, preparation: Preparation | None, out: Path | None) -> Described:
    """Read a file, prepare what it holds, and describe it.

    A file that lacks a unit, sizes or too many points is described as far as it goes.

    Parameters
    ----------
    source : Source
        The topography.
    preparation : Preparation or None
        Default: only the tilt of measured topographies is removed.
    out : Path or None
        Folder for figures and the prepared body; None writes nothing.

    Raises
    ------
    InputError
        If the file cannot be read, or what is asked for does not suit it.
    """
    found = source.measurement()
    missing = missing_pattern(found.unknown, found.sizes)
    obstacles = source.obstacles(found)
    files: list[Path] = []
    if out is not None:
        from roughline.report.measured_figures import (
            measured_figure,
        )  # here, as to draw loads slowly
        from roughline.report.style import save, styled

        make_folder(out)
        if missing.count or obstacles:
            with styled():
                files += save(measured_figure(found, missing), out, "file")
    if obstacles:
        return Described(source, found, missing, obstacles, None, None, [], files)
    body = prepared(source.body(found), preparation)
    notes, parameters = notes_on_body(body), None
    try:
        parameters = roughness(body)
    except InputError as error:  # a reduced line is no topography
        notes.append(str(error))
    if out is not None:
        from roughline.report.contact_figures import roughness_figure

        if parameters is not None:
            with styled():
                files += save(roughness_figure(body, parameters), out, "roughness")
        write(body, out / "prepared.nc")
        files.append(out / "prepared.nc")
    return Described(source, found, missing, obstacles, body, parameters, notes, files)


def described_table(described: Described) -> list[tuple[str, str]]:
    """Return names and values of what is known, in SI units where the file states its unit."""
    rows = _rows_of_file(described)
    body = described.body
    if body is not None:
        letter = "S" if isinstance(body, Surface) else "R"
        rows += [
            (f"{letter}q, rms height", engineering(body.rms_height, "m")),
            (f"{letter}dq, rms slope", f"{body.rms_slope:.4g}"),
        ]
        if described.roughness is not None:
            rows += _rows_of_roughness(described.roughness, letter)
    return rows


def missing_map(described: Described) -> list[str]:
    """Return a coarse map of the missing points in characters; empty if there are few."""
    missing = described.missing
    if missing.share < _MAPPED_FROM:
        return []
    rows = np.atleast_2d(missing.cells.T)[::-1]
    shades = np.where(rows == 0, 0, np.where(rows <= 0.5, 1, 2))
    return [
        "missing points, x to the right" + (" and y upwards:" if missing.cells.ndim == 2 else ":"),
        *("  " + "".join(_SHADES[shade] for shade in row) for row in shades),
        f"  {_SHADES[0]} none, {_SHADES[1]} up to half, {_SHADES[2]} more than half of a piece",
    ]


def _rows_of_file(described: Described) -> list[tuple[str, str]]:
    """What the file holds, and of the body its points and sizes."""
    found, body, missing = described.measurement, described.body, described.missing
    channel = "own format" if found.is_own else found.channel
    rows = [("file", ", ".join(filter(None, (described.source.file.name, channel))))]
    if len(found.channels) > 1:
        rows.append(("channels", ", ".join(found.channels)))
    points = found.heights.shape if body is None else body.heights.shape
    stated = found.unit or "none stated"
    if not found.unit and described.source.unit:
        stated += f"; {described.source.unit} is given"
    rows += [("points", _times(points)), ("unit in the file", stated), *_rows_of_sizes(described)]
    if points != found.heights.shape:
        rows.append(("points in the file", _times(found.heights.shape)))
    where = f", {missing}" if missing.count else ""
    return [*rows, ("missing points", f"{missing.count} ({missing.share:.2%}){where}")]


def _rows_of_sizes(described: Described) -> list[tuple[str, str]]:
    """Sides and the distance of points: of the body, or else as far as the file says."""
    found, body = described.measurement, described.body
    names = ("sizes", "pixel") if found.kind == "surface" else ("length", "spacing")
    sizes: tuple[float, ...]
    spacings: tuple[float, ...]
    if isinstance(body, Surface):
        sizes, spacings = body.sizes, body.spacing
    elif body is not None:
        sizes, spacings = (body.length,), (body.spacing,)
    elif found.sizes is None:
        return [(names[0], "none stated")]
    else:
        metres = metres_per(found.unit) if found.unit else 1.0
        sizes = tuple(metres * size for size in found.sizes)
        spacings = tuple(
            size / points for size, points in zip(sizes, found.heights.shape, strict=True)
        )
    if body is None and not found.unit:
        return [
            (name, f"{' x '.join(f'{length:.4g}' for length in lengths)}, unit not stated")
            for name, lengths in zip(names, (sizes, spacings), strict=True)
        ]
    return [
        (name, " x ".join(engineering(length, "m") for length in lengths))
        for name, lengths in zip(names, (sizes, spacings), strict=True)
    ]


def _rows_of_roughness(found: Roughness, letter: str) -> list[tuple[str, str]]:
    fit = found.fit
    rows = [
        (f"{letter}sk, skewness", _number(found.skewness)),
        (f"{letter}ku, kurtosis", _number(found.kurtosis)),
        ("summits", f"{found.summits}, skewness of heights {_number(found.summit_skewness)}"),
    ]
    if found.isotropy is not None:
        rows.append(("slope, least over most", f"{_number(found.isotropy)} over all directions"))
    if fit is not None:
        low, high = fit.rms_interval
        rows += [
            ("Sq of such surfaces", f"{engineering(low, 'm')} to {engineering(high, 'm')}"),
            ("Hurst exponent", f"{fit.hurst:.2f} ({_span(fit.hurst_interval)})"),
            ("fractal dimension", f"{3 - fit.hurst:.2f}"),
            ("roll-off wavelength", _wavelength(fit.q_roll, fit.q_roll_interval, "none")),
            ("cutoff wavelength", _wavelength(fit.q_high, fit.q_high_interval, "the grid's")),
            (
                "self-affine",
                "yes" if not fit.objections else f"no: {'; '.join(fit.objections)}",
            ),
        ]
    return rows


def _wavelength(q: float | None, interval: tuple[float, float], otherwise: str) -> str:
    longest, shortest = (engineering(2 * np.pi / end, "m", 3) if end else "" for end in interval)
    shown = otherwise if q is None else engineering(2 * np.pi / q, "m", 3)
    return f"{shown} ({shortest} {f'to {longest}' if longest else 'or longer'})"


def _span(interval: tuple[float, float]) -> str:
    return f"{interval[0]:.2f} to {interval[1]:.2f}"


def _times(points: tuple[int, ...]) -> str:
    return " x ".join(map(str, points))


def _number(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.3g}"
