"""Archives that unpack to far more than their size."""

from __future__ import annotations

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
