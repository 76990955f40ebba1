"""The empty figures of the view "My surface", as Bokeh draws them."""

from __future__ import annotations

from typing import Any

from bokeh.models import (
    BasicTickFormatter,
    BoxAnnotation,
    BoxSelectTool,
    ColorBar,
    ColumnDataSource,
    DataRange1d,
    FactorRange,
    FixedTicker,
    GlyphRenderer,
    LinearColorMapper,
    Range1d,
    Span,
)
from bokeh.palettes import Cividis256
from bokeh.plotting import figure

from roughline.lab.plots import embedded, log_figure, tools

_FORCE = "force F [N]"
_BORDERS = {"min_border_left": 72, "min_border_right": 96, "min_border_bottom": 54}
"""Of maps, so wide that axes and colour bars fit: maps beside each other have frames alike. [px]"""


def figures() -> bytes:
    """All of them; their data come later, into sources of these names."""
    prepared, contact = _ranges(), _ranges()
    before = _map("before", *prepared)
    _take_boxes(before)
    return embedded(
        {
            "measured-file": _map("file", *_ranges(), rings="here"),
            "measured-file-line": _lines("file line", {"heights": "dark-line"}, marks=True),
            "measured-spectrum": _spectrum(),
            "measured-before": before,
            "measured-after": _map("after", *prepared),
            "measured-prepared-line": _lines(
                "prepared line", {"before": "theory", "after": "dark-line"}
            ),
            "measured-topography": _map("topography", *contact),
            "measured-contact": _map("contact", *contact, rings="theory"),
            "measured-stiffness": _stiffness(),
            "measured-area": _curve("area", "real contact area A / A_0"),
            "measured-models": _models(),
            "measured-part": _part(),
        }
    )


def _ranges() -> tuple[DataRange1d, DataRange1d]:
    """Both ranges of a map, or of two that move together."""
    return DataRange1d(range_padding=0), DataRange1d(range_padding=0)


def _map(name: str, x_range: DataRange1d, y_range: DataRange1d, *, rings: str = "") -> figure:
    """A map whose sides keep their ratio, and rings of a colour around some of its points.

    Missing points are in a colour of their own.
    """
    plot = figure(
        x_range=x_range,
        y_range=y_range,
        match_aspect=True,
        tools=tools(match_aspect=True),
        sizing_mode="stretch_both",
        **_BORDERS,
    )
    source = ColumnDataSource({"image": [], "x": [], "y": [], "dw": [], "dh": []}, name=name)
    mapper = LinearColorMapper(
        palette=Cividis256,
        low=-1,
        high=1,
        name=f"{name} colours",
        tags=[{"colours": {"nan_color": "here"}}],
    )
    plot.image(image="image", x="x", y="y", dw="dw", dh="dh", source=source, color_mapper=mapper)
    if rings:
        spikes = ColumnDataSource({"x": [], "y": []}, name=f"{name} spikes")
        drawn = plot.scatter("x", "y", source=spikes, size=13, line_width=2, fill_alpha=0)
        _colour(drawn, line_color=rings)
    plot.add_layout(ColorBar(color_mapper=mapper, title="", name=f"{name} bar"), "right")
    plot.grid.visible = False
    _finish(plot, name, "x", "y")
    return plot


def _take_boxes(plot: figure) -> None:
    """Let a piece be drawn on a map."""
    tool = BoxSelectTool(description="draw the piece to keep")
    plot.add_tools(tool)
    plot.toolbar.active_drag = tool
    box = BoxAnnotation(
        name="crop box",
        left=0,
        right=0,
        top=0,
        bottom=0,
        fill_alpha=0.0,
        line_width=3,
        visible=False,
        tags=[{"colours": {"line_color": "here"}}],
    )
    plot.add_layout(box)


def _lines(name: str, shown: dict[str, str], *, marks: bool = False) -> figure:
    """Heights along a line; `shown` are the sources, and their colours."""
    plot = figure(tools=tools(), sizing_mode="stretch_both")
    for each, colour in shown.items():
        source = ColumnDataSource({"x": [], "y": []}, name=f"{name} {each}")
        legend = {"legend_label": each} if len(shown) > 1 else {}
        _colour(plot.line("x", "y", source=source, line_width=1.2, **legend), line_color=colour)
    if marks:
        for each, marker, size in (("spikes", "circle", 11), ("missing", "x", 8)):
            source = ColumnDataSource({"x": [], "y": []}, name=f"{name} {each}")
            drawn = plot.scatter(
                "x", "y", source=source, marker=marker, size=size, fill_alpha=0, line_width=2
            )
            _colour(drawn, line_color="here")
    _finish(plot, name, "x", "height")
    return plot


def _spectrum() -> figure:
    plot = _log_figure("wavenumber q = 2π/λ [1/m]", "C_2d [m⁴]")
    points = ColumnDataSource({"x": [], "y": []}, name="spectrum")
    law = ColumnDataSource({"x": [], "y": []}, name="spectrum law")
    _colour(
        plot.scatter("x", "y", source=points, size=3.5, legend_label="this surface"),
        fill_color="dark-line",
        line_color="dark-line",
    )
    _colour(
        plot.line("x", "y", source=law, line_width=2.5, legend_label="nearest self-affine law"),
        line_color="here",
    )
    plot.legend.location = "bottom_left"
    _finish(plot, "spectrum", None, None)
    return plot


