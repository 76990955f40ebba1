"""One self-contained HTML page from sections of text, tables and pictures."""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from roughline.report.values import value_and_interval
from roughline.statistics.verdict import Verdict

if TYPE_CHECKING:
    import jinja2

    from roughline.report.judged import JudgedClaim


@dataclass(frozen=True)
class Table:
    """A table; `numbers` are the columns set right."""

    header: Sequence[str]
    rows: Sequence[Sequence[str]]
    numbers: Sequence[int] = ()

    @classmethod
    def with_numbers(cls, header: Sequence[str], rows: Sequence[Sequence[str]]) -> Table:
        """A table whose columns are numbers, but for the first."""
        return cls(header, rows, numbers=range(1, len(header)))


@dataclass(frozen=True)
class Picture:
    """A PNG with its name and caption, and what it is put beside, in words."""

    path: Path
    name: str
    caption: str
    beside: str = ""

    @property
    def png(self) -> str:
        """The file in base64, so that the page needs no other."""
        return base64.b64encode(self.path.read_bytes()).decode("ascii")


@dataclass(frozen=True)
class Bar:
    """What one cause leaves open: its ends in words, and what would narrow it.

    It is drawn from its left end, as wide as it is, in per cent of the axis; not without a width.
    """

    name: str
    ends: str
    remedy: str = ""
    left: float = 0.0
    width: float | None = None


@dataclass(frozen=True)
class BarGroup:
    """What some answers have in common: the bar of the whole interval, and one of each cause."""

    names: str
    bars: Sequence[Bar]


@dataclass(frozen=True)
class Bars:
    """Bars on one axis; `ticks` are places on it, and `value` that of the value. [% of it]"""

    title: str
    about: str
    ticks: Mapping[str, float]
    value: float
    groups: Sequence[BarGroup]

    header: ClassVar[tuple[str, str, str]] = (
        "left open by",
        "times the value",
        "what would narrow it",
    )

    @property
    def table(self) -> Table:
        """The same numbers as a table."""
        rows = [
            [each.names if i == 0 else "", bar.name, bar.ends, bar.remedy]
            for each in self.groups
            for i, bar in enumerate(each.bars)
        ]
        return Table(["answer", *self.header], rows)


@dataclass(frozen=True)
class Section:
    """A heading and the content below it; `notes` are shown as a list.

    Symbols in it are set, but for paragraphs that are to be typed again, which are `verbatim`.

    On a screen the content is folded behind the heading where `behind` says in short what it is.
    """

    heading: str
    paragraphs: Sequence[str] = ()
    note: str = ""
    notes: Sequence[str] = ()
    tables: Sequence[Table] = ()
    pictures: Sequence[Picture] = ()
    abreast: Sequence[Picture] = ()
    behind: str = ""
    verbatim: Sequence[str] = ()
    bars: Bars | None = None
    claims: Sequence[JudgedClaim] = ()


@dataclass(frozen=True)
class KeyFigure:
    """A leading answer: what it is called, its value with its unit, its interval, a sentence."""

    name: str
    value: str
    interval: str = ""
    sentence: str = ""

    @classmethod
    def of(cls, name: str, cell: str) -> KeyFigure:
        """A cell of a table as a key figure."""
        value, *interval = value_and_interval(cell)
        joined = " ".join(interval)
        return cls(name, value, joined[1:-1] if joined.startswith("(") else joined)


@dataclass(frozen=True)
class Headline:
    """What a page begins with: warnings, pictures, the answers that lead, a remark below them."""

    figures: Sequence[KeyFigure]
    warnings: Sequence[str] = ()
    below: str = ""
    pictures: Sequence[Picture] = ()


def render(
    title: str,
    lead: str,
    sections: Sequence[Section],
    made: str = "",
    headline: Headline | None = None,
) -> str:
    """Return the page as HTML; `made` says when and with which version it was made."""
    return _template("page.html.jinja").render(
        title=title, lead=lead, sections=sections, made=made, headline=headline
    )


def render_markdown(
    title: str,
    lead: str,
    sections: Sequence[Section],
    folder: str,
    headline: Headline | None = None,
) -> str:
    """Return the page as Markdown, with its pictures in a folder beside it."""
    headline = headline or Headline(())
    parts = [f"# {title}", *headline.warnings, lead]
    parts += [_markdown_pictures(headline.pictures, folder)]
    parts += ["\n".join(f"- {each.sentence}" for each in headline.figures)]
    for section in sections:
        parts += [f"## {section.heading}", *section.paragraphs, *section.verbatim]
        parts += ["\n".join(f"- {note}" for note in section.notes)] if section.notes else []
        parts += [markdown_table(table) for table in section.tables]
        parts += [markdown_table(section.bars.table)] if section.bars else []
        parts += [_template("claims.html.jinja").render(section=section)] if section.claims else []
        abreast = [section.abreast, *([each] for each in section.pictures)]
        parts += [_markdown_pictures(each, folder) for each in abreast]
        parts += [section.note] if section.note else []
    return "\n\n".join(filter(None, parts)) + "\n"


def _template(name: str) -> jinja2.Template:
    import jinja2  # here because the terminal needs none

    from roughline.report.typeset import typeset

    environment = jinja2.Environment(
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        loader=jinja2.PackageLoader("roughline.report", "."),
    )
    environment.filters["typeset"] = typeset
    environment.filters["verdict_class"] = _verdict_class
    environment.filters["value_and_interval"] = value_and_interval
    return environment.get_template(name)


def _markdown_pictures(pictures: Sequence[Picture], folder: str) -> str:
    """Return pictures of that folder abreast, and below them what each is put beside and shows."""
    images = "\n".join(f"![{each.name}]({folder}/{each.path.name})" for each in pictures)
    words = (w for x in pictures for w in (x.beside, f"**{x.name}.** {x.caption}"))
    return "\n\n".join(filter(None, (images, *words)))


def markdown_table(table: Table) -> str:
    """Return a table as Markdown."""
    rule = "|".join("--:" if i in table.numbers else "---" for i in range(len(table.header)))
    cells = [[cell.replace("|", "\\|") for cell in row] for row in (table.header, *table.rows)]
    header, *rows = (f"| {' | '.join(row)} |" for row in cells)
    return "\n".join([header, f"|{rule}|", *rows])


def sentence(text: str) -> str:
    """A remark as a sentence: with a capital and a full stop; nothing stays nothing."""
    if not text:
        return ""
    return text[:1].upper() + text[1:] + ("" if text.endswith(".") else ".")


def _verdict_class(words: str) -> str:
    classes = {Verdict.CONFIRMED: "yes", Verdict.REFUTED: "no"}
    return next((name for each, name in classes.items() if words.startswith(each)), "partly")
