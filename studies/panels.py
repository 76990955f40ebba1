"""Panels that the lab shows of a study: their data, how they are drawn, and their words."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from roughline.paper.studies import StudyPicture
from roughline.plot.style import COLUMN, MARKERS, colours, ink, new_figure

_HEIGHT = 3.8  # of a panel with its legend below [inch]
_RAMP = 6  # colours that curves choose from
_PIXELS = 200  # of an inch of a picture
_FEW = 100  # end over beginning of a logarithmic axis up to which more than decades are labelled
_WIDE = 28  # letters of a legend that leave no room for a second column
_SYMBOL = re.compile(r"(\w)_([A-Za-z0-9]+)")


@dataclass(frozen=True)
class StudyCurve:
    """A curve or a row of marks."""

    name: str  # what the legend says
    x: Sequence[float]
    y: Sequence[float]
    low: Sequence[float] = ()  # ends of the 95 % intervals of y; empty where none are drawn
    high: Sequence[float] = ()
    colour: int = -1  # place in the ramp of six colours; -1 for the colour of text
    dash: str = "solid"  # of the line
    marks: bool = False  # whether points are marked, and not joined by a line


@dataclass(frozen=True)
class StudyPanel:
    """A panel of a figure."""

    title: str
    x_label: str
    y_label: str
    x_range: Sequence[float]  # ends of the axis
    y_range: Sequence[float]
    curves: Sequence[StudyCurve]
    is_log: bool = True  # whether the x axis is logarithmic; the y axis is linear

    def picture(self, file: str) -> StudyPicture:
        """Return its words, with the ends of each curve, and the name of its file."""
        bands = [one.marks for one in self.curves if len(one.low)]
        told = f"; {'bars' if any(bands) else 'bands'}: 95 % intervals" if bands else ""
        curves = "; ".join(map(_in_words, self.curves))
        return StudyPicture(
            file,
            self.title,
            f"{self.y_label} over {self.x_label}{told}.",
            f"{self.y_label} over {self.x_label}, from left to right: {curves}.",
            (round(COLUMN * _PIXELS), round(_HEIGHT * _PIXELS)),
        )

    def figure(self) -> Figure:
        """Draw it, with the legend below, where it covers nothing."""
        figure = new_figure(COLUMN, _HEIGHT)
        axes = figure.add_subplot()
        ramp = colours(_RAMP)
        for curve in self.curves:
            colour = ink() if curve.colour < 0 else ramp[curve.colour]
            look: Any = {"color": colour, "label": _typeset(curve.name)}
            if curve.marks:
                ends = (curve.low, curve.y), (curve.y, curve.high)
                error = [[b - a for a, b in zip(*each, strict=True)] for each in ends]
                marker = MARKERS[curve.colour % len(MARKERS)]
                axes.errorbar(curve.x, curve.y, error, fmt=marker, capsize=2, linewidth=1, **look)
                continue
            if len(curve.low):
                axes.fill_between(
                    curve.x, curve.low, curve.high, color=colour, alpha=0.25, linewidth=0
                )
            axes.plot(curve.x, curve.y, linestyle=curve.dash, **look)
        axes.set(
            **{"xlabel": _typeset(self.x_label), "ylabel": _typeset(self.y_label)},
            **{"xlim": self.x_range, "ylim": self.y_range},
            xscale="log" if self.is_log else "linear",
        )
        if self.is_log and self.x_range[1] < _FEW * self.x_range[0]:
            axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            axes.xaxis.set_major_formatter("{x:g}")
            axes.xaxis.set_minor_formatter(NullFormatter())
        is_wide = max(len(each.name) for each in self.curves) > _WIDE
        figure.legend(
            loc="outside lower center", ncols=1 if is_wide else 2, fontsize=7.5, handlelength=2.4
        )
        return figure


def _in_words(curve: StudyCurve) -> str:
    first, last = (f"{value:.3g}" for value in (curve.y[0], curve.y[-1]))
    return f"{curve.name}: {first}" + ("" if first == last else f" to {last}")


def _typeset(text: str) -> str:
    """Set the letters after an underscore low."""
    return _SYMBOL.sub(r"$\\mathrm{\1}_\\mathrm{\2}$", text)
