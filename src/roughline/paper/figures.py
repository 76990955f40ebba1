"""The figures of the page, drawn to files with their captions: the paper's, and others beside."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure

from roughline.contact import scaling
from roughline.paper.mean_curve import mean_curve
from roughline.paper.stated import REDUCED_ENDS
from roughline.plot.pixels import show_map
from roughline.plot.style import (
    COLUMN,
    FORCE_LABEL,
    SHADE,
    colours,
    dimension_label,
    ink,
    label_decades,
    legend_dimensions,
    looks,
    new_figure,
    save,
    styled,
)
from roughline.report.page import Picture
from roughline.statistics.power_law import linear_exponent, scaling_exponent

if TYPE_CHECKING:
    import xarray

    from roughline.computing.arrays import Mask, Real
    from roughline.paper.laws import DimensionLaws
    from roughline.paper.results import PaperResults
    from roughline.paper.windows import ForceWindow

_INDENTED = 1  # which body of the gallery Figure 2 shows
_OPEN_MARKS = (
    " Bands are the standard error of the mean; dashed or open where, in at least one realisation, "
    "fewer than ten springs or cells are in contact, so that the grid decides. The shaded range "
    "is the window of the fit."
)
_BLOCKS = 128  # along a side, of the contact in a picture
_CAPTIONS = {
    "both_models": (
        "Both models",
        "Stiffness over force, six fractal dimensions at once: surfaces (3D) and lines (1D), which "
        "have the waves of the surfaces and no shorter ones where there are such lines. Bands and "
        "bars are 95 % intervals of the mean; marks are open where fewer than ten cells touch.",
    ),
    "difference": (
        "Their difference",
        "How much stiffer surfaces are than lines with the same waves; bands are 95 % intervals. "
        "Excellent agreement would be curves within the dashed box. Near saturation the models "
        "must differ, by 15.2 % (dotted).",
    ),
    "figure_2": (
        "Figure 2",
        "The indented line. Springs under the parts above the level are in contact (black bars); "
        "their total length gives the stiffness, the shaded area the force.",
    ),
    "figure_3": (
        "Figure 3",
        "Dimensionless stiffness over force in the reduced model, mean at fixed force."
        + _OPEN_MARKS,
    ),
    "figure_4": (
        "Figure 4",
        "Dimensionless stiffness over force in the full model, mean at fixed force, normalised "
        "by the paper's 1.1419." + _OPEN_MARKS,
    ),
    "figure_5": (
        "Figure 5",
        "Exponent α over fractal dimension with 95 % intervals from resampled realisations, and "
        "the two predictions. The windows of the two models differ, as their grids do.",
    ),
    "area_law": (
        "Area law",
        "Left: real contact area over force, corrected for the steps of its outline, dashed where "
        "fewer than ten cells touch. Right: κ of eq. 4 with 95 % intervals, of the corrected "
        "area and of the cells in contact; all loads of the shaded window are weighted equally. "
        "The slope is that of the grid (forward differences).",
    ),
    "grid_convergence": (
        "The influence of the grid",
        "One surface for each fractal dimension, computed on several grids: every grid carries all "
        "waves down to its own spacing, so a finer one shows more roughness as well as less error. "
        "Heights are scaled to rms 1 on each grid.",
    ),
}
_IN_THE_PAPER = {
    "figure_2": "The same drawing of a line: springs in contact, and the force as an area.",
    "figure_3": (
        "The same six D_f and the mean of 500 lines: a power law with α from 0.5 at D_f = 2 to "
        "0.75 at D_f = 3 (dash-dotted here), then saturation when all springs touch."
    ),
    "figure_4": (
        "The same six D_f and the mean of 60 surfaces: α ≈ 0.2567 D_f, from 0.51 to 0.77 "
        "(dash-dotted here), then saturation at 1, which the paper says is the square punch."
    ),
    "figure_5": (
        "Both models, 0.2567 D_f and 1 / (4 - D_f), which is said to match extremely well up to "
        "D_f = 2.6. Of the lines the text gives 0.5 and 0.75 (stars here)."
    ),
}
"""What the paper's own figures show."""


