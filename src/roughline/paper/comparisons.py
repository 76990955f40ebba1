"""Figures that compare: the area law with theory, the two models with each other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.ticker import PercentFormatter

from roughline.comparison.trust import TrustMap
from roughline.contact import scaling
from roughline.paper.contact_area import WINDOW_AREA
from roughline.paper.exponents import WINDOW_AGREEMENT, DimensionSummary
from roughline.report.style import (
    FORCE_LABEL,
    MARKERS,
    PAGE,
    SHADE,
    colours,
    legend_dimensions,
    new_figure,
)
from roughline.statistics.averages import relative_difference

if TYPE_CHECKING:
    import xarray

CONVERGENCE_DIMENSIONS = (2.0, 2.4, 2.8)
LINE_STYLES = (":", "-.", "--", "-")


def area_law(full: xarray.Dataset, summaries: list[DimensionSummary]) -> Figure:
    """Real contact area over force, scaled as in eq. 4, and kappa over fractal dimension."""
    figure = new_figure(PAGE, 3.0)
    left, right = figure.subplots(1, 2)
    low, high = WINDOW_AREA
    left.axvspan(low, high, **SHADE)
    dimensions = full.fractal_dimension.values
    for dimension, colour, marker in zip(dimensions, colours(6), MARKERS, strict=False):
        one = full.sel(fractal_dimension=dimension)
        area = np.nanmean(one.area_fraction_corrected.values, axis=0)
        certain = (one.resolved.values == 1).all(axis=0)
        force = one.force_bar.values
        left.loglog(
            force[certain], area[certain], color=colour, marker=marker, label=f"{dimension:.1f}"
        )
        left.loglog(force, area, color=colour, linewidth=0.7, linestyle="--")
    left.set(xlabel=FORCE_LABEL, ylabel="real contact area $A/A_0$")
    legend_dimensions(left, dimensions)
    for name, look in (("corrected", "ko"), ("cells", "k^")):
        kappa = [getattr(s, name).kappa for s in summaries]
        right.errorbar(
            [s.fractal_dimension for s in summaries],
            [each.value for each in kappa],
            yerr=np.transpose([(k.value - k.low, k.high - k.value) for k in kappa]),
            fmt=look,
            fillstyle="full" if name == "corrected" else "none",
            capsize=2,
            label="this study, " + ("area corrected" if name == "corrected" else "area in cells"),
        )
    for value, name, style in (
        (np.sqrt(2 * np.pi), "Bush, Gibson, Thomas", "--"),
        (np.sqrt(8 / np.pi), "Persson", ":"),
    ):
        right.axhline(value, color="0.3", linewidth=1, linestyle=style, label=f"{name} {value:.2f}")
    right.set(xlabel="fractal dimension $D_f$", ylabel=r"$\kappa = A\,E^* \nabla h\,/\,F$")
    right.set_ylim(0, 1.45 * max(s.cells.kappa.high for s in summaries))
    right.legend(loc="upper left")
    return figure


def models_compared(matched: xarray.Dataset, full: xarray.Dataset) -> Figure:
    """Raw stiffness of both models with the same waves, and their relative difference."""
    figure = new_figure(PAGE, 3.2)
    left, right = figure.subplots(1, 2)
    dimensions = full.fractal_dimension.values
    force = full.force_bar.values
    for dimension, colour, marker in zip(dimensions, colours(6), MARKERS, strict=False):
        stiffness_1d, stiffness_3d = (
            data.sel(fractal_dimension=dimension).stiffness.values for data in (matched, full)
        )
        certain = (full.sel(fractal_dimension=dimension).resolved.values == 1).all(axis=0)
        look = {"color": colour, "marker": marker}
        left.loglog(force, np.nanmean(stiffness_1d, axis=0), color=colour, linewidth=1)
        for shown, fill in ((certain, "full"), (~certain, "none")):
            left.loglog(
                force[shown],
                np.nanmean(stiffness_3d, axis=0)[shown],
                linestyle="",
                fillstyle=fill,
                label=f"{dimension:.1f}" if fill == "full" else None,
                **look,
            )
        difference, low, high = relative_difference(stiffness_3d, stiffness_1d, paired=False)
        right.fill_between(
            force[certain], low[certain], high[certain], color=colour, alpha=0.2, linewidth=0
        )
        right.plot(force[certain], difference[certain], linewidth=1, **look)
    left.set(xlabel=FORCE_LABEL, ylabel=r"raw stiffness $k\,/\,(E^* L)$")
    left.annotate("lines 1D, marks 3D", (0.04, 0.92), xycoords="axes fraction", fontsize=7.5)
    legend_dimensions(left, dimensions)
    right.axvspan(*WINDOW_AGREEMENT, **SHADE)
    right.axhline(0, color="k", linewidth=0.7)
    right.axhline(scaling.EXACT_PUNCH - 1, color="0.4", linewidth=0.8, linestyle=":")
    right.yaxis.set_major_formatter(PercentFormatter(1, decimals=0))
    right.set(xscale="log", xlabel=FORCE_LABEL, ylabel="raw stiffness, 3D over 1D, less 1")
    return figure


def grid_convergence(grids: dict[int, xarray.Dataset]) -> Figure:
    """Stiffness and area of the same surfaces on several grids, relative to the finest."""
    figure = new_figure(PAGE, 3.3)
    axes = figure.subplots(1, 2)
    for panel, name in zip(axes, ("stiffness", "area_fraction_corrected"), strict=True):
        for dimension, colour in zip(CONVERGENCE_DIMENSIONS, colours(3), strict=True):
            found = {
                n: data.sel(fractal_dimension=dimension)
                for n, data in sorted(grids.items())
                if dimension in data.fractal_dimension.values
            }
            finest = max(found)
            for (n, data), style in zip(found.items(), LINE_STYLES, strict=False):
                if n == finest:
                    continue
                reference = found[finest]
                shared = np.intersect1d(data.force_bar, reference.force_bar)
                one, best = (
                    part.sel(force_bar=shared)[name].isel(realisation=0).values
                    for part in (data, reference)
                )
                sure = data.sel(force_bar=shared).resolved.isel(realisation=0).values == 1
                panel.plot(
                    shared[sure],
                    (one / best)[sure],
                    color=colour,
                    linestyle=style,
                    label=f"$D_f$ = {dimension:.1f}, {n}²",
                )
        panel.axhline(1, color="k", linewidth=0.7)
        panel.set(xlabel=FORCE_LABEL, xscale="log")
    axes[0].set(ylabel=f"stiffness, over that of {finest}²")
    axes[1].set(ylabel=f"real area, over that of {finest}²", yscale="log")
    axes[1].yaxis.set_major_formatter("{x:g}")
    axes[1].set_yticks([1, 2, 5, 10], minor=False)
    figure.legend(
        *axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=6, fontsize=6.5
    )
    return figure


def trust_map(trust: TrustMap) -> Figure:
    """Relative difference of the two models over load and fractal dimension, for each roll-off."""
    count = trust.roll_off_ratios.size
    figure = new_figure(PAGE, 2.7)
    panels = figure.subplots(1, count, sharey=True)
    levels = np.array([-0.3, -0.2, -0.1, -0.05, 0.05, 0.1, 0.2, 0.3, 0.4])
    # equal steps of colour on both sides of none, white where the models agree
    colours_of = mpl.colormaps["RdBu_r"](
        np.concatenate([np.linspace(0.1, 0.4, 4), [0.5], np.linspace(0.6, 0.95, 5)])
    )
    scale, norm = ListedColormap(colours_of), BoundaryNorm(levels, levels.size + 1, extend="both")
    for i, (panel, roll_off) in enumerate(zip(panels, trust.roll_off_ratios, strict=True)):
        shown = panel.pcolormesh(
            trust.force_bars, trust.fractal_dimensions, trust.difference[i], cmap=scale, norm=norm
        )
        panel.contourf(
            trust.force_bars,
            trust.fractal_dimensions,
            trust.resolved[i],
            levels=[-1, 0.5],
            colors="none",
            hatches=["////"],
        )
        panel.set(xscale="log", title=f"$q_r/q_0$ = {roll_off:g}", xlabel=r"$\bar F$")
    panels[0].set(ylabel="fractal dimension $D_f$")
    bar = figure.colorbar(shown, ax=panels, label="3D over 1D, less 1", ticks=levels)
    bar.ax.yaxis.set_major_formatter(PercentFormatter(1, decimals=0))
    return figure
