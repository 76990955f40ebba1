"""The empty figures of the view "Explore", as Bokeh draws them."""

from __future__ import annotations

from bokeh.models import ColumnDataSource, Range1d, Span
from bokeh.plotting import figure

from roughline.lab.plots import embedded, empty_map, log_figure

_FORCE = "force F / (E* h L)"


def figures() -> bytes:
    """All of them; their data come later, into sources of these names."""
    x, y = Range1d(0, 1, bounds="auto"), Range1d(0, 1, bounds="auto")
    topography = empty_map("topography", x, y, colours="rgba", label="height / h")
    contact = empty_map("contact", x, y, colours="cividis", label="")
    return embedded(
        {
            "explore-topography": topography,
            "explore-contact": contact,
            "explore-stiffness": _stiffness(),
            "explore-area": _area(),
            "explore-spectrum": _spectrum(),
        }
    )


def _stiffness() -> figure:
    plot = log_figure(_FORCE, "stiffness k̄", (1e-4, 10), (1e-3, 1.6))
    line = ColumnDataSource({"x": [], "y": [], "low": [], "high": []}, name="stiffness line")
    plot.varea("x", "low", "high", source=line, fill_alpha=0.25, legend_label="1D, single lines")
    plot.line("x", "y", source=line, line_width=2, legend_label="1D, mean of lines")
    _draw_loads(plot, "stiffness")
    return plot


def _area() -> figure:
    plot = log_figure(_FORCE, "real contact area A / A_0", (1e-4, 10), (1e-4, 1.3))
    _draw_loads(plot, "area")
    return plot


def _spectrum() -> figure:
    plot = log_figure("waves in the side, q L / 2π", "C_2d [m⁴]", None, None)
    source = ColumnDataSource({"x": [], "y": [], "law": []}, name="spectrum")
    plot.scatter("x", "y", source=source, size=4)
    plot.line("x", "law", source=source, line_width=2)
    return plot


def _draw_loads(plot: figure, name: str) -> None:
    """Add theories, the loads of the full model, the present one, and the cursor that sets it."""
    theories = ColumnDataSource({"xs": [], "ys": [], "name": []}, name=f"{name} theories")
    plot.multi_line("xs", "ys", source=theories, line_dash="dashed", line_width=1.5)
    for what, label, size, fill in (
        ("curve", "3D", 7, 1.0),
        ("unsure", "3D, the grid decides", 7, 0.0),
        ("here", "3D, this load", 12, 1.0),
    ):
        source = ColumnDataSource({"x": [], "y": []}, name=f"{name} {what}")
        plot.scatter("x", "y", source=source, size=size, fill_alpha=fill, legend_label=label)
    plot.add_layout(
        Span(dimension="height", location=0.1, line_width=3, editable=True, name=f"{name} cursor")
    )
    plot.legend.location = "bottom_right"
