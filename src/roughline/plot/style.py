"""One style for all figures: journal sizes, colours and marks that are legible in grey print."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from itertools import cycle
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogFormatterSciNotation
from numpy.typing import ArrayLike, NDArray

from roughline.units import SI, prefix

COLUMN, PAGE = 3.5, 7.2  # widths of one and two journal columns [inch]
MARKERS = "osD^vP"
_FEW_DECADES = 0.4  # in which some more labels have room
_DIMENSIONS = {"length", "force", "pressure", "energy"}  # units of no system

FORCE_LABEL = r"force $\bar F = F\,/\,(E^* h L)$"
OPEN: dict[str, Any] = {"markerfacecolor": "w", "zorder": 3}
"""Look of an open mark: nothing that is drawn below it, or after it, fills it."""
SHADE: dict[str, Any] = {"color": "0.92", "zorder": -10, "linewidth": 0}

_RC: Any = {
    "font.size": 9,
    "font.family": "DejaVu Sans",
    "mathtext.fontset": "dejavusans",
    "axes.linewidth": 0.7,
    "axes.grid": False,
    "axes.axisbelow": True,
    "lines.linewidth": 1.3,
    "lines.markersize": 3.5,
    "legend.fontsize": 8,
    "legend.frameon": False,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
    "pdf.fonttype": 42,
    "savefig.dpi": 200,
    "figure.constrained_layout.use": True,
}
_PAPER, _INK, _FRAME = "#16181c", "#ececea", "#7d7d78"  # of the dark theme of the lab
_DARK: Any = {
    **dict.fromkeys(("figure.facecolor", "axes.facecolor", "savefig.facecolor"), _PAPER),
    **dict.fromkeys(("text.color", "axes.labelcolor", "xtick.color", "ytick.color"), _INK),
    "axes.edgecolor": _FRAME,
}


def new_figure(width: float, height: float) -> Figure:
    """Make an empty figure; every figure is drawn inside :func:`styled`."""
    return Figure(figsize=(width, height))


@contextmanager
def styled(*, dark: bool = False) -> Iterator[None]:
    """Context in which figures are drawn and saved, with light ink on dark paper if wanted.

    It gives back its own settings alone. The first figure of a notebook makes all later pictures
    appear, by another setting, which has to stay.
    """
    settings = _RC | _DARK if dark else _RC
    before = {name: mpl.rcParams[name] for name in settings}
    mpl.rcParams.update(settings)
    try:
        yield
    finally:
        mpl.rcParams.update(before)


@contextmanager
def drawing_on(axes: Axes | None, width: float = 4.5, height: float = 3.2) -> Iterator[Axes]:
    """Context that gives the axes to draw on, in the reports' style; new ones if there are none."""
    with styled():
        if axes is None:
            from matplotlib import pyplot  # here because its figures are for screens and notebooks

            axes = pyplot.figure(figsize=(width, height)).add_subplot()
        yield axes


def ink() -> str:
    """Return the colour of text and frames, which differs from the paper most."""
    return str(mpl.rcParams["text.color"])


def colours(count: int) -> list[tuple[float, float, float, float]]:
    """Return colours that differ in lightness too (viridis, without the end next to the paper)."""
    ramp = mpl.colormaps["viridis"]
    first, last = (0.3, 1.0) if ink() == _INK else (0.0, 0.88)
    return [ramp(first + (last - first) * i / max(count - 1, 1)) for i in range(count)]


def looks(dimensions: NDArray[np.float64]) -> Iterator[tuple[float, Any, str]]:
    """Return fractal dimensions with their colours and marks."""
    return zip(dimensions, colours(dimensions.size), cycle(MARKERS), strict=False)


def save(figure: Figure, folder: Path, name: str) -> list[Path]:
    """Write a figure as PNG and PDF, laid out alike; without dates, so equal data give equal files.

    The figure keeps the places that its axes have then.
    """
    paths = [folder / f"{name}.png", folder / f"{name}.pdf"]
    figure.savefig(paths[0], metadata={"Software": None})
    figure.set_layout_engine("none")  # to lay it out takes as long as to draw it
    figure.savefig(paths[1], metadata={"CreationDate": None, "Creator": None, "Producer": None})
    return paths


def label_decades(axes: Axes) -> None:
    """Label so few places of a logarithmic x axis that labels do not overlap.

    These are the powers of ten if two are seen. Else a few multiples of them are labelled as well,
    the more, the smaller the part of a decade that is seen.
    """
    written = LogFormatterSciNotation(minor_thresholds=(np.inf, np.inf))
    written.set_axis(axes.xaxis)

    def label(value: float, _position: int | None = None) -> str:
        low, high = np.log10(sorted(axes.get_xlim()))
        if np.floor(high) - np.ceil(low) >= 1:
            return ""
        multiple = round(value / 10 ** np.floor(np.log10(value)), 6)
        some = (2, 3, 5, 7) if high - low < _FEW_DECADES else (2, 5) if high - low < 1 else (3,)
        return written(value) if multiple in some else ""

    axes.xaxis.set_minor_formatter(FuncFormatter(label))


def dimension_label(dimension: float) -> str:
    """Write a fractal dimension with one digit, or with as many as it has."""
    return f"{dimension:.1f}" if abs(dimension - round(dimension, 1)) < 1e-9 else f"{dimension:.5g}"


def legend_dimensions(axes: Axes, dimensions: NDArray[np.float64]) -> None:
    """Draw a legend of the fractal dimensions alone, in two columns."""
    handles, labels = axes.get_legend_handles_labels()
    wanted = {dimension_label(dimension) for dimension in dimensions}
    labelled = [(h, label) for h, label in zip(handles, labels, strict=True) if label in wanted]
    axes.legend(*zip(*labelled, strict=True), title="$D_f$", loc="lower right", ncols=2)


def say(axes: Axes, text: str) -> None:
    """Write a text in the middle of axes."""
    axes.text(0.5, 0.5, text, ha="center", va="center", transform=axes.transAxes, wrap=True)


def in_unit(
    name: str, values: ArrayLike, unit: str | None, scale: float = 1.0
) -> tuple[str, float]:
    """Return the label of an axis with its unit, and the factor from the values to that unit.

    The largest value chooses the prefix of an SI unit. A dimension such as "force/length", which
    stands for any coherent unit, and None are left out of the label.
    """
    if unit in (None, "1") or _DIMENSIONS & set(unit.split("/")):
        return name, scale
    if unit not in SI:
        return f"{name} [{unit}]", scale
    largest = scale * float(np.nanmax(np.abs(values), initial=0.0))
    factor, prefixed = prefix(largest, unit)
    return f"{name} [{prefixed}]", factor * scale
