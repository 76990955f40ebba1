"""The report that a client receives: one page, as HTML and PDF, from a pressed file."""

from __future__ import annotations

from datetime import date
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from roughline._version import __version__
from roughline.assessment.pressed import Pressed
from roughline.report.contact_figures import (
    draw_area,
    draw_contact,
    draw_filled,
    draw_heights,
    draw_partial_slip,
    draw_spectrum,
    draw_stiffness,
    write_pressed,
)
from roughline.report.contact_tables import (
    UNRESOLVED,
    answer_table,
    formula_table,
    quantity,
    star_is_shown,
)
from roughline.report.page import Picture, Section, Table, render
from roughline.report.pdf import write_pdf
from roughline.report.style import PAGE, new_figure, save, styled
from roughline.spectra.roughness import Roughness, roughness
from roughline.topography.body import Body, Line, Surface
from roughline.units import engineering

_LEADING = ("k", "A/A_0", "R", "h_c")  # symbols of the answers that the page begins with
_ABREAST = 4  # loads that fit beside each other on a page

ASSUMPTIONS = (
    "Linear elastic half-spaces, small slopes, no friction in the normal problem, no adhesion, "
    "static loads.",
    "Heights as measured: the filter, the probe and the grid decide the finest waves, and with "
    "them the real contact area; stiffness and conductance depend on them less.",
    "Intervals, where given, are those of the grid and of filled points, or of what a line scan "
    "leaves open; those of k_i, h_c and |R| of a map hold the surface behind it as well. The "
    "scatter of material data, and for all other answers that of other places on the part, comes "
    "on top.",
)


def write_report(
    pressed: Pressed, folder: Path, command: str, friction: float | None = None
) -> list[Path]:
    """Write ``report.html``, ``report.pdf``, ``curve.nc`` and the figures.

    Parameters
    ----------
    pressed : Pressed
        With answers for two materials.
    folder : Path
        Made if it does not exist.
    command : str
        The command that does it again.
    friction : float, optional
        Coefficient of friction; adds the curve of partial slip at the largest load. [1]

    Raises
    ------
    StoreError
        If the folder cannot be written.
    """
    files = write_pressed(pressed, folder)
    described = None
    body = pressed.body
    if isinstance(body, Surface) or body.kind == "profile":
        described = roughness(body)
    with styled():
        overview = save(_overview(pressed, described, friction), folder, "overview")
    title, lead = f"Contact of {pressed.source.file.name}", _lead(pressed)
    made = f"Computed on {date.today().isoformat()} with roughline {__version__}."
    sections = _sections(pressed, described, overview[0], command)
    page = folder / "report.html"
    page.write_text(render(title, lead, sections, made), encoding="utf-8")
    write_pdf(folder / "report.pdf", title, lead, sections, made)
    return [page, folder / "report.pdf", *files, *overview]


def settings_of(pressed: Pressed) -> dict[str, Any]:
    """Everything that the numbers depend on, by name."""
    return {
        "roughline_version": __version__,
        "E_star": pressed.curve.E_star,
        **pressed.curve.settings,
    }


def _lead(pressed: Pressed) -> str:
    """The answers at the largest load, by the names that they have in the table."""
    pair, curve = pressed.pair, pressed.at_asked
    assert pair is not None
    largest = int(np.argmax(pressed.asked))
    shown = {each.symbol: quantity(each, largest) for each in pressed.answers}
    names = {each.symbol: each.name for each in pressed.answers}
    found = [f"{names[symbol]} {shown[symbol]}" for symbol in _LEADING if symbol in shown]
    unsure = curve.converged[largest] and not curve.resolved[largest]
    return _sentence(
        f"{pair.first.name} on {pair.second.name} under {shown['F']}, {shown['p']} over the "
        f"nominal area: {', '.join(found)}" + (f" ({UNRESOLVED})" if unsure else "")
    )


