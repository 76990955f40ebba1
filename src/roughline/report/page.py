"""One self-contained HTML page from sections of text, tables and pictures."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path

import jinja2


@dataclass(frozen=True)
class Table:
    """A table; `numbers` are the columns set right, `verdict` is the one in colour."""

    header: Sequence[str]
    rows: Sequence[Sequence[str]]
    numbers: Sequence[int] = ()
    verdict: int | None = None


@dataclass(frozen=True)
class Picture:
    """A PNG with its name and caption."""

    path: Path
    name: str
    caption: str

    @property
    def png(self) -> str:
        """The file in base64, so that the page needs no other."""
        return base64.b64encode(self.path.read_bytes()).decode("ascii")


@dataclass(frozen=True)
class Section:
    """A heading and what stands below it, in this order."""

    heading: str
    paragraphs: Sequence[str] = ()
    note: str = ""
    tables: Sequence[Table] = ()
    pictures: Sequence[Picture] = field(default=())


def render(title: str, lead: str, sections: Sequence[Section]) -> str:
    """Return the page as HTML."""
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    environment.filters["verdict_class"] = _verdict_class
    source = files("roughline.report").joinpath("page.html.jinja").read_text(encoding="utf-8")
    return environment.from_string(source).render(title=title, lead=lead, sections=sections)


def _verdict_class(verdict: str) -> str:
    if verdict.startswith("not"):
        return "no"
    return "yes" if verdict == "confirmed" or verdict.startswith("confirmed, ") else "partly"
