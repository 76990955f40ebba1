"""SUR, the format of Digital Surf's Mountains, which many instruments write."""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from roughline.errors import InputError
from roughline.errors.checks import shortened
from roughline.topography.files.archives import refuse_points
from roughline.topography.files.measurement import Measurement, in_stated_units
from roughline.topography.settings import MEASURED
from roughline.units import is_unit_of_length, metres_per

_PLAIN, _COMPRESSED = b"DIGITAL SURF", b"DSCOMPRESSED"
_HEAD = 512  # bytes
_PLACES = {  # of what the head states, and its types
    **{"objects": ("<H", 14), "type": ("<H", 18), "special": ("<H", 86), "bits": ("<H", 98)},
    **{"least": ("<i", 100), "nx": ("<i", 108), "ny": ("<i", 112)},
    **{"dx": ("<f", 120), "dy": ("<f", 124), "dz": ("<f", 128), "inversion": ("<H", 290)},
    **{"comment": ("<H", 334), "private": ("<H", 336)},
}
_UNITS = {"x": 180, "y": 196, "z": 212}  # their places, in 16 bytes each
_WITH_HEIGHTS = (0, 1, 2, 5, 7, 8, 11, 13, 16)  # types: profiles and surfaces; 0 is not stated
_OTHERS = {  # by the number of their type
    **{3: "a binary image", 4: "a series of profiles", 6: "a meridian disc", 9: "a parallel disc"},
    **{10: "an image of intensity", 12: "an image of colours", 14: "a force curve"},
    **{15: "a series of force curves", 17: "a parametric profile", 18: "a series of images"},
    **{19: "a spectrum", 20: "a spectrum", 21: "a map of spectra"},
}
_NUMBERS = {16: "<i2", 32: "<i4"}  # by their bits
_INVERTED = (1, 2, 3)  # heights; by 2 and 3, the map is mirrored too, along x and along y
_BELOW_LEAST = 2  # counts from the least height to what stands for a missing point
_INCHES = {'"': "in", "inch": "in", "inches": "in"}
_BYTES_PER_POINT = 24


def read_sur(path: Path, channel: int | str | None, name: str) -> Measurement | None:
    """Read heights from SUR, plain or compressed; None if the file has another format.

    Of several layers, the first is read. Inverted heights are turned back, and the map with them,
    as Gwyddion and SurfaceTopography do it.
    """
    with path.open("rb") as file:
        if file.read(len(_PLAIN)) not in (_PLAIN, _COMPRESSED):
            return None
    return _SurFile(path, name, path.read_bytes()).measurement()


@dataclass(frozen=True, eq=False)
class _SurFile:
    """A file of SUR and its bytes."""

    path: Path
    name: str
    data: bytes

    def measurement(self) -> Measurement:
        """The first layer of the file."""
        head = self._head
        if head["type"] not in _WITH_HEIGHTS:
            found = _OTHERS.get(head["type"], f"an object of type {head['type']}")
            self._refuse(f"it holds {found}, and no map of heights")
        nx, ny = points = head["nx"], head["ny"]
        if min(points) < 1 or head["bits"] not in _NUMBERS:
            self._refuse(f"its head states {nx} x {ny} points of {head['bits']} bits")
        refuse_points(points, self.path, self.name, _BYTES_PER_POINT)
        stored = self._counts(nx * ny * head["bits"] // 8)
        counts = np.frombuffer(stored, _NUMBERS[head["bits"]]).reshape(ny, nx).T
        sign = -1.0 if head["inversion"] in _INVERTED else 1.0
        heights = np.ma.array(sign * head["dz"] * counts)
        if head["special"] == 1:
            heights.mask = counts == head["least"] - _BELOW_LEAST
        along_x, along_y = (-1 if head["inversion"] == flag else 1 for flag in (2, 3))
        # what is stated across a line scan means nothing
        x, y = map(self._unit, "yy" if nx == 1 else "xx" if ny == 1 else "xy")
        several = head["objects"] > 1
        return Measurement(
            file=self.name,
            kind="surface",
            format="SUR",
            doubts=(f"it holds {head['objects']} layers, of which the first is read",) * several,
            settings={"origin": MEASURED, "file": self.name},
            **in_stated_units(heights[::along_x, ::along_y], self._sides(x, y), self._unit("z"), x),
        )

    def _refuse(self, why: str) -> NoReturn:
        raise InputError(f"{self.name} cannot be read: {why}; export it again")

    @cached_property
    def _head(self) -> dict[str, Any]:
        if len(self.data) < _HEAD:
            self._refuse("it ends within its head")
        found = {
            key: struct.unpack_from(form, self.data, place)[0]
            for key, (form, place) in _PLACES.items()
        }
        if not (np.isfinite(found["dz"]) and found["dz"] != 0):
            self._refuse(f"its step of heights is {found['dz']:g}")
        return found

    def _sides(self, unit: str, unit_along_y: str) -> tuple[float, float]:
        """The sides of the map, in the unit of that along x."""
        sides = []
        for n, step in (("nx", "dx"), ("ny", "dy")):
            if self._head[n] > 1 and not 0 < self._head[step] < np.inf:
                self._refuse(f"its points are {self._head[step]:g} apart")
            sides.append(self._head[n] * self._head[step])
        if bool(unit) != bool(unit_along_y):
            self._refuse("it states the unit of one side alone")
        if unit != unit_along_y:
            sides[1] *= metres_per(unit_along_y) / metres_per(unit)
        return sides[0], sides[1]

    def _unit(self, axis: str) -> str:
        """The unit of an axis; empty where none is stated.

        Programs write a micro sign in Latin-1, in UTF-8, as Latin-1 in UTF-8, or as MS-DOS did.
        """
        text = self.data[_UNITS[axis] : _UNITS[axis] + 16].partition(b"\0")[0]
        try:
            unit = text.decode("utf-8")
        except UnicodeDecodeError:
            unit = text.decode("latin-1")
        unit = unit.replace("Â", "").replace("æ", "µ").strip()
        unit = _INCHES.get(unit.lower(), unit)
        if unit and not is_unit_of_length(unit):
            what = "no heights in it" if axis == "z" else "no map"
            self._refuse(f'its {axis} axis is in "{shortened(unit)}": {what}')
        return unit

    def _counts(self, size: int) -> bytes:
        """The heights as counts, unpacked if they are packed."""
        start = _HEAD + self._head["comment"] + self._head["private"]
        if self.data.startswith(_PLAIN):
            counts = self.data[start : start + size]
        else:
            counts = self._unpacked(start, size)
        if len(counts) != size:
            found = f"{len(counts)}" if len(counts) < size else f"more than {size}"
            self._refuse(f"it holds {found} bytes of heights, and its head states {size}")
        return counts

    def _unpacked(self, start: int, size: int) -> bytes:
        """The pieces of packed heights, of which their table states the sizes, one by one."""
        try:
            (pieces,) = struct.unpack_from("<I", self.data, start)
            place, table = start + 4 + 8 * pieces, start + 4
            if place > len(self.data):
                self._refuse("it was cut short")
            found = b""
            for i in range(pieces):
                _, packed = struct.unpack_from("<2I", self.data, table + 8 * i)
                piece = zlib.decompressobj()
                most = size - len(found) + 1  # one more is too much already
                found += piece.decompress(self.data[place : place + packed], most)
                place += packed
                if len(found) > size:
                    break
        except (struct.error, zlib.error) as error:
            raise InputError(
                f"{self.name} is damaged: its heights cannot be unpacked ({error}); export it again"
            ) from error
        return found
