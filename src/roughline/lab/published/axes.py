"""Empty plots with linear axes, as this view has them."""

from __future__ import annotations

from bokeh.plotting import figure

_TOOLS = "pan,wheel_zoom,box_zoom,reset,save"


def linear_figure(
    x_label: str, y_label: str, x_range: tuple[float, float], y_range: tuple[float, float] | None
) -> figure:
    """Return an empty plot with two linear axes; without y_range it follows the data."""
    ranges = {} if y_range is None else {"y_range": y_range}
    plot = figure(
        tools=_TOOLS,
        active_scroll="wheel_zoom",
        x_range=x_range,
        sizing_mode="stretch_both",
        **ranges,
    )
    plot.xaxis.axis_label, plot.yaxis.axis_label = x_label, y_label
    plot.toolbar.logo = None
    plot.toolbar.autohide = True
    return plot
