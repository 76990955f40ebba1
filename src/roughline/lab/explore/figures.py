"""The empty figures of the view "Explore", as Bokeh draws them."""

from __future__ import annotations

from bokeh.models import ColumnDataSource, Range1d, Span
from bokeh.plotting import figure

from roughline.lab.plots import embedded, empty_map, log_figure, themed

_FORCE = "force F / (E* h L)"
_FORCES = (1e-4, 10.0)
_MARKS = (  # of the full model, and how they look
    ("curve", "3D", "circle", 7, "dark-line", True),
    ("unsure", "3D, fewer than ten cells touch", "circle", 7, "dark-line", False),
    ("unloading", "3D, on unloading", "triangle", 7, "mark", False),
    ("back", "3D, way back from this load", "square", 5, "here", True),
    ("here", "3D, this load", "circle", 13, "here", True),
)


def figures() -> bytes:
    """All of them; their data come later, into sources of these names."""
    x, y = Range1d(0, 1), Range1d(0, 1)
    return embedded(
        {
            "explore-topography": empty_map("topography", x, y, rgba=True, label="height / h"),
            "explore-contact": empty_map("contact", x, y, rgba=False, label=""),
            "explore-stiffness": _stiffness(),
            "explore-area": _area(),
            "explore-spectrum": _spectrum(),
        }
    )


def _stiffness() -> figure:
    plot = log_figure(_FORCE, "stiffness k̄", _FORCES, (1e-3, 1.6))
    line = ColumnDataSource({"x": [], "y": [], "low": [], "high": []}, name="stiffness line")
    look = {"source": line, "legend_label": "1D, mean and range of single lines"}
    band = plot.varea("x", "low", "high", fill_alpha=0.25, **look)
    band.glyph.tags = themed(fill_color="light-line")
    mean = plot.line("x", "y", line_width=2.5, **look)
    mean.glyph.tags = themed(line_color="light-line")
    _draw_loads(plot, "stiffness")
    return plot


def _area() -> figure:
    plot = log_figure(_FORCE, "real contact area A / A₀", _FORCES, (1e-4, 1.3))
    _draw_loads(plot, "area")
    return plot


def _spectrum() -> figure:
    plot = log_figure("waves along the side, q L / 2π", "C_2d [m⁴]", (0.8, 300), (1e-20, 1e-10))
    source = ColumnDataSource({"x": [], "y": [], "law": []}, name="spectrum")
    marks = plot.scatter("x", "y", source=source, size=4)
    marks.glyph.tags = themed(fill_color="mark", line_color="mark")
    law = plot.line("x", "law", source=source, line_width=2)
    law.glyph.tags = themed(line_color="here")
    return plot


def _draw_loads(plot: figure, name: str) -> None:
    """Add theories, the loads of the full model, the present one, and the cursor that sets it."""
    for i, dashes in enumerate(("dashed", "dotted", "dashdot")):
        source = ColumnDataSource({"x": [], "y": []}, name=f"{name} theory {i}")
        curve = plot.line("x", "y", source=source, line_dash=dashes, line_width=2)
        curve.glyph.tags = themed(line_color="theory")
    for what, label, marker, size, colour, filled in _MARKS:
        source = ColumnDataSource({"x": [], "y": []}, name=f"{name} {what}")
        look = {"source": source, "legend_label": label}
        if what == "back":
            line = plot.line("x", "y", line_width=2, **look)
            line.glyph.tags = themed(line_color=colour)
        marks = plot.scatter(
            "x",
            "y",
            marker=marker,
            size=size,
            line_width=1.5,
            fill_alpha=float(filled),
            **look,
        )
        marks.glyph.tags = themed(fill_color=colour, line_color=colour)
        item = plot.legend.items[-1]
        item.name = f"{name} {what} label"
        item.visible = what in ("curve", "here")  # the others are shown if there are any
    cursor = Span(dimension="height", location=0.1, line_width=3, editable=True)
    cursor.name, cursor.tags = f"{name} cursor", themed(line_color="here", hover_line_color="mark")
    plot.add_layout(cursor)
    plot.legend.location = "bottom_right"
