"""The panels of the view "My surface"."""

from __future__ import annotations

from roughline.lab.explore.controls import CHOICES
from roughline.lab.panels import FORCE, Panel, Series, band, estimates, line, marks, theory_lines

_OPEN = {"line_width": 2, "fill_alpha": 0}


def _over_force(key: str, title: str, y: str) -> Panel:
    """A quantity over force with its interval; open marks where the grid decides."""
    series = (
        Series("interval", "interval", "dark-line", {"varea": {"fill_alpha": 0.25}}),
        *theory_lines(CHOICES["theories"].options),
        line("line", "", "theory", 1),
        marks("loads", "loads", "dark-line", size=6),
        marks("unsure", "the grid decides", "dark-line", size=6, fill_alpha=0),
        marks("asked", "as asked", "here", size=13, **_OPEN),
    )
    return Panel(key, title, "force F", y, series)


PANELS = (
    Panel(
        key="file-line",
        title="Heights as the file has them",
        x="x",
        y="height",
        series=(
            line("heights", "", "dark-line", 1.2),
            marks("spikes", "spikes", "here", size=11, marker="circle", **_OPEN),
            marks("missing", "missing points", "here", size=8, marker="x", **_OPEN),
        ),
        columns=("heights", ""),
        is_logarithmic=False,
    ),
    Panel(
        key="prepared-line",
        title="Before and after",
        x="x",
        y="height",
        series=(line("before", "before", "theory", 1.2), line("after", "after", "dark-line", 1.2)),
        columns=("heights", "before", "after"),
        is_logarithmic=False,
    ),
    Panel(
        key="spectrum",
        title="Spectrum",
        x="wavenumber q = 2π/λ [1/m]",
        y="spectrum C [m⁴]",
        series=(
            marks("spectrum", "this surface", "dark-line", size=3.5, line_width=1),
            line("law", "nearest self-affine law", "here", 2.5),
        ),
    ),
    _over_force("stiffness", "Stiffness over force", "stiffness k").with_series(
        line("unloading", "on unloading", "mark", 1.5, line_dash="dashed")
    ),
    _over_force("area", "Area over force", "real contact area A / A₀"),
    Panel(
        key="models",
        title="Stiffness of both models",
        x=FORCE,
        y="raw stiffness k / (E* L)",
        series=(
            band("full", "full model, this surface", "dark-line", size=6, line_width=2),
            band("reduced", "reduced model, mean of lines", "light-line", size=6, line_width=2),
        ),
    ),
    Panel(
        key="part",
        title="The maps beside each other",
        x="",
        y="",
        series=(
            band("mean", "mean, and the interval for the part", "here", 0.2, line_width=2),
            estimates("maps", "each map and its interval", "dark-line"),
        ),
        columns=("map", "value", "from", "to"),
        of_places=True,
    ),
)
"""Panels of curves."""
