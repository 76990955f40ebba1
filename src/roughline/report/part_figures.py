"""Figures of several maps of a part: their answers beside each other, and their heights."""

from __future__ import annotations

import math
import textwrap
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from roughline.plot.pixels import thinned
from roughline.plot.style import PAGE, new_figure
from roughline.report.answers import leading_keys, unit_shown
from roughline.report.values import scale_of
from roughline.topography.body import Surface
from roughline.units import prefix

if TYPE_CHECKING:
    from roughline.assessment.part import PartAnswer, PartAssessment

_ABREAST = 4  # maps of heights in a row
_LOG_FROM = 5.0  # largest over smallest from which on an axis is logarithmic
_LONGEST, _BEGIN = 18, 4  # letters of a name under an axis, and of them from its beginning
_BROAD = 22  # letters of a line beside an axis
_MOST_NAMED = 12  # maps whose names fit under an axis

MOST_HEIGHTS = 16
"""Maps whose heights are drawn, so that the figure fits a sheet."""


def answers_figure(part: PartAssessment) -> Figure:
    """Leading answers of each map with their intervals, their mean and the part's interval."""
    keys = leading_keys(part)
    rows = math.ceil(len(keys) / 2)
    figure = new_figure(PAGE, 2.4 * max(rows, 1))
    if not keys:
        return figure
    panels = np.atleast_1d(figure.subplots(rows, 2)).ravel()
    for axes, key in zip(panels, keys, strict=False):
        _draw_answer(axes, part.answers[key], part)
    for empty in panels[len(keys) :]:
        empty.set_axis_off()
    return figure


def heights_figure(part: PartAssessment) -> Figure:
    """Heights of the maps, each about its mean, in the same colours; of scans, lines."""
    bodies = [each.body for each in part.assessments[:MOST_HEIGHTS]]
    rows = math.ceil(len(bodies) / _ABREAST)
    figure = new_figure(PAGE, 1.85 * rows + 0.75)
    panels = np.atleast_1d(figure.subplots(rows, _ABREAST)).ravel()
    spread = 4 * max(body.rms_height for body in bodies)
    factor, unit = prefix(spread, "m", 3)
    shown = None
    for axes, body, name in zip(panels, bodies, part.names, strict=False):
        axes.set_title(_short(name), fontsize=8)
        axes.tick_params(labelsize=8)
        heights = (body.heights - body.heights.mean()) * factor
        if isinstance(body, Surface):
            size, sides = prefix(max(body.sizes), "m", 3)
            extent = (0.0, body.sizes[0] * size, 0.0, body.sizes[1] * size)
            shown = axes.imshow(
                thinned(heights).T,
                origin="lower",
                extent=extent,
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
    if shown is not None:
        bar = figure.colorbar(
            shown, ax=panels, orientation="horizontal", shrink=0.5, aspect=40, extend="both"
        )
        bar.set_label(f"height [{unit}]", fontsize=8)
        bar.ax.tick_params(labelsize=8)
    return figure


def _draw_answer(axes: Axes, answer: PartAnswer, part: PartAssessment) -> None:
    """One answer of each map at the largest load, its mean, and the interval of the part."""
    load = part.largest
    values = np.array([each.values[load] for each in answer.of_maps])
    factor, unit = scale_of(float(np.nanmax(values)), unit_shown(answer))
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
    name = textwrap.fill(answer.name, _BROAD)
    axes.set_ylabel(name + (f"\n[{unit.strip()}]" if unit else ""), fontsize=8)


def _short(name: str) -> str:
    """A name that fits under an axis; maps of a part mostly differ in the end of their names."""
    return name if len(name) <= _LONGEST else f"{name[:_BEGIN]}…{name[_BEGIN + 1 - _LONGEST :]}"