def _stiffness() -> figure:
    """Stiffness over force, that on unloading beside it."""
    plot = _curve("stiffness", "stiffness k")
    source = ColumnDataSource({"x": [], "y": []}, name="stiffness unloading")
    look = {"source": source, "line_dash": "dashed", "line_width": 1.5}
    _colour(plot.line("x", "y", legend_label="on unloading", **look), line_color="mark")
    plot.legend.items[-1].name = "stiffness unloading label"
    return plot


def _curve(name: str, label: str) -> figure:
    """A quantity over force with its interval; open marks where the grid decides."""
    plot = _log_figure(_FORCE, label)
    ends = ColumnDataSource({"x": [], "low": [], "high": []}, name=f"{name} interval")
    _colour(
        plot.varea("x", "low", "high", source=ends, fill_alpha=0.25, legend_label="interval"),
        fill_color="dark-line",
    )
    theories = ColumnDataSource({"xs": [], "ys": [], "name": []}, name=f"{name} theories")
    _colour(
        plot.multi_line("xs", "ys", source=theories, line_dash="dashed", line_width=1.5),
        line_color="theory",
    )
    line = ColumnDataSource({"x": [], "y": []}, name=f"{name} line")
    _colour(plot.line("x", "y", source=line, line_width=1), line_color="theory")
    for what, label_, size, fill, colour in (
        ("loads", "loads", 6, 1.0, "dark-line"),
        ("unsure", "the grid decides", 6, 0.0, "dark-line"),
        ("asked", "as asked", 13, 0.0, "here"),
    ):
        source = ColumnDataSource({"x": [], "y": []}, name=f"{name} {what}")
        drawn = plot.scatter(
            *("x", "y"),
            source=source,
            size=size,
            fill_alpha=fill,
            line_width=2 if what == "asked" else 1,
            legend_label=label_,
        )
        _colour(drawn, fill_color=colour, line_color=colour)
    plot.legend.location = "bottom_right"
    _finish(plot, name, None, None)
    return plot


def _models() -> figure:
    plot = _log_figure("force F / (E* h L)", "raw stiffness k / (E* L)")
    for name, label, colour in (
        ("full", "full model, this surface", "dark-line"),
        ("reduced", "reduced model, mean of lines", "light-line"),
    ):
        source = ColumnDataSource({"x": [], "y": [], "low": [], "high": []}, name=f"models {name}")
        band = plot.varea("x", "low", "high", source=source, fill_alpha=0.25)
        _colour(band, fill_color=colour)
        _colour(
            plot.line("x", "y", source=source, line_width=2, legend_label=label), line_color=colour
        )
        drawn = plot.scatter("x", "y", source=source, size=6, legend_label=label)
        _colour(drawn, fill_color=colour, line_color=colour)
    plot.legend.location = "bottom_right"
    _finish(plot, "models", None, None)
    return plot


def _part() -> figure:
    """An answer of each map with its interval; their mean, and the interval of the part."""
    plot = figure(
        x_range=FactorRange(),
        y_axis_type="log",
        y_range=Range1d(0.1, 10),
        tools=tools(),
        sizing_mode="stretch_both",
    )
    whole = BoxAnnotation(name="part interval", fill_alpha=0.2, line_alpha=0.0, level="underlay")
    whole.tags = [{"colours": {"fill_color": "here"}}]
    mean = Span(name="part mean", dimension="width", line_width=2)
    mean.tags = [{"colours": {"line_color": "here"}}]
    for each in (whole, mean):
        plot.add_layout(each)
    source = ColumnDataSource({"map": [], "y": [], "low": [], "high": []}, name="part")
    _colour(plot.segment("map", "low", "map", "high", source=source), line_color="dark-line")
    drawn = plot.scatter("map", "y", source=source, size=8)
    _colour(drawn, fill_color="dark-line", line_color="dark-line")
    plot.xaxis.major_label_orientation = 0.6
    plot.xgrid.visible = False
    ticks = [mantissa * 10.0**power for power in range(-6, 7) for mantissa in (1, 2, 5)]
    plot.yaxis.ticker = plot.ygrid.ticker = FixedTicker(ticks=ticks)  # Bokeh's own miss decades
    plot.yaxis.formatter = BasicTickFormatter()
    _finish(plot, "part", None, None)
    return plot


def _log_figure(x_label: str, y_label: str) -> figure:
    """A plot with two logarithmic axes that follow what is drawn."""
    plot = log_figure(x_label, y_label, (0.1, 10), (0.1, 10))
    plot.x_range, plot.y_range = DataRange1d(), DataRange1d()
    return plot


def _finish(plot: figure, name: str, x_label: str | None, y_label: str | None) -> None:
    """Name the axes, so that the page can say their units."""
    for axis, letter, label in ((plot.xaxis[0], "x", x_label), (plot.yaxis[0], "y", y_label)):
        axis.name = f"{name} {letter}"
        if label is not None:
            axis.axis_label = label
    plot.toolbar.logo = None
    plot.toolbar.autohide = True


def _colour(drawn: GlyphRenderer[Any], **colours: str) -> None:
    """Let a glyph follow the colours of the theme."""
    drawn.glyph.tags = [{"colours": colours}]
