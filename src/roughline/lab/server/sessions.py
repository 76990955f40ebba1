"""Sessions: what a page has on the server, which outlives a line that drops; and all of them."""

from __future__ import annotations

import asyncio
import secrets
import shutil
import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Protocol

from tornado.ioloop import PeriodicCallback

from roughline.computing.cores import available_cores
from roughline.computing.memory import free_memory
from roughline.lab.server.files import Files
from roughline.lab.server.lanes import Lane, Request
from roughline.lab.server.settings import ServerSettings
from roughline.lab.server.tasks import Site, TaskOutcome

_PAGE_WITHIN = 600.0  # that a session waits for its page [s]
_RELOAD_WITHIN = 20.0  # that tasks go on when a page was left, as it may be loaded again [s]
_SWEEP_INTERVAL = 1.0  # after which it is looked again for what is over [s]
_PROGRESS_INTERVAL = 0.1  # between messages on progress [s]
_ELSEWHERE = 4001  # with which the websocket of the older page is closed
_USABLE = 0.9  # of the memory that is free when the server starts
_SERVER_BYTES = 500_000_000  # of the server itself and what all processes share [bytes]
_FEWEST_PRESSES, _MOST_PRESSES = 2, 8  # at once, each in a process
_MOST_MEMORY, _QUICK_MEMORY = 4_000_000_000, 1_000_000_000  # of a task, beside the program [bytes]


class PageLine(Protocol):
    """The connection to a page, as its session sees it."""

    def send(self, message: Mapping[str, Any] | bytes) -> None:
        """Send a message."""

    def close(self, code: int | None = None, reason: str | None = None) -> None:
        """Close it, and say why."""


@dataclass(eq=False)
class _PageRequest:
    """What a page has asked for one of its parts, until it is told the outcome."""

    number: int  # by which the page knows the answer
    task: str  # what is to be done
    arguments: Mapping[str, Any]  # of the task
    # On which it was asked; another line knows another question by this number.
    line: PageLine | None
    outcome: TaskOutcome | None = None  # how it ended while no page could be told


class Session:
    """What a page has; it goes on over a new line if the old one drops or the page is reloaded."""

    def __init__(self, server: Server, line: PageLine) -> None:
        self.server = server
        # known to the page alone; a request with it counts as a request of the page
        self.token = secrets.token_urlsafe(16)
        self.line: PageLine | None = line  # to its page; None while it waits for one
        self.since, self.is_left = 0.0, False  # when its line closed, and whether the page did so
        self.files = Files(server.root / self.token)
        self.asked: dict[str, _PageRequest] = {}

    @property
    def has_something(self) -> bool:
        """Whether a page that comes back would find something here."""
        return bool(self.asked or self.files.uploads) or self.files.folder.exists()

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
        asked = self.asked[slot] = _PageRequest(number, task, arguments, self.line)
        started = latest = time.monotonic()

        def progress(done: int, total: int) -> None:
            nonlocal latest
            now = time.monotonic()
            is_time = now - latest >= _PROGRESS_INTERVAL or done in (0, total)
            if self.line is not None and self.line is asked.line and is_time:
                latest = now
                left = (now - started) * (total - done) / done if done else None
                self.line.send({"id": asked.number, "done": done, "total": total, "left": left})

        place, uploads = self.server.site.tasks[task], self.files.uploads
        context = {
            "folder": str(self.files.folder),
            "files": {key: str(each.path) for key, each in uploads.items()},
            "names": {str(each.path): each.name for each in uploads.values()},
        }
        in_session, answer = {**arguments, "session": context}, partial(self._tell, slot, asked)
        lane = self.server.quick if place.is_quick else self.server.slow
        lane.submit(Request(self.token, slot, place, in_session, answer, progress))

    def withdraw(self, slot: str | None = None) -> list[asyncio.Task[None]]:
        """Stop what was asked for a part of the page, or for all; returns the work that ends."""
        for each in list(self.asked) if slot is None else [slot]:
            self.asked.pop(each, None)
        lanes = self.server.quick, self.server.slow
        return [work for lane in lanes for work in lane.withdraw(self.token, slot)]

    def forget_files(self) -> None:
        """Delete all files and what was made of them, and stop what reads them."""
        tasks = self.server.site.tasks
        readers = [slot for slot, each in self.asked.items() if tasks[each.task].reads_files]
        self._delete_files([work for slot in readers for work in self.withdraw(slot)])

    def end(self) -> None:
        """End it, stop what runs, and delete all files."""
        self.server.sessions.pop(self.token, None)
        self.line = None
        self._delete_files(self.withdraw())

    def _delete_files(self, writers: list[asyncio.Task[None]]) -> None:
        """Delete the folder of the files as soon as nobody writes to it."""
        delete = partial(shutil.rmtree, self.files.take_away(), ignore_errors=True)
        loop = asyncio.get_running_loop()
        asyncio.gather(*writers, return_exceptions=True).add_done_callback(
            lambda _: loop.run_in_executor(None, delete)
        )

    def _tell(self, slot: str, asked: _PageRequest, outcome: TaskOutcome) -> None:
        """Tell the page how a task ended, or hold it until the page comes back and asks again."""
        is_latest = self.asked.get(slot) is asked
        if asked.line is not None and asked.line is self.line:
            if is_latest:
                del self.asked[slot]
            if outcome.answer is not None:
                asked.line.send(asked.number.to_bytes(8, "little") + outcome.answer)
            else:
                asked.line.send({"id": asked.number, "error": outcome.error, "at": outcome.at})
        elif is_latest:
            asked.outcome = outcome


