"""How plots of the lab look, and how they reach the page."""

from __future__ import annotations

from collections.abc import Mapping

from bokeh.document import Document
from bokeh.embed.util import standalone_docs_json_and_render_items
from bokeh.models import ColorBar, ColumnDataSource, LinearColorMapper, Range1d
from bokeh.palettes import Cividis256, Viridis256
from bokeh.plotting import figure

from roughline.lab.frames import frame

_TOOLS = "pan,wheel_zoom,box_zoom,reset,save"
_PALETTES = {"cividis": Cividis256, "viridis": Viridis256}


def embedded(plots: Mapping[str, figure]) -> bytes:
    """Return plots as BokehJS embeds them, in one document, so that they may share ranges.

    Parameters
    ----------
    plots : mapping of str to figure
        By the element of the page that each belongs to, without its prefix "plot-".
    """
    document = Document()
    for element, plot in plots.items():
        plot.name = element
        document.add_root(plot)
    documents, (item, *_) = standalone_docs_json_and_render_items(document)
    places = {plot.id: f"plot-{element}" for element, plot in plots.items()}
    return frame({"documents": documents, "items": [{**item.to_json(), "roots": places}]})


def log_figure(
    x_label: str,
    y_label: str,
    x_range: tuple[float, float] | None,
    y_range: tuple[float, float] | None,
) -> figure:
    """Return an empty plot with two logarithmic axes."""
    ranges = {"x_range": x_range, "y_range": y_range}
    plot = figure(
        x_axis_type="log",
        y_axis_type="log",
        tools=_TOOLS,
        sizing_mode="stretch_both",
        output_backend="canvas",
        **{name: value for name, value in ranges.items() if value is not None},
    )
    plot.xaxis.axis_label, plot.yaxis.axis_label = x_label, y_label
    plot.toolbar.logo = None
    plot.toolbar.autohide = True
    return plot


def empty_map(name: str, x_range: Range1d, y_range: Range1d, *, colours: str, label: str) -> figure:
    """Return an empty map over both sides; its source has the name `name`.

    Parameters
    ----------
    name : str
        Name of the source, of its colours and of its colour bar.
    x_range, y_range : Range1d
        Shared by maps that move together.
    colours : {"cividis", "viridis", "rgba"}
        Palette; "rgba" takes colours instead of numbers, and its bar is that of cividis.
    label : str
        Of the colour bar.
    """
    plot = figure(
        x_range=x_range,
        y_range=y_range,
        match_aspect=True,
        tools=_TOOLS,
        active_scroll="wheel_zoom",
        sizing_mode="stretch_both",
    )
    source = ColumnDataSource({"image": [], "x": [], "y": [], "dw": [], "dh": []}, name=name)
    mapper = LinearColorMapper(
        palette=_PALETTES.get(colours, Cividis256), low=-1, high=1, name=f"{name} colours"
    )
    glyph = {"image": "image", "x": "x", "y": "y", "dw": "dw", "dh": "dh", "source": source}
    if colours == "rgba":
        plot.image_rgba(**glyph)
    else:
        plot.image(**glyph, color_mapper=mapper)
    plot.add_layout(ColorBar(color_mapper=mapper, title=label, name=f"{name} bar"), "right")
    plot.grid.visible = False
    plot.xaxis.axis_label, plot.yaxis.axis_label = "x / L", "y / L"
    plot.toolbar.logo = None
    plot.toolbar.autohide = True
    return plot
