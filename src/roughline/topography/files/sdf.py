"""Surface data files (SDF): those of ISO 25178-71 and of the proposals before it, text and binary.

Lengths are in metres. A file holds profiles along x, one after the other.
"""

from __future__ import annotations

import math
import re
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from roughline.computing.arrays import Mask, Real
from roughline.computing.memory import refuse_beyond_memory
from roughline.errors import InputError
from roughline.errors.checks import shortened
from roughline.topography.files.archives import refuse_points
from roughline.topography.files.measurement import Measurement
from roughline.topography.settings import MEASURED

_TEXT = re.compile(rb"(?:\xef\xbb\xbf)?\s*[aA]\s?[A-Za-z]{2,6}\s*-\s*V?\d\.\d\s*[\r\n;]")
_KEYS = (re.compile(rb"\bnumpoints\s*="), re.compile(rb"\bnumprofiles\s*="))
_BINARY = re.compile(rb"[bB](ISO|BCR)-\d\.\d", re.DOTALL)
_COUNTS = {b"ISO-1.0": "HH", b"ISO-2.0": "II", b"BCR-1.0": "HH"}  # of points and profiles
_START = 4096  # bytes of a file that show whether it is an SDF file
_BYTES_PER_POINT = 24  # as stored, as heights and as a mask
_BYTES_PER_CHARACTER = 16  # of text: as characters, as words and as numbers

_END_OF_RECORD = re.compile(r"^[ \t]*\*[ \t]*(?:;.*)?$", re.MULTILINE)
_COMMENT = re.compile(r";.*")
_FIELD = re.compile(r"\s*(\w+)\s*=\s*(.*?)\s*")
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)
_MISSING = re.compile(r"\bbad\b", re.IGNORECASE)
_CONTROLS = re.compile(rb"[\x00-\x08\x0e-\x19\x1b-\x1f]")  # in no text
_OLYMPUS_MARK = struct.pack("<2I", 5, 1)  # which its software writes between head and heights

_TYPES = ("u1", "<u2", "<u4", "<f4", "i1", "<i2", "<i4", "<f8")  # by their code
_NAMES = ("uchar", "uinteger", "ulongint", "float", "char", "integer", "longint", "double")
_NONE = ("0", "null", "none")  # of compression and check sum
_LARGEST_HEIGHT = {4: 3.4e38, 8: 1.7e308}  # floats that are heights are below it, by their bytes


@dataclass(frozen=True)
class _SdfHead:
    """What the first record of a file states."""

    points: int  # in a profile
    profiles: int
    x_scale: float  # [m]
    y_scale: float  # [m]
    z_scale: float  # [m]
    type: np.dtype[Any]
    is_bcr: bool  # of the proposal of 1993, in which the largest number of a type is missing

    @property
    def count(self) -> int:
        return self.points * self.profiles

    @property
    def shape(self) -> tuple[int, int]:
        return self.points, self.profiles


def read_sdf(path: Path, _: int | str | None, name: str) -> Measurement | None:
    """Read a surface data file; None if the file has another format."""
    with path.open("rb") as file:
        start = file.read(_START)
    if _BINARY.match(start):
        return _measurement(*_read_binary(path, name), name)
    has_keys = all(key.search(start.lower()) for key in _KEYS)
    if _TEXT.match(start) or has_keys:
        return _measurement(*_read_text(path, name), name)
    return None


def _measurement(head: _SdfHead, raw: Real, name: str) -> Measurement:
    """The heights of a map, or of a line where there is one profile or one point in each."""
    heights = raw.astype(np.float64)
    heights[_is_missing(raw, head)] = np.nan
    with np.errstate(over="ignore"):  # what is no height of a surface is missing
        heights *= head.z_scale
    heights = heights.reshape(head.profiles, head.points).T
    sides = head.points * head.x_scale, head.profiles * head.y_scale
    along = [i for i, n in enumerate(head.shape) if n > 1]
    return Measurement(
        file=name,
        heights=heights if len(along) == 2 else heights.ravel(),
        unit="m",
        sizes=tuple(sides[i] for i in along),
        kind="surface" if len(along) == 2 else "profile",
        settings={"origin": MEASURED, "file": name},
        format="SDF",
    )


def _is_missing(raw: Real, head: _SdfHead) -> Mask:
    """Which points are missing: they have the least number of the type; in BCR the largest.

    Writers of BCR use both. Unsigned types are BCR's; in them 0 is a height.
    """
    if head.type.kind == "f":
        return ~(np.abs(raw) < _LARGEST_HEIGHT[head.type.itemsize])  # NaN too
    ends = np.iinfo(head.type)
    missing: Mask = raw == ends.max if head.is_bcr or ends.min == 0 else np.zeros(raw.shape, bool)
    return missing | (raw == ends.min) if ends.min else missing


