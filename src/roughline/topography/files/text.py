"""Tables of numbers in text: separators, decimal signs, missing points, lines above the table."""

from __future__ import annotations

import codecs
import math
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.memory import refuse_beyond_memory
from roughline.errors import InputError

READ_AS_TEXT = (
    "text is read as a matrix of heights or as lines of x z or x y z, separated by spaces, tabs, "
    "semicolons or commas"
)
"""What text is read, for messages."""

_LIST = 3  # columns of a list of points, at most
_LAST_ROWS = 50  # that show how many decimals numbers have
_PIECE = 2**20  # of a file that is read in pieces [bytes]
_SAMPLE = 4096  # bytes that show whether a file is text
_BYTES_PER_CHARACTER = 5  # of text: as characters, as lines and as numbers
_CONTROLS = re.compile(rb"[\x00-\x08\x0e-\x1f]")
_MARKS = {codecs.BOM_UTF16_LE: "utf-16", codecs.BOM_UTF16_BE: "utf-16"}
_COMMENT = re.compile(r"\s*(?:#(?!N/A|NV|VALUE)|%|//|!)", re.IGNORECASE)

_FOREIGN_HEAD = re.compile(r"X;Y;valid")  # SurfaceTopography reads them whole
_OPENS, _CLOSES = "{", "}"  # a list of points, in what Alicona's programs write
_BETWEEN = (r"[\s;,]+", r"[\s;]+")  # cells, where a comma separates, and where it is a decimal sign
_NUMBER = re.compile(r"[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?")
_MISSING_WORDS = {"", "nan", "bad", "n/a", "na", "null", "none", "inf", "+inf", "-inf"}
_MISSING_WORDS |= {"#n/a", "#nv", "#value!"}  # of spreadsheets
_MISSING_SIGNS = re.compile(r"\*+|-{2,}|[?]+|[-+]?1\.#[A-Za-z]+")
_CELL = (
    r"(?:[-+]?(?:\d[\d.,]*|[.,]\d+)(?:[eE][-+]?\d+)?|nan|bad|n/?a|null|none|[-+]?inf|#n/a|#nv|"
    r"#value!|\*+|-{2,}|[?]+|[-+]?1\.#[a-z]+)"
)
_PLAIN_ROW = re.compile(
    rf"\s*(?:{_NUMBER.pattern}|nan|bad|inf)(?:\s+(?:{_NUMBER.pattern}|nan|bad|inf))*\s*",
    re.IGNORECASE,
)
_FIRST_ROW = re.compile(rf"[\s,;]*{_CELL}(?:[\s,;]+{_CELL})*[\s,;]*", re.IGNORECASE)
_INTEGERS_OF_DECIMALS = re.compile(r"(?:^|,)\s*[-+]?0\d", re.MULTILINE)
_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2},\d{3}")
_WITH_COMMA = re.compile(r"[-+]?\d+,\d+")

_STAND_FOR_MISSING = (-9999.0, -99999.0, -999999.0, 9999.0, 99999.0, -32768.0, 32767.0)
_HUGE = 1e30  # no height in any unit; programs write such numbers for missing points


@dataclass(frozen=True, eq=False)
class TextTable:
    """Rows of numbers in a text."""

    head: tuple[str, ...]  # lines above the rows, without blank ones
    rows: Real  # shape (rows, columns): the numbers; NaN where a point is marked as missing
    separator: str | None  # between the numbers of a row; None for white space
    decimal: str  # the decimal sign


_Cells = list[tuple[int, list[str]]]  # the cells of each row, with the number of its line


