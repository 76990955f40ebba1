"""The folder of a server's files, and those that servers before it could not delete."""

from __future__ import annotations

import os
import re
import shutil
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

_PREFIX = "roughline-lab-"
_NAME = re.compile(_PREFIX + r"(?P<pid>\d+)-\w+")


@contextmanager
def folder_of_files(parent: Path | None = None) -> Iterator[Path]:
    """Give a folder that only its owner may enter, and delete it with all that is in it.

    It lies among the system's temporary files, or in `parent`.
    """
    parent = parent or Path(tempfile.gettempdir())
    _remove_leftovers(parent)
    root = Path(tempfile.mkdtemp(prefix=f"{_PREFIX}{os.getpid()}-", dir=parent))
    try:
        yield root
    finally:
        shutil.rmtree(root, ignore_errors=True)


def _remove_leftovers(parent: Path) -> None:
    """Delete the folders of servers that no longer run; folders of other users are left alone."""
    import psutil  # here because it is wanted once

    for folder in parent.glob(f"{_PREFIX}*"):
        named = _NAME.fullmatch(folder.name)
        with suppress(OSError):
            if named and _is_own_folder(folder) and not psutil.pid_exists(int(named["pid"])):
                shutil.rmtree(folder, ignore_errors=True)


def _is_own_folder(path: Path) -> bool:
    """Whether it is a folder, not a link to one, of the user who runs this."""
    found = path.lstat()
    is_own = not hasattr(os, "getuid") or found.st_uid == os.getuid()
    return stat.S_ISDIR(found.st_mode) and is_own
