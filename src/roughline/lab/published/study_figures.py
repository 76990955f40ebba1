"""The figures of the studies beside the paper's, drawn with their data."""

from __future__ import annotations

from bokeh.models import ColumnDataSource, Whisker
from bokeh.plotting import figure

from roughline.lab.plots import embedded, linear_figure, semilog_figure, themed
from roughline.lab.published.controls import element_of
from roughline.paper.studies import StudyCurve, StudyPanel, study_summaries

_COLUMNS = 2  # of the legend: three are wider than a phone
_MARKERS = ("circle", "square", "triangle", "diamond", "inverted_triangle", "plus")


def figures() -> bytes:
    """All of them, by the elements of :func:`element_of`."""
    return embedded(
        {
            element_of(study.name, i): _drawn(panel)
            for study in study_summaries()
            for i, panel in enumerate(study.panels)
        }
    )


def _drawn(panel: StudyPanel) -> figure:
    empty = semilog_figure if panel.is_log else linear_figure
    (left, right), (bottom, top) = panel.x_range, panel.y_range
    plot = empty(panel.x_label, panel.y_label, (left, right), (bottom, top))
    for curve in panel.curves:
        _draw(plot, curve)
    legend = plot.legend[0]
    legend.ncols, legend.spacing, legend.location = _COLUMNS, 12, "center"
    legend.glyph_height = legend.label_height = 12  # [pixel] room for the curves instead
    plot.center.remove(legend)
    plot.add_layout(legend, "below")  # inside it would lie on the curves
    return plot


def _draw(plot: figure, curve: StudyCurve) -> None:
    """Draw a curve with its band, or marks with whiskers."""
    names = ("x", "y", "low", "high") if curve.low else ("x", "y")
    source = ColumnDataSource({name: list(getattr(curve, name)) for name in names})
    colour = "text" if curve.colour < 0 else f"ramp-{curve.colour}"
    named = {"legend_label": curve.name} if curve.name else {}
    if curve.marks:
        if curve.low:
            whisker = Whisker(base="x", lower="low", upper="high", source=source)
            whisker.tags = themed(line_color=colour)
            for head in (whisker.upper_head, whisker.lower_head):
                head.size, head.tags = 6, themed(line_color=colour)
            plot.add_layout(whisker)
        marker = _MARKERS[curve.colour % len(_MARKERS)]
        marks = plot.scatter("x", "y", source=source, marker=marker, size=7, **named)
        marks.glyph.tags = themed(fill_color=colour, line_color=colour)
        return
    if curve.low:
        band = plot.varea("x", "low", "high", source=source, fill_alpha=0.2)
        band.glyph.tags = themed(fill_color=colour)
    line = plot.line("x", "y", source=source, line_dash=curve.dash, line_width=1.5, **named)
    line.glyph.tags = themed(line_color=colour)