def read_table(path: Path, name: str) -> TextTable | None:
    """Read the rows of numbers in a text; None if there are none, or a program's own format."""
    text = _read_text(path, name)
    if text is None or _FOREIGN_HEAD.match(text):
        return None
    lines = _unquoted(text.split("\n"))
    start = _first_row(lines)
    if start is None:
        return None
    body = [(i + 1, line) for i, line in enumerate(lines[start:], start) if line.strip(" \r")]
    body = _within_braces(body, lines[:start], name)
    if any(_COMMENT.match(line) for _, line in body):
        _refuse_words_between_rows(body, name)
        return None  # files of several channels go on so
    joined = "\n".join(line for _, line in body)
    if "_" in joined or not joined.isascii():  # Python would read 1_0, and digits of all scripts
        raise InputError(f"{name} has signs among its numbers that are none; {READ_AS_TEXT}")
    separator, decimal = _dialect(joined, name)
    if separator != "\t":
        body = [(number, line) for number, line in body if line.strip()]
    cells = [(number, _cells(line, separator, decimal)) for number, line in body]
    if not text.endswith("\n"):
        _refuse_a_cut_number(cells, name)
    _refuse_uneven_rows(cells, name)
    if separator is not None:
        _refuse_empty_row_above(lines[:start], separator, len(cells[0][1]), name)
        cells = _without_empty_ends(cells, name)
    rows = _without_stand_ins(_numbers(cells, name), name)
    _refuse_row_in_head(lines[:start], separator, rows.shape[1], name)
    above = (line.strip().removesuffix(_OPENS).strip() for line in lines[:start])
    head = tuple(line for line in above if line)
    return TextTable(head, rows, separator, decimal)


def _read_text(path: Path, name: str) -> str | None:
    """The text of a file, its lines ending alike; None if it holds other bytes."""
    with path.open("rb") as file:
        sample = file.read(_SAMPLE)
    coding = next((found for mark, found in _MARKS.items() if sample.startswith(mark)), None)
    if coding is None and _CONTROLS.search(sample):
        return None
    refuse_beyond_memory(
        _BYTES_PER_CHARACTER * path.stat().st_size,
        f"reading the text of {name}",
        "write it as X3P, SUR or NPY, which take less",
    )
    data = path.read_bytes()
    try:
        if coding is None and _CONTROLS.search(data):
            return None
        text = data.decode(coding or "utf-8-sig")
    except UnicodeDecodeError:
        if coding is not None:
            raise InputError(f"{name} ends within a character: export it again") from None
        text = data.decode("latin-1")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def has_other_bytes(path: Path) -> bool:
    """Whether a file holds bytes that no text has."""
    with path.open("rb") as file:
        if file.read(2) in _MARKS:
            return False
        file.seek(0)
        return any(_CONTROLS.search(piece) for piece in iter(lambda: file.read(_PIECE), b""))


def _begins_rows(line: str) -> bool:
    """Whether a line is the first row of numbers."""
    return bool(_FIRST_ROW.fullmatch(line)) and any(c.isdigit() or c in "nN" for c in line)


def _first_row(lines: list[str]) -> int | None:
    """The line that rows begin at; None if there are none.

    A row of which all points are missing may be the first.
    """
    start = next((i for i, line in enumerate(lines) if _begins_rows(line)), None)
    if start is None:
        return None
    counts = {len(re.split(signs, lines[start].strip(" \t;,"))) for signs in _BETWEEN}
    while start and _is_missing(lines[start - 1], counts):
        start -= 1
    return start


def _is_missing(line: str, counts: set[int]) -> bool:
    """Whether a line is a row of marks of missing points, as many as a row may have cells."""
    cells = re.split(_BETWEEN[0], line.strip(" \t;,"))
    return (
        len(cells) > _LIST
        and len(cells) in counts
        and all(
            cell.lower() in _MISSING_WORDS - {""} or _MISSING_SIGNS.fullmatch(cell)
            for cell in cells
        )
    )


def _unquoted(lines: list[str]) -> list[str]:
    """Lines without quotation marks around cells.

    Commas between cells become semicolons where there are commas in them.
    """
    start = next((i for i, each in enumerate(lines) if _begins_rows(each.replace('"', ""))), None)
    if start is None or '"' not in lines[start]:
        return lines
    cells = [line.split('"') for line in lines]
    within = [cell for line in cells[start:] if len(line) % 2 for cell in line[1::2]]
    has_comma = any("," in cell for cell in within)
    for line in cells:
        if has_comma and len(line) % 2:
            line[::2] = [between.replace(",", ";") for between in line[::2]]
    return ["".join(line) if len(line) % 2 else '"'.join(line) for line in cells]


