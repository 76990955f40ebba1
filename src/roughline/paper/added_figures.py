"""Figures beyond the paper's: both models at once, area law and theories, several grids."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import PercentFormatter

from roughline.contact import scaling
from roughline.paper.contact_area import mean_area
from roughline.paper.laws import at_dimension
from roughline.paper.stated import STIFFNESS_TOLERANCE
from roughline.paper.windows import WINDOW_AGREEMENT, WINDOW_AREA
from roughline.plot.style import (
    COLUMN,
    FORCE_LABEL,
    OPEN,
    PAGE,
    SHADE,
    colours,
    dimension_label,
    label_decades,
    legend_dimensions,
    looks,
    new_figure,
)
from roughline.statistics.averages import average, relative_difference
from roughline.theories import bush_gibson_thomas, persson

if TYPE_CHECKING:
    import xarray

    from roughline.computing.arrays import Real
    from roughline.paper.contact_area import AreaLaw
    from roughline.paper.laws import DimensionLaws
    from roughline.paper.results import PaperResults

CONVERGENCE_DIMENSIONS = (2.0, 2.4, 2.8)
_LINE_STYLES = (":", "-.", "--", "-")


def first_drawings(results: PaperResults) -> dict[str, Callable[[], Figure]]:
    """How the pictures of both models are drawn, with which the page begins, by their files."""
    full, lines = results.full, results.reduced if results.matched is None else results.matched
    drawings = {"both_models": lambda: _both_models_figure(full, lines)}
    if results.matched is not None and _shared(full, lines).size:
        drawings["difference"] = lambda: _difference_figure(full, lines)
    return drawings


def added_drawings(results: PaperResults) -> dict[str, Callable[[], Figure]]:
    """How each figure beyond the paper's is drawn that the results allow, by its file."""
    drawings = {"area_law": lambda: _area_law_figure(results.full, results.laws)}
    if results.grids:
        grids = results.grids | {int(results.full.attrs["n"]): results.full}
        drawings["grid_convergence"] = lambda: _grid_convergence_figure(grids)
    return drawings


def _area_law_figure(full: xarray.Dataset, laws: list[DimensionLaws]) -> Figure:
    """Draw the real contact area over force, and κ of eq. 4 over fractal dimension."""
    figure = new_figure(PAGE, 3.0)
    left, right = figure.subplots(1, 2)
    _draw_area(left, full)
    _draw_kappa(right, laws)
    return figure


def _draw_area(axes: Axes, full: xarray.Dataset) -> None:
    axes.axvspan(*WINDOW_AREA, **SHADE)
    dimensions = full.fractal_dimension.values
    for dimension, colour, marker in looks(dimensions):
        one = full.sel(fractal_dimension=dimension)
        area, resolved = mean_area(one)
        force = one.force_bar.values
        axes.loglog(
            force[resolved],
            area[resolved],
            color=colour,
            marker=marker,
            label=dimension_label(dimension),
        )
        axes.loglog(force, area, color=colour, linewidth=0.7, linestyle="--")
    axes.set(xlabel=FORCE_LABEL, ylabel="real contact area $A/A_0$")
    label_decades(axes)
    legend_dimensions(axes, dimensions)


def _draw_kappa(axes: Axes, laws: list[DimensionLaws]) -> None:
    dimensions = [each.fractal_dimension for each in laws]
    marked: tuple[tuple[list[AreaLaw], str, dict[str, Any], str], ...] = (
        ([each.corrected for each in laws], "ko", {}, "this study, area corrected"),
        ([each.cells for each in laws], "k^", OPEN, "this study, area in cells"),
    )
    for area_laws, marks, look, label in marked:
        kappas = [law.kappa for law in area_laws]
        axes.errorbar(
            dimensions,
            [kappa.value for kappa in kappas],
            yerr=np.transpose([(k.value - k.low, k.high - k.value) for k in kappas]),
            fmt=marks,
            capsize=2,
            **look,
            label=label,
        )
    for kappa, name, style in (
        (bush_gibson_thomas.KAPPA, "Bush, Gibson, Thomas", "--"),
        (persson.KAPPA, "Persson", ":"),
    ):
        axes.axhline(kappa, color="0.3", linewidth=1, linestyle=style, label=f"{name} {kappa:.2f}")
    axes.set(xlabel="fractal dimension $D_f$", ylabel=r"$\kappa = A\,E^* \nabla h\,/\,F$")
    highest = np.nanmax([bush_gibson_thomas.KAPPA, *(each.cells.kappa.high for each in laws)])
    axes.set_ylim(0, 1.45 * highest)
    axes.legend(loc="upper left")


def _shared(full: xarray.Dataset, lines: xarray.Dataset) -> Real:
    """Fractal dimensions of both."""
    return np.intersect1d(full.fractal_dimension, lines.fractal_dimension)


