"""The empty figures of the view "The paper", as Bokeh draws them."""

from __future__ import annotations

from bokeh.models import BoxAnnotation, BoxSelectTool, ColumnDataSource, Range1d, Span, Whisker
from bokeh.palettes import Viridis256
from bokeh.plotting import figure

from roughline.lab.plots import embedded, linear_figure, log_figure
from roughline.lab.published.controls import DIMENSIONS, MODELS, ROLL_OFF

_FORCE = "force F / (E* h L)"
_FORCES = {"1D": (1e-5, 10), "3D": (1e-3, 10)}
_STIFFNESSES = {"1D": (1e-4, 1.6), "3D": (5e-3, 1.6)}
_HATCH = {
    "hatch_pattern": "right_diagonal_line",
    "hatch_color": "#1c1c1a",
    "hatch_alpha": 0.7,
    "hatch_scale": 7,
    "hatch_weight": 0.8,
}


def figures() -> bytes:
    """All of them; their data come later, into sources of these names."""
    plots = {f"published-stiffness-{model}": _stiffness(model) for model in MODELS}
    plots |= {
        "published-exponents": _exponents(),
        "published-area": _area(),
        "published-kappa": _kappa(),
    }
    dimensions, forces = Range1d(1.95, 3.05), Range1d(7.5e-4, 4.217)
    for roll_off in ROLL_OFF.options:
        plots[f"published-trust-{roll_off}"] = _trust(roll_off, forces, dimensions)
    return embedded(plots)


def _stiffness(model: str) -> figure:
    """Figure 3 or 4: mean curves with their standard error, the window and the fits in it."""
    plot = log_figure(_FORCE, "stiffness k̄", _FORCES[model], _STIFFNESSES[model])
    plot.add_tools(BoxSelectTool(dimensions="width", renderers=[]))
    plot.toolbar.active_drag = plot.tools[-1]
    plot.add_layout(_window(f"window {model}", editable=True))
    plot.add_layout(_dotted("width", f"saturated {model}"))
    name = f"stiffness {model}"
    bands = ColumnDataSource({"xs": [], "ys": [], "colour": []}, name=f"{name} bands")
    plot.patches("xs", "ys", source=bands, fill_color="colour", fill_alpha=0.25, line_color=None)
    _draw_curves(plot, name)
    fits = ColumnDataSource({"xs": [], "ys": []}, name=f"{name} fits")
    law = plot.multi_line("xs", "ys", source=fits, line_width=1.5, line_dash="dashed")
    law.glyph.tags = [{"colours": {"line_color": "text"}}]
    _name_dimensions(plot)
    return plot


def _draw_curves(plot: figure, name: str) -> None:
    """Add curves with marks, dashed where the grid decides."""
    for what, width, dash in (("sure", 1.6, "solid"), ("unsure", 1.0, "dashed")):
        source = ColumnDataSource({"xs": [], "ys": [], "colour": []}, name=f"{name} {what}")
        plot.multi_line(
            "xs", "ys", source=source, line_color="colour", line_width=width, line_dash=dash
        )
    empty: dict[str, list[float]] = {key: [] for key in ("x", "y", "colour", "marker", "D_f")}
    marks = ColumnDataSource(empty, name=f"{name} marks")
    plot.scatter(
        "x",
        "y",
        source=marks,
        marker="marker",
        size=6,
        color="colour",
        legend_field="D_f",
    )


def _name_dimensions(plot: figure) -> None:
    """Say which mark is which fractal dimension."""
    plot.legend.location, plot.legend.title = "bottom_right", "D_f"
    plot.legend.tags = [{"colours": {"title_text_color": "text"}}]


def _exponents() -> figure:
    """Figure 5: exponents of both models, and the two predictions."""
    plot = linear_figure("fractal dimension D_f", "exponent α", (1.97, 3.03), (0.4, 1.02))
    dashes = ("solid", "dashed", "dotted")
    for i, dash in enumerate(dashes):
        empty: dict[str, list[float]] = {key: [] for key in ("x", "y", "low", "high", "label")}
        source = ColumnDataSource(empty, name=f"exponents {i}")
        band = plot.varea("x", "low", "high", source=source, fill_alpha=0.3)
        line = plot.line("x", "y", source=source, line_dash=dash, line_width=1.5)
        line.name = f"exponents line {i}"
        band.glyph.tags = [{"colours": {"fill_color": "light-line"}}]
        line.glyph.tags = [{"colours": {"line_color": "light-line"}}]
    for key, dash, label in (
        ("scaling", "dashed", "1 / (4 - D_f)"),
        ("linear", "dotted", "0.2567 D_f"),
    ):
        source = ColumnDataSource({"x": [], "y": []}, name=f"prediction {key}")
        line = plot.line(
            "x", "y", source=source, line_dash=dash, line_width=1.5, legend_label=label
        )
        line.glyph.tags = [{"colours": {"line_color": "text"}}]
    for model, marker, colour in (("1D", "triangle", "here"), ("3D", "circle", "dark-line")):
        label = f"{model}, the window chosen"
        _draw_with_intervals(plot, f"exponents {model}", marker, colour, label)
    plot.legend.location = "top_left"
    return plot


