"""A page of sections as PDF, to be printed: on as many sheets as it takes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from markupsafe import escape
from matplotlib import get_data_path

from roughline.errors import StoreError
from roughline.report.typeset import typeset
from roughline.report.values import value_and_interval

if TYPE_CHECKING:
    from roughline.report.page import Headline, KeyFigure, Section, Table

_FONT_SIZE = 9.0
"""Of the text and of tables; nothing but indices and powers is smaller. [points]"""

_FIGURE_SIZE, _HEADING_SIZE, _TITLE_SIZE = 15.0, 11.5, 16.0  # [points]
_LEADING = 1.3  # distance of lines over their size
_MARGIN = 38.0  # so that figures, 7.2 inches wide, keep their size [points]
_FOOTER_HEIGHT = 20.0  # above the edge of the sheet [points]
_LARGEST_PICTURE = 600.0  # its height [points]
_LEAST_ROOM = 140.0  # below which a section or a table begins on the next sheet [points]
_ROOM_OF_BARS = 200.0  # the same of a table with a title and a text above it [points]
_PADDING = 4.0  # left and right of a cell [points]
_NAMES_SHARE = 0.2  # share of the width that the first column gets at least, if it needs it
_WORD_SHARE = 0.4  # share of the width from which on a word is broken
_FIGURES_ABREAST = 3  # key figures beside each other
_ROWS_TOGETHER = 3  # first or last rows of a table that stay on one sheet
_SUBSCRIPT, _SUPERSCRIPT = '<sub rise="1.5" size="7">', '<sup rise="3" size="7">'
_WARNING_COLOUR = "#fbe9e7"  # behind warnings


def write_pdf(
    path: Path,
    title: str,
    lead: str,
    sections: Sequence[Section],
    made: str = "",
    headline: Headline | None = None,
) -> None:
    """Write a page as PDF on sheets of A4, with their numbers at the foot.

    Tables that are too wide go on below, with their first column; headers are repeated on every
    sheet.

    Raises
    ------
    StoreError
        If the file cannot be written.
    """
    _register_fonts()

    def build(target: str | BytesIO, count: int) -> int:
        """Write all sheets to a target, and return how many they are."""
        document = _document(target, title)

        def foot(canvas: Any, _: Any) -> None:
            canvas.setFont("Sans", _FONT_SIZE)
            number = f"page {canvas.getPageNumber()} of {count}"
            canvas.drawRightString(_MARGIN + document.width - 12, _FOOTER_HEIGHT, number)
            canvas.drawString(_MARGIN, _FOOTER_HEIGHT, _shortened(title, 0.8 * document.width))

        flow = _flow(title, lead, sections, made, headline, document.width - 12)
        document.build(flow, onFirstPage=foot, onLaterPages=foot)
        return int(document.page)

    try:
        build(str(path), build(BytesIO(), 0))  # how many there are is known at the end only
    except OSError as error:
        raise StoreError(f"cannot write {path} ({error}): choose another folder") from error


def _register_fonts() -> None:
    """Make the fonts of the figures known to ReportLab."""
    from reportlab.pdfbase import pdfmetrics
    from reportlab.pdfbase.ttfonts import TTFont

    folder = Path(get_data_path()) / "fonts" / "ttf"
    for name, file in (("Sans", "DejaVuSans"), ("Sans-Bold", "DejaVuSans-Bold")):
        pdfmetrics.registerFont(TTFont(name, folder / f"{file}.ttf"))


def _document(target: str | BytesIO, title: str) -> Any:
    """Sheets of A4; their frames have a padding of 6 points."""
    from reportlab.lib.pagesizes import A4
    from reportlab.platypus import SimpleDocTemplate

    return SimpleDocTemplate(
        target,
        pagesize=A4,
        leftMargin=_MARGIN - 6,
        rightMargin=_MARGIN - 6,
        topMargin=_MARGIN,
        bottomMargin=_MARGIN + 6,
        title=title,
        author="roughline",
        invariant=True,
    )


def _flow(
    title: str,
    lead: str,
    sections: Sequence[Section],
    made: str,
    headline: Headline | None,
    width: float,
) -> list[Any]:
    """What stands on the sheets, from the title down."""
    from reportlab.lib import colors
    from reportlab.platypus import CondPageBreak, KeepTogether, Paragraph, Spacer

    text, small = _style(_FONT_SIZE), _style(_FONT_SIZE, textColor=colors.HexColor("#555555"))
    heading = _style(_HEADING_SIZE, bold=True, keepWithNext=1, spaceBefore=_FONT_SIZE, spaceAfter=3)
    item = _style(_FONT_SIZE, leftIndent=12, bulletIndent=3, spaceAfter=2)
    flow: list[Any] = [Paragraph(escape(title), _style(_TITLE_SIZE, bold=True, spaceAfter=4))]
    if headline is not None:
        grave = _style(
            _FONT_SIZE, backColor=colors.HexColor(_WARNING_COLOUR), borderPadding=3, spaceAfter=7
        )
        flow += [Spacer(1, 3)] if headline.warnings else []
        flow += [Paragraph(f"Warning: {_set(each)}", grave) for each in headline.warnings]
    flow += [Paragraph(escape(lead), _style(_FONT_SIZE + 1, spaceAfter=4))] if lead else []
    if headline is not None and headline.figures:
        flow += [_key_figures(headline.figures, width), Spacer(1, 3)]
        flow += [Paragraph(_set(headline.below), text)] if headline.below else []
    flow += [Paragraph(escape(made), small)] if made else []
    parts = [_section_parts(section, heading, text, item, width) for section in sections]
    last = len(sections)
    while last > 1 and not (sections[last - 1].tables or sections[last - 1].pictures):
        last -= 1  # words at the end, which would leave a sheet to a line
    for each in parts[:last]:
        flow += [CondPageBreak(_LEAST_ROOM), *each]
    return [*flow, KeepTogether([every for each in parts[last:] for every in each])]


def _section_parts(section: Section, heading: Any, text: Any, item: Any, width: float) -> list[Any]:
    """A section, in styles of its heading, its text and its notes."""
    from reportlab.platypus import CondPageBreak, Paragraph, Spacer

    spaced = text.clone("spaced", spaceAfter=3)
    flow: list[Any] = [Paragraph(escape(section.heading), heading)]
    flow += [Paragraph(_set(paragraph), spaced) for paragraph in section.paragraphs]
    flow += [Paragraph(escape(paragraph), spaced) for paragraph in section.verbatim]
    flow += [Paragraph(_set(section.note), spaced)] if section.note else []
    flow += [Paragraph(_set(note), item, bulletText="•") for note in section.notes]
    for i, grid in enumerate(grid for each in section.tables for grid in _grids(each, width)):
        flow += [CondPageBreak(_LEAST_ROOM)] if i else []  # the first stays below its heading
        flow += [Spacer(1, 5), grid]
    if section.bars is not None:
        title = _style(_FONT_SIZE, bold=True, keepWithNext=1, spaceBefore=7, spaceAfter=2)
        flow += [CondPageBreak(_ROOM_OF_BARS), Paragraph(_set(section.bars.title), title)]
        flow += [Paragraph(_set(section.bars.about), spaced)]
        flow += _grids(section.bars.table, width)
    for each in section.pictures:
        flow += _picture(each.path, f"{each.name}. {each.caption}", width)
    return flow


def _style(size: float, *, bold: bool = False, **others: Any) -> Any:
    from reportlab.lib.styles import ParagraphStyle

    font = "Sans-Bold" if bold else "Sans"
    unbroken = {"allowWidows": 0, "allowOrphans": 0}  # no line alone on a sheet
    return ParagraphStyle(
        font, fontName=font, fontSize=size, leading=_LEADING * size, **unbroken, **others
    )


def _key_figures(figures: Sequence[KeyFigure], width: float) -> Any:
    """The answers that lead, in large figures: name, value and interval."""
    from reportlab.lib import colors
    from reportlab.platypus import Paragraph
    from reportlab.platypus import Table as Grid

    text, large = _style(_FONT_SIZE), _style(_FIGURE_SIZE, bold=True)
    rows: list[list[Any]] = []
    for i in range(0, len(figures), _FIGURES_ABREAST):
        row_figures = figures[i : i + _FIGURES_ABREAST]
        blank = [""] * (_FIGURES_ABREAST - len(row_figures))
        values = [
            [Paragraph(_unbroken(each.value), large), Paragraph(_set(each.interval), text)]
            for each in row_figures
        ]
        rows += [[Paragraph(_set(each.name), text) for each in row_figures] + blank, values + blank]
    rules = [
        ("VALIGN", (0, 0), (-1, -1), "TOP"),
        ("LEFTPADDING", (0, 0), (-1, -1), 0),
        ("TOPPADDING", (0, 0), (-1, -1), 2),
        ("BOTTOMPADDING", (0, 0), (-1, -1), 2),
        *(("LINEABOVE", (0, i), (-1, i), 0.6, colors.grey) for i in range(0, len(rows), 2)),
    ]
    return Grid(rows, [width / _FIGURES_ABREAST] * _FIGURES_ABREAST, style=rules, hAlign="LEFT")


def _picture(path: Path, caption: str, width: float) -> list[Any]:
    """A picture with its caption, on one sheet, and on that of a heading above it."""
    from reportlab.lib.utils import ImageReader
    from reportlab.platypus import Image, Paragraph, Spacer

    wide, high = ImageReader(str(path)).getSize()
    share = min(1.0, _LARGEST_PICTURE * wide / (high * width))
    image = Image(str(path), width * share, width * share * high / wide)
    space = Spacer(1, 5)
    space.keepWithNext = image.keepWithNext = 1
    return [space, image, Paragraph(_set(caption), _style(_FONT_SIZE))]


def _grids(table: Table, width: float) -> Iterator[Any]:
    """A table, or several of the same rows where its columns do not fit beside each other."""
    from reportlab.lib import colors
    from reportlab.platypus import Paragraph
    from reportlab.platypus import Table as Grid

    styles = {
        (bold, right): _style(_FONT_SIZE, bold=bold, alignment=2 if right else 0)
        for bold in (False, True)
        for right in (False, True)
    }
    rules = [
        ("LINEBELOW", (0, 0), (-1, 0), 0.8, colors.black),
        ("LINEBELOW", (0, 1), (-1, -1), 0.2, colors.lightgrey),
        ("TOPPADDING", (0, 0), (-1, -1), 1),
        ("BOTTOMPADDING", (0, 0), (-1, -1), 2),
        ("LEFTPADDING", (0, 0), (-1, -1), _PADDING),
        ("RIGHTPADDING", (0, 0), (-1, -1), _PADDING),
        ("VALIGN", (0, 0), (-1, -1), "TOP"),
        ("NOSPLIT", (0, 0), (-1, min(_ROWS_TOGETHER, len(table.rows)))),
        ("NOSPLIT", (0, max(-_ROWS_TOGETHER, -len(table.rows))), (-1, -1)),
    ]
    lines = [table.header, *table.rows]
    for columns in _abreast(table, width):
        rows = [
            [
                Paragraph(
                    _unbroken(line[i]) if i in table.numbers and n else _set(line[i]),
                    styles[n == 0, i in table.numbers],
                )
                for i in columns
            ]
            for n, line in enumerate(lines)
        ]
        widths = _widths(table, columns, width)
        yield Grid(rows, widths, style=rules, repeatRows=1, hAlign="LEFT")


def _set(text: str) -> str:
    """A text with its symbols, whose low letters stay clear of the line below."""
    return str(typeset(text)).replace("<sub>", _SUBSCRIPT).replace("<sup>", _SUPERSCRIPT)


def _unbroken(cell: str) -> str:
    """A number that is broken before its interval only."""
    pieces = value_and_interval(cell)
    return " ".join(_set(piece.replace(" ", "\u00a0")) for piece in pieces)


def _abreast(table: Table, width: float) -> list[list[int]]:
    """Columns that fit beside each other, by their numbers, each time with the first."""
    if not table.numbers:
        return [[*range(len(table.header))]]
    least = [_least(table, i, width) for i in range(len(table.header))]
    least[0] = max(least[0], _NAMES_SHARE * width)
    groups = [[0]]
    for i in range(1, len(table.header)):
        if len(groups[-1]) > 1 and sum(least[j] for j in (*groups[-1], i)) > width:
            groups.append([0])
        groups[-1].append(i)
    return groups


def _widths(table: Table, columns: Sequence[int], width: float) -> list[float]:
    """Widths of columns: what each needs in one line, or its part of what there is.

    Each has room for its longest word, and what is left is shared as it is needed.
    """
    needed = [max(map(_length, _cells(table, i))) + 2 * _PADDING for i in columns]
    if sum(needed) <= width:
        return needed
    least = [_least(table, i, width) for i in columns]
    least[0] = max(least[0], min(needed[0], _NAMES_SHARE * width))
    wanted = [max(need - low, 0.0) for need, low in zip(needed, least, strict=True)]
    part = min(1.0, max(width - sum(least), 0.0) / (sum(wanted) or 1.0))
    return [low + part * want for low, want in zip(least, wanted, strict=True)]


def _least(table: Table, column: int, width: float) -> float:
    """Width that a column has at least: that of its longest word, or of its longest number."""
    header, *cells = _cells(table, column)
    if column in table.numbers:
        pieces = [piece for cell in cells for piece in value_and_interval(cell)]
    else:
        pieces = [word for cell in cells for word in cell.split()]
    pieces += header.split()
    return min(max(map(_length, pieces), default=0.0) + 2 * _PADDING, _WORD_SHARE * width)


def _cells(table: Table, column: int) -> list[str]:
    return [line[column] for line in (table.header, *table.rows)]


def _length(text: str) -> float:
    """Length of a text in bold, the widest that it may be set in. [points]"""
    from reportlab.pdfbase.pdfmetrics import stringWidth

    return float(stringWidth(text, "Sans-Bold", _FONT_SIZE)) + 0.5


def _shortened(text: str, width: float) -> str:
    """A text that fits into a line, its end left out if need be."""
    while _length(text) > width:
        text = f"{text[:-2]}…"
    return text