class Server:
    """What all requests share; the files of all sessions are in the folder `root`.

    Presses that run at once never take more memory together than is free at the start.
    """

    def __init__(self, site: Site, settings: ServerSettings, root: Path) -> None:
        self.site, self.settings, self.root = site, settings, root
        self.sessions: dict[str, Session] = {}
        self.token = secrets.token_hex(16)  # new at each start, and what a browser must know
        free = max(_USABLE * free_memory() - _SERVER_BYTES, 0.0)
        memory = min(_MOST_MEMORY, free / _FEWEST_PRESSES)
        presses = min(_MOST_PRESSES, max(_FEWEST_PRESSES, int(free // max(memory, 1))))
        self.quick = Lane(available_cores(), min(_QUICK_MEMORY, memory), lasting=True)
        self.slow = Lane(presses, memory, lasting=False)
        self._sweeping = PeriodicCallback(self.sweep, 1000 * _SWEEP_INTERVAL)
        self._sweeping.start()

    def session_for(self, line: PageLine, token: str) -> Session:
        """The session of a page that opens: the one with its token, or a new one."""
        before = self.sessions.get(token)
        if before is not None:
            older, before.line = before.line, line
            if older is not None:  # it still seems open
                older.close(_ELSEWHERE, "another page goes on with this one's file")
            return before
        session = Session(self, line)
        self.sessions[session.token] = session
        return session

    def line_closed(self, session: Session, *, is_left: bool) -> None:
        """Let a session wait for its page, if it has something to wait with.

        What runs goes on while a line is down. If the page was left, which may be to load it
        again, it is stopped soon.
        """
        session.line, session.since, session.is_left = None, time.monotonic(), is_left
        if not session.has_something:
            session.end()

    def sweep(self) -> None:
        """End sessions that nobody came back for, and first their work.

        Memory is given back when no page is open.
        """
        now = time.monotonic()
        for session in [each for each in self.sessions.values() if each.line is None]:
            if session.is_left and now - session.since > _RELOAD_WITHIN:
                session.withdraw()
            if now - session.since > _PAGE_WITHIN or not session.has_something:
                session.end()
        if all(session.line is None for session in self.sessions.values()):
            self.quick.renew()
            self.slow.renew()

    async def close(self) -> None:
        """End everything."""
        self._sweeping.stop()
        await asyncio.gather(self.quick.close(), self.slow.close())
        for session in list(self.sessions.values()):
            session.end()
