"""A study's page and figures, written into ``docs``."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping
from pathlib import Path

from matplotlib.figure import Figure

from roughline.paper.studies import StudySummary, write_summary
from roughline.plot.style import save, styled

DOCS = Path(__file__).parents[1] / "docs"


def publish(
    name: str,
    page: Callable[[], str],
    figures: Mapping[str, Callable[[], Figure]],
    summary: Callable[[], StudySummary] | None = None,
) -> None:
    """Write ``docs/NAME.md``, the figures into ``docs/figures/NAME``, and what the lab shows.

    Parameters
    ----------
    name : str
        Name of the page.
    page : callable
        Returns the page as Markdown.
    figures : mapping of str to callable
        Draw the figures, by their file names without an ending.
    summary : callable, optional
        Returns the study in short, which comes with the package.
    """
    text = page()  # data that are refused leave everything as it is
    folder = DOCS / "figures" / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    with styled():
        for file_name, draw in figures.items():
            _, pdf = save(draw(), folder, file_name)
            pdf.unlink()
    (DOCS / f"{name}.md").write_text(text, encoding="utf-8")
    if summary is not None:
        write_summary(summary())