def _within_braces(
    body: list[tuple[int, str]], above: list[str], name: str
) -> list[tuple[int, str]]:
    """The rows of a list that a brace closes, without it."""
    is_closed = body[-1][1].strip() == _CLOSES
    is_opened = any(line.strip().endswith(_OPENS) for line in above)
    if is_opened and not is_closed:
        raise InputError(
            f'{name} opens a list with "{_OPENS}" and does not close it: it was cut short; export '
            "it again"
        )
    return body[:-1] if is_closed else body


def _dialect(body: str, name: str) -> tuple[str | None, str]:
    """Separator and decimal sign of rows; refused where they can be read in more than one way."""
    has_comma, has_point = "," in body, "." in body
    unclear = f"{name} can be read in more than one way: "
    separator: str | None = None
    if ";" in body or "\t" in body.strip("\t\n"):
        separator = ";" if ";" in body else "\t"
    elif has_comma:
        separator = _comma_between(body, has_point, unclear)
    if separator == "," or not has_comma:
        return separator, "."
    if has_point:
        raise InputError(
            f"{unclear}its numbers have points and commas, so that one of them may stand between "
            "thousands: export it without separators of thousands"
        )
    with_comma = _WITH_COMMA.findall(body)
    if all(_THOUSANDS.fullmatch(number) for number in with_comma):
        raise InputError(
            f'{unclear}"{with_comma[0]}" may have a decimal comma or a separator of thousands: '
            "export it with a decimal point, or with more decimals"
            if with_comma
            else f"{unclear}it has both semicolons or tabs, and commas: export it with one of them"
        )
    return separator, ","


def _comma_between(body: str, has_point: bool, unclear: str) -> str | None:
    """Whether commas are separators, or decimal commas between white space (None)."""
    if has_point:
        return ","
    has_spaces = re.search(r"[^\s,][ ]+[^\s,]", body)
    if has_spaces and re.search(r",\s|\s,", body.strip()):
        raise InputError(f"{unclear}some of its commas stand beside spaces, and some do not")
    if has_spaces:
        return None
    if all(line.count(",") == 1 for line in body.split("\n")):
        raise InputError(
            f"{unclear}each of its lines has one comma, between two whole numbers or before "
            "decimals: separate them with semicolons, or write a decimal point"
        )
    if _INTEGERS_OF_DECIMALS.search(body):
        raise InputError(
            f"{unclear}commas separate its numbers and stand before decimals: separate them with "
            "semicolons, or write a decimal point"
        )
    return ","


def _cells(line: str, separator: str | None, decimal: str) -> list[str]:
    """The cells of a line, with decimal points."""
    if decimal == ",":
        line = line.replace(",", ".")
    return line.split(separator) if separator is None else line.strip(" ").split(separator)


def _refuse_uneven_rows(cells: _Cells, name: str) -> None:
    """Refuse rows of different lengths."""
    (first, row), last = cells[0], cells[-1][0]
    for number, other in cells:
        if len(other) != len(row):
            what = "it was cut short" if number == last else "it is damaged"
            if number == cells[1][0]:
                what = f"line {first} may be a header that has to go"
            raise InputError(
                f"{name} has {len(other)} numbers in line {number} and {len(row)} in line {first}: "
                f"{what}; export it again"
            )


def _without_empty_ends(cells: _Cells, name: str) -> _Cells:
    """Rows without the empty cells that come from separators at their ends."""
    empty = [not any(cell.strip() for cell in column) for column in zip(*_rows(cells), strict=True)]
    first, end = 0, len(empty)
    while end > 1 and empty[end - 1]:
        end -= 1
    while first < end - 1 and empty[first]:
        first += 1
    if end - first > _LIST and max(first, len(empty) - end) > 1:
        raise InputError(
            f"{name} has several columns of empty cells beside its heights: delete them, or write "
            "NaN where heights are missing"
        )
    cells = [(number, row[first:end]) for number, row in cells]
    if end - first <= _LIST:
        return [(number, row) for number, row in cells if any(cell.strip() for cell in row)]
    for number, row in (cells[0], cells[-1]):
        if not any(cell.strip() for cell in row):
            raise InputError(
                f"{name}, line {number}: a row of empty cells is at an end of the heights; delete "
                "it, or write NaN where heights are missing"
            )
    return cells


