"""The study's figure."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughline.computing.arrays import Real
from roughline.plot.style import MARKERS, PAGE, colours, new_figure
from roughline.statistics.averages import average
from studies.sealing.body import ELASTIC, Case
from studies.sealing.claims import KINDS, SEALING, THEORIES
from studies.sealing.measure import OF_GAPS, Data, mean, theory_of
from studies.sealing.run import COUNTS, HARDNESSES, LEAKING
from studies.sealing.scaling import PERCOLATION, first_and_last, threshold

SHOWN = 0.8
"""Hurst exponent of what is drawn."""
_OF_PERSSON = [name for name, (kind, _) in THEORIES.items() if kind != OF_GAPS]
_DASHES = ("dashed", "dotted", "dashdot")
_AREAS = (0.35, 0.6)
_APERTURES = (0.0, 2.5)  # in rms heights


def sealing_figure(data: Data) -> Figure:
    """Draw the areas at sealing over the size, and the hydraulic aperture over the pressure."""
    figure = new_figure(PAGE, 3.2)
    left, right = figure.subplots(1, 2)
    _draw_areas(left, data)
    _draw_leaks(right, data)
    return figure


def _draw_areas(axes: Axes, data: Data) -> None:
    waves = np.array(list(COUNTS))
    for hardness, colour in zip(HARDNESSES, colours(len(HARDNESSES)), strict=True):
        endless = threshold(data, SHOWN, hardness).value
        areas = [first_and_last(data.sample(n, SHOWN, hardness)) for n in waves]
        for k, marker in zip((0, 1), MARKERS, strict=False):
            found = [mean(each[:, k]) for each in areas]
            value, low, high = np.array([(one.value, one.low, one.high) for one in found]).T
            axes.errorbar(
                waves**-PERCOLATION,
                value,
                (value - low, high - value),
                color=colour,
                marker=marker,
                capsize=2,
                linewidth=0.8,
                label=KINDS[hardness] if k else None,
            )
        axes.plot(0, endless, color=colour, marker="x", clip_on=False)
    for area in (SEALING, 0.5):
        axes.axhline(area, color="0.5", linewidth=0.7, zorder=0)
    axes.set(xlabel="roll-off waves along a side", ylabel=r"$A/A_0$ at sealing", ylim=_AREAS)
    places = [0.0, *(waves**-PERCOLATION).tolist()]
    axes.set(xticks=places, xticklabels=["∞", *map(str, waves)], xlim=(0, max(places) * 1.05))
    axes.legend(loc="upper left")


def _draw_leaks(axes: Axes, data: Data) -> None:
    for hardness, colour in zip(HARDNESSES, colours(len(HARDNESSES)), strict=True):
        load, value, low, high = apertures(data, hardness)
        axes.semilogx(load, value, color=colour, label=KINDS[hardness])
        axes.fill_between(load, low, high, color=colour, alpha=0.2, linewidth=0)
    for name, style in zip(_OF_PERSSON, _DASHES, strict=True):
        axes.semilogx(*theory_apertures(name), color="0.3", linestyle=style, label=name)
    axes.set(xlabel=r"$p\,/\,(E^*\nabla h)$", ylabel=r"$u_h\,/\,h$", ylim=_APERTURES)
    axes.legend(loc="upper right", fontsize=6)


def apertures(data: Data, hardness: float) -> tuple[Real, Real, Real, Real]:
    """Loads, and the hydraulic aperture of the mean leak with the ends of its interval."""
    one = data.leaks(LEAKING, SHOWN, hardness)
    found = average(one.of_both("permeance"))
    ends = (np.cbrt(np.maximum(each, 0)) for each in (found.mean, found.low, found.high))
    value, low, high = ends
    return np.array(one.case.loads), value, low, high


def theory_apertures(name: str) -> tuple[Real, Real]:
    """Loads, and the hydraulic aperture of a theory."""
    case = Case(LEAKING, SHOWN, ELASTIC)
    leaks = [theory_of(*THEORIES[name], case, load) for load in case.loads]
    return np.array(case.loads), np.cbrt(leaks)
