"""The study's figure."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughline.computing.arrays import Real
from roughline.plot.style import MARKERS, PAGE, colours, new_figure
from studies.friction.body import SHARES, Case
from studies.friction.claims import WORDS, ratio
from studies.friction.measure import Data, over_lines
from studies.friction.run import FORCE_BARS, HURSTS, MIDDLE, PAIRS
from studies.judged import Found

SHOWN = 0.5
"""Hurst exponent of the slides that are drawn."""


def friction_figure(data: Data) -> Figure:
    """Draw slides beside Jäger's, and surfaces beside reduced lines."""
    figure = new_figure(PAGE, 3.0)
    left, right = figure.subplots(1, 2)
    _draw_slides(left, data)
    _draw_reduced(right, data)
    for axes in (left, right):
        axes.axhline(0, color="0.5", linewidth=0.7, zorder=0)
    return figure


def _draw_slides(axes: Axes, data: Data) -> None:
    cases = {
        "β = 0": Case(SHOWN, MIDDLE),
        **{
            f"μ/β = {ratio(pair)}, β = {pair[0]:.2g}": Case(SHOWN, MIDDLE, PAIRS[pair], *pair)
            for pair in PAIRS
        },
    }
    marks = zip(cases.items(), MARKERS, colours(len(cases)), strict=False)
    for k, ((label, case), marker, colour) in enumerate(marks):
        one = data.sample(case)
        found = [one.slip(i) for i in range(len(SHARES))]
        _draw(axes, np.array(SHARES) + 0.012 * (k - 2), found, color=colour, marker=marker)
        axes.plot([], [], color=colour, marker=marker, label=label)
    axes.set(xlabel=r"$Q/\mu F$", ylabel="slide over Jäger's, less 1 [%]")
    axes.legend(fontsize=6)


def _draw_reduced(axes: Axes, data: Data) -> None:
    shifts = np.geomspace(0.85, 1 / 0.85, len(HURSTS) * len(WORDS)).reshape(len(HURSTS), -1)
    for hurst, colour, shift in zip(HURSTS, colours(len(HURSTS)), shifts, strict=True):
        for (quantity, words), marker, at in zip(WORDS.items(), MARKERS, shift, strict=False):
            found = [over_lines(data.pressed(Case(hurst, force)), quantity) for force in FORCE_BARS]
            _draw(axes, at * np.array(FORCE_BARS), found, color=colour, marker=marker)
            if hurst == HURSTS[0]:
                axes.plot([], [], color="0.3", marker=marker, label=words)
        axes.plot([], [], color=colour, label=f"Hurst {hurst:g}")
    axes.set(xscale="log", xlabel=r"$\bar F$", ylabel="surfaces over lines, less 1 [%]")
    axes.legend(fontsize=6, ncols=2)


def _draw(axes: Axes, x: Real, found: list[Found], **style: Any) -> None:
    value, low, high = 100 * np.array([(one.value, one.low, one.high) for one in found]).T
    axes.errorbar(x, value, (value - low, high - value), capsize=2, linewidth=0.8, **style)