def _both_models_figure(full: xarray.Dataset, lines: xarray.Dataset) -> Figure:
    """Draw the raw stiffness of both models, with 95 % intervals of the means."""
    figure = new_figure(COLUMN, 3.4)
    axes = figure.add_subplot()
    dimensions = full.fractal_dimension.values
    for dimension, colour, marker in looks(dimensions):
        if (one := at_dimension(lines, dimension)) is not None:
            mean = average(one.stiffness.values)
            axes.fill_between(
                one.force_bar, mean.low, mean.high, color=colour, alpha=0.25, linewidth=0
            )
            axes.loglog(one.force_bar, mean.mean, color=colour, linewidth=1)
        one, force = full.sel(fractal_dimension=dimension), full.force_bar.values
        mean, resolved = average(one.stiffness.values), (one.resolved.values == 1).all(axis=0)
        bars = np.array([mean.mean - mean.low, mean.high - mean.mean])
        for which, mark in ((resolved, {}), (~resolved, OPEN)):
            axes.errorbar(
                force[which],
                mean.mean[which],
                bars[:, which],
                fmt=marker,
                color=colour,
                linewidth=0.8,
                label=None if mark else dimension_label(dimension),
                **mark,
            )
    axes.set(
        **{"xscale": "log", "yscale": "log", "xlabel": FORCE_LABEL},
        ylabel=r"stiffness $k\,/\,(E^* L)$",
    )
    axes.annotate("lines 1D, marks 3D", (0.04, 0.93), xycoords="axes fraction", fontsize=8)
    label_decades(axes)
    legend_dimensions(axes, dimensions)
    return figure


def _difference_figure(full: xarray.Dataset, matched: xarray.Dataset) -> Figure:
    """Draw the relative difference of the models with the same waves, and what counts as none."""
    figure = new_figure(COLUMN, 3.4)
    axes = figure.add_subplot()
    force = full.force_bar.values
    for dimension, colour, marker in looks(_shared(full, matched)):
        stiffness_1d, stiffness_3d = (
            data.sel(fractal_dimension=dimension).stiffness.values for data in (matched, full)
        )
        resolved = (full.sel(fractal_dimension=dimension).resolved.values == 1).all(axis=0)
        difference, low, high = relative_difference(stiffness_3d, stiffness_1d, paired=False)
        axes.fill_between(
            force[resolved], low[resolved], high[resolved], color=colour, alpha=0.2, linewidth=0
        )
        axes.plot(force[resolved], difference[resolved], linewidth=1, color=colour, marker=marker)
    near = STIFFNESS_TOLERANCE * np.array([-1, -1, 1, 1, -1])
    ends = np.array(WINDOW_AGREEMENT)[[0, 1, 1, 0, 0]]
    axes.plot(ends, near, color="k", linewidth=1, linestyle="--", zorder=4)
    axes.axhline(0, color="k", linewidth=0.7)
    axes.axhline(scaling.EXACT_PUNCH - 1, color="0.4", linewidth=0.8, linestyle=":")
    axes.yaxis.set_major_formatter(PercentFormatter(1, decimals=0))
    axes.set(xscale="log", xlabel=FORCE_LABEL, ylabel="surfaces over lines, $k_{3D}/k_{1D} - 1$")
    return figure


def _grid_convergence_figure(grids: dict[int, xarray.Dataset]) -> Figure:
    """Draw stiffness and area of the same surfaces on several grids, relative to the finest."""
    figure = new_figure(PAGE, 3.3)
    axes = figure.subplots(1, 2)
    for panel, name in zip(axes, ("stiffness", "area_fraction_corrected"), strict=True):
        for dimension, colour in zip(CONVERGENCE_DIMENSIONS, colours(3), strict=True):
            _draw_ratios_to_finest(panel, grids, dimension, name, colour)
        panel.axhline(1, color="k", linewidth=0.7)
        panel.set(xlabel=FORCE_LABEL, xscale="log")
    finest = max(grids)
    axes[0].set(ylabel=f"stiffness, over that of {finest}²")
    axes[1].set(ylabel=f"real area, over that of {finest}²", yscale="log")
    axes[1].yaxis.set_major_formatter("{x:g}")
    axes[1].set_yticks([1, 2, 5, 10], minor=False)
    figure.legend(
        *axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=6, fontsize=6.5
    )
    return figure


def _draw_ratios_to_finest(
    axes: Axes, grids: dict[int, xarray.Dataset], dimension: float, name: str, colour: Any
) -> None:
    """Draw a quantity of one fractal dimension on each grid over that on the finest grid."""
    surfaces = {
        n: data.sel(fractal_dimension=dimension).isel(realisation=0)
        for n, data in sorted(grids.items())
        if dimension in data.fractal_dimension.values
    }
    finest = surfaces.pop(max(surfaces))
    for (n, surface), style in zip(surfaces.items(), _LINE_STYLES, strict=False):
        shared = np.intersect1d(surface.force_bar, finest.force_bar)
        coarse, fine = (each.sel(force_bar=shared) for each in (surface, finest))
        resolved = coarse.resolved.values == 1
        axes.plot(
            shared[resolved],
            (coarse[name].values / fine[name].values)[resolved],
            color=colour,
            linestyle=style,
            label=f"$D_f$ = {dimension_label(dimension)}, {n}²",
        )