def _draw_with_intervals(
    plot: figure, name: str, marker: str, colour: str, label: str, *, filled: bool = True
) -> None:
    """Add marks with their 95 % intervals."""
    source = ColumnDataSource({"x": [], "y": [], "low": [], "high": []}, name=name)
    whisker = Whisker(base="x", lower="low", upper="high", source=source, level="overlay")
    whisker.tags = [{"colours": {"line_color": colour}}]
    for head in (whisker.upper_head, whisker.lower_head):
        head.size = 7
        head.tags = [{"colours": {"line_color": colour}}]
    plot.add_layout(whisker)
    marks = plot.scatter("x", "y", source=source, marker=marker, size=8, legend_label=label)
    marks.glyph.fill_alpha = 1.0 if filled else 0.0
    marks.glyph.tags = [{"colours": {"fill_color": colour, "line_color": colour}}]


def _area() -> figure:
    """The real contact area over force."""
    plot = log_figure(_FORCE, "real contact area A / A_0", (1e-3, 10), (1e-6, 1.3))
    plot.add_layout(_window("window area", editable=False))
    _draw_curves(plot, "area")
    plot.tags = [_colours()]
    _name_dimensions(plot)
    return plot


def _colours() -> dict[str, list[str]]:
    """Colours of the fractal dimensions as in the figures: viridis without its palest end.

    On a dark page it goes without its darkest end instead.
    """
    shares = [i / (len(DIMENSIONS) - 1) for i in range(len(DIMENSIONS))]
    return {
        "light": [Viridis256[round(255 * 0.88 * share)] for share in shares],
        "dark": [Viridis256[round(255 * (0.3 + 0.7 * share))] for share in shares],
    }


def _kappa() -> figure:
    """κ of eq. 4 over fractal dimension, beside two theories."""
    plot = linear_figure("fractal dimension D_f", "κ = A E* ∇h / F", (1.95, 3.05), (0, 6))
    for name, dash in (("Bush, Gibson, Thomas", "dashed"), ("Persson", "dotted")):
        source = ColumnDataSource({"x": [], "y": []}, name=f"kappa {name}")
        line = plot.line("x", "y", source=source, line_dash=dash, line_width=1.5, legend_label=name)
        line.glyph.tags = [{"colours": {"line_color": "theory"}}]
    _draw_with_intervals(plot, "kappa corrected", "circle", "dark-line", "area corrected")
    _draw_with_intervals(plot, "kappa cells", "triangle", "here", "area in cells", filled=False)
    plot.legend.location = "top_left"
    return plot


def _trust(roll_off: str, forces: Range1d, dimensions: Range1d) -> figure:
    """One panel of the trust map, with the point that is asked about."""
    plot = figure(
        x_axis_type="log",
        x_range=forces,
        y_range=dimensions,
        tools="",
        sizing_mode="stretch_both",
        title=f"q_r/q_0 = {roll_off}",
    )
    sides = ("left", "right", "bottom", "top")
    for name, look in (
        (f"trust {roll_off}", {"fill_color": "colour", "line_color": "colour"}),
        (f"trust {roll_off} unsure", {"fill_color": None, "line_color": None, **_HATCH}),
    ):
        empty: dict[str, list[float]] = {key: [] for key in (*sides, "colour")}
        source = ColumnDataSource(empty, name=name)
        plot.quad(**{side: side for side in sides}, source=source, **look)
    point = ColumnDataSource({"x": [], "y": []}, name=f"trust point {roll_off}")
    for colour, width in (("#ffffff", 5), ("#000000", 2)):  # seen on any colour
        plot.scatter(
            "x",
            "y",
            source=point,
            marker="circle",
            size=15,
            fill_alpha=0,
            line_color=colour,
            line_width=width,
        )
    plot.grid.visible = False
    plot.xaxis.axis_label, plot.yaxis.axis_label = "F̄", "D_f"
    plot.toolbar_location = None
    return plot


def _window(name: str, *, editable: bool) -> BoxAnnotation:
    """A range of loads, shaded."""
    return BoxAnnotation(
        name=name,
        editable=editable,
        movable="x",
        resizable="x",
        fill_alpha=0.12,
        line_alpha=0.6,
        level="underlay",
        tags=[{"colours": {"fill_color": "quiet", "line_color": "quiet"}}],
    )


def _dotted(dimension: str, name: str) -> Span:
    return Span(
        dimension=dimension,
        line_dash="dotted",
        line_width=1.2,
        name=name,
        tags=[{"colours": {"line_color": "theory"}}],
    )
