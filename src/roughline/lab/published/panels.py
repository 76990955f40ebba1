"""The panels of the view "The paper"."""

from __future__ import annotations

from roughline.lab.panels import FORCE, AxisRange, Panel, band, estimates, line, marks
from roughline.lab.published.controls import DIMENSIONS

_MARKERS = ("circle", "square", "diamond", "triangle", "inverted_triangle", "plus")
_WINDOWS = ("solid", "dashed", "dotted")  # of the published reduced model
_EVERY = [(f"{d:g}", f"ramp-{i}", _MARKERS[i]) for i, d in enumerate(DIMENSIONS)]
_CURVES = (
    *(band(f"{d} mean", "", colour, line_dash="dashed") for d, colour, _ in _EVERY),
    *(line(f"{d} sure", "", colour, 1.6) for d, colour, _ in _EVERY),
    *(marks(f"{d} marks", d, colour, size=6, marker=m) for d, colour, m in _EVERY),
)
"""Of each fractal dimension, with its standard error; dashed where the grid decides."""


def _stiffness(model: str, title: str, ranges: tuple[AxisRange, AxisRange]) -> Panel:
    """Figure 3 or 4, with the laws that are fitted in a window."""
    laws = (
        line("saturated", "", "theory", 1, line_dash="dotted"),
        line("fits", "", "text", 1.5, line_dash="dashed"),
    )
    series = (*_CURVES, *laws)
    return Panel(f"stiffness-{model}", title, FORCE, "stiffness k̄", series, ranges=ranges)


PANELS = (
    _stiffness(
        "1D", "Figure 3: stiffness over force, reduced model, lines", ((3e-6, 10), (1e-4, 1.6))
    ),
    _stiffness(
        "3D", "Figure 4: stiffness over force, full model, surfaces", ((6e-4, 10), (5e-3, 1.6))
    ),
    Panel(
        key="exponents",
        title="Figure 5: exponent over fractal dimension",
        x="fractal dimension",
        y="exponent α",
        series=(
            *(
                band(f"{i}", "", "light-line", 0.3, line_dash=dash, line_width=1.5)
                for i, dash in enumerate(_WINDOWS)
            ),
            line("scaling", "scaling argument", "text", 1.5, line_dash="dashed"),
            line("linear", "line of §7", "text", 1.5, line_dash="dotted"),
            estimates("1D", "1D, window chosen", "here", marker="triangle"),
            estimates("3D", "3D, window chosen", "dark-line", marker="circle"),
        ),
        ranges=((1.97, 3.25), (0.4, 1.02)),
        is_logarithmic=False,
    ),
)
"""Panels of curves; those of the trust map are made by the page."""
