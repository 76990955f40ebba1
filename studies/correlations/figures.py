"""The study's two figures."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughline.plot.style import MARKERS, PAGE, SHADE, colours, new_figure
from roughline.statistics.averages import average
from studies.correlations.measure import (
    BANDS,
    DIMENSIONS,
    ELASTIC,
    FULL,
    HARDNESSES,
    Sample,
    dimensions_of,
    holm,
    mikic,
    sample,
    yovanovich,
)
from studies.correlations.ratios import ELASTIC_BANDS, MIDDLE

_CONDUCTANCE = r"$h_c\,\sigma\,/\,(\kappa_s m)$"
_PRESSURE_ELASTIC = r"pressure $p\,/\,(E^*\nabla h)$"
_HARDNESS = r"$H\,/\,(E^*\nabla h)$"
_PRESSURE_PLASTIC = r"pressure $p\,/\,H$"


def conductance_figure() -> Figure:
    """Draw the conductance over the pressure, with the handbooks' lines."""
    figure = new_figure(PAGE, 3.1)
    left, right = figure.subplots(1, 2, sharey=True)
    elastic = [sample("main", ELASTIC, dimension) for dimension in DIMENSIONS]
    for one, colour, marker in zip(elastic, colours(len(elastic)), MARKERS, strict=False):
        label = f"Hurst {3 - one.fractal_dimension:.1f}"
        _draw(left, one, colour, marker, label)
    left.loglog(elastic[0].pressure, mikic(elastic[0].pressure), "k-", label="Mikic", zorder=0)
    left.set(xlabel=_PRESSURE_ELASTIC, ylabel=_CONDUCTANCE, title="elastic")
    left.legend(loc="upper left")
    for hardness, colour, marker in zip(HARDNESSES, colours(5), MARKERS, strict=False):
        _draw(right, sample("main", hardness, MIDDLE), colour, marker, f"{hardness:g}")
    one = sample("main", FULL, MIDDLE)
    right.loglog(one.pressure, yovanovich(one.pressure), "k-", label="CMY", zorder=0)
    right.loglog(one.pressure, holm(one.pressure, one.slope), "k:", label="Holm", zorder=0)
    right.set(xlabel=_PRESSURE_PLASTIC, title=f"with a hardness, Hurst {3 - MIDDLE:.1f}")
    right.legend(loc="upper left", title=_HARDNESS, alignment="left")
    return figure


def ratio_figure() -> Figure:
    """Draw the conductance over that of the handbooks, over pressure and over the band."""
    figure = new_figure(PAGE, 2.9)
    left, middle, right = figure.subplots(1, 3)
    for axes in (left, middle, right):
        axes.axhspan(0.8, 1.2, **SHADE)
        axes.axhspan(0.9, 1.1, color="0.84", zorder=-9, linewidth=0)
        axes.axhline(1, color="0.5", linewidth=0.7, zorder=-8)
    for dimension, colour in zip(DIMENSIONS, colours(len(DIMENSIONS)), strict=True):
        one = sample("main", ELASTIC, dimension)
        _draw_ratio(left, one, colour, f"Hurst {3 - dimension:.1f}")
    left.set(xlabel=_PRESSURE_ELASTIC, ylabel="conductance over Mikic's", ylim=(0.6, 1.6))
    left.legend(loc="upper right")
    for hardness, colour in zip(HARDNESSES, colours(len(HARDNESSES)), strict=True):
        _draw_ratio(middle, sample("main", hardness, MIDDLE), colour, f"{hardness:g}")
    middle.set(xlabel=_PRESSURE_PLASTIC, ylabel=f"over CMY's, Hurst {3 - MIDDLE:.1f}")
    middle.set(yscale="log", ylim=(0.6, 6), yticks=(0.6, 0.8, 1, 1.5, 2, 3, 5))
    middle.set_yticklabels(["0.6", "0.8", "1", "1.5", "2", "3", "5"])
    middle.minorticks_off()
    middle.legend(loc="upper right", title=_HARDNESS, ncols=2)
    _draw_bands(right)
    return figure


def _draw(axes: Axes, one: Sample, colour: object, marker: str, label: str) -> None:
    mean = average(one.conductance).mean
    axes.loglog(one.pressure, mean, color=colour, marker=marker, linestyle="none", label=label)


def _draw_ratio(axes: Axes, one: Sample, colour: object, label: str) -> None:
    mean = average(one.ratio)
    axes.semilogx(one.pressure, mean.mean, color=colour, label=label)
    axes.fill_between(one.pressure, mean.low, mean.high, color=colour, alpha=0.2, linewidth=0)


def _draw_bands(axes: Axes) -> None:
    """Draw ratios over how many times the longest waves are as long as the shortest."""
    for hardness, style, name in ((ELASTIC, "--", "Mikic"), (FULL, "-", "CMY")):
        for dimension, colour in zip(DIMENSIONS, colours(len(DIMENSIONS)), strict=True):
            widths = [
                width
                for width in (BANDS if hardness == FULL else ELASTIC_BANDS)
                if dimension in dimensions_of(BANDS[width])
            ]
            points = [sample(BANDS[width], hardness, dimension) for width in widths]
            means = [one.mean_at(one.ratio, 1e-2) for one in points]
            value, low, high = np.array([[m.mean[0], m.low[0], m.high[0]] for m in means]).T
            axes.errorbar(
                widths, value, (value - low, high - value), color=colour, linestyle=style, capsize=2
            )
        axes.plot([], [], f"k{style}", label=f"over {name}'s")
    axes.set(xscale="log", xlabel="$q_{high}\\,/\\,q_{roll}$", ylabel="at a pressure of 0.01")
    axes.set(xticks=list(BANDS), xticklabels=list(map(str, BANDS)), ylim=(0.5, 1.25))
    axes.minorticks_off()
    axes.legend(loc="upper right")
