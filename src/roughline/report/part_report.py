"""The report on several maps of one part, as HTML and PDF."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from roughline.plot.pixels import show_map, thinned
from roughline.plot.style import PAGE, new_figure, save, styled
from roughline.report.answers import (
    NO_MEAN,
    leading_keys,
    marks,
    quantity,
    written_unit,
)
from roughline.report.contact_figures import write_contact
from roughline.report.contact_report import write_contact_report
from roughline.report.document import write_document
from roughline.report.page import Picture, Section, Table
from roughline.report.part_tables import count_in_words, leading_table, maps_table
from roughline.report.values import written_scale
from roughline.topography.body import Surface
from roughline.units import prefix

if TYPE_CHECKING:
    from roughline.assessment.part import PartAnswer, PartAssessment

_MAPS_ABREAST = 3  # in a table
_HEIGHTS_ABREAST = 4  # maps of heights in a row
_LOG_FROM = 5.0  # largest over smallest from which on an axis is logarithmic
_LONGEST_NAME = 18  # letters of a name under an axis
_NAME_BEGINNING = 4  # of them from its beginning
_AXIS_LABEL_WIDTH = 22  # letters of a line beside an axis
_MOST_ANSWERS_IN_PAIRS = 6  # more stand three abreast, so that the figure fits a sheet
_MOST_NAMED = 12  # maps whose names fit under an axis
_MOST_HEIGHTS = 16  # maps whose heights are drawn, so that the figure fits a sheet


def write_part_report(part: PartAssessment, folder: Path, how_to_repeat: str) -> list[Path]:
    """Write ``report.html``, ``report.pdf``, figures, and each map's report in a folder of its own.

    The maps need the fields of one load. `how_to_repeat` is the command, or the lines of Python,
    that give the same report.

    Raises
    ------
    StoreError
        If the folder cannot be written.
    """
    written = []
    for of_map, each in zip(_folders(part, folder), part.assessments, strict=True):
        written.append(write_contact_report(each, of_map, how_to_repeat)[0])
    figures = _figures(part, folder)
    title, own = (
        f"Contact of a part, {count_in_words(part)}",
        _map_sections(part, figures[0], figures[2]),
    )
    document = write_document(part, folder, title, own, [how_to_repeat])
    return [*document, *figures, *written]


def write_part(part: PartAssessment, folder: Path) -> list[Path]:
    """Write figures of the part, and each map's curve and figures in a folder of its own.

    Raises
    ------
    StoreError
        If the folder cannot be written.
    """
    written = []
    for of_map, each in zip(_folders(part, folder), part.assessments, strict=True):
        written += write_contact(each, of_map)
    return [*_figures(part, folder), *written]


def _folders(part: PartAssessment, folder: Path) -> list[Path]:
    """A folder for each map, with its number and its name."""
    return [folder / f"map-{i:02d}-{Path(name).stem}" for i, name in enumerate(part.names, 1)]


def _figures(part: PartAssessment, folder: Path) -> list[Path]:
    """Draw the answers and the heights of all maps, each as PNG and PDF."""
    with styled():
        return [
            *save(answers_figure(part), folder, "answers"),
            *save(heights_figure(part), folder, "maps"),
        ]


def _map_sections(part: PartAssessment, answers: Path, heights: Path) -> list[Section]:
    """What the maps are, and what each of them gives."""
    loads, maps = range(len(part.headings)), range(len(part.names))
    of_maps = [
        _each_map_table(part, load, maps[i : i + _MAPS_ABREAST])
        for load in loads
        for i in maps[::_MAPS_ABREAST]
    ]
    return [
        Section(
            "The maps",
            tables=[
                Table.with_numbers(*maps_table(part)),
                Table.with_numbers(*leading_table(part)),
            ],
            pictures=[
                Picture(answers, "Answers", _caption_of_answers(part)),
                Picture(heights, "Heights", _caption_of_heights(part)),
            ],
        ),
        Section(
            "Each map",
            [
                "Values and intervals of each map alone; its own report lies in a folder beside "
                "this page."
            ],
            tables=[Table.with_numbers(*each) for each in of_maps],
            behind="values and intervals of each map alone",
        ),
    ]


def _caption_of_answers(part: PartAssessment) -> str:
    text = f"Answers at {part.headings[part.largest]} of each map, with its own interval"
    return f"{text}; red: their mean, and its interval over the places of the part."


def _caption_of_heights(part: PartAssessment) -> str:
    which = (
        "Each map" if len(part.names) <= _MOST_HEIGHTS else f"The first {_MOST_HEIGHTS} maps, each"
    )
    return f"{which} about its mean, in the same colours."


def _each_map_table(
    part: PartAssessment, load: int, maps: Sequence[int]
) -> tuple[list[str], list[list[str]]]:
    """Return header and rows of all answers of some of the maps, at one load.

    A star after a map's name marks that the grid decides on its values.
    """
    stars = [marks(each)[load] for each in part.assessments]
    header = [part.headings[load], *(f"{part.names[i]}{stars[i]}" for i in maps)]
    keys = part.assessments[0].answers
    rows = []
    for key, first in keys.items():
        found = [part.assessments[i].answers.get(key) for i in maps]
        cells = [NO_MEAN if each is None else quantity(each, load) for each in found]
        rows.append([f"{first.name} {first.symbol}", *cells])
    return header, rows


def answers_figure(part: PartAssessment) -> Figure:
    """Leading answers of each map with their intervals, their mean and the part's interval."""
    keys = leading_keys(part)
    abreast = 2 if len(keys) <= _MOST_ANSWERS_IN_PAIRS else 3
    rows = math.ceil(len(keys) / abreast)
    figure = new_figure(PAGE, 2.4 * max(rows, 1))
    if not keys:
        return figure
    panels = np.atleast_1d(figure.subplots(rows, abreast)).ravel()
    for axes, key in zip(panels, keys, strict=False):
        _draw_answer(axes, part.answers[key], part)
    for empty in panels[len(keys) :]:
        empty.set_axis_off()
    return figure


