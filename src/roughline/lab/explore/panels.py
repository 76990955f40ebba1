"""The panels of the view "Explore", and what is drawn alike in several of them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.lab.controls import Choice
from roughline.lab.explore.controls import CHOICES
from roughline.lab.panels import (
    FORCE,
    Panel,
    Points,
    Series,
    band,
    joined,
    line,
    marks,
    theory_lines,
)


def over_force(
    key: str, title: str, y: str, lines: tuple[Series, ...], theories: Choice | None, **others: Any
) -> Panel:
    """Loads of the full model over force: those of the curve, and the present one."""
    return Panel(
        key=key,
        title=title,
        x=FORCE,
        y=y,
        series=(
            *lines,
            *(theory_lines(theories.options) if theories else ()),
            marks("curve", "3D", "dark-line", size=7, marker="circle"),
            marks("unsure", UNRESOLVED_3D, "dark-line", size=7, marker="circle", fill_alpha=0),
            marks("here", "this load", "here", size=13, marker="circle"),
        ),
        cursor="height",
        **others,
    )


UNRESOLVED_3D = "3D, fewer than ten cells touch"
"""Name of loads whose contact the grid decides."""
BACK = joined("back", "3D, way back", "here", size=5, marker="square")
"""The way back from the present load."""


def selected_points(
    x: NDArray[Any], y: NDArray[Any], wanted: NDArray[np.bool_] | None = None
) -> Points:
    """Points that are wanted, at loads and values that are positive unless they say others."""
    wanted = (x > 0) & (y > 0) if wanted is None else wanted
    return {"x": x[wanted], "y": y[wanted]}


def loads(
    force_bar: NDArray[Any], values: NDArray[Any], pressed: rl.SurfaceCurve
) -> dict[str, Points]:
    """Loads of a curve, apart from those with too few cells in contact."""
    is_known = pressed.converged & (values > 0)
    return {
        "curve": selected_points(force_bar, values, is_known & pressed.resolved),
        "unsure": selected_points(force_bar, values, is_known & ~pressed.resolved),
    }


def curve_note(pressed: rl.SurfaceCurve, n: int) -> str:
    """Say what the marks of a curve are, and which loads have none."""
    failed = int((~pressed.converged).sum())
    unsure = "" if pressed.resolved.all() else "; * in the table: fewer than ten cells touch"
    unsolved = f"; {failed} loads were not solved" if failed else ""
    return f"marks of the curve on {n}² points{unsure}{unsolved}"


_CURVE_TASK: dict[str, Any] = {
    "theories": CHOICES["theories"],
    "task": "curve",
    "waits": "the surface is being pressed under every load",
}

PANELS = (
    over_force(
        key="stiffness",
        title="Stiffness over force",
        y="stiffness k / (E* L)",
        lines=(band("line", "1D, mean and range of lines", "light-line", line_width=2.5),),
        ranges=((1e-4, 10.0), (1e-3, 3)),
        columns=("F̄", "k / (E* L)", "model"),
        **_CURVE_TASK,
    ),
    over_force(
        key="area",
        title="Area over force",
        y="real contact area A / A₀",
        lines=(),
        ranges=((1e-4, 10.0), (1e-4, 1.3)),
        columns=("F̄", "A/A₀", "model"),
        **_CURVE_TASK,
    ),
    Panel(
        key="spectrum",
        title="Spectrum",
        x="waves along the side, q L / 2π",
        y="spectrum C [m⁴]",
        ranges=((0.8, 300.0), (1e-20, 1e-10)),
        series=(
            marks("surface", "the surface", "mark", size=4, line_width=1),
            line("law", "the law", "here", 2),
        ),
        columns=("waves along the side", "C [m⁴]", "law [m⁴]"),
        task="contact",
        waits="the spectrum follows with the whole grid",
    ),
)
"""Panels that are always there; the first stands alone, the others share their place."""
