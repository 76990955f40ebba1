"""Figures that compare: the area law with theory, the two models with each other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from roughline import scaling
from roughline.report.style import (
    FORCE_LABEL,
    MARKERS,
    PAGE,
    SHADE,
    colours,
    legend_dimensions,
    new_figure,
)
from roughline.report.summary import WINDOW_AGREEMENT, WINDOW_AREA, DimensionSummary

if TYPE_CHECKING:
    import xarray


def area_law(full: xarray.Dataset, summaries: list[DimensionSummary]) -> Figure:
    """Real contact area over force, scaled as in eq. 4, and kappa over fractal dimension."""
    figure = new_figure(PAGE, 3.0)
    left, right = figure.subplots(1, 2)
    low, high = WINDOW_AREA
    left.axvspan(low, high, **SHADE)
    dimensions = full.fractal_dimension.values
    for dimension, colour, marker in zip(dimensions, colours(6), MARKERS, strict=False):
        one = full.sel(fractal_dimension=dimension)
        area = np.nanmean(one.area_fraction.values, axis=0)
        certain = one.resolved.values.all(axis=0)
        force = one.force_bar.values
        left.loglog(
            force[certain], area[certain], color=colour, marker=marker, label=f"{dimension:.1f}"
        )
        left.loglog(force, area, color=colour, linewidth=0.7, linestyle="--")
    left.set(xlabel=FORCE_LABEL, ylabel="real contact area $A/A_0$")
    legend_dimensions(left, dimensions)
    kappa = np.array([(s.kappa.value, s.kappa.low, s.kappa.high) for s in summaries])
    right.errorbar(
        [s.fractal_dimension for s in summaries],
        kappa[:, 0],
        yerr=[kappa[:, 0] - kappa[:, 1], kappa[:, 2] - kappa[:, 0]],
        fmt="o",
        color="k",
        capsize=2,
        label="this study, slope and area of the grid",
    )
    for value, name, style in (
        (np.sqrt(2 * np.pi), "Bush, Gibson, Thomas", "--"),
        (np.sqrt(8 / np.pi), "Persson", ":"),
    ):
        right.axhline(value, color="0.3", linewidth=1, linestyle=style, label=f"{name} {value:.2f}")
    right.set(xlabel="fractal dimension $D_f$", ylabel=r"$\kappa = A\,E^* \nabla h\,/\,F$")
    right.set_ylim(0, max(5.0, 1.1 * kappa.max()))
    right.legend(loc="upper left")
    return figure


def models_compared(reduced: xarray.Dataset, full: xarray.Dataset) -> Figure:
    """Raw stiffness of both models, and their ratio."""
    figure = new_figure(PAGE, 3.2)
    left, right = figure.subplots(1, 2)
    dimensions = full.fractal_dimension.values
    for dimension, colour, marker in zip(dimensions, colours(6), MARKERS, strict=False):
        one_1d, one_3d = (data.sel(fractal_dimension=dimension) for data in (reduced, full))
        force = one_3d.force_bar.values
        mean_1d = np.nanmean(one_1d.stiffness.values, axis=0)
        mean_3d = np.nanmean(one_3d.stiffness.values, axis=0)
        visible = one_1d.force_bar.values >= force[0]
        certain = one_3d.resolved.values.all(axis=0)
        left.loglog(one_1d.force_bar[visible], mean_1d[visible], color=colour, linewidth=1)
        left.loglog(
            force[certain],
            mean_3d[certain],
            color=colour,
            marker=marker,
            linestyle="",
            label=f"{dimension:.1f}",
        )
        left.loglog(
            force[~certain],
            mean_3d[~certain],
            color=colour,
            marker=marker,
            linestyle="",
            fillstyle="none",
        )
        at_force = np.exp(np.interp(np.log(force), np.log(one_1d.force_bar), np.log(mean_1d)))
        error = np.nanstd(one_3d.stiffness.values, axis=0, ddof=1) / np.sqrt(
            one_3d.sizes["realisation"]
        )
        right.errorbar(
            force[certain],
            (mean_3d / at_force)[certain],
            yerr=(error / at_force)[certain],
            color=colour,
            marker=marker,
            linewidth=1,
            elinewidth=0.6,
        )
    left.set(xlabel=FORCE_LABEL, ylabel=r"raw stiffness $k\,/\,(E^* L)$")
    left.annotate("lines 1D, marks 3D", (0.04, 0.92), xycoords="axes fraction", fontsize=7.5)
    legend_dimensions(left, dimensions)
    right.axvspan(*WINDOW_AGREEMENT, **SHADE)
    right.axhline(1, color="k", linewidth=0.7)
    right.axhline(scaling.EXACT_PUNCH, color="0.4", linewidth=0.8, linestyle=":")
    right.set(xscale="log", xlabel=FORCE_LABEL, ylabel="raw stiffness, 3D over 1D")
    return figure
