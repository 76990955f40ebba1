"""Figures beyond the paper's: area law and theories, both models, several grids."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import PercentFormatter

from roughline.contact import scaling
from roughline.paper.contact_area import mean_area
from roughline.paper.windows import WINDOW_AGREEMENT, WINDOW_AREA
from roughline.plot.style import (
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
from roughline.statistics.averages import relative_difference
from roughline.theories import bush_gibson_thomas, persson

if TYPE_CHECKING:
    import xarray

    from roughline.paper.contact_area import AreaLaw
    from roughline.paper.laws import DimensionLaws
    from roughline.paper.results import PaperResults

CONVERGENCE_DIMENSIONS = (2.0, 2.4, 2.8)
_LINE_STYLES = (":", "-.", "--", "-")


def added_drawings(results: PaperResults) -> dict[str, Callable[[], Figure]]:
    """How each of these figures is drawn that the results allow, by the name of its file."""
    full, matched = results.full, results.matched
    drawings = {"area_law": lambda: _area_law_figure(full, results.laws)}
    if matched is not None and np.isin(full.fractal_dimension, matched.fractal_dimension).any():
        drawings["models_compared"] = lambda: _both_models_figure(full, matched)
    if results.grids:
        grids = results.grids | {int(full.attrs["n"]): full}
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


def _both_models_figure(full: xarray.Dataset, matched: xarray.Dataset) -> Figure:
    """Draw the raw stiffness of both models with the same waves, and their relative difference."""
    figure = new_figure(PAGE, 3.2)
    left, right = figure.subplots(1, 2)
    dimensions = np.intersect1d(full.fractal_dimension, matched.fractal_dimension)
    force = full.force_bar.values
    for dimension, colour, marker in looks(dimensions):
        stiffness_1d, stiffness_3d = (
            data.sel(fractal_dimension=dimension).stiffness.values for data in (matched, full)
        )
        resolved = (full.sel(fractal_dimension=dimension).resolved.values == 1).all(axis=0)
        look = {"color": colour, "marker": marker}
        left.loglog(force, np.nanmean(stiffness_1d, axis=0), color=colour, linewidth=1)
        for which, mark in ((resolved, {}), (~resolved, OPEN)):
            left.loglog(
                force[which],
                np.nanmean(stiffness_3d, axis=0)[which],
                linestyle="",
                label=None if mark else dimension_label(dimension),
                **look,
                **mark,
            )
        difference, low, high = relative_difference(stiffness_3d, stiffness_1d, paired=False)
        right.fill_between(
            force[resolved], low[resolved], high[resolved], color=colour, alpha=0.2, linewidth=0
        )
        right.plot(force[resolved], difference[resolved], linewidth=1, **look)
    left.set(xlabel=FORCE_LABEL, ylabel=r"raw stiffness $k\,/\,(E^* L)$")
    left.annotate("lines 1D, marks 3D", (0.04, 0.92), xycoords="axes fraction", fontsize=7.5)
    label_decades(left)
    legend_dimensions(left, dimensions)
    right.axvspan(*WINDOW_AGREEMENT, **SHADE)
    right.axhline(0, color="k", linewidth=0.7)
    right.axhline(scaling.EXACT_PUNCH - 1, color="0.4", linewidth=0.8, linestyle=":")
    right.yaxis.set_major_formatter(PercentFormatter(1, decimals=0))
    right.set(xscale="log", xlabel=FORCE_LABEL, ylabel="raw stiffness, $k_{3D} / k_{1D} - 1$")
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
