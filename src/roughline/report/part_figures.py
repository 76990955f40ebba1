"""Figures of several maps of a part: their answers beside each other, and their heights."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughline.assessment.part import PartAnswer, PartAssessment
from roughline.report.contact_figures import draw_heights
from roughline.report.contact_tables import leading_keys
from roughline.report.style import PAGE, new_figure
from roughline.units import prefix

_ABREAST = 5  # maps of heights in a row
_LONGEST = 14  # letters of a name under an axis
_MOST_HEIGHTS = 20  # maps whose heights are drawn


def answers_figure(part: PartAssessment) -> Figure:
    """Leading answers of each map with their intervals, their mean and the part's interval."""
    keys = [key for key in leading_keys(part.assessments[0]) if key in part.answers]
    rows = math.ceil(len(keys) / 2)
    figure = new_figure(PAGE, 2.3 * max(rows, 1))
    if not keys:
        return figure
    panels = np.atleast_1d(figure.subplots(rows, 2)).ravel()
    for axes, key in zip(panels, keys, strict=False):
        _draw_answer(axes, part.answers[key], part)
    for empty in panels[len(keys) :]:
        empty.set_axis_off()
    return figure


def heights_figure(part: PartAssessment) -> Figure:
    """Heights of the maps, each about its mean."""
    bodies = [each.body for each in part.assessments[:_MOST_HEIGHTS]]
    columns = min(_ABREAST, max(2, len(bodies)))
    rows = math.ceil(len(bodies) / columns)
    figure = new_figure(PAGE, 1.7 * rows if columns > 2 else 2.4 * rows)
    panels = np.atleast_1d(figure.subplots(rows, columns)).ravel()
    for axes, body, name in zip(panels, bodies, part.names, strict=False):
        draw_heights(axes, body)
        axes.set_title(name, fontsize=7)
        axes.tick_params(labelsize=6)
    for axes in panels[len(bodies) :]:
        axes.set_axis_off()
    for axes in figure.axes:  # bars of colours are axes too
        axes.tick_params(labelsize=6)
        axes.xaxis.label.set_fontsize(6)
        axes.yaxis.label.set_fontsize(6)
    return figure


def _draw_answer(axes: Axes, answer: PartAnswer, part: PartAssessment) -> None:
    """One answer of each map at the largest load, its mean, and the interval of the part."""
    load = part.largest
    values = np.array([each.values[load] for each in answer.of_maps])
    factor, unit = prefix(float(np.nanmax(values)), answer.unit)
    places = np.arange(1, values.size + 1)
    for place, each in zip(places, answer.of_maps, strict=True):
        if each.low is not None and each.high is not None:
            ends = [each.low[load] * factor, each.high[load] * factor]
            axes.plot([place, place], ends, color="0.35", linewidth=1.0)
    axes.plot(places, values * factor, "o", color="k")
    if np.isfinite(answer.mean[load]):
        axes.axhline(answer.mean[load] * factor, color="tab:red", linewidth=1.0)
    low, high = answer.low[load] * factor, answer.high[load] * factor
    if np.isfinite([low, high]).all():
        axes.axhspan(low, high, color="tab:red", alpha=0.12, linewidth=0)
    axes.set_yscale("log")
    names = [n if len(n) <= _LONGEST else f"{n[: _LONGEST - 1]}…" for n in part.names]
    axes.set_xticks(places, names, rotation=30, ha="right", fontsize=6)
    axes.set_xlim(0.5, values.size + 0.5)
    unit = "" if unit == "1" else f" [{unit}]"
    axes.set_ylabel(f"{answer.name}\n{unit}".strip(), fontsize=7)
