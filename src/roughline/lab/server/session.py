"""What a page has on the server: its requests and its files, which outlive a line that drops."""

from __future__ import annotations

import asyncio
import re
import secrets
import shutil
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any, Protocol

from roughline.lab.server.access import Allowance
from roughline.lab.server.lanes import Lane, Request
from roughline.lab.server.process import Process
from roughline.lab.server.settings import ServerSettings
from roughline.lab.server.tasks import Outcome, Site

_MOST_FILES = 20  # of one session at once
_MOST_UPLOADS = 3  # largest files that a session's files may make together
_NAME = re.compile(r"[^\w.()+ -]")
_SUFFIX = re.compile(r"\.[A-Za-z0-9]{1,8}")
_MOST_PROGRESS = 10.0  # messages on progress [1 / s]
_MOST_HELD = 16  # outcomes that wait for a page to come back
_MOST_HELD_BYTES = 10_000_000  # of their answers


class Line(Protocol):
    """The connection to a page, as its session sees it."""

    def send(self, content: dict[str, Any]) -> None:
        """Send plain content."""

    def send_answer(self, number: int, answer: bytes) -> None:
        """Send an answer with the number of its question."""

    def give_way(self) -> None:
        """Close, because the session goes on over another line."""

    def log_out(self) -> None:
        """Close, because the login has ended, and the session with it."""


@dataclass(frozen=True)
class Visit:
    """Who opens a page."""

    address: str  # where the page is
    login: str  # of the browser; empty where nobody logs in
    token: str  # of the session that the page had before; empty if it had none


@dataclass(frozen=True)
class Upload:
    """A file that a page has brought."""

    path: Path  # where it lies, under a random name
    name: str  # name that its owner gave it
    size: int  # as the page stated it in advance [bytes]
    digest: str = ""  # of its content; empty until it is whole


@dataclass(eq=False)
class _Asked:
    """What a page has asked for one of its parts, until it is told the outcome."""

    number: int  # by which the page knows the answer
    task: str  # what is to be done
    arguments: Mapping[str, Any]  # of the task
    line: Line | None  # on which it was asked; another line knows another question by this number
    outcome: Outcome | None = None  # how it ended while no page could be told


@dataclass
class Session:
    """What a page has; it goes on over a new line if the old one drops or the page is reloaded."""

    address: str  # where the page is
    login: str  # of the browser; only the same login may go on with the session
    root: Path  # folder of all sessions; this one's lies in it from the first file on
    site: Site
    settings: ServerSettings
    quick: Lane  # processes for what takes some milliseconds
    slow: Lane  # and for the rest
    room: Callable[[], float]  # tells how large a file a task may write [bytes]
    line: Line | None  # the connection to its page; None while it waits for one
    # known to the page alone; a request with it counts as a request of the page
    token: str = field(default_factory=lambda: secrets.token_urlsafe(16))
    uploads: dict[str, Upload] = field(default_factory=dict)
    allowance: Allowance = field(default_factory=lambda: Allowance(rate=200, most=800))
    asked: dict[str, _Asked] = field(default_factory=dict)

    @property
    def folder(self) -> Path:
        """Folder of its files."""
        return self.root / self.token

    @property
    def has_something(self) -> bool:
        """Whether a page that comes back would find something here."""
        return bool(self.asked or self.uploads) or self.folder.exists()

    def files(self) -> dict[str, dict[str, str]]:
        """Names and digests of the files that are whole, by their keys."""
        whole = {key: each for key, each in self.uploads.items() if each.digest}
        return {key: {"name": each.name, "digest": each.digest} for key, each in whole.items()}

    def go_on(self, line: Line) -> None:
        """Go on over another line; an older one that still seems open is closed."""
        if self.line is not None:
            self.line.give_way()
        self.line = line

    def ask(self, number: int, slot: str, task: str, arguments: Mapping[str, Any]) -> None:
        """Have a task done for a part of the page, and send what came of it.

        What was asked in the same words over a line that is gone goes on, or is answered at once.
        """
        before = self.asked.get(slot)
        is_same = before is not None and (before.task, before.arguments) == (task, arguments)
        if before is not None and is_same and before.line is not self.line:
            before.number, before.line = number, self.line
            if before.outcome is not None:
                self._tell(slot, before, before.outcome)
            return
        asked = self.asked[slot] = _Asked(number, task, arguments, self.line)
        started = last_told = time.monotonic()

        def progress(done: int, total: int) -> None:
            nonlocal last_told
            now = time.monotonic()
            if now - last_told < 1 / _MOST_PROGRESS and done < total:
                return
            last_told = now
            left = (now - started) * (total - done) / done if done else None
            if self.line is not None and self.line is asked.line:
                told = {"done": done, "total": total, "left": left}
                self.line.send({"id": asked.number, **told})

        told = {**arguments, "session": self._context()}
        place = self.site.tasks[task]
        answer = partial(self._tell, slot, asked)
        request = Request(self.address, self.token, slot, place, told, answer, progress)
        (self.quick if place.is_quick else self.slow).submit(request)

    def withdraw(self, slot: str | None = None) -> list[Process]:
        """Stop what was asked for a part of the page, or for all of it; returns what is stopped."""
        for each in list(self.asked) if slot is None else [slot]:
            self.asked.pop(each, None)
        return self.quick.withdraw(self.token, slot) + self.slow.withdraw(self.token, slot)

    def forget_files(self) -> None:
        """Delete all files and what was made of them, and stop what reads them."""
        readers = [slot for slot, each in self.asked.items() if self._reads_files(each)]
        stopped = [process for slot in readers for process in self.withdraw(slot)]
        self.uploads.clear()
        gone = self.folder.with_name(f"{self.token}-{secrets.token_hex(4)}")
        try:
            self.folder.rename(gone)
        except FileNotFoundError:
            return
        except PermissionError:  # of Windows, while one of the files is read
            gone = self.folder
        asyncio.get_running_loop().run_in_executor(None, _delete, gone, stopped)

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
        self.line = None
        stopped = self.withdraw()
        self.uploads.clear()
        asyncio.get_running_loop().run_in_executor(None, _delete, self.folder, stopped)

    def _tell(self, slot: str, asked: _Asked, outcome: Outcome) -> None:
        """Tell the page how a task ended, or hold it until the page comes back and asks again."""
        if asked.line is not None and asked.line is self.line:
            if self.asked.get(slot) is asked:
                del self.asked[slot]
            if outcome.answer is not None:
                asked.line.send_answer(asked.number, outcome.answer)
            else:
                asked.line.send({"id": asked.number, "error": outcome.error, "at": outcome.at})
        elif self.asked.get(slot) is asked:
            held = [each.outcome for each in self.asked.values() if each.outcome is not None]
            size = sum(len(each.answer or b"") for each in (*held, outcome))
            if len(held) < _MOST_HELD and size <= _MOST_HELD_BYTES:
                asked.outcome = outcome
            else:
                del self.asked[slot]  # it is done anew when it is asked again

    def _reads_files(self, asked: _Asked) -> bool:
        return self.site.tasks[asked.task].reads_files

    def _context(self) -> dict[str, Any]:
        """What tasks are told of the session: its files and limits."""
        return {
            "folder": str(self.folder),
            "files": {key: str(each.path) for key, each in self.uploads.items()},
            "names": {str(each.path): each.name for each in self.uploads.values()},
            "max_points": self.settings.max_points,
            "room": self.room(),
        }


def _delete(folder: Path, writers: list[Process]) -> None:
    """Delete a folder as soon as nobody writes to it."""
    for process in writers:
        process.end()
    shutil.rmtree(folder, ignore_errors=True)
