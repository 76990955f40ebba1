"""One open page: its requests and its files, which end with it."""

from __future__ import annotations

import asyncio
import re
import secrets
import shutil
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from roughline.server.access import Allowance
from roughline.server.lanes import Lane
from roughline.server.process import Process
from roughline.server.requests import Request
from roughline.server.settings import ServerSettings
from roughline.server.site import Site
from roughline.server.tasks import Outcome

_MOST_FILES = 20  # of one session at once
_MOST_UPLOADS = 3  # largest files that a session's files may make together
_NAME = re.compile(r"[^\w.()+ -]")
_SUFFIX = re.compile(r"\.[A-Za-z0-9]{1,8}")
_MOST_PROGRESS = 10.0  # messages on progress [1 / s]


@dataclass(frozen=True)
class Upload:
    """A file that a page has brought.

    Attributes
    ----------
    path : Path
        Where it lies, under a random name.
    name : str
        Name that its owner gave it.
    size : int
        Size, as the page stated it in advance. [bytes]
    """

    path: Path
    name: str
    size: int


@dataclass
class Session:
    """One open page.

    Attributes
    ----------
    address : str
        Where the page is.
    token : str
        Known to the page alone; a request with it counts as a request of the page.
    root : Path
        Folder of all sessions; this one's lies in it from the first file on.
    site : Site
        What may be asked for.
    settings : ServerSettings
        Limits.
    quick, slow : Lane
        Processes for what takes some milliseconds, and for the rest.
    send : callable
        Sends a message to the page: plain content, or an answer with the number of its question.
    """

    address: str
    root: Path
    site: Site
    settings: ServerSettings
    quick: Lane
    slow: Lane
    send: Callable[[dict[str, Any]], None]
    send_answer: Callable[[int, bytes], None]
    token: str = field(default_factory=lambda: secrets.token_urlsafe(16))
    uploads: dict[str, Upload] = field(default_factory=dict)
    allowance: Allowance = field(default_factory=lambda: Allowance(rate=200, most=800))
    is_open: bool = True

    @property
    def folder(self) -> Path:
        """Folder of its files."""
        return self.root / self.token

    def ask(self, number: int, slot: str, task: str, arguments: Mapping[str, Any]) -> None:
        """Have a task done for a part of the page, and send what came of it."""
        started = last_told = time.monotonic()

        def answer(outcome: Outcome) -> None:
            if outcome.answer is not None:
                self.send_answer(number, outcome.answer)
            else:
                self.send({"id": number, "error": outcome.error, "at": outcome.at})

        def progress(done: int, total: int) -> None:
            nonlocal last_told
            now = time.monotonic()
            if now - last_told < 1 / _MOST_PROGRESS and done < total:
                return
            last_told = now
            left = (now - started) * (total - done) / done if done else None
            self.send({"id": number, "done": done, "total": total, "left": left})

        told = {**arguments, "session": self._context()}
        place = self.site.tasks[task]
        request = Request(self.address, self.token, slot, place, told, answer, progress)
        (self.quick if place.is_quick else self.slow).submit(request)

    def withdraw(self, slot: str | None = None) -> list[Process]:
        """Stop what was asked for a part of the page, or for all of it; returns what is stopped."""
        return self.quick.withdraw(self.token, slot) + self.slow.withdraw(self.token, slot)

    def new_upload(self, name: str, size: int) -> tuple[str, Upload]:
        """Return the key and the place of a file that is about to come.

        The oldest files go if there are too many, or too large ones.
        """
        shown = _NAME.sub("_", name)[-100:] or "file"
        suffix = _SUFFIX.fullmatch(Path(shown).suffix)
        key = secrets.token_urlsafe(12)
        self.folder.mkdir(mode=0o700, exist_ok=True)
        most = _MOST_UPLOADS * self.settings.max_upload - size
        while self.uploads and (
            len(self.uploads) >= _MOST_FILES
            or sum(each.size for each in self.uploads.values()) > most
        ):
            self.forget_upload(next(iter(self.uploads)))
        path = self.folder / (secrets.token_hex(8) + (suffix[0].lower() if suffix else ""))
        upload = Upload(path, shown, size)
        self.uploads[key] = upload
        return key, upload

    def forget_upload(self, key: str) -> None:
        """Delete a file."""
        upload = self.uploads.pop(key, None)
        if upload is not None:
            with suppress(PermissionError):  # of Windows, while it is read; its folder goes later
                upload.path.unlink(missing_ok=True)

    def close(self) -> None:
        """Stop what runs, and delete all files when it has stopped."""
        self.is_open = False
        stopped = self.withdraw()
        self.uploads.clear()
        asyncio.get_running_loop().run_in_executor(None, _delete, self.folder, stopped)

    def _context(self) -> dict[str, Any]:
        """What tasks are told of the session: its files and limits."""
        return {
            "folder": str(self.folder),
            "files": {key: str(each.path) for key, each in self.uploads.items()},
            "names": {str(each.path): each.name for each in self.uploads.values()},
            "max_points": self.settings.max_points,
            "max_memory": self.settings.max_memory,
        }


def _delete(folder: Path, writers: list[Process]) -> None:
    """Delete a folder as soon as nobody writes to it."""
    for process in writers:
        process.end()
    shutil.rmtree(folder, ignore_errors=True)