def draw_pictures(drawings: Mapping[str, Callable[[], Figure]], folder: Path) -> list[Picture]:
    """Draw figures, by the names of their files, to a folder as PNG and PDF."""
    folder.mkdir(parents=True, exist_ok=True)
    pictures = []
    with styled():
        for file_name, draw in drawings.items():
            png, _ = save(draw(), folder, file_name)
            name, caption = _CAPTIONS[file_name]
            beside = _IN_THE_PAPER.get(file_name, "")
            pictures.append(Picture(png, name, caption, beside and f"In the paper: {beside}"))
    return pictures


def draw_bodies(gallery: xarray.Dataset, folder: Path) -> list[Picture]:
    """Draw Figure 1, a body in each picture, as PNG and PDF."""
    folder.mkdir(parents=True, exist_ok=True)
    pictures = []
    with styled():
        for row, contact in enumerate(gallery.contact):
            name = body_name(gallery, row)
            png, _ = save(body_figure(gallery, row), folder, f"figure_1{name[0]}")
            pictures.append(
                Picture(png, f"Figure 1 {name}", f"{float(contact.mean()):.1%} of the area touch.")
            )
    return pictures


def paper_drawings(results: PaperResults) -> dict[str, Callable[[], Figure]]:
    """How the paper's Figures 2 to 5 are drawn, by the names of their files."""
    reduced, full, gallery, laws = results.reduced, results.full, results.gallery, results.laws
    windows = results.windows
    dimensions = full.fractal_dimension.values
    drawings: dict[str, Callable[[], Figure]] = {}
    if gallery is not None:
        drawings["figure_2"] = lambda: indented_figure(gallery)
    drawings["figure_3"] = lambda: _figure_3(reduced, dimensions, windows.reduced)
    drawings["figure_4"] = lambda: _figure_4(full, windows.full)
    drawings["figure_5"] = lambda: _figure_5(results.exponents, laws, windows.full)
    return drawings


def body_figure(gallery: xarray.Dataset, row: int) -> Figure:
    """Draw a row of Figure 1: rough line, surface, real contact area and deflection.

    The contact is shown in blocks, those that have some of it in black.
    """
    figure = new_figure(4.4, 4.2)
    grid = figure.add_gridspec(2, 2, width_ratios=[1, 1.15])
    body, deepest = gallery.isel(fractal_dimension=row), float(gallery.displacement.max())
    look: Any = {"sides": (1.0, 1.0), "interpolation": "nearest"}
    marks = LinearSegmentedColormap.from_list("", [mpl.rcParams["axes.facecolor"], ink()])
    line = figure.add_subplot(grid[0, 0])
    position = np.arange(body.sizes["s"]) / body.sizes["s"]
    line.plot(position, body.line_heights, color=ink(), linewidth=0.4)
    line.set(xlim=(0, 1), ylim=(-3.6, 3.6), ylabel="height $z/h$")
    line.set_title(body_name(gallery, row).replace("D_f", " $D_f$"), loc="left")
    _draw_topography(figure.add_subplot(grid[0, 1], projection="3d"), body.heights.values)
    contact = figure.add_subplot(grid[1, 0])
    touched = body.contact.values
    if touched.shape[0] % _BLOCKS == 0:
        side = touched.shape[0] // _BLOCKS
        touched = touched.reshape(_BLOCKS, side, _BLOCKS, side).max(axis=(1, 3)) > 0
    show_map(contact, touched, cmap=marks, **look)
    fraction = float(body.contact.mean())
    contact.set_title(f"contact {fraction:.1%}", fontsize=8)
    deflection = figure.add_subplot(grid[1, 1])
    image = show_map(
        deflection, body.displacement.values, cmap="cividis", vmin=0, vmax=deepest, **look
    )
    figure.colorbar(image, ax=deflection, label="deflection $u/h$", shrink=0.85)
    for axes in (contact, deflection):
        axes.set(xticks=[0, 1], yticks=[0, 1])
    contact.set_ylabel("$y/L$", labelpad=-6)
    for axes in (line, contact, deflection):
        axes.set_xlabel("$x/L$")
    return figure


def body_name(gallery: xarray.Dataset, row: int) -> str:
    """Name a row of Figure 1 by its letter; "a) D_f = 2" is the first."""
    return f"{'abcdefgh'[row]}) D_f = {_as_fraction(float(gallery.fractal_dimension[row]))}"


