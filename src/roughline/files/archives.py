"""Files that say that they hold far more than their size: archives, and grids without heights."""

from __future__ import annotations

import math
import zipfile
from pathlib import Path

from roughline.errors import InputError

_LARGE = 2**26  # unpacked; smaller ones do no harm [bytes]
_RATIO = 200  # unpacked over packed; measured heights reach about 10


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
        If it unpacks to more than 64 MiB, and to more than 200 times its size.
    """
    if not zipfile.is_zipfile(path):
        return
    try:
        with zipfile.ZipFile(path) as archive:
            unpacked = sum(part.file_size for part in archive.infolist())
    except (zipfile.BadZipFile, ValueError, OSError, NotImplementedError) as error:
        raise InputError(f"{name} is a damaged archive ({error}): export it again") from error
    packed = path.stat().st_size
    if unpacked > max(_LARGE, _RATIO * packed):
        raise InputError(
            f"{name} has {packed / 1e6:.3g} MB and would unpack to {unpacked / 1e6:.4g} MB, "
            "far too large for a measurement: export it again"
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
        raise InputError(
            f"{name} declares {declared} points and has {size / 1e3:.3g} kB, too little to hold "
            "them: export it again"
        )
