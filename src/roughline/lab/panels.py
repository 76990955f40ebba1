"""Panels of curves: what each draws, under which names and how; the page makes them of this."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np

FORCE = "force F / (E* h L)"
"""Label of an axis."""

_LOG_MARGIN = 1.2  # factor about what is drawn on logarithmic axes
_LINEAR_MARGIN = 0.06  # share about what is drawn on linear ones
_DASHES = ("dashed", "dotted", "dashdot")  # of theories, which black and white tell apart

AxisRange = tuple[float, float]
Points = dict[str, Any]
"""Columns of what is drawn: x and y, or low and high too. Zeros stand at the foot of a logarithm,
and lines have a gap where a number is not known."""


@dataclass(frozen=True)
class Series:
    """Points that are drawn alike."""

    name: str
    legend: str  # without one it has no name on the page
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
    series: tuple[Series, ...]
    columns: tuple[str, ...] = ()  # heads of the table
    ranges: tuple[AxisRange, AxisRange] = ((0.1, 1.0), (0.1, 1.0))  # before anything is drawn
    task: str = ""  # whose answer fills it, if it is waited for
    waits: str = ""  # what is said while the first is awaited
    is_logarithmic: bool = True
    of_places: bool = False  # whether x counts places with names: 1, 2, 3
    cursor: Literal["", "height", "width"] = ""  # how a line lies that can be dragged
    drags: str = "F"  # key of the control that it sets

    def with_series(self, *others: Series) -> Panel:
        """Return the same panel with more series, each once."""
        known = {each.name for each in self.series}
        new = {each.name: each for each in others if each.name not in known}
        return replace(self, series=(*self.series, *new.values()))


@dataclass
class PanelContent:
    """What an answer has for a panel; what it does not say stays."""

    series: dict[str, Points] = field(default_factory=dict)
    rows: list[list[str]] | None = None  # of the table; None if the answer is a part of others
    caption: str | None = None
    remarks: str | None = None  # on its theories, below it
    x: AxisRange | None = None  # ranges of the axes
    y: AxisRange | None = None
    legends: dict[str, str] = field(default_factory=dict)  # other names of series
    axes: tuple[str, str] | None = None  # other labels of x and y
    columns: tuple[str, ...] | list[str] | None = None  # other heads of the table
    names: list[str] | None = None  # of places

    @classmethod
    def fitted(
        cls, series: dict[str, Points], *, is_logarithmic: bool = True, **others: Any
    ) -> PanelContent:
        """Series, with axes about all of their points."""
        of_axis, every = span if is_logarithmic else linear_span, series.values()
        x, y = (
            of_axis(np.concatenate([each[key] for each in every for key in keys if key in each]))
            for keys in (("x",), ("y", "low", "high"))
        )
        return cls(series, **{"x": x, "y": y, **others})


def marks(name: str, legend: str, colour: str, **look: Any) -> Series:
    """Marks without a line."""
    return Series(name, legend, colour, {"scatter": {"line_width": 1.5, **look}})


def joined(name: str, legend: str, colour: str, **look: Any) -> Series:
    """Marks on a line."""
    glyphs = {"line": {"line_width": 2}, "scatter": {"line_width": 1.5, **look}}
    return Series(name, legend, colour, glyphs)


def line(name: str, legend: str, colour: str, width: float, **look: Any) -> Series:
    """A line without marks."""
    return Series(name, legend, colour, {"line": {"line_width": width, **look}})


def band(
    name: str, legend: str, colour: str, alpha: float = 0.25, size: float = 0, **look: Any
) -> Series:
    """A line between two ends, with marks if they have a size."""
    marked = {"scatter": {"size": size}} if size else {}
    glyphs = {"varea": {"fill_alpha": alpha}, "line": look, **marked}
    return Series(name, legend, colour, glyphs)


def estimates(name: str, legend: str, colour: str, **look: Any) -> Series:
    """Marks with their intervals."""
    return Series(name, legend, colour, {"scatter": {"size": 8, **look}, "whisker": {"size": 8}})


def theory_lines(theories: Mapping[str, str]) -> tuple[Series, ...]:
    """Lines of theories, each with its dash and its name."""
    return tuple(
        line(f"theory {name}", called, "theory", 2, line_dash=dash)
        for (name, called), dash in zip(theories.items(), _DASHES, strict=False)
    )


def span(values: Any, *at_least: float) -> AxisRange | None:
    """A range on a logarithmic axis about all that is positive."""
    known = np.array([*np.ravel(values), *at_least], dtype=float)
    known = known[np.isfinite(known) & (known > 0)]
    return (
        (float(known.min() / _LOG_MARGIN), float(known.max() * _LOG_MARGIN)) if known.size else None
    )


def linear_span(values: Any) -> AxisRange | None:
    """A range on a linear axis about values."""
    known = np.ravel(values)
    known = known[np.isfinite(known)]
    if not known.size:
        return None
    room = _LINEAR_MARGIN * float(np.ptp(known)) or 1.0
    return float(known.min()) - room, float(known.max()) + room
