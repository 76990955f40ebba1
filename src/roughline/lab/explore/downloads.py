"""Files of the view "Explore": what its plots and maps show, as pictures and as numbers.

All is computed anew, as the tasks of the page do.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from importlib.resources import files
from pathlib import Path
from textwrap import fill
from typing import Any
from urllib.parse import urlencode

import numpy as np
import pandas as pd
import xarray
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, LogNorm, Normalize
from matplotlib.patches import Patch

import roughline as rl
from roughline.computing.disk import write_dataset
from roughline.lab.controls import STRANGE, ControlError, rounded
from roughline.lab.explore import physics, pictures
from roughline.lab.explore.controls import FILES
from roughline.lab.explore.pressing import CURVE_POINTS, pressed_under
from roughline.lab.explore.reading import state_in
from roughline.lab.explore.state import ExploreState
from roughline.lab.frames import frame
from roughline.lab.maps import Map
from roughline.lab.panels import Panel, PanelContent
from roughline.lab.server.tasks import Arguments, Progress
from roughline.plot.pixels import draw_map, drawn_sides
from roughline.plot.style import PAGE, new_figure, styled

_ROW_HEIGHT = 3.4  # height of a row of two plots [inch]
_FONT_SIZE = 7  # [pt]
_LEGEND_WIDTH = 36  # [characters]
_POINTS_PER_PIXEL = 0.6  # of sizes on the page, for those on paper [pt]
_RING_STROKES = ((5, "paper"), (2, "here"))  # its widths on the page, and the colours of the theme
_ZERO_MARK_HEIGHT = 0.04  # of a logarithmic axis: how far above its end zeros stand
_LIGHT = Path(str(files("roughline.lab").joinpath("static/lab.css"))).read_text(encoding="utf-8")
_COLOURS = dict(re.findall(r"--([\w-]+): (#\w+)", _LIGHT.partition("}")[0]))
"""Those of the page on paper, by their names in its style."""
_MARKERS = {"circle": "o", "square": "s", "triangle": "^", "inverted_triangle": "v", "x": "x"}
_DASHES = {"dashed": "--", "dotted": ":", "dashdot": "-."}
_PALETTES = {"Cividis256": "cividis", "Viridis256": "viridis", "flux": "YlGnBu"}


def download(arguments: Arguments, progress: Progress) -> bytes:
    """Write one of the files to the folder of the session.

    It is of a state as it was answered, on the `points` along a side that its maps have.
    """
    name, state = str(arguments.get("name")), state_in(arguments)
    if name not in FILES:
        raise ControlError(f"there is no such file; there are {', '.join(FILES)}")
    points = arguments.get("points", state.n)
    if not isinstance(points, int) or not 2 <= points <= state.n:
        raise ControlError(STRANGE)
    folder = Path(arguments["session"]["folder"]) / "results"
    folder.mkdir(parents=True, exist_ok=True)
    _WRITERS[name](state, points, folder / name, progress)
    return frame({"file": name})


def all_panels(state: ExploreState, points: int, progress: Progress) -> dict[str, PanelContent]:
    """All that the panels show of a state, by their keys."""
    followed = [each for each in state.added if each.follows]
    steps = _steps(progress, 2 + len(followed))
    answers = [
        pictures.line(state)["panels"],
        pictures.over_loads(state, next(steps)),
        pictures.contact(state, points, next(steps), is_coarse=points < state.n)[0]["panels"],
        *(each.further(state, True, next(steps))[0]["panels"] for each in followed),
    ]
    found: dict[str, PanelContent] = {}
    for answer in answers:
        for key, filled in answer.items():
            before = found.setdefault(key, PanelContent())
            before.series |= filled.series
            before.legends |= filled.legends
            before.x, before.y = filled.x or before.x, filled.y or before.y
    return found


def all_maps(state: ExploreState, points: int, progress: Progress) -> dict[str, Map]:
    """All maps that the page can show of a state, by the words that choose them."""
    wanted = [each for each in state.added if state.shown in each.maps and each.follows]
    steps = _steps(progress, 1 + len(wanted))
    maps = pictures.contact(state, points, next(steps), is_coarse=True)[1]
    for each in wanted:
        maps |= each.further(state, True, next(steps))[1]
    if not maps:
        raise ControlError("the load was not solved, so that no map of it is known", "F")
    return maps


def _steps(progress: Progress, presses: int) -> Iterator[Progress]:
    """What each of several presses, one after the other, tells its steps to."""
    for before in range(presses):

        def step(done: int, total: int, before: int = before) -> None:
            progress(before * total + done, presses * total)

        yield step


def _write_panels(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    """Write the points of all panels: a row for each, below the names of columns and remarks.

    The names come first, where both NumPy and pandas look for them.
    """
    found, declared = all_panels(state, points, progress), physics.panels()
    tables, remarks = [], [f"{name} = {value}" for name, value in _settings(state, points).items()]
    for key, filled in found.items():
        panel = declared[key]
        remarks.append(f"panel {key}: x is {panel.x}, y is {panel.y}")
        called = {each.name: each.legend for each in panel.series} | filled.legends
        for name, columns in filled.series.items():
            rows = pd.DataFrame(columns)
            if rows.empty:
                continue
            remarks.append(f"series {key} {name}: {called[name]}")
            tables.append(rows.assign(panel=key, series=name.replace(" ", "_")))
    table = pd.concat(tables).reindex(columns=["panel", "series", "x", "y", "low", "high"])
    head, body = table.to_csv(index=False, na_rep="nan", lineterminator="\n").split("\n", 1)
    lines = "".join(f"# {' '.join(each.split())}\n" for each in remarks)
    path.write_text(f"{head}\n{lines}{body}", encoding="utf-8")


def _write_loads(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    """Write the loads of the full model with all their quantities, in SI units."""
    surface = state.surface(state.points(CURVE_POINTS))
    forces = pictures.drawn_forces(state)
    pressed = pressed_under(state, surface, forces, progress, measures=state.measures)
    data = pressed.to_dataset().assign_attrs(_settings(state, points))
    write_dataset(data, path)


def _write_maps(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    """Write the heights as `rl.write` does, and with them the maps of the contact."""
    surface = state.surface(points)
    rl.write(surface, path)
    pressed = pressed_under(state, surface, np.array([state.F]), progress, fields=True)
    maps = pressed.to_dataset().isel(force=0).drop_vars("force")
    if (fields := pressed.fields[0]) is not None:
        for each in state.added:
            for name, (values, unit, meaning) in each.saved_fields(fields).items():
                maps[name] = (("x", "y"), values, {"units": unit, "long_name": meaning})
    heights = xarray.load_dataset(path)
    data = heights.merge(maps)
    write_dataset(data.assign_attrs(_settings(state, points) | heights.attrs), path)


def _write_surface(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    rl.write(state.surface(points), path)


def _settings(state: ExploreState, points: int) -> dict[str, Any]:
    """What files say of a state: what it is made of, how it is pressed, and a link to it."""
    side, height = state.length, state.rms_height
    numbers = {
        "E_star [Pa]": state.E_star,
        "length L [m]": side,
        "rms_height h [m]": height,
        "rms_slope": state.rms_slope,
        "fractal_dimension": state.D_f,
        "roll_off [m]": state.roll_off * side,
        "cutoff [m]": state.cutoff_used * side,
        "force F [N]": state.force(state.F),
        "force_bar": state.F,
        "E* h L, unit of force_bar [N]": state.force(1.0),
        "E* L, unit of stiffness_bar [N/m]": state.E_star * side,
    }
    return {
        "roughline_version": rl.__version__,
        **{name: rounded(value) for name, value in numbers.items()},
        "seed": state.seed,
        "boundary": state.boundary,
        "points along a side": state.n,
        "points along a side of the maps": points,
        "points along a side of the curves": state.points(CURVE_POINTS),
        **{key: value for each in state.added for key, value in each.numbers.items()},
        "lab_link": f"?view=explore&{urlencode(state.address())}",
    }


def _draw_panels(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    """Draw all panels as the page does."""
    found, declared = all_panels(state, points, progress), physics.panels()

    def drawn(key: str) -> Callable[[Axes], None]:
        return lambda axes: _draw_panel(axes, declared[key], found[key])

    _write_figure(path, [drawn(key) for key in declared if key in found])


def _draw_panel(axes: Axes, panel: Panel, filled: PanelContent) -> None:
    """Draw the points of a panel; zeros stand at the foot of a logarithmic axis."""
    scale = "log" if panel.is_logarithmic else "linear"
    axes.set(xlabel=panel.x, ylabel=panel.y, xscale=scale, yscale=scale)
    axes.set(xlim=filled.x or panel.ranges[0], ylim=filled.y or panel.ranges[1])
    low, high = axes.get_ylim()
    foot = low * (high / low) ** _ZERO_MARK_HEIGHT if panel.is_logarithmic else low
    named: dict[str, list[Artist]] = {}
    drawn: Sequence[Artist]
    for series in panel.series:
        points = filled.series.get(series.name, {})
        if not len(points.get("x", ())):
            continue
        x, y = (np.asarray(points[name], dtype=float) for name in "xy")
        y = np.where(y == 0, foot, y) if panel.is_logarithmic else y
        label = fill(filled.legends.get(series.name, series.legend), _LEGEND_WIDTH)
        colour = _COLOURS[series.colour]
        for kind, look in series.glyphs.items():
            size, width = (
                look.get("size", 6) * _POINTS_PER_PIXEL,
                look.get("line_width", 1) * _POINTS_PER_PIXEL,
            )
            if kind == "varea":
                bottom, top = (np.asarray(points[end], dtype=float) for end in ("low", "high"))
                alpha = look["fill_alpha"]
                drawn = [axes.fill_between(x, bottom, top, color=colour, alpha=alpha, linewidth=0)]
            elif kind == "line":
                dash = _DASHES.get(look.get("line_dash", ""), "-")
                drawn = axes.plot(x, y, dash, color=colour, linewidth=width)
            else:
                marker = _MARKERS[look["marker"]] if "marker" in look else "."
                face = "none" if look.get("fill_alpha") == 0 else colour
                drawn = axes.plot(x, y, marker, color=colour, markersize=size, markerfacecolor=face)
            named.setdefault(label, []).extend(drawn)
    axes.legend([tuple(each) for each in named.values()], [*named], fontsize=_FONT_SIZE)


def _draw_maps(state: ExploreState, points: int, path: Path, progress: Progress) -> None:
    """Draw the topography, and beside it what the map of the contact shows."""
    maps = all_maps(state, points, progress)
    chosen = maps[state.shown if state.shown in maps else "area"]
    surface = state.surface(points)
    _write_figure(
        path,
        [
            lambda axes: rl.plot.topography(surface, axes=axes),
            lambda axes: _draw_map(axes, chosen, surface.sizes),
        ],
    )


def _draw_map(axes: Axes, content: Map, sizes: tuple[float, float]) -> None:
    """Draw a map in the colours of the page, with their scale or their meanings."""
    norm, values, unit = Normalize(content.low, content.high), content.values, content.unit
    if content.is_logarithmic:
        norm, values = LogNorm(10**content.low, 10**content.high), 10.0**values
    look: dict[str, Any] = {"norm": norm}
    if isinstance(content.palette, tuple):
        look["cmap"] = ListedColormap([_COLOURS[name] for name in content.palette])
    else:
        palette = colormaps[_PALETTES[content.palette]]
        extremes = {"bad": _COLOURS[content.blank], "under": _COLOURS["paper"]}
        look["cmap"] = palette.with_extremes(**extremes)
    image = draw_map(axes, np.ma.masked_invalid(values), sizes, "m", **look)
    if content.title:
        label = f"{content.title} {unit if unit.startswith('/') else f'[{unit}]'}"
        axes.figure.colorbar(image, ax=axes, shrink=0.85, label=label)
    x, y = drawn_sides(image)
    for place in content.rings:
        for width, colour in _RING_STROKES:
            ring = axes.plot(place[0] * x, place[1] * y, "o", markerfacecolor="none")[0]
            ring.set(markersize=14 * _POINTS_PER_PIXEL, markeredgewidth=width * _POINTS_PER_PIXEL)
            ring.set_markeredgecolor(_COLOURS[colour])
    marks = [
        Patch(color=_COLOURS[name], label=meaning) for name, meaning in content.meanings.items()
    ]
    axes.legend(
        handles=marks,
        title=content.caption,
        ncols=2,
        loc="lower left",
        bbox_to_anchor=(0, 1),
        fontsize=_FONT_SIZE,
        title_fontsize=_FONT_SIZE,
    )


def _write_figure(path: Path, plots: list[Callable[[Axes], Any]]) -> None:
    """Draw plots, two abreast, and write the figure as the ending of its name says."""
    rows = -(-len(plots) // 2)
    with styled():
        figure = new_figure(PAGE, _ROW_HEIGHT * rows)
        figure.set_layout_engine("compressed")
        axes = figure.subplots(rows, 2, squeeze=False).ravel()
        for draw, each in zip(plots, axes, strict=False):
            draw(each)
        for empty in axes[len(plots) :]:
            empty.set_axis_off()
        figure.savefig(path)


_WRITERS: dict[str, Callable[[ExploreState, int, Path, Progress], None]] = {
    "contact.png": _draw_maps,
    "contact.pdf": _draw_maps,
    "maps.nc": _write_maps,
    "curve.png": _draw_panels,
    "curve.pdf": _draw_panels,
    "curve.csv": _write_panels,
    "curve.nc": _write_loads,
    "surface.nc": _write_surface,
    "surface.x3p": _write_surface,
    "surface.gsf": _write_surface,
}