def indented_figure(gallery: xarray.Dataset) -> Figure:
    """Draw Figure 2, the indented line: springs in contact, and the force above the level."""
    figure = new_figure(COLUMN, 2.4)
    axes = figure.add_subplot()
    body = gallery.isel(fractal_dimension=min(_INDENTED, gallery.sizes["fractal_dimension"] - 1))
    heights = body.line_heights.values
    position = np.arange(heights.size) / heights.size
    level = heights.max() - float(body.line_depth)
    axes.plot(position, heights, color=ink(), alpha=0.65, linewidth=0.5, label="rough line")
    axes.axhline(level, color=ink(), linewidth=0.8, linestyle="--", label="level $z = z_{max} - d$")
    axes.fill_between(
        position,
        level,
        heights,
        where=heights > level,
        color=colours(2)[1],
        linewidth=0,
        label=r"$F/E^*$",
    )
    bottom = heights.min() - 1.2
    for start, end in _runs(heights > level):
        axes.plot(position[[start, end]], [bottom, bottom], color=ink(), linewidth=3)
    axes.annotate(
        "springs in contact: $k = E^*\\,\\sum L_i$",
        (0.03, bottom + 0.3),
        fontsize=7.5,
        xycoords="data",
    )
    axes.set(xlabel="$x/L$", ylabel="height $z/h$", xlim=(0, 1))
    axes.set_ylim(bottom - 0.25, heights.max() + 0.4)
    figure.legend(loc="outside upper center", ncols=3, columnspacing=1.2)
    return figure


def _figure_3(reduced: xarray.Dataset, dimensions: Real, window: ForceWindow) -> Figure:
    """Draw the stiffness over force of the reduced model, k / (E* L).

    Fractal dimensions are those of the surfaces, as far as the lines have them, or else all.
    """
    shared = np.isclose(reduced.fractal_dimension.values[:, np.newaxis], dimensions).any(axis=1)
    chosen = reduced.isel(fractal_dimension=shared) if shared.any() else reduced
    label = r"stiffness $\bar k_{1D} = k\,/\,(E^* L)$"
    figure = _stiffness_figure(chosen, 1.0, label, window, REDUCED_ENDS)
    figure.axes[0].axhline(1, color="0.4", linewidth=0.8, linestyle=":")
    return figure


def _figure_4(full: xarray.Dataset, window: ForceWindow) -> Figure:
    """Draw the stiffness over force of the full model, k / (1.1419 E* L)."""
    label = r"stiffness $\bar k_{3D} = k\,/\,(1.1419\,E^* \sqrt{A_0})$"
    stated = {dimension: linear_exponent(dimension) for dimension in (2.0, 3.0)}
    figure = _stiffness_figure(full, scaling.PAPER_PUNCH, label, window, stated)
    exact = scaling.EXACT_PUNCH / scaling.PAPER_PUNCH
    figure.axes[0].set_ylim(top=1.6)
    figure.axes[0].axhline(exact, color="0.4", linewidth=0.8, linestyle=":")
    figure.axes[0].annotate(
        "exact square punch, $1.1523\\,E^* L$",
        (full.force_bar.values[0], exact),
        fontsize=7,
        va="bottom",
        ha="left",
    )
    return figure


def _figure_5(exponents: xarray.Dataset, laws: list[DimensionLaws], window: ForceWindow) -> Figure:
    """Draw the exponent over fractal dimension: both models and the two predictions."""
    figure = new_figure(COLUMN, 3.2)
    axes = figure.add_subplot()
    fine = np.linspace(2, 3, 101)
    dark, light = colours(2)
    axes.plot(fine, scaling_exponent(fine), "k--", linewidth=1, label=r"$1/(4 - D_f)$")
    axes.plot(fine, linear_exponent(fine), "k:", linewidth=1.2, label=r"$0.2567\,D_f$")
    for i, style in zip(range(exponents.sizes["window"]), ("-", "--", ":"), strict=True):
        one = exponents.isel(window=i)
        if not np.isfinite(one.exponent).any():
            continue
        span = (float(one.window_low), float(one.window_high))
        axes.fill_between(
            one.fractal_dimension, one.low, one.high, color=light, alpha=0.45, linewidth=0
        )
        axes.plot(
            one.fractal_dimension,
            one.exponent,
            color=light,
            linestyle=style,
            label=f"1D, {_window_label(span)}",
        )
    alpha = np.array([each.full.exponent for each in laws])
    low, high = np.array([each.full.exponent_interval for each in laws]).T
    axes.errorbar(
        [each.fractal_dimension for each in laws],
        alpha,
        yerr=[alpha - low, high - alpha],
        fmt="o",
        color=dark,
        capsize=2,
        linewidth=1,
        label=f"3D, {_window_label(window)}",
    )
    axes.plot(*zip(*REDUCED_ENDS.items(), strict=True), "k*", markersize=7, label="1D, the paper")
    axes.set(xlabel="fractal dimension $D_f$", ylabel=r"exponent $\alpha$")
    lowest = np.nanmin([0.42, *low, *np.ravel(exponents.low)])
    highest = np.nanmax([1.0, *high, *np.ravel(exponents.high)])
    axes.set(xlim=(1.97, 3.03), ylim=(min(0.4, lowest - 0.02), max(1.02, highest + 0.02)))
    axes.legend(loc="upper left")
    return figure


