"""One open page: what it has asked for, its files, and how they end with it."""

from __future__ import annotations

import re
import secrets
import shutil
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from roughline.lab.access import Allowance
from roughline.lab.lanes import Lane, Request
from roughline.lab.settings import LabSettings
from roughline.lab.tasks import TASKS, Outcome

_MOST_FILES = 20  # of one session at once
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
        What its owner calls it.
    """

    path: Path
    name: str


@dataclass
class Session:
    """One open page.

    Attributes
    ----------
    token : str
        Known to the page alone; who has it may speak for the page.
    root : Path
        Folder of all sessions; this one's lies in it from the first file on.
    settings : LabSettings
        Limits.
    quick, slow : Lane
        Processes for what takes some milliseconds, and for the rest.
    send : callable
        Sends a message to the page: plain content, or an answer with the number of its question.
    """

    root: Path
    settings: LabSettings
    quick: Lane
    slow: Lane
    send: Callable[[dict[str, Any]], None]
    send_answer: Callable[[int, bytes], None]
    token: str = field(default_factory=lambda: secrets.token_urlsafe(16))
    uploads: dict[str, Upload] = field(default_factory=dict)
    allowance: Allowance = field(default_factory=lambda: Allowance(rate=60, most=240))

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

        request = Request(
            self.token, slot, task, {**arguments, "session": self._context()}, answer, progress
        )
        (self.quick if TASKS[task].is_quick else self.slow).submit(request)

    def withdraw(self, slot: str | None = None) -> None:
        """Stop what was asked for a part of the page, or for all of it."""
        self.quick.withdraw(self.token, slot)
        self.slow.withdraw(self.token, slot)

    def new_upload(self, name: str) -> tuple[str, Upload]:
        """Return the key and the place of a file that is about to come.

        The oldest file goes if there are too many.
        """
        shown = _NAME.sub("_", name)[-100:] or "file"
        suffix = _SUFFIX.fullmatch(Path(shown).suffix)
        key = secrets.token_urlsafe(12)
        self.folder.mkdir(mode=0o700, exist_ok=True)
        while len(self.uploads) >= _MOST_FILES:
            self.forget_upload(next(iter(self.uploads)))
        path = self.folder / (secrets.token_hex(8) + (suffix[0].lower() if suffix else ""))
        upload = Upload(path, shown)
        self.uploads[key] = upload
        return key, upload

    def forget_upload(self, key: str) -> None:
        """Delete a file."""
        upload = self.uploads.pop(key, None)
        if upload is not None:
            upload.path.unlink(missing_ok=True)

    def close(self) -> None:
        """Stop what runs, and delete all files."""
        self.withdraw()
        self.uploads.clear()
        shutil.rmtree(self.folder, ignore_errors=True)

    def _context(self) -> dict[str, Any]:
        """What tasks are told of the session: its files and limits."""
        return {
            "folder": str(self.folder),
            "files": {key: str(each.path) for key, each in self.uploads.items()},
            "names": {str(each.path): each.name for each in self.uploads.values()},
            "max_points": self.settings.max_points,
            "max_memory": self.settings.max_memory,
        }
