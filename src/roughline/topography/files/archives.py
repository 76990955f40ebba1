"""Files that say that they hold far more than their size: archives, grids, images of nothing."""

from __future__ import annotations

import math
import re
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any, BinaryIO

from roughline.computing.memory import refuse_beyond_memory
from roughline.errors import InputError
from roughline.errors.checks import shortened

_HARMLESS_BYTES = 2**26  # unpacked; smaller ones do no harm [bytes]
_RATIO = 200  # unpacked over packed; measured heights reach about 10
_HDF5 = b"\x89HDF\r\n\x1a\n"
_STARTS_OF_HDF5 = (0, *(512 * 2**i for i in range(8)))  # where it may begin [bytes]
_SHEET = re.compile(r"xl/worksheets/[^/]+\.xml")
_CELL = re.compile(rb"""<(?:\w+:)?(?:row|c)\b[^>]*?\br=["'][A-Z]*(\d+)["']""")
_ZSTD = b"\x28\xb5\x2f\xfd"
_PROCEDURE = re.compile(r"[^/.]+\.dsc")  # of a scan, in archives of nanomeasuring machines
_SCANS = re.compile(rb"Number of scans\s*:\s*(\d+)")
_DATASETS = b"[DataSet]\r\n"  # the start of files of easyScan
_COUNTS = re.compile(rb"Count=(\d+)")
_TIFF = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
_DEFLATE, _LZMA = (8, 32946), 34925  # how images in TIFF are packed
_STEP = 2**20  # of what is unpacked to learn how much it is [bytes]
_DIGITS = 12  # of a number of parts, at most
_DAMAGED_PART_ERRORS = (
    ValueError,
    OSError,
    EOFError,
    RuntimeError,
)  # one has a password, or is cut
_FEW_ROWS, _ROWS_PER_CELL = 1000, 20  # of a table, and for each of its cells, that do no harm


def refuse_hollow(path: Path, name: str) -> None:
    """Refuse a file of any format that says that it holds far more than its size."""
    _refuse_bombs(path, name)
    refuse_empty_datasets(path, name)
    _refuse_empty_images(path, name)
    _refuse_many_datasets(path, name)


def _refuse_bombs(path: Path, name: str) -> None:
    """Refuse an archive, such as X3P or XLSX, whose parts are too large for a measurement.

    One is too large if it unpacks to more than 64 MiB and to more than 200 times its size, if a
    table in it has hardly any cells for its rows, or if it lists more scans than it has parts.
    """
    if not zipfile.is_zipfile(path):
        return
    try:
        with zipfile.ZipFile(path) as archive:
            parts = archive.infolist()
            unpacked = sum(part.file_size for part in parts)
            most = _most_unpacked(path)
            is_bomb = unpacked > most
            if not is_bomb:  # parts may be packed once more
                unpacked = sum(_unpacked_twice(archive, part, most) for part in parts)
                is_bomb = unpacked > most
            sheets = [] if is_bomb else [part for part in parts if _SHEET.fullmatch(part.filename)]
            rows = [[int(row) for row in _CELL.findall(archive.read(sheet))] for sheet in sheets]
            scans = [] if is_bomb else _scans_in(archive)
    except (zipfile.BadZipFile, zlib.error, *_DAMAGED_PART_ERRORS) as error:
        reason = shortened(str(error))
        raise InputError(f"{name} is a damaged archive ({reason}): export it again") from error
    packed = path.stat().st_size
    if is_bomb:
        raise _unpacks_to_too_much(unpacked, packed, name)
    for each in rows:
        if max(each, default=0) > _FEW_ROWS + _ROWS_PER_CELL * len(each):
            raise InputError(
                f"{name} has a cell in row {max(each)} of a table with {len(each)} cells: delete "
                "what stands far below the others"
            )
    _refuse_more_than(len(parts), scans, f"scans and has {len(parts)} parts", name)


def _most_unpacked(path: Path) -> int:
    """The most that a file may unpack to. [bytes]"""
    return max(_HARMLESS_BYTES, _RATIO * path.stat().st_size)


def _unpacks_to_too_much(unpacked: int, packed: int, name: str) -> InputError:
    return InputError(
        f"{name} has {packed / 1e6:.3g} MB and would unpack to {unpacked / 1e6:.4g} MB or more, "
        "far too large for a measurement: export it again"
    )


def _unpacked_twice(archive: zipfile.ZipFile, part: zipfile.ZipInfo, most: int) -> int:
    """The size of a part of an archive, unpacked again if it is packed; counted up to a limit."""
    with archive.open(part) as stream:
        if stream.read(len(_ZSTD)) != _ZSTD:
            return part.file_size
    import zstandard  # here because few files need it

    size = 0
    unpacker = zstandard.ZstdDecompressor()
    with suppress(zstandard.ZstdError), archive.open(part) as stream:  # damaged
        pieces = unpacker.stream_reader(stream)
        while size <= most and (piece := pieces.read(_STEP)):
            size += len(piece)
    return size


def _scans_in(archive: zipfile.ZipFile) -> list[bytes]:
    """Numbers of scans, as an archive of a nanomeasuring machine states them."""
    procedures = filter(_PROCEDURE.fullmatch, archive.namelist())
    return [scans for each in procedures for scans in _SCANS.findall(archive.read(each))]


