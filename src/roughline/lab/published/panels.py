"""The panels of the view "The paper"."""

from __future__ import annotations

from roughline.lab.panels import FORCE, Panel, Range, Series, line, marks
from roughline.lab.published.controls import DIMENSIONS

MARKERS = ("circle", "square", "diamond", "triangle", "inverted_triangle", "plus")
"""Of fractal dimensions, as in the figures of the page."""
_BAND = {"fill_alpha": 0.3}
_WINDOWS = ("solid", "dashed", "dotted")  # of the published reduced model
_KAPPAS = {"Bush, Gibson, Thomas": "dashed", "Persson": "dotted"}


def _curves(key: str, title: str, y: str, ranges: tuple[Range, Range], *others: Series) -> Panel:
    """A curve for each fractal dimension with its standard error, dashed where the grid decides."""
    every = [(f"{each:g}", f"ramp-{i}", MARKERS[i]) for i, each in enumerate(DIMENSIONS)]
    band = {"varea": {"fill_alpha": 0.25}, "line": {"line_dash": "dashed"}}
    return Panel(
        *(key, title, FORCE, y),
        series=(
            *(Series(f"{name} mean", "", colour, band) for name, colour, _ in every),
            *(line(f"{name} sure", "", colour, 1.6) for name, colour, _ in every),
            *(
                marks(f"{name} marks", f"D_f = {name}", colour, size=6, marker=marker, line_width=1)
                for name, colour, marker in every
            ),
            *others,
        ),
        ranges=ranges,
    )


def _stiffness(model: str, number: int, bodies: str, ranges: tuple[Range, Range]) -> Panel:
    """Figure 3 or 4, with the laws that are fitted in a window."""
    return _curves(
        *(f"stiffness-{model}", f"Figure {number}: stiffness over force, {bodies}", "stiffness k̄"),
        ranges,
        line("saturated", "", "theory", 1, line_dash="dotted"),
        line("fits", "", "text", 1.5, line_dash="dashed"),
    )


def _estimates(name: str, legend: str, colour: str, **look: object) -> Series:
    return Series(name, legend, colour, {"scatter": {"size": 8, **look}, "whisker": {"size": 8}})


PANELS = (
    _stiffness("1D", 3, "reduced model, lines", ((1e-5, 10), (1e-4, 1.6))),
    _stiffness("3D", 4, "full model, surfaces", ((1e-3, 10), (5e-3, 1.6))),
    Panel(
        *("exponents", "Figure 5: exponent over fractal dimension"),
        *("fractal dimension", "exponent α"),
        series=(
            *(
                Series(
                    *(f"{i}", "", "light-line"),
                    {"varea": _BAND, "line": {"line_dash": dash, "line_width": 1.5}},
                )
                for i, dash in enumerate(_WINDOWS)
            ),
            line("scaling", "scaling argument", "text", 1.5, line_dash="dashed"),
            line("linear", "line of §7", "text", 1.5, line_dash="dotted"),
            _estimates("1D", "1D, window chosen", "here", marker="triangle"),
            _estimates("3D", "3D, window chosen", "dark-line", marker="circle"),
        ),
        ranges=((1.97, 3.03), (0.4, 1.02)),
        is_logarithmic=False,
    ),
    _curves(
        *("area", "Area law: real contact area over force", "real contact area A / A₀"),
        ((1e-3, 10), (1e-6, 1.3)),
    ),
    Panel(
        *("kappa", "Area law: κ of eq. 4", "fractal dimension", "κ = A E* ∇h / F"),
        series=(
            *(line(name, name, "theory", 1.5, line_dash=dash) for name, dash in _KAPPAS.items()),
            _estimates("corrected", "area corrected", "dark-line", marker="circle"),
            _estimates("cells", "area in cells", "here", marker="triangle", fill_alpha=0),
        ),
        ranges=((1.95, 3.05), (0, 4.6)),
        is_logarithmic=False,
    ),
)
"""Panels of curves; those of the trust map are made by the page."""