def _stiffness_figure(
    data: xarray.Dataset,
    punch: float,
    label: str,
    window: ForceWindow,
    stated: Mapping[float, float],
) -> Figure:
    """Draw the mean stiffness with its standard error; dashed where the grid does not resolve.

    Exponents that the paper states, by fractal dimension, are slopes through the window's middle.
    """
    middle = math.sqrt(window[0] * window[1])
    around = np.geomspace(window[0] / 3, window[1] * 3, 2)
    figure = new_figure(COLUMN, 3.2)
    axes = figure.add_subplot()
    axes.axvspan(*window, **SHADE)
    dimensions = data.fractal_dimension.values
    for dimension, colour, marker in looks(dimensions):
        one = data.sel(fractal_dimension=dimension)
        curve = mean_curve(one, punch)
        force, mean, resolved = curve.force_bar, curve.mean, curve.resolved
        mark_spacing = max(1, force.size // 24)
        axes.fill_between(force, curve.low, curve.high, color=colour, alpha=0.25, linewidth=0)
        axes.loglog(
            force[resolved],
            mean[resolved],
            color=colour,
            marker=marker,
            markevery=mark_spacing,
            label=dimension_label(dimension),
        )
        axes.loglog(force[~resolved], mean[~resolved], color=colour, linewidth=0.8, linestyle="--")
        if dimension in stated:
            level = np.interp(middle, force, mean)
            slope = level * (around / middle) ** stated[dimension]
            axes.loglog(around, slope, color="0.35", linewidth=0.8, linestyle="-.", zorder=3)
    axes.set(xlabel=FORCE_LABEL, ylabel=label)
    label_decades(axes)
    legend_dimensions(axes, dimensions)
    return figure


def _draw_topography(axes: Any, heights: Real) -> None:
    step = max(1, heights.shape[0] // 128)
    coarse = heights[::step, ::step]
    x, y = np.meshgrid(*(np.arange(n) / n for n in coarse.shape), indexing="ij")
    axes.plot_surface(
        x, -y, coarse, cmap="cividis", rcount=128, ccount=128, linewidth=0, rasterized=True
    )
    axes.set_box_aspect((1, 1, 0.45), zoom=1.35)
    axes.view_init(elev=38, azim=-60)
    axes.set_zlim(-3.6, 3.6)
    axes.set_axis_off()


def _runs(flags: Mask) -> list[tuple[int, int]]:
    """First and last index of each run of true values."""
    edges = np.diff(np.concatenate([[0], flags.astype(np.int8), [0]]))
    starts, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1) - 1
    return list(zip(starts.tolist(), ends.tolist(), strict=True))


def _as_fraction(value: float) -> str:
    """A fractal dimension as it is written in the paper."""
    return {2 + 1 / 3: "7/3", 2 + 2 / 3: "8/3"}.get(value, f"{value:g}")


def _window_label(window: ForceWindow) -> str:
    low, high = (_power_of_ten(edge) for edge in window)
    return rf"$\bar F = {low}$ to ${high}$"


def _power_of_ten(value: float) -> str:
    exponent = np.log10(value)
    return f"10^{{{exponent:.0f}}}" if abs(exponent - round(exponent)) < 1e-6 else f"{value:g}"
