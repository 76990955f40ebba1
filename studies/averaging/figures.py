"""The study's figure."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughline.paper.windows import ForceWindow
from roughline.plot.style import PAGE, colours, new_figure
from studies.averaging.measure import (
    BODIES,
    DIMENSIONS,
    PUBLISHED,
    choices,
    count,
    exponent,
    windows,
)

_FIXED = dict(zip(("force", "depth", "level"), colours(3), strict=True))
_MARKS = {"arithmetic": ("o", "-"), "geometric": ("s", "--")}
_LAWS = dict(zip(PUBLISHED, ("--", ":", "-"), strict=True))
_BESIDE = 0.012  # by which marks of the choices lie side by side, in fractal dimension
_NAMES = {"surfaces": "full model, 3D", "lines": "reduced model, 1D"}
_DIMENSIONS, _EXPONENTS = (1.95, 3.05), (0.38, 1.04)


def exponents_figure() -> Figure:
    """Draw the exponents of every window and mean over fractal dimension, with published ones."""
    figure = new_figure(PAGE, 5.2)
    panels = figure.subplots(len(BODIES), len(windows("surfaces")), sharex=True, sharey=True)
    for row, bodies in zip(panels, BODIES, strict=True):
        for axes, window in zip(row, windows(bodies), strict=True):
            _draw(axes, bodies, window)
        row[0].set_ylabel(f"exponent $\\alpha$, {_NAMES[bodies]}")
    for axes in panels[-1]:
        axes.set_xlabel("fractal dimension $D_f$")
    handles = [
        *_looks(panels[0, 0]),
        *(
            panels[0, 0].plot([], [], color="0.3", linestyle=style, label=f"${law}$")[0]
            for law, style in (("1/(4 - D_f)", "--"), ("0.2567\\,D_f", ":"), ("1", "-"))
        ),
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=5)
    return figure


def _draw(axes: Axes, bodies: str, window: ForceWindow) -> None:
    fine = np.linspace(2, 3, 51)
    for law, style in _LAWS.items():
        values = [PUBLISHED[law](each) for each in fine]
        axes.plot(fine, values, color="0.3", linestyle=style, linewidth=1, zorder=0)
    for i, choice in enumerate(choices()):
        beside = np.array(DIMENSIONS) + _BESIDE * (i - 2.5)
        found = [exponent(bodies, window, choice, each) for each in DIMENSIONS]
        value, low, high = np.array([(each.value, each.low, each.high) for each in found]).T
        marker, style = _MARKS[choice.averaging]
        axes.errorbar(
            beside,
            value,
            (value - low, high - value),
            color=_FIXED[choice.fixed],
            marker=marker,
            fillstyle="full" if choice.averaging == "arithmetic" else "none",
            linestyle=style,
            linewidth=1,
            elinewidth=0.6,
            capsize=1.5,
        )
    low_force, high_force = window
    title = f"$\\bar F$ = {low_force:g} to {high_force:g}, {count(bodies)} {bodies}"
    axes.set_title(title, fontsize=7.5)
    axes.set(xlim=_DIMENSIONS, ylim=_EXPONENTS)


def _looks(axes: Axes) -> list[object]:
    """Return what the legend shows of the choices."""
    return [
        axes.plot(
            [],
            [],
            color=_FIXED[choice.fixed],
            marker=_MARKS[choice.averaging][0],
            linestyle=_MARKS[choice.averaging][1],
            fillstyle="full" if choice.averaging == "arithmetic" else "none",
            label=f"fixed {choice.fixed}, {choice.averaging}",
        )[0]
        for choice in choices()
    ]
