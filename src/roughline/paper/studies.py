"""Results of the studies other than the paper's, in short: a figure and verdicts, for the lab."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path


@dataclass(frozen=True)
class StudyCurve:
    """A curve or a row of marks."""

    name: str  # what the legend says; empty for curves that it leaves out
    x: Sequence[float]
    y: Sequence[float]
    low: Sequence[float] = ()  # ends of the 95 % intervals of y; empty where none are drawn
    high: Sequence[float] = ()
    colour: int = -1  # place in the ramp of six colours; -1 for the colour of text
    dash: str = "solid"  # of the line
    marks: bool = False  # whether points are marked, and not joined by a line


@dataclass(frozen=True)
class StudyPanel:
    """A panel of a figure."""

    title: str
    x_label: str
    y_label: str
    x_range: Sequence[float]  # ends of the axis
    y_range: Sequence[float]
    curves: Sequence[StudyCurve]
    is_log: bool = True  # whether the x axis is logarithmic; the y axis is linear


@dataclass(frozen=True)
class StudySummary:
    """What a study found."""

    name: str  # name of its page and of its folder
    title: str  # its question
    answer: str  # in a few sentences
    # the table of its verdicts; a verdict begins with confirmed, refuted or undecided
    header: Sequence[str]
    rows: Sequence[Sequence[str]]
    panels: Sequence[StudyPanel]  # its figure


@cache
def study_summaries() -> list[StudySummary]:
    """Return the results of the studies that come with the package, by their names."""
    folder = Path(str(files("roughline.paper").joinpath("data", "studies")))
    return [_read(path) for path in sorted(folder.glob("*.json"))]


def _read(path: Path) -> StudySummary:
    content = json.loads(path.read_text(encoding="utf-8"))
    panels = [
        StudyPanel(**{**panel, "curves": [StudyCurve(**each) for each in panel["curves"]]})
        for panel in content.pop("panels")
    ]
    return StudySummary(**content, panels=panels)
