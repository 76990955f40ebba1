"""A topography file, described."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughline.body_file import write
from roughline.characterisation import Roughness, roughness
from roughline.preparation import Preparation, prepared
from roughline.quantities import engineering
from roughline.report.folder import make_folder
from roughline.report.pressed_figures import roughness_figure
from roughline.report.source import Source, notes_on_body
from roughline.report.style import save, styled
from roughline.topography import Body, Surface


@dataclass(frozen=True, eq=False)
class Described:
    """What is known of a file.

    Attributes
    ----------
    source : Source
        The file.
    body : Surface or Line
        Prepared, in metres.
    roughness : Roughness
        Its parameters.
    notes : list of str
        What was filled, what is suspicious.
    files : list of Path
        What was written.
    """

    source: Source
    body: Body
    roughness: Roughness
    notes: list[str]
    files: list[Path]


def describe_file(source: Source, preparation: Preparation | None, out: Path | None) -> Described:
    """Read a file, prepare it, and describe it.

    Parameters
    ----------
    source : Source
        The topography.
    preparation : Preparation or None
        Default: the tilt of measured topographies is removed.
    out : Path or None
        Folder for a figure and the prepared body; None writes nothing.

    Raises
    ------
    InputError
        If the file cannot be used, or holds a reduced line.
    """
    body = prepared(source.read(), preparation)
    found = roughness(body)
    files: list[Path] = []
    if out is not None:
        make_folder(out)
        with styled():
            files += save(roughness_figure(body, found), out, "roughness")
        write(body, out / "prepared.nc")
        files.append(out / "prepared.nc")
    return Described(source, body, found, notes_on_body(body), files)


def described_table(described: Described) -> list[tuple[str, str]]:
    """Return names and values of what is known, in SI units."""
    body, found, fit = described.body, described.roughness, described.roughness.fit
    of_surface = isinstance(body, Surface)
    letter = "S" if of_surface else "R"
    rows = [
        ("file", f"{described.source.file.name}, {body.settings.get('channel', 'own format')}"),
        ("points", " x ".join(map(str, body.heights.shape))),
        ("unit in the file", str(body.settings.get("file_unit", body.unit or "none"))),
    ]
    if isinstance(body, Surface):
        rows += [
            ("sizes", " x ".join(engineering(size, "m") for size in body.sizes)),
            ("pixel", " x ".join(engineering(size, "m") for size in body.spacing)),
        ]
    else:
        rows += [
            ("length", engineering(body.length, "m")),
            ("spacing", engineering(body.spacing, "m")),
        ]
    missing = body.settings.get("missing_points", 0)
    rows += [
        ("missing points", f"{missing} ({float(body.settings.get('missing_share', 0)):.2%})"),
        (f"{letter}q, rms height", engineering(found.rms_height, "m")),
        (f"{letter}dq, rms slope", f"{found.rms_slope:.4g}"),
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


def _number(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.3g}"
