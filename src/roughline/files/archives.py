"""Files that say that they hold far more than their size: archives, grids and tables of nothing."""

from __future__ import annotations

import math
import re
import zipfile
from contextlib import suppress
from pathlib import Path
from typing import Any, BinaryIO

from roughline.errors import InputError

_LARGE = 2**26  # unpacked; smaller ones do no harm [bytes]
_RATIO = 200  # unpacked over packed; measured heights reach about 10
_HDF5 = b"\x89HDF\r\n\x1a\n"
_STARTS_OF_HDF5 = (0, *(512 * 2**i for i in range(8)))  # where it may begin [bytes]
_SHEET = re.compile(r"xl/worksheets/[^/]+\.xml")
_CELL = re.compile(rb"""<(?:\w+:)?(?:row|c)\b[^>]*?\br=["'][A-Z]*(\d+)["']""")
_FEW_ROWS, _SPARSE = 1000, 20  # rows of a table, and rows for each of its cells, that do no harm


def refuse_bombs(path: Path, name: str) -> None:
    """Refuse an archive, such as X3P or XLSX, whose parts are too large for a measurement.

    Parameters
    ----------
    path : Path
        The file.
    name : str
        What it is called.

    Raises
    ------
    InputError
        If it unpacks to more than 64 MiB, and to more than 200 times its size, or if a table in it
        has hardly any cells for its rows.
    """
    if not zipfile.is_zipfile(path):
        return
    try:
        with zipfile.ZipFile(path) as archive:
            parts = archive.infolist()
            unpacked = sum(part.file_size for part in parts)
            is_bomb = unpacked > max(_LARGE, _RATIO * path.stat().st_size)
            sheets = [] if is_bomb else [part for part in parts if _SHEET.fullmatch(part.filename)]
            rows = [[int(row) for row in _CELL.findall(archive.read(sheet))] for sheet in sheets]
    except (zipfile.BadZipFile, ValueError, OSError, NotImplementedError) as error:
        raise InputError(f"{name} is a damaged archive ({error}): export it again") from error
    packed = path.stat().st_size
    if is_bomb:
        raise InputError(
            f"{name} has {packed / 1e6:.3g} MB and would unpack to {unpacked / 1e6:.4g} MB, "
            "far too large for a measurement: export it again"
        )
    for each in rows:
        if max(each, default=0) > _FEW_ROWS + _SPARSE * len(each):
            raise InputError(
                f"{name} has a cell in row {max(each)} of a table with {len(each)} cells: delete "
                "what stands far below the others"
            )


def refuse_empty_datasets(path: Path, name: str) -> None:
    """Refuse a file of HDF5, such as NetCDF, one of whose datasets it is too small to hold.

    Parameters
    ----------
    path : Path
        The file.
    name : str
        What it is called.

    Raises
    ------
    InputError
        If a dataset has more than 200 numbers, or one text, for each byte of the file.
    """
    with path.open("rb") as file:
        if not any(_starts_hdf5(file, place) for place in _STARTS_OF_HDF5):
            return
    import h5py  # here because it loads slowly

    found: list[tuple[tuple[int, ...], str]] = []

    def note(_: str, node: Any) -> None:
        if isinstance(node, h5py.Dataset) and node.shape is not None:
            found.append((node.shape, node.dtype.kind))

    with suppress(OSError, RuntimeError, KeyError), h5py.File(path, "r") as file:  # damaged
        file.visititems(note)
    size = path.stat().st_size
    for shape, kind in found:
        if math.prod(shape) > (_RATIO if kind in "biuf" else 1) * size:
            raise _too_small(shape, size, name)


def _starts_hdf5(file: BinaryIO, place: int) -> bool:
    file.seek(place)
    return file.read(len(_HDF5)) == _HDF5


def _too_small(points: tuple[int, ...], size: int, name: str) -> InputError:
    return InputError(
        f"{name} declares {' x '.join(map(str, points))} points and has {size / 1e3:.3g} kB, too "
        "little to hold them: export it again"
    )


def refuse_too_few_bytes(points: tuple[int, ...], path: Path, name: str) -> None:
    """Refuse a file that is too small for the points that it declares, before they are read.

    Parameters
    ----------
    points : tuple of int
        Points along each axis, as the file declares them.
    path : Path
        The file.
    name : str
        What it is called.

    Raises
    ------
    InputError
        If there are more than 200 points for each byte, or fewer than two.
    """
    count, declared = math.prod(points), " x ".join(map(str, points))
    if count < 2:
        raise InputError(f"{name} holds {declared or 1} points; at least 2 are needed")
    size = path.stat().st_size
    if count > _RATIO * size:
        raise _too_small(points, size, name)
