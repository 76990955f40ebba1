"""What all studies share: from claims, numbers and a text to a page and its figures."""

from __future__ import annotations

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
        return filled(text, {"verdicts": self.verdicts(), **self.told()})

    def publish(self) -> None:
        """Write the page and its figures into ``docs``."""
        name, text = self.folder.name, self.page  # data that are refused leave all as it is
        folder = DOCS / "figures" / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        with styled():
            for file_name, draw in self.figures.items():
                _, pdf = save(draw(), folder, file_name)
                pdf.unlink()
        (DOCS / f"{name}.md").write_text(text, encoding="utf-8")


def filled(text: str, told: Mapping[str, object]) -> str:
    """Return a text with the numbers and tables that it names; each paragraph is one line."""
    unwrapped = re.sub(r"(?<=\S)\n *(?=[^\s#|-])", " ", text)
    return unwrapped.format_map(
        {name: markdown_table(x) if isinstance(x, Table) else x for name, x in told.items()}
    )


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
    return Table((*texts, *words), rows, (), len(texts))
