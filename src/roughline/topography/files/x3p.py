"""X3P, the exchange format of ISO 25178-72: an archive of main.xml and files of numbers."""

from __future__ import annotations

import hashlib
import math
import re
import zipfile
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn
from xml.etree.ElementTree import Element, TreeBuilder
from xml.parsers import expat

import numpy as np

from roughline.computing.arrays import Real
from roughline.computing.memory import refuse_beyond_memory
from roughline.errors import InputError
from roughline.errors.checks import shortened
from roughline.topography.files.archives import refuse_hollow, refuse_points
from roughline.topography.files.heights_in_text import gridded_map, sorted_line
from roughline.topography.files.measurement import Measurement
from roughline.topography.settings import MEASURED

_MAIN = "main.xml"
_MAINS = re.compile(rf"((?!__MACOSX/)[^/]+/)?{_MAIN}")  # in a folder, or in none
_CHECKSUM = "md5checksum.hex"
_TYPES = {"I": "<i2", "L": "<i4", "F": "<f4", "D": "<f8"}  # of numbers
_REVISIONS = ("", "ISO5436 - 2000", "ISO25178-72:2017/DAM1")  # of one layout; not all state theirs
_DASHES = re.compile("[‐-―−]")  # that stand for a hyphen in texts of some programs
_DIGEST = re.compile(r"[0-9a-f]{32}")
_BYTES_PER_CHARACTER = 20  # of XML, as a tree of elements
_BYTES_PER_POINT = 24  # as stored, as heights and as their mask


def read_x3p(path: Path, channel: int | str | None, name: str) -> Measurement | None:
    """Read heights from X3P, all in metres; None if the file has another format."""
    if not zipfile.is_zipfile(path):
        if path.suffix.lower() == ".x3p":
            raise InputError(
                f"{name} is damaged or was cut short: X3P is an archive, and it is none; export it "
                "again"
            )
        return None
    try:
        with zipfile.ZipFile(path) as archive:
            mains = [part for part in archive.namelist() if _MAINS.fullmatch(part)]
            if not mains:
                return None
            refuse_hollow(path, name)
            folder = min(mains, key=len).removesuffix(_MAIN)
            return _X3pFile(path, name, archive, folder).measurement(channel)
    except (zipfile.BadZipFile, zlib.error, RuntimeError, EOFError, OSError) as error:
        reason = shortened(str(error))
        raise InputError(f"{name} is a damaged archive ({reason}): export it again") from error


@dataclass(frozen=True)
class _Axis:
    """An axis: the numbers of its points times a step, or what is stored for them times it."""

    type: str | None  # of the stored numbers; None for an axis that only counts its points
    step: float  # [m]
    offset: float  # [m]

    def positions(self, numbers: Any) -> Real:
        """Positions along the axis of the numbers of points, or of those that are stored. [m]"""
        if self.step == 1 and self.offset == 0:
            return np.asarray(numbers, np.float64)  # as it is, if memory need not hold it twice
        found: Real = np.multiply(numbers, self.step, dtype=np.float64)
        found += self.offset
        return found


