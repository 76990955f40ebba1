"""The description of a topography as a table, and on the terminal with a map of what is missing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from rich.console import Console

from roughline.question.assumptions import broken
from roughline.report.terminal import print_files, print_remarks, print_rows
from roughline.report.texture_table import standard_title, texture_rows
from roughline.report.values import Write, figure, with_interval
from roughline.topography.body import Surface, point_spacings, side_lengths
from roughline.units import engineering, metres_per

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

    from roughline.measurement.departures import Departure
    from roughline.measurement.fit import SelfAffineFit
    from roughline.measurement.roughness import Roughness
    from roughline.question.description import Description

_MAPPED_FROM = 0.01  # share of missing points from which on a coarse map shows more than words
_SHADES = ".+#"

_NO_VERDICT = "not judged"


def description_table(
    description: Description, write: Write = with_interval
) -> list[tuple[str, str]]:
    """Return names and values of what is known, in SI units where the file states its unit."""
    rows = _rows_of_file(description)
    body = description.body
    if body is not None:
        letter = "S" if isinstance(body, Surface) else "R"
        rows += [
            (f"{letter}q, rms height", write(body.rms_height, None, "m")),
            (f"{letter}dq, rms slope", write(body.rms_slope, None, "1")),
        ]
        if description.roughness is not None:
            rows += _rows_of_roughness(description.roughness, letter, broken("fit", body), write)
    return rows


def print_description(description: Description, files: Iterable[Path] = ()) -> None:
    """Print what a topography is like."""
    console = Console(markup=False)
    of_roughness = [] if description.roughness is None else description.roughness.remarks
    print_remarks(console, "warning", [*description.warnings, *of_roughness])
    print_rows(console, description_table(description))
    for line in _missing_map(description):
        console.print(line, highlight=False, soft_wrap=True)
    for obstacle in description.obstacles:
        console.print(f"it cannot be pressed as it is: {obstacle}", highlight=False, soft_wrap=True)
    if description.texture is not None:
        console.print(f"\n{standard_title(description.texture)}", highlight=False)
        print_rows(console, texture_rows(description.texture))
        print_remarks(console, "note", description.texture.remarks)
    print_remarks(console, "note", description.notes)
    print_files(files)


def _missing_map(description: Description) -> list[str]:
    """Return a coarse map of the missing points in characters; empty if there are few."""
    missing = description.missing
    if missing.share < _MAPPED_FROM:
        return []
    rows = np.atleast_2d(missing.cells.T)
    shades = np.where(rows == 0, 0, np.where(rows <= 0.5, 1, 2))
    return [
        "missing points, x to the right"
        + (" and y downwards:" if missing.cells.ndim == 2 else ":"),
        *("  " + "".join(_SHADES[shade] for shade in row) for row in shades),
        f"  {_SHADES[0]} none, {_SHADES[1]} up to half, {_SHADES[2]} more than half of a piece",
    ]


def _rows_of_file(description: Description) -> list[tuple[str, str]]:
    """What the file holds, and of the body its points and sizes."""
    content, body, missing = description.measurement, description.body, description.missing
    channel = "own format" if content.by_roughline else content.channel
    rows = [
        ("file", ", ".join(filter(None, (content.file, channel)))),
        ("read by", ", as ".join(filter(None, (content.read_by, content.format)))),
    ]
    if len(content.channels) > 1:
        rows.append(("channels", ", ".join(content.channels)))
    points = content.heights.shape if body is None else body.heights.shape
    stated = content.unit or "none stated"
    if content.unit_of_sides:
        stated = f"{content.unit_of_sides}, and none of heights stated"
    if not content.unit and description.unit:
        stated += f"; {description.unit} is given"
    rows += [("points", _times(points)), ("unit in the file", stated), *_rows_of_sizes(description)]
    if points != content.heights.shape:
        rows.append(("points in the file", _times(content.heights.shape)))
    where = f", {missing}" if missing.count else ""
    return [*rows, ("missing points", f"{missing.count} ({missing.share:.2%}){where}")]


def _rows_of_sizes(description: Description) -> list[tuple[str, str]]:
    """Sides and the distance of points: of the body, or else as far as the file says."""
    content, body = description.measurement, description.body
    names = ("sizes", "pixel") if content.kind == "surface" else ("length", "spacing")
    sizes: tuple[float, ...]
    spacings: tuple[float, ...]
    if body is not None:
        sizes, spacings = side_lengths(body), point_spacings(body)
    elif content.sizes is None:
        return [(names[0], "none stated")]
    else:
        unit = content.unit or content.unit_of_sides
        metres = metres_per(unit) if unit else 1.0
        sizes = tuple(metres * size for size in content.sizes)
        spacings = tuple(
            size / points for size, points in zip(sizes, content.heights.shape, strict=True)
        )
    if body is None and not (content.unit or content.unit_of_sides):
        return [
            (name, f"{' x '.join(f'{length:.4g}' for length in lengths)}, unit not stated")
            for name, lengths in zip(names, (sizes, spacings), strict=True)
        ]
    return [
        (name, " x ".join(engineering(length, "m") for length in lengths))
        for name, lengths in zip(names, (sizes, spacings), strict=True)
    ]


def _rows_of_roughness(
    parameters: Roughness, letter: str, departures: Sequence[Departure], write: Write
) -> list[tuple[str, str]]:
    fit = parameters.fit
    rows = [
        (f"{letter}sk, skewness", _number(parameters.skewness)),
        (f"{letter}ku, kurtosis", _number(parameters.kurtosis)),
        (
            "summits",
            f"{parameters.summits}, skewness of heights {_number(parameters.summit_skewness)}",
        ),
    ]
    if parameters.isotropy is not None:
        rows.append(
            ("slope, least over largest", f"{_number(parameters.isotropy)} over all directions")
        )
    if fit is not None and not fit.objections:
        low, high = fit.rms_interval
        rows += [
            (
                "Sq of such surfaces",
                f"{write(low, None, 'm')} to {write(high, None, 'm')}"
                if fit.is_judged
                else _NO_VERDICT,
            ),
            ("Hurst exponent", fit.hurst_in_words),
            ("fractal dimension", f"{3 - fit.hurst:.2f}"),
            ("roll-off wavelength", _wavelength(fit.q_roll, fit.q_roll_interval, "none")),
            ("cutoff wavelength", _wavelength(fit.q_high, fit.q_high_interval, "the grid's")),
            ("blur of the instrument", _blur(fit)),
        ]
    if fit is not None:
        rows.append(("self-affine", _verdict(fit, departures)))
    return rows


def _verdict(fit: SelfAffineFit, departures: Sequence[Departure]) -> str:
    """Say whether a self-affine law describes a topography, or what forbids to say so."""
    if fit.objections:
        return f"no: {'; '.join(fit.objections)}"
    if departures:
        return f"not known: {departures[0].text}"
    return "yes"


def _blur(fit: SelfAffineFit) -> str:
    """What the tail of a spectrum says of the instrument."""
    text = engineering(fit.blur, "m", 3) if fit.blur else "none"
    if not fit.is_judged:
        return f"{text} ({_NO_VERDICT})"
    low, high = (engineering(end, "m", 3) if end else "0" for end in fit.blur_interval)
    return text if low == high else f"{text} ({low} to {high})"


def _wavelength(q: float | None, interval: tuple[float, float], otherwise: str) -> str:
    text = otherwise if q is None else engineering(2 * np.pi / q, "m", 3)
    if np.isnan(interval[0]):
        return f"{text} ({_NO_VERDICT})"
    longest, shortest = (engineering(2 * np.pi / end, "m", 3) if end else "" for end in interval)
    return f"{text} ({shortest} {f'to {longest}' if longest else 'or longer'})"


def _times(points: tuple[int, ...]) -> str:
    return " x ".join(map(str, points))


def _number(value: float) -> str:
    return "-" if np.isnan(value) else figure(value)
