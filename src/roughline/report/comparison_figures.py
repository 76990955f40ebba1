"""The comparison of both models in files: a table and a figure."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from roughline.errors import StoreError
from roughline.plot.models import comparison, difference
from roughline.plot.style import PAGE, new_figure, save, styled
from roughline.report.folder import make_folder

if TYPE_CHECKING:
    from roughline.assessment.comparison import ModelComparison
    from roughline.contact.comparison.models import Comparison


def _comparison_figure(result: Comparison, tolerance: float) -> Figure:
    """Both curves, and their relative difference with its interval."""
    figure = new_figure(PAGE, 3.0)
    left, right = figure.subplots(1, 2)
    comparison(result, left)
    difference(result, tolerance, right)
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
            files = save(_comparison_figure(result, compared.tolerance), out, "comparison")
    except OSError as error:
        raise StoreError(f"cannot write to {out} ({error}): choose another folder") from error
    return [out / "comparison.csv", *files]
