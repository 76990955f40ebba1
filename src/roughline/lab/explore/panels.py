"""Panels of curves: what each draws, under which names and how; the page makes them of this."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

import roughline as rl
from roughline.lab.controls import Choice
from roughline.lab.explore.controls import CHOICES

FORCE = "force F / (E* h L)"
"""Label of an axis."""

_ROOM = 1.2  # factor about what is drawn on logarithmic axes
_ROOM_ABOUT = 0.06  # share about what is drawn on linear ones
_DASHES = ("dashed", "dotted", "dashdot")  # of theories, which black and white tell apart

Points = dict[str, Any]
"""Columns of what is drawn: x and y, or low and high. Zeros stand at the foot of a logarithm."""


@dataclass(frozen=True)
class Series:
    """Points that are drawn alike."""

    name: str
    legend: str
    colour: str  # of the theme
    glyphs: Mapping[str, Mapping[str, Any]]  # how each is drawn, by their names in Bokeh
    edge: str = ""  # colour of the outline, if it is another


@dataclass(frozen=True)
class Panel:
    """Curves over the same axes."""

    key: str
    title: str
    x: str  # label of the axis
    y: str
    ranges: tuple[tuple[float, float], tuple[float, float]]  # before anything is drawn
    series: tuple[Series, ...]
    columns: tuple[str, ...]  # heads of the table
    task: str  # whose answer fills it
    waits: str  # what is said while the first is awaited
    is_logarithmic: bool = True
    cursor: Literal["", "height", "width"] = "height"  # how the line of the load lies

    def with_series(self, *others: Series) -> Panel:
        """Return the same panel with more series, each once."""
        known = {each.name for each in self.series}
        new = {each.name: each for each in others if each.name not in known}
        return replace(self, series=(*self.series, *new.values()))


@dataclass
class Filled:
    """What an answer has for a panel; what it does not say stays."""

    series: dict[str, Points] = field(default_factory=dict)
    rows: list[list[str]] | None = None  # of the table; None if the answer is a part of others
    caption: str | None = None
    remarks: str | None = None  # on its theories, below it
    x: tuple[float, float] | None = None  # ranges of the axes
    y: tuple[float, float] | None = None
    legends: dict[str, str] = field(default_factory=dict)  # other names of series


def marks(name: str, legend: str, colour: str, **look: Any) -> Series:
    """Marks without a line."""
    return Series(name, legend, colour, {"scatter": {"line_width": 1.5, **look}})


def theory_lines(theories: Mapping[str, str]) -> tuple[Series, ...]:
    """Lines of theories, each with its dash and its name."""
    return tuple(
        Series(f"theory {name}", called, "theory", {"line": {"line_dash": dash, "line_width": 2}})
        for (name, called), dash in zip(theories.items(), _DASHES, strict=False)
    )


def over_force(
    key: str, title: str, y: str, lines: tuple[Series, ...], theories: Choice | None, **others: Any
) -> Panel:
    """Loads of the full model over force: those of the curve, and the present one."""
    return Panel(
        *(key, title, FORCE, y),
        series=(
            *lines,
            *(theory_lines(theories.options) if theories else ()),
            marks("curve", "3D", "dark-line", size=7, marker="circle"),
            marks("unsure", FEW, "dark-line", size=7, marker="circle", fill_alpha=0),
            marks("here", "3D, this load", "here", size=13, marker="circle"),
        ),
        **others,
    )


FEW = "3D, fewer than ten cells touch"
"""Name of loads whose contact the grid decides."""
BACK = Series(
    *("back", "3D, way back", "here"),
    {"line": {"line_width": 2}, "scatter": {"line_width": 1.5, "size": 5, "marker": "square"}},
)
"""The way back from the present load."""


def kept(x: NDArray[Any], y: NDArray[Any], wanted: NDArray[np.bool_] | None = None) -> Points:
    """Points that are wanted, at loads and values that are positive unless they say others."""
    wanted = (x > 0) & (y > 0) if wanted is None else wanted
    return {"x": x[wanted], "y": y[wanted]}


def loads(force_bar: NDArray[Any], values: NDArray[Any], pressed: rl.Curve) -> dict[str, Points]:
    """Loads of a curve, apart from those with too few cells in contact."""
    is_known = pressed.converged & (values > 0)
    return {
        "curve": kept(force_bar, values, is_known & pressed.resolved),
        "unsure": kept(force_bar, values, is_known & ~pressed.resolved),
    }


def note_of(pressed: rl.Curve, n: int) -> str:
    """Say what the marks of a curve are, and which loads have none."""
    failed = int((~pressed.converged).sum())
    unsure = "" if pressed.resolved.all() else "; * in the table: fewer than ten cells touch"
    unsolved = f"; {failed} loads were not solved" if failed else ""
    return f"marks of the curve on {n}² points{unsure}{unsolved}"


def span(values: Any, *at_least: float) -> tuple[float, float] | None:
    """A range on a logarithmic axis about all that is positive."""
    known = np.array([*np.ravel(values), *at_least], dtype=float)
    known = known[np.isfinite(known) & (known > 0)]
    return (float(known.min() / _ROOM), float(known.max() * _ROOM)) if known.size else None


def linear_span(values: NDArray[Any]) -> tuple[float, float]:
    """A range on a linear axis about values."""
    room = _ROOM_ABOUT * float(np.ptp(values))
    return float(values.min()) - room, float(values.max()) + room


_REDUCED = Series(
    *("line", "1D, mean and range of single lines", "light-line"),
    {"varea": {"fill_alpha": 0.25}, "line": {"line_width": 2.5}},
)
_OF_SPECTRUM = (
    Series("surface", "the surface", "mark", {"scatter": {"size": 4}}),
    Series("law", "the law", "here", {"line": {"line_width": 2}}),
)
_FORCES, _AREAS = (1e-4, 10.0), (1e-4, 1.3)
_OF_CURVE: dict[str, Any] = {
    "task": "curve",
    "waits": "the surface is being pressed under every load",
}

PANELS = (
    over_force(
        *("stiffness", "Stiffness over force", "stiffness k̄", (_REDUCED,), CHOICES["theories"]),
        ranges=(_FORCES, (1e-3, 1.6)),
        columns=("F̄", "k̄", "model"),
        **_OF_CURVE,
    ),
    over_force(
        *("area", "Area over force", "real contact area A / A₀", (), CHOICES["theories"]),
        ranges=(_FORCES, _AREAS),
        columns=("F̄", "A/A₀", "model"),
        **_OF_CURVE,
    ),
    Panel(
        *("spectrum", "Spectrum", "waves along the side, q L / 2π", "spectrum C [m⁴]"),
        ranges=((0.8, 300.0), (1e-20, 1e-10)),
        series=_OF_SPECTRUM,
        columns=("waves along the side", "C [m⁴]", "law [m⁴]"),
        task="contact",
        waits="the spectrum follows with the whole grid",
        cursor="",
    ),
)
"""Panels that are always there; the first stands alone, the others share their place."""
