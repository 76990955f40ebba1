"""The comparison of both models in files: a table and a figure."""

from __future__ import annotations

from pathlib import Path

from matplotlib.figure import Figure
from matplotlib.ticker import PercentFormatter

from roughline.assessment.comparison import ModelComparison
from roughline.comparison.models import Comparison
from roughline.errors import StoreError
from roughline.report.folder import make_folder
from roughline.report.style import FORCE_LABEL, PAGE, SHADE, colours, new_figure, save, styled


def comparison_figure(result: Comparison, tolerance: float) -> Figure:
    """Both curves, and their relative difference with its interval."""
    figure = new_figure(PAGE, 3.0)
    left, right = figure.subplots(1, 2)
    force = result.force_bar
    dark, light = colours(2)
    count = result.surfaces
    for mean, colour, label in (
        (
            result.full,
            dark,
            "full model" + (f", mean of {count} surfaces" if count > 1 else ", one surface"),
        ),
        (result.reduced, light, f"reduced model, mean of {result.lines} lines"),
    ):
        left.loglog(force, mean.mean, color=colour, marker="o", label=label)
        left.fill_between(force, mean.low, mean.high, color=colour, alpha=0.25, linewidth=0)
    left.set(xlabel=FORCE_LABEL, ylabel=r"raw stiffness $k\,/\,(E^* L)$")
    left.legend()
    right.axhspan(-tolerance, tolerance, **SHADE)
    right.axhline(0, color="k", linewidth=0.7)
    right.fill_between(force, result.low, result.high, color=dark, alpha=0.25, linewidth=0)
    right.semilogx(force, result.difference, color=dark)
    for sure, fill in ((result.resolved, "full"), (~result.resolved, "none")):
        right.semilogx(
            force[sure],
            result.difference[sure],
            color=dark,
            marker="o",
            linestyle="",
            fillstyle=fill,
        )
    right.yaxis.set_major_formatter(PercentFormatter(1, decimals=0))
    right.set(xlabel=FORCE_LABEL, ylabel="3D over 1D, less 1")
    return figure


def write_comparison(compared: ModelComparison, out: Path) -> list[Path]:
    """Write a table (CSV) and a figure.

    Raises
    ------
    StoreError
        If the folder cannot be written.
    """
    import pandas as pd  # here because it loads slowly

    make_folder(out)
    result = compared.comparison
    frame = pd.DataFrame(
        {
            "force_bar": result.force_bar,
            "stiffness_reduced": result.reduced.mean,
            "stiffness_full": result.full.mean,
            "difference": result.difference,
            "low": result.low,
            "high": result.high,
            "scatter": result.scatter,
            "resolved": result.resolved,
        }
    )
    try:
        frame.to_csv(out / "comparison.csv", index=False)
        with styled():
            files = save(comparison_figure(result, compared.tolerance), out, "comparison")
    except OSError as error:
        raise StoreError(f"cannot write to {out} ({error}): choose another folder") from error
    return [out / "comparison.csv", *files]