def _overview(pressed: Pressed, described: Roughness | None, friction: float | None) -> Any:
    figure = new_figure(PAGE, 4.6)
    panels = figure.subplots(2, 2 if friction is None else 3).ravel()
    draw_heights(panels[0], pressed.body)
    draw_filled(panels[0], pressed)
    remaining = list(panels[1:])
    if described is not None:
        draw_spectrum(remaining.pop(0), described)
    draw_stiffness(remaining.pop(0), pressed)
    if isinstance(pressed.body, Surface):
        if pressed.theories or friction is not None:
            draw_area(remaining.pop(0), pressed)
        if remaining:
            draw_contact(remaining.pop(0), pressed.body, pressed.curve)
    if friction is not None and remaining:
        draw_partial_slip(remaining.pop(0), pressed, friction)
    for empty in remaining:
        empty.set_axis_off()
    return figure


def _sections(
    pressed: Pressed, described: Roughness | None, overview: Path, command: str
) -> list[Section]:
    pair = pressed.pair
    assert pair is not None
    settings = "; ".join(f"{key} = {_shown(value)}" for key, value in settings_of(pressed).items())
    legend = [f"A star behind a load: {UNRESOLVED}."] if star_is_shown(pressed) else []
    return [
        Section(
            "Answers",
            [f"Materials: {_material(pair.first)}; {_material(pair.second)}."],
            notes=[*legend, *map(_sentence, pressed.notes)],
            tables=[
                Table(header, rows, numbers=range(1, len(header)))
                for header, rows in map(partial(answer_table, pressed), _abreast(pressed))
            ],
        ),
        Section(
            "Surface",
            [_surface(pressed, described)],
            pictures=[Picture(overview, "Overview", _caption(pressed))],
        ),
        Section("Where the answers are from", tables=[Table(*formula_table(pressed))]),
        Section(
            "Assumptions",
            [
                *ASSUMPTIONS,
                *(f"{theory.name}: {theory.validity}." for theory in pressed.theories),
            ],
        ),
        Section("To do it again", [command, settings]),
    ]


def _abreast(pressed: Pressed) -> list[slice]:
    """Loads that stand beside each other in a table."""
    return [slice(i, i + _ABREAST) for i in range(0, pressed.asked.size, _ABREAST)]


def _caption(pressed: Pressed) -> str:
    marked = any(marks is not None for marks in pressed.filled)
    return (
        "Heights"
        + (" (red: filled points)" if marked else "")
        + ", spectrum with the nearest self-affine law, stiffness over force (open marks: fewer "
        "than ten points in contact)"
        + (", and theories for the same spectrum" if pressed.theories else "")
        + (
            ", and the points in contact at the largest load; their area is corrected for the "
            "outline's steps, as in the table"
            if isinstance(pressed.body, Surface)
            else ""
        )
        + "."
    )


def _shown(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _material(material: Any) -> str:
    parts = [f"E = {engineering(material.E, 'Pa')}", f"nu = {material.nu:g}"]
    if material.hardness:
        parts.append(f"H = {engineering(material.hardness, 'Pa')}")
    return f"{material.name} ({', '.join(parts)}; {material.source})"


def _surface(pressed: Pressed, described: Roughness | None) -> str:
    body = pressed.body
    if isinstance(body, Line):
        what = f"{body.heights.size} points over {engineering(body.length, 'm')}"
    else:
        sides = " x ".join(engineering(size, "m") for size in body.sizes)
        what = f"{body.shape[0]} x {body.shape[1]} points on {sides}"
    if len(pressed.parts) == 1:
        done = f"Preparation: {_preparation(body)}."
    else:
        first, second = map(_preparation, pressed.parts)
        done = f"Preparation of the first body: {first}; of the second: {second}."
        what += ", two bodies together" if isinstance(body, Surface) else ", the first of two"
    text = (
        f"{what}; rms height {engineering(body.rms_height, 'm')}, rms slope {body.rms_slope:.3g}. "
        f"{done}"
    )
    if described is not None and described.fit is not None:
        low, high = described.fit.hurst_interval
        text += f" Hurst exponent {described.fit.hurst:.2f} ({low:.2f} to {high:.2f})."
    if described is not None and described.remarks:
        text += " " + " ".join(_sentence(remark) for remark in described.remarks)
    return text


def _preparation(body: Body) -> str:
    steps = (
        "cropped",
        "outliers_removed",
        "detrended",
        "low_pass",
        "resampled",
        "resampled_to",
        "filled",
    )
    done = [
        f"{name.replace('_', ' ')}: {body.settings[name]}"
        for name in steps
        if name in body.settings
    ]
    return ", ".join(done) or "none"


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:] + ("" if text.endswith(".") else ".")
