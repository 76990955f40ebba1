"""Files on the disk of the server: those of a page, and what servers leave."""

from __future__ import annotations

import errno
import os
import re
import secrets
import shutil
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

_PREFIX = "roughline-lab-"
_ROOT = re.compile(_PREFIX + r"(?P<pid>\d+)-\w+")
MOST_UPLOAD = 1_000_000_000  # largest file that is taken [bytes]
_MOST_FILES = 20  # of one page at once
_MOST_UPLOADS = 3  # largest files that a page's files may make together
_NOT_IN_NAMES = re.compile(r"[<>/\\\0-\x1f\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069]")
"""What no system lets a name have, or what a terminal or a page could take for something else."""

_SUFFIX = re.compile(r"\.[A-Za-z0-9]{1,8}")


@dataclass
class Upload:
    """A file that a page has brought."""

    key: str  # by which the page knows it
    path: Path  # where it lies, under a random name
    name: str  # name that its owner gave it
    size: int  # as the page stated it in advance [bytes]
    digest: str = ""  # of its content; empty until it is whole


class Files:
    """What a page has brought, by keys, in a folder of its own that is there from the first on."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.uploads: dict[str, Upload] = {}

    def new(self, name: str, size: int) -> Upload:
        """Make place for a file that is about to come, of a size that counts from now on.

        The oldest go if they are too many or too large. Raises an OSError if there is no room.
        """
        usable = _NOT_IN_NAMES.sub("_", name)[-100:] or "file"
        suffix = _SUFFIX.fullmatch(Path(usable).suffix)
        self.folder.mkdir(mode=0o700, exist_ok=True)
        if shutil.disk_usage(self.folder).free <= size:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        while self.uploads and (
            len(self.uploads) >= _MOST_FILES
            or sum(each.size for each in self.uploads.values()) + size > _MOST_UPLOADS * MOST_UPLOAD
        ):
            self.forget(next(iter(self.uploads)))
        path = self.folder / (secrets.token_hex(8) + (suffix[0].lower() if suffix else ""))
        path.touch()
        upload = Upload(secrets.token_urlsafe(12), path, usable, size)
        self.uploads[upload.key] = upload
        return upload

    def forget(self, key: str) -> None:
        """Delete a file."""
        upload = self.uploads.pop(key, None)
        if upload is not None:
            with suppress(PermissionError):  # of Windows, while it is read; its folder goes later
                upload.path.unlink(missing_ok=True)

    def take_away(self) -> Path:
        """Have no files any more; returns the folder of those that were, which may be deleted."""
        self.uploads.clear()
        gone = self.folder.with_name(f"{self.folder.name}-{secrets.token_hex(4)}")
        try:
            with suppress(FileNotFoundError):
                self.folder.rename(gone)
        except PermissionError:  # of Windows, while one of the files is read
            return self.folder
        return gone


@contextmanager
def folder_of_files(parent: Path | None = None) -> Iterator[Path]:
    """Give a folder that only its owner may enter, and delete it with all that is in it.

    It lies among the system's temporary files, or in `parent`; so do the folders of servers that no
    longer run, which are deleted now.
    """
    import psutil  # here because it is wanted once

    parent = parent or Path(tempfile.gettempdir())
    for folder in parent.glob(f"{_PREFIX}*"):
        named = _ROOT.fullmatch(folder.name)
        with suppress(OSError):
            if named and _is_own_folder(folder) and not psutil.pid_exists(int(named["pid"])):
                shutil.rmtree(folder, ignore_errors=True)
    prefix = f"{_PREFIX}{os.getpid()}-"
    with tempfile.TemporaryDirectory(prefix=prefix, dir=parent, ignore_cleanup_errors=True) as root:
        yield Path(root)


def _is_own_folder(path: Path) -> bool:
    """Whether it is a folder, not a link to one, of the user who runs this."""
    found = path.lstat()
    is_own = not hasattr(os, "getuid") or found.st_uid == os.getuid()
    return stat.S_ISDIR(found.st_mode) and is_own