def heights_figure(part: PartAssessment) -> Figure:
    """Heights of the maps, each about its mean, in the same colours; of scans, lines."""
    bodies = [each.body for each in part.assessments[:_MOST_HEIGHTS]]
    rows = math.ceil(len(bodies) / _HEIGHTS_ABREAST)
    figure = new_figure(PAGE, 1.85 * rows + 0.75)
    panels = np.atleast_1d(figure.subplots(rows, _HEIGHTS_ABREAST)).ravel()
    spread = 4 * max(body.rms_height for body in bodies)
    factor, unit = prefix(spread, "m", 3)
    image = None
    for axes, body, name in zip(panels, bodies, part.names, strict=False):
        axes.set_title(_short(name), fontsize=8)
        axes.tick_params(labelsize=8)
        heights = (body.heights - body.heights.mean()) * factor
        if isinstance(body, Surface):
            size, sides = prefix(max(body.sizes), "m", 3)
            image = show_map(
                axes,
                thinned(heights),
                (body.sizes[0] * size, body.sizes[1] * size),
                cmap="cividis",
                vmin=-spread * factor,
                vmax=spread * factor,
            )
        else:
            size, sides = prefix(body.length, "m", 3)
            x = (np.arange(heights.size) + 0.5) * body.spacing * size
            axes.plot(x, heights, color="k", linewidth=0.5)
        axes.set_xlabel(f"x [{sides}]", fontsize=8)
    for axes in panels[len(bodies) :]:
        axes.set_axis_off()
    if image is not None:
        bar = figure.colorbar(
            image, ax=panels, orientation="horizontal", shrink=0.5, aspect=40, extend="both"
        )
        bar.set_label(f"height [{unit}]", fontsize=8)
        bar.ax.tick_params(labelsize=8)
    return figure


def _draw_answer(axes: Axes, answer: PartAnswer, part: PartAssessment) -> None:
    """One answer of each map at the largest load, its mean, and the interval of the part."""
    load = part.largest
    values = np.array([each.values[load] for each in answer.of_maps])
    factor, unit = written_scale(float(np.nanmax(values)), written_unit(answer))
    places = np.arange(1, values.size + 1)
    low, high = (end * factor for end in answer.ends_of_maps(load))
    axes.vlines(places, low, high, color="0.35", linewidth=1.0)
    axes.plot(places, values * factor, "o", color="k")
    if np.isfinite(answer.mean[load]):
        axes.axhline(answer.mean[load] * factor, color="tab:red", linewidth=1.0)
    interval = np.array([answer.low[load], answer.high[load]]) * factor
    if np.isfinite(interval).all():
        axes.axhspan(*interval, color="tab:red", alpha=0.12, linewidth=0)
    known = np.concatenate([low, high, interval])
    known = known[np.isfinite(known) & (known > 0)]
    if known.size and known.max() > _LOG_FROM * known.min():
        axes.set_yscale("log")
        decades = math.log10(known.max() / known.min())
        axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if decades < 2 else (1.0,)))
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axes.yaxis.set_minor_formatter(NullFormatter())
    if values.size <= _MOST_NAMED:
        axes.set_xticks(places, list(map(_short, part.names)), rotation=30, ha="right", fontsize=8)
    else:
        axes.set_xlabel("number of the map")
    axes.set_xlim(0.5, values.size + 0.5)
    name = textwrap.fill(answer.name, _AXIS_LABEL_WIDTH)
    axes.set_ylabel(name + (f"\n[{unit.strip()}]" if unit else ""), fontsize=8)


def _short(name: str) -> str:
    """A name that fits under an axis; maps of a part mostly differ in the end of their names."""
    short = (
        name
        if len(name) <= _LONGEST_NAME
        else f"{name[:_NAME_BEGINNING]}…{name[_NAME_BEGINNING + 1 - _LONGEST_NAME :]}"
    )
    return short.replace("$", r"\$")  # which would begin a formula
