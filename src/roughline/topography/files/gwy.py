"""GWY, the format of Gwyddion: named components, each of a type, within each other."""

from __future__ import annotations

import math
import re
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.topography.files.archives import refuse_points
from roughline.topography.files.channels import Channel, find_channel, listed
from roughline.topography.files.measurement import Measurement, in_stated_units
from roughline.topography.settings import MEASURED
from roughline.units import is_unit_of_length

_MARK = b"GWYP"
_NUMBERS = {"b": "<?", "c": "<c", "i": "<i", "q": "<q", "d": "<d"}
_ARRAYS = {"C": "u1", "I": "<i4", "Q": "<i8", "D": "<f8"}
_DEEPEST = 16  # components within each other; programs write about 5
_SELECTED = 0.5  # of a mask, which goes from 0 to 1
_BYTES_PER_POINT = 24
_CHANNEL = re.compile(r"/(\d+)/data")
_FIELD = "GwyDataField"


def read_gwy(path: Path, channel: int | str | None, name: str) -> Measurement | None:
    """Read heights from GWY; None if the file has another format.

    A mask of Gwyddion selects points, such as grains; it does not say that they are missing. But
    points that are missing are written with a mask too, and with one height for all of them.
    """
    with path.open("rb") as file:
        if file.read(len(_MARK)) != _MARK:
            return None
    content = _Bytes(path.read_bytes(), name).content()
    fields = {
        found[1]: _DataField(data[_FIELD], str(content.get(f"{key}/title", "")), name)
        for key, data in content.items()
        if (found := _CHANNEL.fullmatch(key)) and isinstance(data, dict) and _FIELD in data
    }
    channels = [each.channel for each in fields.values()]
    number, field = list(fields.items())[find_channel(channels, channel, name)]
    refuse_points(field.points, path, name, _BYTES_PER_POINT)
    marks, masked = content.get(f"/{number}/mask"), None
    if isinstance(marks, dict) and _FIELD in marks:
        selection = _DataField(marks[_FIELD], "the mask", name)
        if selection.points != field.points:
            selection.refuse("has other points than its channel")
        masked = selection.numbers > _SELECTED
    heights = field.numbers
    doubts: tuple[str, ...] = ()
    if masked is not None and _stands_for_missing(heights[masked]):
        heights, masked = np.ma.array(heights, mask=masked), None
        doubts = (
            "the points that its mask selects all have one height, as programs write it for "
            "missing points: they are missing",
        )
    return Measurement(
        file=name,
        **in_stated_units(heights, field.sides, field.unit("z"), field.unit("xy")),
        kind="surface",
        channel=field.name,
        channels=listed(channels),
        format="GWY",
        masked=masked if masked is not None and masked.any() else None,
        mask_of="Gwyddion",
        doubts=doubts,
        settings={"origin": MEASURED, "file": name, "channel": field.name},
    )


def _stands_for_missing(heights: Real) -> bool:
    """Whether masked heights are one and the same; a single one may be measured if it is not 0."""
    return heights.tolist() == [0.0] if heights.size < 2 else bool((heights == heights[0]).all())


@dataclass(frozen=True, eq=False)
class _DataField:
    """Numbers on a grid, as Gwyddion keeps them."""

    data: Mapping[str, Any]
    name: str
    file: str

    def unit(self, of: str) -> str:
        """The unit of "xy" or of "z"; empty where it is not stated."""
        found = self.data.get(f"si_unit_{of}")
        stated = found.get("GwySIUnit", {}) if isinstance(found, dict) else {}
        return str(stated.get("unitstr", "")).strip()

    @property
    def channel(self) -> Channel:
        """Whether the numbers are heights: both units are lengths, or are not stated."""
        others = [
            unit for of in ("z", "xy") if (unit := self.unit(of)) and not is_unit_of_length(unit)
        ]
        return Channel(self.name, f"in {others[0]}" if others else "")

    @property
    def points(self) -> tuple[int, int]:
        """Numbers of points along x and y."""
        nx, ny = self.data.get("xres"), self.data.get("yres")
        if not isinstance(nx, int) or not isinstance(ny, int) or min(nx, ny) < 1:
            self.refuse(f"states {nx} x {ny} points")
        return nx, ny

    @property
    def sides(self) -> tuple[float, float]:
        """Sides of the map, of which Gwyddion, too, takes the amount."""
        x, y = (self.data.get(key, math.nan) for key in ("xreal", "yreal"))
        if not all(isinstance(side, float) and 0 < abs(side) < math.inf for side in (x, y)):
            self.refuse(f"states sides of {x} x {y}")
        return abs(x), abs(y)

    @property
    def numbers(self) -> Real:
        """The numbers, x along the first axis."""
        nx, ny = self.points
        found = self.data.get("data")
        if not isinstance(found, np.ndarray) or found.dtype.kind != "f" or found.size != nx * ny:
            self.refuse(f"does not hold {nx} x {ny} numbers")
        return np.asarray(found, np.float64).reshape(ny, nx).T

    def refuse(self, why: str) -> NoReturn:
        """Refuse the file for this field."""
        raise InputError(f"{self.file} is damaged: {self.name or 'a channel'} {why}; save it again")


@dataclass(eq=False)
class _Bytes:
    """The bytes of a file, and the place in them that is read next."""

    data: bytes
    file: str
    place: int = len(_MARK)

    def content(self) -> dict[str, Any]:
        """All components of the file by their names."""
        found = self._object(0).get("GwyContainer")
        if not isinstance(found, dict):
            raise InputError(f"{self.file} is damaged: it holds no GwyContainer; save it again")
        return found

    def _take(self, size: int) -> int:
        """Step over so many bytes, and return where they begin."""
        start, self.place = self.place, self.place + size
        if self.place > len(self.data):
            raise InputError(
                f"{self.file} ends before what it announces does: it was cut short; save it again"
            )
        return start

    def _text(self) -> str:
        end = self.data.find(b"\0", self.place)
        start = self._take((len(self.data) if end < 0 else end) + 1 - self.place)
        return self.data[start:end].decode("utf-8", "replace")

    def _number(self, form: str) -> Any:
        return struct.unpack_from(form, self.data, self._take(struct.calcsize(form)))[0]

    def _object(self, depth: int) -> dict[str, Any]:
        """An object: its name, and its components by their names."""
        if depth > _DEEPEST:
            raise InputError(f"{self.file} is damaged: it nests without end; save it again")
        name, size = self._text(), self._number("<I")
        end = self._take(size) + size
        self.place = end - size
        components: dict[str, Any] = {}
        while self.place < end:
            key = self._text()
            components[key] = self._value(chr(self.data[self._take(1)]), depth)
        return {name: components}

    def _value(self, type_: str, depth: int) -> Any:
        if type_ in _NUMBERS:
            return self._number(_NUMBERS[type_])
        if type_ == "s":
            return self._text()
        if type_ == "o":
            return self._object(depth + 1)
        count = self._number("<I")
        if type_ in _ARRAYS:
            dtype = np.dtype(_ARRAYS[type_])
            return np.frombuffer(self.data, dtype, count, self._take(count * dtype.itemsize))
        if type_ == "S":
            return [self._text() for _ in range(count)]
        if type_ == "O":
            return [self._object(depth + 1) for _ in range(count)]
        raise InputError(
            f"{self.file} is damaged: it has a component of type {type_!r}; save it again"
        )
