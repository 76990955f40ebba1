"""The empty figures of the bodies, which are embedded when they come into sight."""

from __future__ import annotations

from bokeh.models import ColumnDataSource, LinearColorMapper
from bokeh.palettes import Cividis256
from bokeh.plotting import figure

from roughline.lab.plots import embedded, linear_figure
from roughline.lab.published.controls import GALLERY


def figures() -> bytes:
    """Figure 1, a row for each fractal dimension, and Figure 2."""
    return embedded(_bodies() | {"published-indented": _indented()})


def _indented() -> figure:
    """Figure 2: the indented line."""
    plot = linear_figure("x / L", "height z / h", (0, 1), None)
    empty: dict[str, list[float]] = {key: [] for key in ("x", "z", "level", "above", "bar")}
    source = ColumnDataSource(empty, name="indented")
    force = plot.varea("x", "level", "above", source=source, legend_label="F / E* = shaded area")
    force.glyph.tags = [{"colours": {"fill_color": "light-line"}}]
    for column, width, dash, colour, label in (
        ("z", 1, "solid", "quiet", "rough line"),
        ("level", 1, "dashed", "text", "level z = z_max - d"),
        ("bar", 5, "solid", "text", "springs in contact"),
    ):
        line = plot.line(
            "x", column, source=source, line_width=width, line_dash=dash, legend_label=label
        )
        line.glyph.tags = [{"colours": {"line_color": colour}}]
    plot.legend.location = "top_left"
    return plot


def _bodies() -> dict[str, figure]:
    """Figure 1: line, topography, contact and deflection, a row for each fractal dimension."""
    plots = {}
    for row in range(len(GALLERY)):
        plots[f"published-line-{row}"] = _line(row)
        for what in ("topography", "contact", "deflection"):
            plots[f"published-{what}-{row}"] = _map(f"{what} {row}", rgba=what == "topography")
    return plots


def _map(name: str, *, rgba: bool) -> figure:
    """An empty map over both sides; its colours have the name of its source, and "colours"."""
    plot = linear_figure("x / L", "y / L", (0, 1), (0, 1))
    empty: dict[str, list[float]] = {key: [] for key in ("image", "x", "y", "dw", "dh")}
    source = ColumnDataSource(empty, name=name)
    if rgba:
        plot.image_rgba("image", "x", "y", "dw", "dh", source=source)
    else:
        mapper = LinearColorMapper(palette=Cividis256, low=0, high=1, name=f"{name} colours")
        plot.image("image", "x", "y", "dw", "dh", source=source, color_mapper=mapper)
    plot.grid.visible = False
    plot.toolbar_location = None
    plot.axis.ticker.desired_num_ticks = 3
    return plot


def _line(row: int) -> figure:
    plot = linear_figure("x / L", "height z / h", (0, 1), (-4.5, 4.5))
    plot.toolbar_location = None
    source = ColumnDataSource({"x": [], "z": []}, name=f"line {row}")
    line = plot.line("x", "z", source=source, line_width=0.7)
    line.glyph.tags = [{"colours": {"line_color": "text"}}]
    return plot
