"""Gwyddion Simple Field (GSF): a head of text and a matrix of single precision.

Rows run along x, the first is at the top. Sides and heights are in the units that the head states,
which are SI units without a prefix if Gwyddion wrote them.

References
----------
Gwyddion user guide, "Gwyddion Simple Field".
"""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np

from roughline.errors import InputError, UnitError
from roughline.errors.checks import shortened
from roughline.topography.files.archives import refuse_points
from roughline.topography.files.measurement import Measurement
from roughline.topography.settings import MEASURED
from roughline.units import metres_per

_MARK = b"Gwyddion Simple Field 1.0\n"
_START = 2**16  # bytes; heads are shorter
_BYTES_PER_POINT = 16
_FLOAT = np.dtype("<f4")
_LENGTH = re.compile(r"\+?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)


def read_gsf(path: Path, _: int | str | None, name: str) -> Measurement | None:
    """Read a simple field of Gwyddion; None if the file has another format."""
    with path.open("rb") as file:
        start = file.read(_START)
    if not start.startswith(_MARK):
        return None
    text, end, _rest = start.partition(b"\0")
    place = len(text) + 4 - len(text) % 4  # one to four bytes fill the head up
    if not end or start[len(text) : place].strip(b"\0"):
        raise InputError(f"{name} is a GSF file without an end of its head: export it again")
    fields = _fields(text[len(_MARK) :], name)
    columns, rows = (_count(fields, key, name) for key in ("XRes", "YRes"))
    refuse_points((columns, rows), path, name, _BYTES_PER_POINT)
    if path.stat().st_size - place != columns * rows * _FLOAT.itemsize:
        raise InputError(
            f"{name} states {columns} x {rows} heights and has "
            f"{(path.stat().st_size - place) / _FLOAT.itemsize:.8g}: it was cut short or changed; "
            "export it again"
        )
    raw = np.fromfile(path, _FLOAT, offset=place).reshape(rows, columns).T
    along = [i for i in (0, 1) if raw.shape[i] > 1]  # a row or a column is a line
    heights = raw.astype(np.float64) if len(along) == 2 else raw.ravel().astype(np.float64)
    across, upwards = (_unit(fields, key, name) for key in ("XYUnits", "ZUnits"))
    sides = [_side(fields, ("XReal", "YReal")[i], name) for i in along]
    lengths = [side for side in sides if side is not None]
    sizes = tuple(lengths) if across and len(lengths) == len(sides) else None
    if across and upwards:
        heights *= metres_per(upwards)
        sizes = tuple(metres_per(across) * size for size in sizes) if sizes else None
    title = fields.get("Title", "")
    return Measurement(
        file=name,
        heights=heights,
        unit="m" if across and upwards else upwards,
        unit_of_sides=across if sizes and not upwards else None,
        sizes=sizes,
        kind="surface" if len(along) == 2 else "profile",
        channel=title,
        settings={"origin": MEASURED, "file": name, **({"channel": title} if title else {})},
        format="GSF",
    )


def _fields(text: bytes, name: str) -> dict[str, str]:
    """What the lines of the head state."""
    fields: dict[str, str] = {}
    for line in text.decode("utf-8", "replace").splitlines():
        key, sign, value = (each.strip() for each in line.partition("="))
        if not sign or key in fields:
            what = "twice" if sign else "without a value"
            raise InputError(f'{name} has "{shortened(key)}" {what} in its head: export it again')
        fields[key] = value
    return fields


def _count(fields: dict[str, str], key: str, name: str) -> int:
    """A number of points."""
    text = fields.get(key, "")
    if not (text.isascii() and text.isdecimal() and len(text) < 12 and int(text)):
        raise _no_value(fields, key, name, "a whole number above 0")
    return int(text)


def _side(fields: dict[str, str], key: str, name: str) -> float | None:
    """A side; None if it is not stated. [unit of the sides]"""
    text = fields.get(key)
    if text is None:
        return None
    value = float(text) if _LENGTH.fullmatch(text) else math.nan
    if not 0 < value < math.inf:
        raise _no_value(fields, key, name, "a length above 0")
    return value


def _unit(fields: dict[str, str], key: str, name: str) -> str | None:
    """A unit of length; None if it is not stated."""
    unit = fields.get(key)
    if not unit:
        return None
    try:
        metres_per(unit)
    except UnitError:
        what = "values" if key == "ZUnits" else "sides"
        raise InputError(
            f'{name} holds {what} in "{shortened(unit)}", which is no unit of length: export '
            "its heights"
        ) from None
    return unit


def _no_value(fields: dict[str, str], key: str, name: str, needed: str) -> InputError:
    found = f'states {key} = "{shortened(fields[key])}"' if key in fields else f"lacks {key}"
    return InputError(f"{name} {found}; a GSF file has {needed} there: export it again")
