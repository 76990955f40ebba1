"""Results of the studies other than the paper's, in short: a figure and verdicts, for the lab."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path


@dataclass(frozen=True)
class StudyCurve:
    """A curve or a row of marks.

    Attributes
    ----------
    name : str
        What the legend says; empty for curves that it leaves out.
    x, y : sequence of float
        Points.
    low, high : sequence of float
        Ends of their 95 % intervals; empty where none are drawn.
    colour : int
        Place in the ramp of six colours; -1 for the colour of text.
    dash : {"solid", "dashed", "dotted"}
        Of the line.
    marks : bool
        Whether points are marked, and not joined by a line.
    """

    name: str
    x: Sequence[float]
    y: Sequence[float]
    low: Sequence[float] = ()
    high: Sequence[float] = ()
    colour: int = -1
    dash: str = "solid"
    marks: bool = False


@dataclass(frozen=True)
class StudyPanel:
    """A panel of a figure.

    Attributes
    ----------
    title, x_label, y_label : str
        What it shows.
    x_range, y_range : sequence of float
        Ends of the axes.
    curves : sequence of StudyCurve
        What is drawn.
    is_log : bool
        Whether the x axis is logarithmic; the y axis is linear.
    """

    title: str
    x_label: str
    y_label: str
    x_range: Sequence[float]
    y_range: Sequence[float]
    curves: Sequence[StudyCurve]
    is_log: bool = True


@dataclass(frozen=True)
class StudySummary:
    """What a study found.

    Attributes
    ----------
    name : str
        Name of its page and of its folder.
    title, answer : str
        Its question, and the answer in a few sentences.
    header, rows : sequence
        The table of its verdicts; a verdict begins with confirmed, refuted or undecided.
    panels : sequence of StudyPanel
        Its figure.
    """

    name: str
    title: str
    answer: str
    header: Sequence[str]
    rows: Sequence[Sequence[str]]
    panels: Sequence[StudyPanel]


@cache
def study_summaries() -> list[StudySummary]:
    """Return the results of the studies that come with the package, by their names."""
    folder = summaries_folder()
    return [_read(path) for path in sorted(folder.glob("*.json"))]


def write_summary(summary: StudySummary) -> None:
    """Write what a study found into the package."""
    folder = summaries_folder()
    folder.mkdir(exist_ok=True)
    # five digits are more than a figure shows
    rounded = json.loads(
        json.dumps(asdict(summary)), parse_float=lambda digits: float(f"{float(digits):.5g}")
    )
    text = json.dumps(rounded, ensure_ascii=False, indent=0)
    (folder / f"{summary.name}.json").write_text(text + "\n", encoding="utf-8")


def summaries_folder() -> Path:
    """Folder of these results, a file for each study."""
    return Path(str(files("roughline.paper").joinpath("data", "studies")))


def _read(path: Path) -> StudySummary:
    content = json.loads(path.read_text(encoding="utf-8"))
    panels = [
        StudyPanel(**{**panel, "curves": [StudyCurve(**each) for each in panel["curves"]]})
        for panel in content.pop("panels")
    ]
    return StudySummary(**content, panels=panels)