@dataclass(frozen=True, eq=False)
class _X3pFile:
    """A file of X3P that is open."""

    path: Path
    name: str
    archive: zipfile.ZipFile
    folder: str  # with main.xml; some programs pack the folder, and not what is in it

    def measurement(self, channel: int | str | None) -> Measurement:
        """The heights of a map, a line scan or a list of points."""
        main = self._part(_MAIN)
        root = self._tree(main)
        x, y, z = (self._axis(root, each) for each in ("CX", "CY", "CZ"))
        if z.type is None:
            self._refuse("its z axis counts points and holds no heights")
        nx, ny, layers = self._points(root)
        for axis, points in ((x, nx), (y, ny), (z, 2)):
            if axis.step == 0 and points > 1:  # a line scan may state any step across itself
                self._refuse("the step of an axis is 0")
        refuse_points((nx, ny * layers), self.path, self.name, _BYTES_PER_POINT)
        stored, missing, doubts = self._stored(root, {"x": x, "y": y, "z": z}, nx * ny * layers)
        layer, named = self._layer(channel, layers)
        shape = (layers, ny, nx)
        heights = np.ma.array(z.positions(stored["z"]), mask=missing).reshape(shape)[layer].T
        columns = {
            key: axis.positions(stored[key]).reshape(shape)[layer].T.ravel()
            for key, axis in (("x", x), ("y", y))
            if axis.type is not None
        }
        of_both: dict[str, Any] = {
            "file": self.name,
            "unit": "m",
            "format": "X3P",
            "settings": {"origin": MEASURED, "file": self.name},
            "doubts": (*self._doubts(root), *doubts, *self._doubt_of_main(root, main)),
            "corrected": self._sum_of_heights(root),
            "channels": named,
            "channel": f"layer {layer}" if named else "",
        }
        if min(nx, ny) == 1 and root.find("Record3/ListDimension") is None:
            return self._line(heights, columns, x if ny == 1 else y, of_both)
        if columns:
            return self._listed(heights, columns, (x, y), of_both)
        sides = (nx * abs(x.step), ny * abs(y.step))
        heights = heights[:: 1 if x.step > 0 else -1, :: 1 if y.step > 0 else -1]
        return Measurement(heights=heights, sizes=sides, kind="surface", **of_both)

    def _line(
        self,
        heights: np.ma.MaskedArray,
        columns: dict[str, Real],
        along: _Axis,
        of_both: dict[str, Any],
    ) -> Measurement:
        """A line scan: one row or one column of points."""
        heights = heights.ravel()
        moving = [each for each in columns.values() if np.ptp(each[np.isfinite(each)]) > 0]
        if along.type is None:
            length = heights.size * abs(along.step)
            heights = heights if along.step > 0 else heights[::-1]
            return Measurement(heights=heights, sizes=(length,), kind="profile", **of_both)
        if len(moving) != 1 or not np.isfinite(moving[0]).all():
            self._refuse("its line scan runs along no axis, or has points without a position")
        filled = np.ma.filled(heights, np.nan)
        filled, positions, length = sorted_line(moving[0], filled, self.name)
        return Measurement(
            heights=filled, sizes=(length,), positions=positions, kind="profile", **of_both
        )

    def _listed(
        self,
        heights: np.ma.MaskedArray,
        columns: dict[str, Real],
        axes: tuple[_Axis, _Axis],
        of_both: dict[str, Any],
    ) -> Measurement:
        """A map whose points have positions of their own, which must be those of a grid."""
        counted = np.indices(heights.shape)
        x, y = (
            columns.get(key, axis.positions(along.ravel()))
            for key, axis, along in zip("xy", axes, counted, strict=True)
        )
        z = np.ma.filled(heights, np.nan).ravel()
        placed = np.isfinite(x) & np.isfinite(y)
        found, sides = gridded_map(x[placed], y[placed], z[placed], self.name)
        return Measurement(heights=found, sizes=sides, kind="surface", **of_both)

    def _refuse(self, why: str) -> NoReturn:
        raise InputError(f"{self.name} is X3P that cannot be read: {why}; export it again")

    def _part(self, part: str) -> bytes:
        """A file of the archive."""
        inside = self.folder + part.strip().replace("\\", "/").removeprefix("/")
        if inside not in self.archive.namelist():
            self._refuse(f"{shortened(part)} is missing in it")
        return self.archive.read(inside)

    def _tree(self, main: bytes) -> Element:
        """The tree of main.xml, its tags without prefixes; entities are refused unread."""
        refuse_beyond_memory(
            _BYTES_PER_CHARACTER * len(main), f"reading {_MAIN} of {self.name}", "write it binary"
        )
        parser, builder = expat.ParserCreate(), TreeBuilder()

        def refuse_entities(*_: object) -> None:
            self._refuse(f"{_MAIN} declares a document type, and may declare entities")

        parser.buffer_text = True
        parser.StartDoctypeDeclHandler = refuse_entities
        parser.StartElementHandler = lambda tag, _: builder.start(tag.rpartition(":")[2], {})
        parser.EndElementHandler = lambda tag: builder.end(tag.rpartition(":")[2])
        parser.CharacterDataHandler = builder.data
        try:
            parser.Parse(main, True)
            root = builder.close()
        except InputError:
            raise
        except (expat.ExpatError, ValueError, LookupError) as error:
            raise InputError(
                f"{self.name} is X3P that cannot be read: {_MAIN} is damaged ({error}); export it "
                "again"
            ) from error
        return root

    def _text(self, root: Element, place: str) -> str:
        """The text of an element; empty where there is none."""
        return (root.findtext(place) or "").strip()

    def _number(self, root: Element, place: str, otherwise: float) -> float:
        text = self._text(root, place)
        try:
            value = float(text) if text else otherwise
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            self._refuse(f'{place} is "{shortened(text)}"')
        return value

    def _axis(self, root: Element, name: str) -> _Axis:
        place = f"Record1/Axes/{name}"
        kind, type_ = (self._text(root, f"{place}/{each}") for each in ("AxisType", "DataType"))
        if kind not in ("I", "A") or (kind == "A" and type_ not in _TYPES):
            self._refuse(f'axis {name} is of type "{shortened(kind)}", "{shortened(type_)}"')
        step = self._number(root, f"{place}/Increment", 1.0)
        offset = self._number(root, f"{place}/Offset", 0.0)
        return _Axis(_TYPES[type_] if kind == "A" else None, step, offset)

    def _points(self, root: Element) -> tuple[int, int, int]:
        """Numbers of points along x and y, and of layers; those of a list stand along x."""
        places = [f"MatrixDimension/Size{axis}" for axis in "XYZ"]
        if root.find("Record3/ListDimension") is not None:
            places = ["ListDimension"]
        counts = [self._text(root, f"Record3/{place}") for place in places]
        if not all(re.fullmatch(r"0*[1-9]\d{0,9}", count, re.ASCII) for count in counts):
            self._refuse(f"its numbers of points are {shortened(' x '.join(counts)) or 'missing'}")
        nx, ny, layers = [*map(int, counts), 1, 1][:3]
        return nx, ny, layers

    def _layer(self, channel: int | str | None, layers: int) -> tuple[int, tuple[str, ...]]:
        """The number of the layer that is read, and the names of all where there are several."""
        if layers == 1:
            return 0, ()
        number = 0 if channel is None else str(channel).removeprefix("layer ")
        if not str(number).isdigit() or int(number) >= layers:
            raise InputError(
                f"{self.name} has no channel {channel!r}; it has {layers} layers from 0"
            )
        return int(number), tuple(f"{i} layer {i}" for i in range(layers))

    def _stored(
        self, root: Element, axes: dict[str, _Axis], points: int
    ) -> tuple[dict[str, Any], Any, list[str]]:
        """The numbers that are stored for each point, which ones are missing, and doubts."""
        types = np.dtype([(key, axis.type) for key, axis in axes.items() if axis.type is not None])
        assert types.names is not None  # of z at least
        data = root.find("Record3/DataList")
        if data is not None:
            rows = self._datums(data, points, len(types.names))
            columns = dict(zip(types.names, rows.T, strict=True))
            return columns, np.isnan(rows).any(axis=1), []
        link = self._text(root, "Record3/DataLink/PointDataLink")
        content, doubts = self._linked(root, link, "MD5ChecksumPointData", points * types.itemsize)
        stored = np.frombuffer(content, types)
        missing = np.ma.nomask
        if link := self._text(root, "Record3/DataLink/ValidPointsLink"):
            size = -(-points // 8)
            bits, more = self._linked(root, link, "MD5ChecksumValidPoints", size)
            known = np.unpackbits(np.frombuffer(bits, "u1"), bitorder="little")[:points]
            missing = known == 0
            doubts += more
        return {key: stored[key] for key in types.names}, missing, doubts

    def _linked(
        self, root: Element, link: str, checksum: str, size: int
    ) -> tuple[bytes, list[str]]:
        """A file that main.xml names, and a doubt where its checksum is another one."""
        content = self._part(link)
        if len(content) != size:
            self._refuse(f"{shortened(link)} has {len(content)} bytes, and {size} are needed")
        stated = self._text(root, f"Record3/DataLink/{checksum}").lower()
        if not _DIGEST.fullmatch(stated) or stated == _digest(content):
            return content, []
        return content, [self._changed(link)]

    def _changed(self, part: str) -> str:
        return (
            f"the checksum in the file is not that of its {shortened(part)}, which may have been "
            "changed since it was measured"
        )

    def _datums(self, data: Element, points: int, columns: int) -> Real:
        """Numbers that stand in main.xml itself; NaN where a point has none."""
        texts = [(each.text or "").strip() for each in data.findall("Datum")]
        if len(texts) != points:
            self._refuse(f"it lists {len(texts)} points, and {points} are needed")
        rows = np.full((points, columns), np.nan)
        for i, text in enumerate(texts):
            if text:
                try:
                    rows[i] = [float(each) for each in text.split(";")]
                except ValueError:
                    self._refuse(f'its point {i} is "{shortened(text)}"')
        return rows

    def _doubts(self, root: Element) -> list[str]:
        """What is unusual in main.xml."""
        doubts = []
        revision = self._text(root, "Record1/Revision")
        if _DASHES.sub("-", revision) not in _REVISIONS:
            doubts.append(
                f'its revision, "{shortened(revision)}", is not known; read as {_REVISIONS[1]}'
            )
        if root.find("Record3/Mask") is not None:
            doubts.append("it has a picture of marked regions, which are read like all others")
        return doubts

    def _stated_sum(self, root: Element) -> str:
        """The checksum that stands beside main.xml; empty where there is none."""
        part = self._text(root, "Record4/ChecksumFile") or _CHECKSUM
        if self.folder + part not in self.archive.namelist():
            return ""
        stated = _DIGEST.match(self._part(part).decode("latin-1").strip().lower())
        return stated[0] if stated else ""

    def _sum_of_heights(self, root: Element) -> tuple[str, ...]:
        """A word where the sum beside main.xml is that of the heights, which harms nothing."""
        of_heights = self._text(root, "Record3/DataLink/MD5ChecksumPointData").lower()
        if not of_heights or self._stated_sum(root) != of_heights:
            return ()
        return (
            f"the checksum beside its {_MAIN} is that of the heights, as SurfaceTopography writes "
            "it, and was not used",
        )

    def _doubt_of_main(self, root: Element, main: bytes) -> list[str]:
        """A doubt where the sum beside main.xml is that of something else."""
        stated = self._stated_sum(root)
        is_sound = not stated or stated == _digest(main) or self._sum_of_heights(root)
        return [] if is_sound else [self._changed(_MAIN)]


def _digest(content: bytes) -> str:
    return hashlib.md5(content, usedforsecurity=False).hexdigest()
