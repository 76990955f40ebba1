"""The comparison of both models: as a table, its verdict in words, on the terminal, in files."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from roughline.errors import StoreError
from roughline.report.folder import make_folder
from roughline.report.terminal import print_files, print_remarks, print_table
from roughline.statistics.verdict import Verdict

if TYPE_CHECKING:
    from roughline.comparison.compared import ModelComparison


def comparison_table(compared: ModelComparison) -> tuple[list[str], list[list[str]]]:
    """Return header and rows; a star marks loads that the grid decides."""
    result = compared.comparison
    within = f"within {compared.tolerance:.0%}"
    header = ["F / (E* h L)", "k 1D", "k 3D", "k 3D / k 1D - 1", within]
    shows_map = any(entry is not None for entry in compared.from_map)
    rows = []
    for i, difference in enumerate(result.differences()):
        sure = "" if difference.resolved else " *"
        interval = f"{difference.value:+.1%} ({difference.low:+.1%} to {difference.high:+.1%})"
        row = [
            f"{result.force_bar[i]:.3g}",
            f"{result.reduced.mean[i]:.4f}",
            f"{result.full.mean[i]:.4f}",
            interval + sure,
            difference.verdict(compared.tolerance),
        ]
        entry = compared.from_map[i]
        rows.append([*row, str(entry) if entry else "-"] if shows_map else row)
    return ([*header, "the map says"] if shows_map else header), rows


def verdict_in_words(compared: ModelComparison) -> str:
    """Say in a few sentences where the reduced model may be trusted, and for which surfaces."""
    result, share = compared.comparison, f"{compared.tolerance:.0%}"
    window = result.trusted(compared.tolerance)
    verdicts = compared.verdicts
    undecided = verdicts.count(Verdict.UNDECIDED)
    text = f"agreement within {share} is confirmed "
    text += (
        f"from F / (E* h L) = {window[0]:.3g} to {window[1]:.3g}"
        if window
        else "at no load that the grid resolves"
    )
    text += (
        f", refuted at {verdicts.count(Verdict.REFUTED)} and undecided at {undecided} of "
        f"{len(verdicts)} loads"
    )
    if result.surfaces == 1:
        return (
            f"{text}. This verdict is for all surfaces with this spectrum, of which this is one: "
            f"single surfaces scatter by {result.scatter.max():.0%} or less, and the interval "
            "includes that scatter"
        )
    return f"{text}; more surfaces would decide more of them" if undecided else text


def print_comparison(compared: ModelComparison, files: Iterable[Path] = ()) -> None:
    """Print both curves, their difference, and where the reduced model may be trusted."""
    console = Console(markup=False)
    console.print(compared.what, highlight=False, soft_wrap=True)
    print_remarks(console, "warning", compared.comparison.warnings)
    print_table(console, *comparison_table(compared))
    if not compared.comparison.resolved.all():
        console.print("* fewer than ten cells in contact: the grid decides, not the surface")
    console.print(verdict_in_words(compared), highlight=False, soft_wrap=True)
    print_files(files)


def write_comparison(compared: ModelComparison, out: Path) -> list[Path]:
    """Write a table (CSV) and a figure.

    Raises
    ------
    StoreError
        If the folder cannot be written.
    """
    import pandas as pd  # here because these load slowly

    from roughline.plot.models import comparison, difference
    from roughline.plot.style import PAGE, new_figure, save, styled

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
            figure = new_figure(PAGE, 3.0)
            left, right = figure.subplots(1, 2)
            comparison(result, left)
            difference(result, compared.tolerance, right)
            files = save(figure, out, "comparison")
    except OSError as error:
        raise StoreError(f"cannot write to {out} ({error}): choose another folder") from error
    return [out / "comparison.csv", *files]