def _refuse_more_than(most: int, stated: list[bytes], what: str, name: str) -> None:
    """Refuse a file that states a larger number of its parts than it can have."""
    for number in stated:
        if len(number) > _DIGITS or int(number) > most:
            raise InputError(
                f"{name} lists {number[:_DIGITS].decode()} {what}, too little to hold them: export "
                "it again"
            )


def _refuse_many_datasets(path: Path, name: str) -> None:
    """Refuse a file of easyScan that lists more datasets than it has bytes."""
    with path.open("rb") as file:
        if file.read(len(_DATASETS)) != _DATASETS:
            return
        head = file.read(_STEP)
    size = path.stat().st_size
    what = f"datasets and has {size / 1e3:.3g} kB"
    _refuse_more_than(size, _COUNTS.findall(head), what, name)


def _refuse_empty_images(path: Path, name: str) -> None:
    """Refuse a file of TIFF one of whose images it is too small to hold, or unpacks to too much.

    An image, or a tile of it, may have 200 numbers for each byte of the file, and images may unpack
    to 64 MiB, or to 200 times the size of the file.
    """
    with path.open("rb") as file:
        if file.read(4) not in _TIFF:
            return
    import tifffile  # here because it loads slowly

    wrong = None
    with suppress(Exception), tifffile.TiffFile(path) as images:  # damaged; its reader says so
        wrong = _wrong_image(images, path, name)
    if wrong is not None:
        raise wrong


def _wrong_image(images: Any, path: Path, name: str) -> InputError | None:
    """What is wrong with the first image in a file of TIFF that it is too small to hold."""
    size, most, unpacked = path.stat().st_size, _most_unpacked(path), 0
    for page in images.pages:
        tile = page.tilewidth * page.tilelength * page.samplesperpixel
        for points in (page.shape, (tile,)):
            if math.prod(points) > _RATIO * size:
                return _too_small(points, size, name)
        for piece in _pieces_of_image(page, images.filehandle):
            unpacked += piece
            if unpacked > most:
                return _unpacks_to_too_much(unpacked, size, name)
    return None


def _pieces_of_image(page: Any, file: Any) -> Iterator[int]:
    """Sizes of the pieces that a packed image is unpacked in. [bytes]"""
    if page.compression not in (*_DEFLATE, _LZMA):
        return
    import lzma  # here because few files need it

    for place, size in zip(page.dataoffsets, page.databytecounts, strict=False):
        file.seek(place)
        packed = file.read(size)
        if page.compression == _LZMA:
            unpacker = lzma.LZMADecompressor()
            while not unpacker.eof and (piece := unpacker.decompress(packed, _STEP)):
                packed = b""
                yield len(piece)
        else:
            stream = zlib.decompressobj()
            while piece := stream.decompress(packed, _STEP):
                packed = stream.unconsumed_tail
                yield len(piece)


def refuse_empty_datasets(path: Path, name: str) -> None:
    """Refuse a file of HDF5, such as NetCDF, that is damaged or too small for one of its datasets.

    A dataset may have 200 numbers, or one text, for each byte of the file, and of a large one not
    nearly all may be unwritten.
    """
    with path.open("rb") as file:
        if not any(_starts_hdf5(file, place) for place in _STARTS_OF_HDF5):
            return
    import h5py  # here because it loads slowly

    size = path.stat().st_size
    found: list[tuple[tuple[int, ...], str, int]] = []

    def note(_: str, node: Any) -> None:
        if isinstance(node, h5py.Dataset) and node.shape is not None:
            is_large = node.chunks is not None and node.nbytes > _HARMLESS_BYTES
            written = node.id.get_storage_size() if is_large else size
            found.append((node.shape, node.dtype.kind, min(size, written)))

    try:
        with h5py.File(path, "r") as file:
            dict(file.attrs)  # damaged ones leave h5netcdf half opened
            with suppress(OSError, RuntimeError, KeyError):  # damaged further down
                file.visititems(note)
    except Exception as error:  # of a damaged file h5py raises errors of any type
        first_line = shortened((str(error).strip() or "no reason given").splitlines()[0])
        raise InputError(f"{name} is damaged HDF5 ({first_line}): export it again") from error
    for shape, kind, written in found:
        if math.prod(shape) > (_RATIO if kind in "biuf" else 1) * written:
            raise _too_small(shape, written, name)


def _starts_hdf5(file: BinaryIO, place: int) -> bool:
    file.seek(place)
    return file.read(len(_HDF5)) == _HDF5


def _too_small(points: tuple[int, ...], size: int, name: str) -> InputError:
    return InputError(
        f"{name} declares {' x '.join(map(str, points))} points and has {size / 1e3:.3g} kB, too "
        "little to hold them: export it again"
    )


def refuse_points(
    points: tuple[int, ...],
    path: Path,
    name: str,
    bytes_each: int = 16,
    advice: str = "take a smaller piece",
) -> None:
    """Refuse points that a file declares, before they are read, if it or memory is too small.

    A file may have 200 points for each byte, and has at least two.
    """
    count, declared = math.prod(points), " x ".join(map(str, points))
    if count < 2:
        raise InputError(f"{name} holds {declared or 1} points; at least 2 are needed")
    size = path.stat().st_size
    if count > _RATIO * size:
        raise _too_small(points, size, name)
    refuse_beyond_memory(bytes_each * count, f"reading the {declared} points of {name}", advice)
