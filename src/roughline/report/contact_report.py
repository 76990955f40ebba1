"""The report for a client, as HTML and PDF, from an assessment."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from roughline.plot.style import save, styled
from roughline.report.contact_figures import overview, overview_in_words, write_contact
from roughline.report.document import write_document
from roughline.report.fields_of_load import write_fields
from roughline.report.page import Picture, Section, Table, sentence
from roughline.report.texture_table import (
    causes_in_words,
    filters_in_words,
    standard_title,
    texture_table,
)
from roughline.topography.body import Body, Line, Surface, side_lengths
from roughline.units import engineering

if TYPE_CHECKING:
    from roughline.assessment.assessment import Assessment

_POINT_RANGE = re.compile(r"(?:([xy]) )?(\d+):(\d+)")

_LOW_PASS_KEPT = "low_pass_kept"  # setting: points that a low pass left of a piece

_STEPS = (
    "cropped",
    "lines_levelled",
    "scars_removed",
    "outliers_removed",
    "detrended",
    "low_pass",
    "resampled",
    "resampled_to",
    "filled",
)
"""Settings of a body that record its preparation, in the order in which they are told."""


def write_contact_report(assessment: Assessment, folder: Path, how_to_repeat: str) -> list[Path]:
    """Write ``report.html``, ``report.pdf``, ``curve.nc`` and the figures, of two materials.

    `how_to_repeat` is the command, or the lines of Python, that give the same report.

    Raises
    ------
    StoreError
        If the folder cannot be written.
    """
    files = write_contact(assessment, folder)
    with styled():
        drawn = save(overview(assessment), folder, "overview")
        of_fields, drawn_fields = write_fields(assessment, folder)
    pictures = [Picture(drawn[0], "Overview", overview_in_words(assessment))]
    surface = Section("Surface", [_surface(assessment)], pictures=pictures)
    title = f"Contact of {assessment.question.name}"
    repeat = [how_to_repeat, settings_in_words(assessment)]
    own = [surface, *_texture(assessment), *of_fields]
    document = write_document(assessment, folder, title, own, repeat)
    return [*document, *files, *drawn, *drawn_fields]


def settings_in_words(assessment: Assessment) -> str:
    """Settings of the run; those of the preparation are told with the surface."""
    return "; ".join(
        f"{key} = {_written(value)}"
        for key, value in assessment.settings.items()
        if key.removeprefix("body_") not in _STEPS
    )


def _written(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _surface(assessment: Assessment) -> str:
    body, parameters = assessment.body, assessment.roughness
    if isinstance(body, Line):
        what = f"{body.heights.size} points over {engineering(body.length, 'm')}"
    else:
        sides = " x ".join(engineering(size, "m") for size in body.sizes)
        what = f"{body.shape[0]} x {body.shape[1]} points on {sides}"
    if len(assessment.topographies) == 1:
        done = f"Preparation: {_preparation(body)}."
    else:
        first, second = (_preparation(part.body) for part in assessment.topographies)
        done = f"Preparation of the first body: {first}; of the second: {second}."
        what += ", two bodies together" if isinstance(body, Surface) else ", the first of two"
    text = (
        f"{what}; rms height {engineering(body.rms_height, 'm')}, rms slope {body.rms_slope:.3g}. "
        f"{done}"
    )
    if parameters is not None and (fit := parameters.fit) is not None and not fit.objections:
        text += f" Hurst exponent {fit.hurst_in_words}."
    if parameters is not None and parameters.remarks:
        text += " " + " ".join(sentence(remark) for remark in parameters.remarks)
    return text


def _texture(assessment: Assessment) -> list[Section]:
    """The trade's parameters of what was pressed; none of a reduced line."""
    found = assessment.texture
    if found is None:
        return []
    words = [f"{standard_title(found)}; filters: {filters_in_words(found)}", *found.remarks]
    return [
        Section(
            "Surface texture",
            [" ".join(map(sentence, [*words, *causes_in_words(found)]))],
            tables=[Table(*texture_table(found), numbers=(1,))],
            behind=f"{standard_title(found).lower().replace('iso', 'ISO')} of what was pressed",
        )
    ]


def _preparation(body: Body) -> str:
    """What was done to a body before it was pressed, with units; "none" if nothing was."""
    settings: Mapping[str, str | int | float] = body.settings
    done = [
        f"{name.replace('_', ' ')}: {_step_in_words(name, body)}"
        for name in _STEPS
        if name in settings
    ]
    return ", ".join(done) or "none"


def _step_in_words(name: str, body: Body) -> str:
    """What one step did, in lengths where it is of lengths."""
    value = body.settings[name]
    if name == "cropped":
        return _crop(str(value), body)
    if name == "low_pass":
        text = f"waves shorter than {engineering(float(value), 'm')} (Gaussian, ISO 16610)"
        return text + (
            ", half of it left out at borders" if _LOW_PASS_KEPT in body.settings else ""
        )
    if name == "resampled_to":
        return f"{value} points"
    return str(value)


def _crop(points: str, body: Body) -> str:
    """The piece that was kept, in lengths from the upper left corner of the whole.

    But for a low pass later steps keep its sides, so points had the distance of side over points.
    """
    counts = _POINT_RANGE.findall(str(body.settings.get(_LOW_PASS_KEPT, points)))
    ranges = []
    for (axis, *ends), (_, *left), side in zip(
        _POINT_RANGE.findall(points), counts, side_lengths(body), strict=True
    ):
        first, end = map(int, ends)
        step = side / (int(left[1]) - int(left[0]))
        low, high = (engineering(each * step, "m") for each in (first, end))
        ranges.append(f"{axis} {low} to {high}".strip())
    return f"{' and '.join(ranges)} (points {points})"
