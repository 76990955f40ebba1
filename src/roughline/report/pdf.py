"""A page of sections as PDF."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import escape

from matplotlib import get_data_path

from roughline.errors import StoreError
from roughline.report.values import value_and_interval

if TYPE_CHECKING:
    from roughline.report.page import Section, Table

_SIZE = 6.6  # of the text, so that a page holds it [points]
_MARGIN = 36  # [points]
_SCALES = (1.0, 0.9, 0.8, 0.75, 0.7, 0.65, 0.6, 0.55)  # of a sheet that has to hold more
_PICTURE = 265  # height of a picture at most [points]
_PADDING = 6  # left and right of a cell, as ReportLab has it [points]


def write_pdf(
    path: Path,
    title: str,
    lead: str,
    sections: Sequence[Section],
    made: str = "",
    *,
    one_sheet: bool = True,
) -> None:
    """Write a page as PDF on A4: on one sheet, made smaller as long as it is legible, or on more.

    Parameters
    ----------
    path : Path
        Replaced if it exists.
    title, lead, sections, made
        As for :func:`roughline.report.page.render`.
    one_sheet : bool, optional
        Whether the page is made to fit one sheet, if it is then still legible.

    Raises
    ------
    StoreError
        If the file cannot be written.
    """
    from reportlab.lib.pagesizes import A4
    from reportlab.pdfbase import pdfmetrics
    from reportlab.pdfbase.ttfonts import TTFont
    from reportlab.platypus import SimpleDocTemplate

    folder = Path(get_data_path()) / "fonts" / "ttf"
    for name, file in (("Sans", "DejaVuSans"), ("Sans-Bold", "DejaVuSans-Bold")):
        pdfmetrics.registerFont(TTFont(name, folder / f"{file}.ttf"))
    document = SimpleDocTemplate(
        str(path),
        pagesize=A4,
        leftMargin=_MARGIN,
        rightMargin=_MARGIN,
        topMargin=_MARGIN,
        bottomMargin=_MARGIN,
        title=title,
        author="roughline",
        invariant=True,
    )
    room = (A4[0] - 2 * _MARGIN - 12, A4[1] - 2 * _MARGIN - 12)  # frames have a padding of 6
    flow_of = partial(_flow, title, lead, sections, made)
    flow = _on_one_sheet(flow_of, room) if one_sheet else []
    flow = flow or flow_of(room[0])
    try:
        document.build(flow)
    except OSError as error:
        raise StoreError(f"cannot write {path} ({error}): choose another folder") from error


def _on_one_sheet(flow_of: Callable[[float], list[Any]], room: tuple[float, float]) -> list[Any]:
    """What fits on a sheet, as large as it does; nothing if it could not be read.

    A smaller scale makes the sheet wider as well, so that fewer lines are broken.
    """
    from reportlab.platypus import KeepInFrame

    for scale in _SCALES:
        width = room[0] / scale
        high = sum(each.wrap(width, room[1])[1] for each in flow_of(width))
        if high * scale <= room[1]:
            return [KeepInFrame(*room, flow_of(width), mode="shrink")]
    return []


def _flow(title: str, lead: str, sections: Sequence[Section], made: str, width: float) -> list[Any]:
    """What stands on a sheet of some width, from the title down."""
    from reportlab.lib.utils import ImageReader
    from reportlab.platypus import Image, Paragraph, Spacer

    text, heading = _style(_SIZE, bold=False), _style(1.25 * _SIZE, bold=True)
    item = text.clone("item", leftIndent=1.5 * _SIZE, bulletIndent=0.4 * _SIZE)
    top = _style(2 * _SIZE, bold=True)
    flow: list[Any] = [Paragraph(escape(line), text) for line in (lead, made) if line]
    flow.insert(0, Paragraph(escape(title), top))
    for section in sections:
        flow.append(Spacer(1, _SIZE * 0.5))
        flow.append(Paragraph(escape(section.heading), heading))
        flow += [Paragraph(escape(paragraph), text) for paragraph in section.paragraphs]
        if section.note:
            flow.append(Paragraph(f"<i>{escape(section.note)}</i>", text))
        flow += [Paragraph(escape(note), item, bulletText="•") for note in section.notes]
        flow += [_table(table, width, text) for table in section.tables]
        for picture in section.pictures:
            wide, high = ImageReader(str(picture.path)).getSize()
            share = min(1.0, _PICTURE * wide / (high * width))
            flow.append(Image(str(picture.path), width * share, width * share * high / wide))
            flow.append(Paragraph(escape(f"{picture.name}. {picture.caption}"), text))
    return flow


def _style(size: float, bold: bool) -> Any:
    from reportlab.lib.styles import ParagraphStyle

    font = "Sans-Bold" if bold else "Sans"
    return ParagraphStyle(font + str(size), fontName=font, fontSize=size, leading=1.3 * size)


def _table(table: Table, width: float, style: Any) -> Any:
    from reportlab.lib import colors
    from reportlab.platypus import Paragraph
    from reportlab.platypus import Table as Grid

    lines = [table.header, *table.rows]
    rows = [
        [
            Paragraph(escape(_unbroken(cell) if i in table.numbers else cell), style)
            for i, cell in enumerate(line)
        ]
        for line in lines
    ]
    rules = [
        ("LINEBELOW", (0, 0), (-1, 0), 0.8, colors.black),
        ("LINEBELOW", (0, 1), (-1, -1), 0.2, colors.lightgrey),
        ("TOPPADDING", (0, 0), (-1, -1), 0.6),
        ("BOTTOMPADDING", (0, 0), (-1, -1), 0.9),
        ("VALIGN", (0, 0), (-1, -1), "TOP"),
    ]
    return Grid(rows, _widths(lines, width, style), style=rules, repeatRows=1, hAlign="LEFT")


def _unbroken(cell: str) -> str:
    """A number that is broken before its interval only."""
    return " ".join(piece.replace(" ", "\u00a0") for piece in value_and_interval(cell))


def _widths(lines: Sequence[Sequence[str]], width: float, style: Any) -> list[float]:
    """Widths of columns: what each needs in one line, or a share of what narrow ones leave."""
    from reportlab.pdfbase.pdfmetrics import stringWidth

    needed = [
        2 * _PADDING + max(stringWidth(cell, style.fontName, style.fontSize) for cell in column)
        for column in zip(*lines, strict=True)
    ]
    given = dict.fromkeys(range(len(needed)), 0.0)
    left = width
    for place, i in enumerate(sorted(given, key=needed.__getitem__)):
        given[i] = min(needed[i], left / (len(needed) - place))
        left -= given[i]
    return list(given.values())
