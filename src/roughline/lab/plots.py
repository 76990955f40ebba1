"""How plots of the lab look, and how they reach the page."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from bokeh.document import Document
from bokeh.embed.util import standalone_docs_json_and_render_items
from bokeh.models import (
    BoxAnnotation,
    BoxZoomTool,
    ColorBar,
    ColumnDataSource,
    LinearColorMapper,
    NoOverlap,
    PanTool,
    Range1d,
    ResetTool,
    SaveTool,
    Tool,
    ZoomInTool,
    ZoomOutTool,
)
from bokeh.palettes import Cividis256, Viridis256
from bokeh.plotting import figure

from roughline.lab.frames import frame

_BORDERS = (62, 84)  # for numbers and a colour bar, of maps [pixel]
_ZOOM = 0.25  # of a click on a tool, in sides of the plot


def embedded(plots: Mapping[str, figure]) -> bytes:
    """Return plots as BokehJS embeds them, in one document, so that they may share ranges.

    Parameters
    ----------
    plots : mapping of str to figure
        By the element of the page that each belongs to, without its prefix "plot-".
    """
    document = Document()
    with document.models.freeze():  # otherwise each root would have all the others searched again
        for element, plot in plots.items():
            plot.name = element
            document.add_root(plot)
    documents, (item, *_) = standalone_docs_json_and_render_items(document)
    places = {plot.id: f"plot-{element}" for element, plot in plots.items()}
    return frame(
        {
            "documents": documents,
            "items": [{**item.to_json(), "roots": places}],
            "palettes": {"cividis": Cividis256, "viridis": Viridis256},
        }
    )


def log_figure(
    x_label: str, y_label: str, x_range: tuple[float, float], y_range: tuple[float, float]
) -> figure:
    """Return an empty plot with two logarithmic axes."""
    return _empty(x_label, y_label, x_range, y_range=y_range, x_axis_type="log", y_axis_type="log")


def semilog_figure(
    x_label: str, y_label: str, x_range: tuple[float, float], y_range: tuple[float, float]
) -> figure:
    """Return an empty plot with a logarithmic x axis and a linear y axis."""
    return _empty(x_label, y_label, x_range, y_range=y_range, x_axis_type="log")


def linear_figure(
    x_label: str, y_label: str, x_range: tuple[float, float], y_range: tuple[float, float] | None
) -> figure:
    """Return an empty plot with two linear axes; without y_range it follows the data."""
    ranges = {} if y_range is None else {"y_range": y_range}
    return _empty(x_label, y_label, x_range, **ranges)


def _empty(x_label: str, y_label: str, x_range: tuple[float, float], **axes: Any) -> figure:
    plot = figure(
        x_range=x_range,
        tools=tools(),
        sizing_mode="stretch_both",
        **axes,
    )
    plot.xaxis.axis_label, plot.yaxis.axis_label = x_label, y_label
    plot.axis.major_label_policy = NoOverlap()
    _plain(plot)
    return plot


def empty_map(name: str, x_range: Range1d, y_range: Range1d, *, rgba: bool, label: str) -> figure:
    """Return an empty map over both sides; its source has the name `name`.

    Parameters
    ----------
    name : str
        Name of the source; of its colours and of its colour bar with what they are behind it.
    x_range, y_range : Range1d
        Shared by maps that move together.
    rgba : bool
        Whether the image is of colours instead of numbers; its bar is then that of cividis.
    label : str
        Of the colour bar.
    """
    plot = figure(
        x_range=x_range,
        y_range=y_range,
        tools=tools(),
        sizing_mode="stretch_both",
    )
    source = ColumnDataSource({"image": [], "x": [], "y": [], "dw": [], "dh": []}, name=name)
    mapper = LinearColorMapper(palette=Cividis256, low=-1, high=1, name=f"{name} colours")
    if rgba:
        plot.image_rgba("image", "x", "y", "dw", "dh", source=source)
    else:
        plot.image("image", "x", "y", "dw", "dh", source=source, color_mapper=mapper)
    bar = ColorBar(color_mapper=mapper, title=label, name=f"{name} bar", width=14, padding=4)
    plot.add_layout(bar, "right")
    border = BoxAnnotation(left=0, right=1, bottom=0, top=1, fill_alpha=0, line_width=1)
    border.name, border.tags = f"{name} border", themed(line_color="line")
    plot.add_layout(border)
    plot.min_border_left, plot.min_border_right = _BORDERS  # so that maps side by side are alike
    plot.grid.visible = False
    plot.xaxis.axis_label, plot.yaxis.axis_label = "x / L", "y / L"
    _plain(plot)
    return plot


def tools(*, match_aspect: bool = False) -> list[Tool]:
    """Return the tools of a plot, for the mouse; the wheel is left to the page.

    Parameters
    ----------
    match_aspect : bool
        Whether a box that is zoomed to keeps the ratio of the axes.
    """
    zooms = [ZoomInTool(factor=_ZOOM), ZoomOutTool(factor=_ZOOM)]
    return [PanTool(), BoxZoomTool(match_aspect=match_aspect), *zooms, ResetTool(), SaveTool()]


def themed(**colours: str) -> list[Any]:
    """Return the tag of a model whose colours follow the theme of the page.

    Parameters
    ----------
    colours : str
        Names of the colours in the style of the page, such as "dark-line", by the attributes of
        the model, such as ``line_color``.
    """
    return [{"colours": colours}]


def _plain(plot: figure) -> None:
    """Leave out what is no data, until it is asked for."""
    plot.toolbar.logo = None
    plot.toolbar.autohide = True
