"""What all studies share: from claims, numbers and a text to a page, its figures, and the lab."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import cached_property
from pathlib import Path

from matplotlib.figure import Figure

from roughline.paper.results import published_folder
from roughline.paper.studies import StudySummary
from roughline.plot.style import save, styled
from roughline.report.page import Table, markdown_table
from roughline.statistics.verdict import Claim
from studies.panels import StudyPanel

DOCS = Path(__file__).parents[1] / "docs"
SUMMARIES = published_folder() / "studies"
PICTURES = published_folder().parents[1] / "lab" / "static" / "paper"
_SHARPNESS = 88  # of pictures, which are compressed as photographs are


@dataclass(frozen=True)
class Study:
    """A study: its folder has a plan, its numbers, its claims, and the text of its page."""

    folder: Path  # the folder; page and figures have its name
    verdicts: Callable[[], Table]  # returns the table of its verdicts
    # returns the numbers and tables that the text names beside the verdicts
    told: Callable[[], Mapping[str, object]]
    # draw the figures, by their file names without an ending
    figures: Mapping[str, Callable[[], Figure]] = field(default_factory=dict)
    # returns the panels that the lab shows
    panels: Callable[[], Sequence[StudyPanel]] | None = None

    @cached_property
    def page(self) -> str:
        """The page as Markdown."""
        text = (self.folder / "text.md").read_text(encoding="utf-8")
        return filled(text, {"verdicts": self.verdicts(), **self.told()})

    @cached_property
    def summary(self) -> StudySummary:
        """The study in short, for the lab."""
        title, answer, *_ = self.page.split("\n\n")
        table = self.verdicts()
        pictures = [each.picture(file) for file, each in self._panels.items()]
        return StudySummary(
            self.folder.name, title.removeprefix("# "), answer, table.header, table.rows, pictures
        )

    @cached_property
    def _panels(self) -> dict[str, StudyPanel]:
        """Its panels by the names of their files."""
        panels = self.panels() if self.panels else ()
        return {f"{self.folder.name}-{i}": each for i, each in enumerate(panels)}

    def publish(self) -> None:
        """Write the page and its figures into ``docs``, and into the package what the lab shows."""
        name, text = self.folder.name, self.page  # data that are refused leave all as it is
        folder = DOCS / "figures" / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        with styled():
            for file_name, draw in self.figures.items():
                _, pdf = save(draw(), folder, file_name)
                pdf.unlink()
        (DOCS / f"{name}.md").write_text(text, encoding="utf-8")
        if self.panels:
            show(self.summary, [each.figure for each in self._panels.values()])


def show(summary: StudySummary, drawings: Sequence[Callable[[], Figure]]) -> None:
    """Write into the package what the lab shows: words, and pictures for both themes."""
    for folder in (SUMMARIES, PICTURES):
        folder.mkdir(exist_ok=True)
    for picture, draw in zip(summary.pictures, drawings, strict=True):
        for theme in ("light", "dark"):
            with styled(dark=theme == "dark"):
                file = PICTURES / f"{picture.file}-{theme}.webp"
                draw().savefig(file, pil_kwargs={"quality": _SHARPNESS, "method": 6})
    kept = json.dumps(asdict(summary), ensure_ascii=False, indent=0) + "\n"
    (SUMMARIES / f"{summary.name}.json").write_text(kept, encoding="utf-8")


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
    return Table((*texts, *words), rows)
