"""What all studies share: from claims, numbers and a text to a page and its figures."""

from __future__ import annotations

import csv
import re
import shutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from matplotlib.figure import Figure

from roughline.plot.style import save, styled
from roughline.report.page import Table, markdown_table
from roughline.statistics.verdict import Claim

DOCS = Path(__file__).parents[1] / "docs"
_SHOWN = 10  # rows of a table on a page; all of them are in its file
_IN_FILES_ALONE = {"Basis"}  # columns that a page leaves to the file


@dataclass(frozen=True)
class Study:
    """A study: its folder has a plan, its numbers, its claims, and the text of its page."""

    folder: Path  # the folder; page and figures have its name
    verdicts: Callable[[], Table]  # returns the table of its verdicts
    # returns the numbers and tables that the text names beside the verdicts
    told: Callable[[], Mapping[str, object]]
    # draw the figures, by their file names without an ending
    figures: Mapping[str, Callable[[], Figure]] = field(default_factory=dict)

    @cached_property
    def page(self) -> str:
        """The page as Markdown."""
        text = (self.folder / "text.md").read_text(encoding="utf-8")
        return filled(text, self._named, self.folder.name)

    @cached_property
    def _named(self) -> Mapping[str, object]:
        """What the text names."""
        return {"verdicts": self.verdicts(), **self.told()}

    def publish(self) -> None:
        """Write page, figures and tables into ``docs``."""
        name, text = self.folder.name, self.page  # data that are refused leave all as it is
        folder = DOCS / "figures" / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        with styled():
            for file_name, draw in self.figures.items():
                _, pdf = save(draw(), folder, file_name)
                pdf.unlink()
        (DOCS / f"{name}.md").write_text(text, encoding="utf-8")
        write_tables(self._named, name)


def filled(text: str, told: Mapping[str, object], study: str) -> str:
    """Return a text with the numbers and tables that it names; each paragraph is one line."""
    unwrapped = re.sub(r"(?<=\S)\n *(?=[^\s#|-])", " ", text)
    return unwrapped.format_map(
        {
            name: _in_short(x, f"data/{study}/{name}.csv") if isinstance(x, Table) else x
            for name, x in told.items()
        }
    )


def write_tables(told: Mapping[str, object], study: str) -> None:
    """Write the tables that a text may name into the data of the handbook."""
    folder = DOCS / "data" / study
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name, table in told.items():
        if isinstance(table, Table):
            write_table(table, folder / f"{name}.csv")


def write_table(table: Table, path: Path) -> None:
    """Write a table as CSV."""
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([table.header, *table.rows])


def _in_short(table: Table, file: str) -> str:
    """Return a table as Markdown, ten rows of it at most, spread evenly, with a link to all."""
    count = len(table.rows)
    places = [*range(count)]
    if count > _SHOWN:
        places = [round(i * (count - 1) / (_SHOWN - 1)) for i in range(_SHOWN)]
    columns = [i for i, name in enumerate(table.header) if name not in _IN_FILES_ALONE]
    header, *rows = (
        [row[i] for i in columns] for row in (table.header, *(table.rows[i] for i in places))
    )
    numbers = [columns.index(i) for i in table.numbers if i in columns]
    shown = markdown_table(Table(header, rows, numbers))
    which = f"all {count} rows" if count > _SHOWN else "these rows"
    return f"{shown}\n\n[As CSV, {which}]({file})."


def claims_table(judged: Mapping[str, Sequence[Claim]]) -> Table:
    """Return claims as a table, with a column of verdicts for each way to judge them."""
    claims, *_ = judged.values()
    texts = {
        "What is said": [each.statement for each in claims],
        "Found here": [each.found for each in claims],
        "95 % interval": [each.interval for each in claims],
    }
    if any(each.basis for each in claims):
        texts["Basis"] = [each.basis for each in claims]
    words = {name: [each.cases for each in of_it] for name, of_it in judged.items()}
    rows = list(zip(*texts.values(), *words.values(), strict=True))
    return Table((*texts, *words), rows)
