"""What the plots and maps of the view "Explore" show, as pictures in files."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from itertools import cycle
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap

import roughline as rl
from roughline.lab.controls import ControlError
from roughline.lab.explore import adhesion
from roughline.lab.explore.controls import CHOICES, WITH_ALONE
from roughline.lab.explore.maps import contact_maps
from roughline.lab.explore.numbers import Curves, at_load, curves_of
from roughline.lab.explore.state import ExploreState
from roughline.lab.explore.words import unloading_bar
from roughline.lab.server.tasks import Progress
from roughline.plot.pixels import draw_map
from roughline.plot.style import FORCE_LABEL, PAGE, new_figure, styled

_ROW = 3.2  # height of a row of two panels [inch]
_TITLE = 8  # font size [pt]
_DASHES = ("--", ":", "-.")  # of theories
_BACK: dict[str, Any] = {
    "color": "tab:orange",
    "linestyle": "-",
    "marker": ".",
    "label": "way back",
}

_Draw = Callable[..., Any]  # takes the axes to draw on, by their name


def write_curves(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    """Draw all that the plots over the force show; a line stands at the present load."""
    found = curves_of(state, points, progress)
    panels: list[_Draw] = [partial(_draw_stiffness, found=found), partial(_draw_area, found=found)]
    if (flow := found.flow) is not None:
        of_flow = [flow] if found.back is None else [flow, found.back]
        panels.append(lambda axes: rl.plot.hydraulic_aperture(of_flow, found.of_flow, axes=axes))
    if found.cycle is not None:
        panels.append(partial(rl.plot.curve, found.cycle.by_depths, "depth", "force"))
    _write(path, panels)


def write_maps(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    """Draw the topography, and beside it what the map of the contact shows."""
    needed = WITH_ALONE.get(state.shown)
    shown = state.shown if needed is None or getattr(state, needed) else "area"
    if shown == "retreat":
        points = adhesion.points(state)
        pressed, load = adhesion.cycle(state, points, progress).by_forces, adhesion.BACK
    else:
        pressed, load = at_load(state, points, progress), 0
    surface = state.surface(points)
    if pressed.fields[load] is None:
        raise ControlError("the load was not solved, so that no map of it is known", "F")
    state = replace(state, shown=shown)
    draw = partial(_draw_map, state=state, surface=surface, pressed=pressed, load=load)
    _write(path, [partial(rl.plot.topography, surface), draw])


def _write(path: Path, panels: list[_Draw]) -> None:
    """Draw panels, two abreast, and write the figure as the ending of its name says."""
    rows = -(-len(panels) // 2)
    with styled():
        figure = new_figure(PAGE, _ROW * rows)
        axes = figure.subplots(rows, 2, squeeze=False).ravel()
        for draw, each in zip(panels, axes, strict=False):
            draw(axes=each)
        for empty in axes[len(panels) :]:
            empty.set_axis_off()
        figure.savefig(path)


def _draw_stiffness(axes: Axes, found: Curves) -> None:
    """Stiffness of both models over the force, and of theories."""
    line, loads, back = found.line, found.loads, found.back
    axes.plot(
        line["force_bar"], line["stiffness_bar"], color="tab:blue", label="1D, mean and range"
    )
    band = (line["force_bar"], line["low"], line["high"])
    axes.fill_between(*band, color="tab:blue", alpha=0.15, linewidth=0)
    if back is not None:
        axes.plot(
            loads.force_bar, unloading_bar(loads), "^", color="tab:red", label="unloading $k_u$"
        )
        axes.plot(back.force_bar, unloading_bar(back), **_BACK)
    _draw_loads(axes, found, "stiffness_bar", "stiffness_bar")
    axes.set(ylabel=r"stiffness $\bar k$", ylim=(None, 1.5))


def _draw_area(axes: Axes, found: Curves) -> None:
    """Contact area over the force, and of theories."""
    if (back := found.back) is not None:
        assert back.area_fraction_corrected is not None
        axes.plot(back.force_bar, back.area_fraction_corrected, **_BACK)
    _draw_loads(axes, found, "area_fraction_corrected", "area")
    axes.set(ylabel="contact area $A/A_0$", ylim=(None, 1.5))


def _draw_loads(axes: Axes, found: Curves, name: str, of_theory: str) -> None:
    """A quantity of the full model and of theories over the force, and the present load."""
    rl.plot.curve(found.loads, "force_bar", name, axes)
    for theory, dashes in zip(found.theories, cycle(_DASHES), strict=False):
        if (values := theory[of_theory]) is not None:
            label = CHOICES["theories"].options[theory["name"]]
            axes.plot(theory["force_bar"], values, "k", linestyle=dashes, label=label)
    here = found.here
    axes.axvline(here.force_bar[0], color="0.6", linewidth=0.8, zorder=-1)
    axes.plot(here.force_bar, getattr(here, name), "D", color="tab:red", label="present load")
    axes.set(xlabel=FORCE_LABEL, xscale="log", yscale="log")
    axes.legend()


def _draw_map(
    axes: Axes, state: ExploreState, surface: rl.Surface, pressed: rl.Curve, load: int
) -> None:
    """What the map of the contact shows of a load."""
    fields = pressed.fields[load]
    assert fields is not None
    if state.shown == "flux":
        rl.plot.flow(rl.flow(fields), "m", axes)
    elif state.shown == "pressure":
        rl.plot.pressure(pressed, load, axes)
    elif state.shown in ("area", "retreat"):
        rl.plot.contact(pressed, load, axes)
        if state.w is not None:
            pulled = np.where(fields.pulling, 1.0, np.nan)
            draw_map(axes, pulled, fields.sizes, "m", cmap=ListedColormap(["tab:blue"]))
            axes.set_title(axes.get_title() + "\nblue: pulled across a gap", fontsize=_TITLE)
    else:
        shown = contact_maps(state, surface, fields)[state.shown]
        look = {"cmap": "cividis", "vmin": shown.low, "vmax": shown.high}
        values = np.where(shown.values > 0, shown.values, np.nan)
        image = draw_map(axes, values, fields.sizes, "m", **look)
        axes.figure.colorbar(image, ax=axes, shrink=0.85)
        axes.set_title(shown.caption, fontsize=_TITLE)