def _rows(cells: _Cells) -> list[list[str]]:
    return [row for _, row in cells]


def _numbers(cells: _Cells, name: str) -> Real:
    """Rows of numbers; NaN for what is marked as missing."""
    rows = np.empty((len(cells), len(cells[0][1])))
    for i, (number, row) in enumerate(cells):
        try:
            rows[i] = list(map(float, row))
        except ValueError:
            rows[i] = [_number(cell, f"{name}, line {number}") for cell in row]
    rows[np.abs(rows) > _HUGE] = np.nan  # infinite ones too
    return rows


def _number(cell: str, where: str) -> float:
    """The number in a cell; NaN if it is marked as missing."""
    text = cell.strip()
    if _NUMBER.fullmatch(text):
        return float(text)
    if text.lower() in _MISSING_WORDS or _MISSING_SIGNS.fullmatch(text):
        return math.nan
    raise InputError(f'{where}: "{text[:40]}" is no number; {READ_AS_TEXT}')


def _refuse_a_cut_number(cells: _Cells, name: str) -> None:
    """Refuse a file whose last number has fewer decimals than all those before it."""
    decimals = [
        len(cell.strip().partition(".")[2])
        for row in _rows(cells[-_LAST_ROWS:])
        for cell in row
        if _NUMBER.fullmatch(cell.strip())
    ]
    text = cells[-1][1][-1].strip()
    is_number = _NUMBER.fullmatch(text)
    if len(decimals) > 2 and (
        (is_number and decimals[-1] < min(decimals[:-1])) or re.search(r"[-+eE]$", text)
    ):
        raise InputError(
            f'{name} ends within the number "{text}", which has fewer digits than those before it: '
            "it was cut short; export it again"
        )


def _refuse_empty_row_above(above: list[str], separator: str, width: int, name: str) -> None:
    """Refuse a row of empty cells just above the first numbers: it may be a row of heights."""
    line = above[-1].strip(" ") if above and width > _LIST else ""
    if line and set(line) <= {separator, " "} and line.count(separator) == width - 1:
        raise InputError(
            f"{name}, line {len(above)}: a row of empty cells stands above the first numbers; "
            "delete it, or write NaN where heights are missing"
        )


def _refuse_row_in_head(above: list[str], separator: str | None, width: int, name: str) -> None:
    """Refuse a line above the first numbers that is mostly numbers itself."""
    cells = [cell.strip() for cell in above[-1].split(separator)] if above else []
    numbers = [cell for cell in cells if _NUMBER.fullmatch(cell.replace(",", "."))]
    if len(cells) >= width and 2 * len(numbers) > width:
        other = next(cell for cell in cells if cell not in numbers)
        raise InputError(f'{name}, line {len(above)}: "{other[:40]}" is no number; {READ_AS_TEXT}')


def _refuse_words_between_rows(body: list[tuple[int, str]], name: str) -> None:
    """Refuse lines among the rows of several channels that are no rows: they would be left out."""
    for number, line in body:
        if not _COMMENT.match(line) and not _PLAIN_ROW.fullmatch(line):
            raise InputError(
                f'{name}, line {number}: "{line.strip()[:40]}" is no row of numbers; {READ_AS_TEXT}'
            )


def _without_stand_ins(rows: Real, name: str) -> Real:
    """Rows with NaN for numbers that stand for missing points, such as -9999."""
    for value in _STAND_FOR_MISSING:
        places = rows[:, -1:] if rows.shape[1] <= _LIST else rows  # positions are never missing
        stands = places == value
        if not stands.any():
            continue
        others = places[~stands & ~np.isnan(places)]
        if not others.size or others.min() <= value <= others.max():
            continue
        distance = max(others.min() - value, value - others.max())
        if distance > np.ptp(others):
            places[stands] = np.nan
        elif np.count_nonzero(stands) > 1:
            raise InputError(
                f"{name} has the height {value:g} {np.count_nonzero(stands)} times: write NaN "
                "instead if it stands for missing points"
            )
    return rows
