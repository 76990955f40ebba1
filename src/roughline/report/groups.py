"""Answers in groups, each with a headline: how reports, the terminal and the lab tell them all."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from roughline.report.page import Headline, KeyFigure, Section, Table

if TYPE_CHECKING:
    from roughline.assessment.part import PartAnswer
    from roughline.engineering.rule import Answer

_MOST_FIGURES = 5  # that a page begins with


@dataclass(frozen=True)
class Group:
    """Answers about one thing.

    Attributes
    ----------
    name : str
        Such as "mechanics".
    keys : sequence of str
        Of its answers.
    headline : str
        Key of the answer that stands for it: its first leading one, or else its first.
    """

    name: str
    keys: Sequence[str]
    headline: str


def groups_of(
    answers: Mapping[str, Answer] | Mapping[str, PartAnswer], leading: Sequence[str]
) -> list[Group]:
    """The groups of answers, in the order of their rules; `leading` are keys that lead."""
    keys: dict[str, list[str]] = {}
    for key, each in answers.items():
        keys.setdefault(each.rule.group, []).append(key)
    return [
        Group(name, some, next((key for key in some if key in leading), some[0]))
        for name, some in keys.items()
    ]


def figures_of(groups: Sequence[Group], leading: Sequence[str]) -> list[str]:
    """Keys of the answers that are told in large figures: of each group, and further leading ones.

    A group without a leading answer has one only if it was asked for alone, as a reflection.
    """
    first = [each.headline for each in groups if each.headline in leading or len(each.keys) == 1]
    further = [key for key in leading if key not in first]
    shown = {*first, *further[: _MOST_FIGURES - len(first)]}
    return [key for each in groups for key in each.keys if key in shown]


def headline_of(
    names: Sequence[tuple[str, str]], warnings: Sequence[str], below: Sequence[str]
) -> Headline:
    """What a page begins with, from names and cells of answers, and remarks."""
    figures = [KeyFigure.of(name, cell) for name, cell in names]
    return Headline(
        figures, [*map(sentence, warnings)], " ".join(map(sentence, filter(None, below)))
    )


def sections_of(
    groups: Sequence[Group],
    told: Callable[[str], str],
    tables: Callable[[Sequence[str]], list[tuple[list[str], list[list[str]]]]],
) -> list[Section]:
    """A section for each group, folded behind its headline.

    `told` gives name and value of an answer by its key, `tables` header and rows of the tables of
    some.
    """
    return [
        Section(
            each.name.capitalize(),
            tables=[with_numbers(*table) for table in tables(each.keys)],
            behind=told(each.headline),
        )
        for each in groups
    ]


def with_numbers(header: list[str], rows: list[list[str]]) -> Table:
    """A table whose columns are numbers, but for the first."""
    return Table(header, rows, numbers=range(1, len(header)))


def grouped_rows(
    groups: Sequence[Group], rows: Callable[[Sequence[str]], list[list[str]]], columns: int
) -> list[list[str]]:
    """Rows of all groups in one table, each group but the first below a row with its name."""
    found: list[list[str]] = []
    for each in groups:
        if found:
            found.append([each.name.upper(), *[""] * (columns - 1)])
        found += rows(each.keys)
    return found


def counted(
    groups: Sequence[Group],
    told: Callable[[str], str],
    rows: Callable[[Sequence[str]], list[list[str]]],
) -> list[tuple[str, str, int]]:
    """Name, headline and number of rows of each group, for a page that folds one table."""
    return [(each.name, told(each.headline), len(rows(each.keys))) for each in groups]


def sentence(text: str) -> str:
    """A remark as a sentence: with a capital and a full stop; nothing stays nothing."""
    if not text:
        return ""
    return text[:1].upper() + text[1:] + ("" if text.endswith(".") else ".")
