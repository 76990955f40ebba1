"""The folder that results are written to."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryFile

from roughline.errors import StoreError


def make_folder(out: Path) -> None:
    """Make a folder, and try whether files can be written to it.

    Raises
    ------
    StoreError
        If the folder cannot be made, or no file can be written to it.
    """
    try:
        out.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=out):
            pass
    except OSError as error:
        raise StoreError(f"cannot write to {out} ({error}): choose another folder") from error
