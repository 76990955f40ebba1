"""A report as two files: the page as HTML, and the same as PDF to be printed."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date
from pathlib import Path

from roughline._version import __version__
from roughline.report.page import Headline, Section, render
from roughline.report.pdf import write_pdf


def write_document(
    folder: Path, title: str, lead: str, sections: Sequence[Section], headline: Headline
) -> list[Path]:
    """Write ``report.html`` and ``report.pdf``, with the date and version that made them.

    Raises
    ------
    StoreError
        If the PDF cannot be written.
    """
    made = f"Computed on {date.today().isoformat()} with roughline {__version__}."
    page, sheets = folder / "report.html", folder / "report.pdf"
    page.write_text(render(title, lead, sections, made, headline), encoding="utf-8")
    write_pdf(sheets, title, lead, sections, made, headline)
    return [page, sheets]
