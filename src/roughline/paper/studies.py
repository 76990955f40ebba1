"""What the studies found, in short: their pictures and verdicts, for the lab."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path


@dataclass(frozen=True)
class StudyPicture:
    """A picture that was drawn once, for the light and for the dark theme."""

    file: str  # its name, less the theme and the ending
    title: str
    caption: str
    alternative: str  # what it shows, in words and numbers
    size: Sequence[int]  # width and height [pixel]


@dataclass(frozen=True)
class StudySummary:
    """What a study found."""

    name: str  # name of its page and of its folder
    title: str  # its question
    answer: str  # in a few sentences
    # the table of its verdicts; a verdict begins with confirmed, refuted or undecided
    header: Sequence[str]
    rows: Sequence[Sequence[str]]
    pictures: Sequence[StudyPicture]


@cache
def study_summaries() -> dict[str, StudySummary]:
    """Return the results of the studies that come with the package, by their names."""
    folder = Path(str(files("roughline.paper").joinpath("data", "studies")))
    return {path.stem: _read(path) for path in sorted(folder.glob("*.json"))}


def _read(path: Path) -> StudySummary:
    content = json.loads(path.read_text(encoding="utf-8"))
    pictures = [StudyPicture(**each) for each in content.pop("pictures")]
    return StudySummary(**content, pictures=pictures)