def _read_binary(path: Path, name: str) -> tuple[_SdfHead, Real]:
    """The head and the numbers of a binary file."""
    with path.open("rb") as file:
        data = file.read(_START)
    version = data[1:8]
    if version not in _COUNTS:
        known = ", ".join(each.decode() for each in _COUNTS)
        raise InputError(
            f"{name} is an SDF file of version {version.decode()}; {known} are read: export it in "
            "one of them, or as text"
        )
    layout = struct.Struct(f"<8x10s12s12s{_COUNTS[version]}4d3B")
    if len(data) < layout.size:
        raise InputError(f"{name} ends within the head of an SDF file: export it again")
    _, _, _, points, profiles, *scales, compression, code, check = layout.unpack_from(data)
    fields = {"compression": str(compression), "datatype": str(code), "checktype": str(check)}
    fields |= dict(zip(("xscale", "yscale", "zscale"), map(repr, scales), strict=False))
    fields |= {"numpoints": str(points), "numprofiles": str(profiles)}
    head = _read_head(fields, name, is_bcr=version.startswith(b"BCR"))
    refuse_points(head.shape, path, name, _BYTES_PER_POINT)
    needed, size = head.count * head.type.itemsize, path.stat().st_size - layout.size
    place = layout.size
    if version == b"ISO-1.0" and size == needed + 8 and data[place : place + 8] == _OLYMPUS_MARK:
        place, size = place + 8, size - 8
    if size < needed:
        raise _other_count(name, f"{max(size, 0) // head.type.itemsize}", head)
    with path.open("rb") as file:
        file.seek(place + needed)
        trailer = file.read().rstrip(b"\0")
    if _CONTROLS.search(trailer):
        raise _other_count(name, f"{size // head.type.itemsize}", head)
    return head, np.fromfile(path, head.type, head.count, offset=place)


def _read_text(path: Path, name: str) -> tuple[_SdfHead, Real]:
    """The head and the numbers of a text."""
    needed = _BYTES_PER_CHARACTER * path.stat().st_size
    refuse_beyond_memory(needed, f"reading the text of {name}", "write it as binary SDF, or as X3P")
    text = path.read_bytes().decode("latin-1").replace("\r\n", "\n").replace("\r", "\n")
    ends = list(_END_OF_RECORD.finditer(text))
    if not ends:
        raise InputError(f'{name} has no line "*" between head and heights: export it again')
    first, *lines = text[: ends[0].start()].splitlines()
    fields: dict[str, str] = {}
    for line in lines:
        field = _FIELD.fullmatch(_COMMENT.sub("", line))
        key = field[1].lower() if field else ""
        if key in fields:
            raise InputError(f"{name} states {field[1] if field else key} twice: delete one")
        fields[key] = field[2] if field else ""
    head = _read_head(fields, name, is_bcr="BC" in first)
    refuse_points(head.shape, path, name, _BYTES_PER_POINT)
    body = text[ends[0].end() : ends[1].start() if len(ends) > 1 else len(text)].strip("\x1a")
    if len(ends) == 1 and not body[-1:].isspace():
        raise InputError(f"{name} ends within its heights: it was cut short; export it again")
    return head, _numbers(_COMMENT.sub("", body) if ";" in body else body, head, name)


def _numbers(body: str, head: _SdfHead, name: str) -> Real:
    """The numbers between the head and what follows; NaN for points marked as BAD."""
    words = _MISSING.sub("nan", body).split()
    if len(words) != head.count:
        raise _other_count(name, f"{len(words)}", head)
    try:
        if "_" in body:  # Python would read 1_0
            raise ValueError
        return np.array(words, dtype=np.float64)
    except ValueError:
        wrong = next((each for each in words if not _NUMBER.fullmatch(each)), "_")
        raise InputError(
            f'{name} has "{shortened(wrong)}" among its heights, which is no number: export it '
            "again, with decimal points"
        ) from None


def _read_head(fields: dict[str, str], name: str, *, is_bcr: bool) -> _SdfHead:
    """What fields state, their names in small letters."""
    for key, what in (("compression", "compression"), ("checktype", "check sum")):
        kind = fields.get(key, "0").lower()
        if kind not in _NONE:
            raise InputError(
                f"{name} has a {what} of type {shortened(kind)}; SDF files without are read: "
                f"export it again without"
            )
    code = fields.get("datatype", "").lower()
    number = _NAMES.index(code) if code in _NAMES else int(code) if code.isdecimal() else -1
    if not 0 <= number < len(_TYPES):
        raise InputError(
            f'{name} says that its heights are of type "{shortened(code)}"; SDF files have types '
            f"0 to {len(_TYPES) - 1}: export it again"
        )
    points, profiles = (_count(fields, key, name) for key in ("NumPoints", "NumProfiles"))
    x, y = (
        _scale(fields, key, name) if n > 1 else 1.0  # a line has no scale across it
        for key, n in (("Xscale", points), ("Yscale", profiles))
    )
    z = _scale(fields, "Zscale", name)
    return _SdfHead(points, profiles, x, y, z, np.dtype(_TYPES[number]), is_bcr)


def _count(fields: dict[str, str], key: str, name: str) -> int:
    """A number of points."""
    text = fields.get(key.lower(), "")
    if not (text.isdecimal() and text.isascii() and len(text) < 12 and int(text)):
        raise _no_value(fields, key, name, "a whole number above 0")
    return int(text)


def _scale(fields: dict[str, str], key: str, name: str) -> float:
    """A distance of points, or the height of one count. [m]"""
    text = fields.get(key.lower(), "")
    value = float(text) if _NUMBER.fullmatch(text) else math.nan
    if not 0 < value < math.inf:
        raise _no_value(fields, key, name, "a length above 0, in m")
    return value


def _no_value(fields: dict[str, str], key: str, name: str, needed: str) -> InputError:
    stated = fields.get(key.lower())
    found = f"does not state {key}" if stated is None else f'states {key} = "{shortened(stated)}"'
    return InputError(f"{name} {found}; an SDF file has {needed} there: export it again")


def _other_count(name: str, found: str, head: _SdfHead) -> InputError:
    return InputError(
        f"{name} has {found} heights and states {head.points} x {head.profiles} of them: it was "
        "cut short or changed; export it again"
    )
