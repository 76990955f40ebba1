"""Tables of text as wide as a screen: lines break between words, and never inside a number."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from rich.cells import cell_len

from roughline.report.values import value_and_interval

_COLUMN_GAP = 2  # blanks between columns
_ONE_LINE_WIDTH = 20  # columns of the screen up to which headers and names stay in one line


@dataclass(frozen=True)
class _ColumnBlock:
    """Lines of the header and of the body of some columns of a table."""

    header: Sequence[str]
    body: Sequence[str]


@dataclass(frozen=True)
class _Column:
    """A header, and lines of each cell below it; a long header may be broken, unless `unbroken`."""

    header: str
    cells: Sequence[Sequence[str]]
    unbroken: bool = False

    @property
    def width(self) -> int:
        """Columns of the screen that the cells and the header need."""
        unbroken = self.unbroken or cell_len(self.header) <= _ONE_LINE_WIDTH
        header = [self.header] if unbroken else self.header.split()
        return _longest([*header, *(line for cell in self.cells for line in cell)])

    def stacked(self) -> _Column:
        """A column with the intervals below the values, without brackets."""
        cells = []
        for (cell,) in self.cells:
            value, *interval = value_and_interval(cell)
            cells.append([value, *(re.sub("[()]", "", ends) for ends in interval)])
        return _Column(self.header, cells)


def blocks(
    header: Sequence[str], rows: Sequence[Sequence[str]], width: int
) -> Iterator[_ColumnBlock]:
    """Lay out a table of names and values in blocks below each other, each with the names.

    Where a table is too wide for so many columns of the screen, intervals stand below their values;
    what is then still too wide goes on in further blocks. Names are broken between words, or stand
    above their values.
    """
    names, *values = (
        _Column(head, [[cell] for cell in cells])
        for head, *cells in zip(header, *rows, strict=True)
    )
    in_line = [replace(each, unbroken=True) for each in values]
    if names.width + _widths(in_line) <= width:
        values = in_line
    elif names.width + _widths(values) > width:
        values = [each.stacked() for each in values]
    words = [word for (name,) in names.cells for word in name.split()]
    least = min(names.width, max(_ONE_LINE_WIDTH, _longest([*words, *names.header.split()])))
    above = least + max(map(_widths, ([each] for each in values)), default=0) > width
    while values:
        count = 1
        while count < len(values) and _widths(values[: count + 1]) <= width - least * (not above):
            count += 1
        taken, values = values[:count], values[count:]
        yield _above(names, taken) if above else _beside(names, taken, width - _widths(taken))


def paragraph(name: str, text: str, indent: int, width: int) -> str:
    """A name, and beside it a text that is broken between words."""
    lines = _wrapped(text, max(width - indent, _ONE_LINE_WIDTH))
    return f"{name:{indent}}" + f"\n{'':{indent}}".join(lines)


def _beside(names: _Column, values: Sequence[_Column], most: int) -> _ColumnBlock:
    """Names, in lines no longer than given, with values to the right of them."""
    wrapped = [_wrapped(name, most) for name in (names.header, *(cell[0] for cell in names.cells))]
    widths = [_longest(line for name in wrapped for line in name)]
    widths += [each.width for each in values]
    heads = [_wrapped(each.header, each.width) for each in values]
    body = []
    for name, *cells in zip(wrapped[1:], *(each.cells for each in values), strict=True):
        body += _lines([name, *cells], widths)
    return _ColumnBlock(_lines([wrapped[0], *heads], widths, at_bottom=True), body)


def _above(names: _Column, values: Sequence[_Column]) -> _ColumnBlock:
    """Names in lines of their own, with values below them."""
    widths = [0, *(each.width for each in values)]
    heads = [_wrapped(each.header, each.width) for each in values]
    body = []
    for (name,), *cells in zip(names.cells, *(each.cells for each in values), strict=True):
        body += [name, *_lines([[], *cells], widths)]
    return _ColumnBlock([names.header, *_lines([[], *heads], widths, at_bottom=True)], body)


def _lines(
    cells: Sequence[Sequence[str]], widths: Sequence[int], *, at_bottom: bool = False
) -> list[str]:
    """Lines of one row: the first cell to the left, the others to the right."""
    high = max(map(len, cells))
    lines = []
    for i in range(high):
        line = ""
        for j, (cell, width) in enumerate(zip(cells, widths, strict=True)):
            place = i - (high - len(cell)) * at_bottom
            text = cell[place] if 0 <= place < len(cell) else ""
            blank = " " * (width - cell_len(text))
            line += " " * _COLUMN_GAP + blank + text if j else text + blank
        lines.append(line.rstrip())
    return lines


def _widths(columns: Sequence[_Column]) -> int:
    """Columns of the screen that values take, with the blanks before them."""
    return sum(_COLUMN_GAP + each.width for each in columns)


def _wrapped(text: str, width: int) -> list[str]:
    """Lines that are broken between words alone."""
    return textwrap.wrap(text, width, break_long_words=False, break_on_hyphens=False)


def _longest(texts: Iterable[str]) -> int:
    """Columns of the screen that the longest text takes."""
    return max(map(cell_len, texts), default=0)
