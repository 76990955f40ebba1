"""What the lines above a matrix of heights state: sides, units, the scale of heights, points.

The labels are those of Gwyddion, SPIP, Attocube, Nova (NT-MDT), Koala (Lyncee) and Wyko, whatever
stands between a label and its value.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from roughline.errors import InputError
from roughline.errors.checks import shortened
from roughline.topography.files.text import TextTable
from roughline.units import metres_per

_LABELS = {  # Gwyddion translates its own
    "channel": "Channel|Kanál|Kanal|Canal|Canale|チャネル|채널|Канал",
    "width": "x-length|Width|Šířka|Breite|Anchura|Largeur|Larghezza|幅|폭|Largura|Ширина",
    "height": "y-length|Height|Výška|Höhe|Altura|Hauteur|Altezza|高さ|높이|Высота",
    "columns": "x-pixels|NX",
    "rows": "y-pixels|NY",
    "pixel": "pixel[ _]size|Scale X",
    "pixel along y": "Scale Y",
    "unit": "(?:all |length )?units?",
    "unit of x": "x-unit|Unit X|lateral units?",
    "unit of y": "y-unit|Unit Y",
    "unit of z": "z-unit|Unit Data|Value units|Height units|Jednotky hodnot|Einheiten|Unités|"
    "unità valore|値の単位|값 단위|Unidades de valor|Единицы измерения",
    "nm": "Bit2nm",
    "m": r"height conversion factor \(-> ?m\)",
    "unit of data": "data unit",
    "scale": "Scale Data",
    "is scaled": "DataScaleNeeded",
}
_STATED = {
    field: re.compile(rf"[#%!/\s]*(?:{labels})(\s*[:=：;,\t]\s*|\s+)(.*)", re.IGNORECASE)
    for field, labels in _LABELS.items()
}
_KOALA = re.compile(r"\s*h\s*=\s*(\d+)[\s;,]+w\s*=\s*(\d+)\W*")
_SPIP = re.compile(r"#\s*File Format\W+ASCII\W*", re.IGNORECASE)  # its sides are in nm
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_QUANTITY = re.compile(rf"({_NUMBER})[\s;,]*([^\d\s;,+-]\S*)?", re.ASCII)
_DECIMAL_COMMA = re.compile(r"(?<=\d),(?=\d)")

_KEYS_OF_WYKO = ("Wyko", "X Size", "Y Size", "Block Name", "Pixel_size", "Wavelength", "RAW_DATA")
_WYKO = re.compile(r"Wyko ASCII Data File Format[\s;,]+\d+[\s;,]+(\d+)\b.*")
_SIZE_OF_WYKO = re.compile(r"([XY]) Size[\s;,]+(\d+)\W*")
_BLOCK_OF_WYKO = re.compile(r"(\w[\w ]*?)[\s;,]+\d+[\s;,]+\d+(?:[\s;,]+(\S+))?[\s;,]*")
_HEIGHTS_OF_WYKO = ("OPD", "SAMPLE_DATA", "RAW_DATA", "RAW DATA")  # its other blocks are images

_LENGTHS = re.compile(
    r"[fpnuµμmcd]?m|Å|angstroms?|microns?|(?:nano|micro|milli|centi)?met(?:er|re)s?|in|inch|inches|"
    r"mils?|thou",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class Head:
    """What the lines above a matrix of heights state of it."""

    sides: tuple[float, float] | None = None  # along x and y [unit, or unit of sides]
    unit: str | None = None  # of heights, and of the sides too
    unit_of_sides: str | None = None  # where the unit of heights is not stated
    factor: float = 1.0  # from the numbers of the table to heights in that unit
    channel: str = ""  # its name
    are_columns: bool = False  # each line is a column of the picture, from the bottom to the top
    format: str = "Text"


def length_unit(word: str) -> str | None:
    """Return a unit of length, however its name is capitalised; None of another word."""
    if not _LENGTHS.fullmatch(word):
        return None
    return "Å" if word.lower() == "å" else word.lower()


def ratio(unit: str, other: str) -> float:
    """Return the length of a unit over that of another, without the rounding of both."""
    return float(f"{metres_per(unit) / metres_per(other):.15g}")


def read_head(table: TextTable, name: str) -> Head:
    """Read what the lines above a matrix state; what agrees with no unit or table is refused."""
    lines = [line.replace('"', "") for line in table.head]
    if table.separator != ",":
        lines = [_DECIMAL_COMMA.sub(".", line) for line in lines]
    if sum(any(line.startswith(key) for line in lines) for key in _KEYS_OF_WYKO) > 1:
        return _read_wyko(lines, table, name)
    stated = _Stated(lines, name)
    _refuse_other_points(stated, lines, table, name)
    unit, factor = _read_heights(stated)
    sides = _read_sides(stated, table)
    spip = "nm" if any(map(_SPIP.fullmatch, lines)) else None
    own = [each for _, each in sides if each]
    of_x = stated.unit("unit of x") or stated.unit("unit") or spip or unit
    of_y = stated.unit("unit of y") or of_x
    units = [given or other for (_, given), other in zip(sides, (of_x, of_y), strict=False)]
    shared = unit or (units[0] if units and all(units) else None)
    if own and not all(units):
        raise stated.refused("width", "a unit for both sides, or for neither, is needed")
    lengths = [
        length * ratio(each, shared) if each and shared else length
        for (length, _), each in zip(sides, units, strict=True)
    ]
    return Head(
        sides=(lengths[0], lengths[1]) if lengths else None,
        unit=unit,
        unit_of_sides=None if unit else shared,
        factor=factor,
        channel=stated.text("channel"),
    )


class _Stated:
    """The values of the labels in a head."""

    def __init__(self, lines: list[str], name: str) -> None:
        self.name = name
        self._values: dict[str, str] = {}
        self._lines: dict[str, str] = {}
        for line in lines:
            field, value = _value_in(line)
            if not field:
                continue
            if self._values.get(field, value) != value:
                raise InputError(
                    f'{name} says "{shortened(self._lines[field])}" and "{shortened(line)}": '
                    "delete one of them"
                )
            self._values[field], self._lines[field] = value, line

    def text(self, field: str) -> str:
        """The value of a label; empty if it is not stated."""
        return self._values.get(field, "")

    def unit(self, field: str) -> str | None:
        """A unit of length; None if it is not stated."""
        word = (re.split(r"[\s;,]", self.text(field)) or [""])[0].strip("[]()")
        unit = length_unit(word)
        if word and not unit:
            what = "sides" if field in ("unit of x", "unit of y") else "heights"
            raise self.refused(field, f'"{shortened(word)}" is no unit of length: export {what}')
        return unit

    def quantity(self, field: str) -> tuple[float, str | None] | None:
        """A number above 0 with its unit of length, if it has one; None if it is not stated."""
        text = self.text(field)
        if not any(c.isdigit() for c in text):
            return None
        found = _QUANTITY.fullmatch(text)
        if not found or not 0 < float(found[1]) < math.inf:
            raise self.refused(field, "a number above 0 is needed, and a unit of length after it")
        unit = length_unit(found[2] or "")
        if found[2] and not unit:
            raise self.refused(field, f'"{shortened(found[2])}" is no unit of length')
        return float(found[1]), unit

    def number(self, field: str) -> float | None:
        """A number above 0; None if it is not stated."""
        found = self.quantity(field)
        if found and found[1]:
            raise self.refused(field, "a number above 0 is needed")
        return found[0] if found else None

    def refused(self, field: str, needed: str) -> InputError:
        """The refusal of a file that states a field otherwise than it is needed."""
        line = self._lines.get(field, f"no {field}")
        return InputError(f'{self.name} says "{shortened(line)}"; {needed}; export it again')


def _value_in(line: str) -> tuple[str, str]:
    """The field that a line states, and its value; both empty if there is none."""
    for field, pattern in _STATED.items():
        if found := pattern.fullmatch(line):
            value = found[2].strip(" ;,\t")
            is_value = _QUANTITY.fullmatch(value) or length_unit(value) or value == "yes"
            if found[1].strip() or "\t" in found[1] or is_value:  # words may follow a blank
                return field, value
    return "", ""


def _read_heights(stated: _Stated) -> tuple[str | None, float]:
    """The unit of heights, and the factor from the numbers of the table to it."""
    unit = stated.unit("unit of z") or stated.unit("unit")
    given, factor = stated.text("unit of data"), stated.number("m")
    if factor and length_unit(given) and factor != 1:
        raise stated.refused("m", "its numbers are lengths already: which is right is not said")
    if factor:
        return "m", factor
    unit = unit or stated.unit("unit of data")
    if not unit and (factor := stated.number("nm")):
        return "nm", factor
    is_scaled = stated.text("is scaled").lower() in ("yes", "true", "1")
    return unit, (stated.number("scale") or 1.0) if is_scaled else 1.0


def _read_sides(stated: _Stated, table: TextTable) -> list[tuple[float, str | None]]:
    """Both sides, each with its own unit if it has one; none if they are not stated."""
    rows, columns = table.rows.shape
    sides = [stated.quantity("width"), stated.quantity("height")]
    if sides == [None, None]:
        along_x = stated.quantity("pixel")
        along_y = stated.quantity("pixel along y")
        pixels = [along_x or along_y, along_y or along_x]
        sides = [
            (n * each[0], each[1]) if each else None
            for each, n in zip(pixels, (columns, rows), strict=True)
        ]
    found = [side for side in sides if side]
    if len(found) == 1 and columns == 1:  # of a line scan, whose heights stand below each other
        return 2 * found
    if len(found) == 1:
        field = "width" if sides[0] else "height"
        raise stated.refused(field, "both sides are needed, or none")
    return found


def _refuse_other_points(stated: _Stated, lines: list[str], table: TextTable, name: str) -> None:
    """Refuse a table with other numbers of columns and rows than its head states."""
    rows, columns = table.rows.shape
    counts = [stated.number("columns"), stated.number("rows")]
    for line in lines:
        if koala := _KOALA.fullmatch(line):
            counts = [float(koala[2]), float(koala[1])]
    if any(count not in (None, n) for count, n in zip(counts, (columns, rows), strict=True)):
        listed = " x ".join("?" if count is None else f"{count:g}" for count in counts)
        raise InputError(
            f"{name} states {listed} columns and rows and has {columns} x {rows}: it was cut short "
            "or changed; export it again"
        )


def _read_wyko(lines: list[str], table: TextTable, name: str) -> Head:
    """What the blocks of a Wyko text state; its heights are in nm, or in wavelengths over Mult."""
    flags = _WYKO.fullmatch(lines[0])
    if not flags:
        raise InputError(
            f'{name} begins with "{shortened(lines[0])}"; a Wyko text begins with "Wyko ASCII Data '
            'File Format" and three numbers, the second of which is 0 for waves: export it again'
        )
    sizes = {found[1]: int(found[2]) for line in lines if (found := _SIZE_OF_WYKO.fullmatch(line))}
    blocks = {
        found[1]: found[2] or "" for line in lines if (found := _BLOCK_OF_WYKO.fullmatch(line))
    }
    if not blocks or (last := list(blocks)[-1]) not in _HEIGHTS_OF_WYKO:
        first = shortened(lines[-1]) if lines else "no line"
        raise InputError(
            f'{name} says "{first}" above its numbers; a Wyko text has a block of heights there, '
            f"{', '.join(_HEIGHTS_OF_WYKO)}: export one of them alone"
        )
    rows, columns = table.rows.shape
    if (sizes.get("X"), sizes.get("Y")) != (rows, columns):
        raise InputError(
            f"{name} states {sizes.get('X', 0)} x {sizes.get('Y', 0)} points and has {rows} x "
            f"{columns}: it was cut short or changed; export it again"
        )

    def number(key: str, otherwise: float | None = None) -> float:
        text = blocks.get(key, "")
        if otherwise is not None and key not in blocks:
            return otherwise
        if not re.fullmatch(_NUMBER, text, re.ASCII) or not 0 < float(text) < math.inf:
            raise InputError(
                f'{name} states {key} = "{shortened(text)}" in its head and keeps {last}; a Wyko '
                "text has a number above 0 there: export it again"
            )
        return float(text)

    pixel = number("Pixel_size") if "Pixel_size" in blocks else None  # [mm]
    aspect = number("Aspect", 1.0)
    wavelength = 1.0 if int(flags[1]) else number("Wavelength") / number("Mult", 1.0)
    return Head(
        sides=None if pixel is None else (1e6 * pixel * rows, 1e6 * pixel * aspect * columns),
        unit="nm",
        factor=wavelength,
        channel=last,
        are_columns=True,
        format="Wyko ASCII",
    )
