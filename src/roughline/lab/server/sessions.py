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

from roughline.lab.server.access import Allowance, Key, Logins, allowances
from roughline.lab.server.budget import limits_within
from roughline.lab.server.files import Disk, Files
from roughline.lab.server.lanes import Lane, Request
from roughline.lab.server.settings import ServerSettings
from roughline.lab.server.tasks import Site, TaskOutcome

_PAGE_WITHIN = 600.0  # that a session waits for its page [s]
_RELOAD_WITHIN = 20.0  # that tasks go on when a page was left, as it may be loaded again [s]
_MOST_WAITING = 20  # sessions of one address that wait for their pages
_SWEEP_INTERVAL = 1.0  # after which it is looked again for what is over [s]
_MOST_PROGRESS = 10.0  # messages on progress [1 / s]
_MOST_HELD = 16  # outcomes that wait for a page to come back
_MOST_HELD_BYTES = 10_000_000  # of their answers
_ELSEWHERE, _REFUSED = 4001, 1008  # with which websockets are closed


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

    def __init__(self, server: Server, line: PageLine, address: str, login: str) -> None:
        self.server, self.address = server, address
        self.login = login  # of the browser; only the same login may go on with the session
        # known to the page alone; a request with it counts as a request of the page
        self.token = secrets.token_urlsafe(16)
        self.line: PageLine | None = line  # to its page; None while it waits for one
        self.since, self.is_left = 0.0, False  # when its line closed, and whether the page did so
        self.files = Files(server.root / self.token, server.settings.max_upload)
        self.allowance = Allowance(rate=200, most=800)
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
        started, pace = time.monotonic(), Allowance(_MOST_PROGRESS, 1)

        def progress(done: int, total: int) -> None:
            if self.line is not None and self.line is asked.line and (pace.take() or done >= total):
                left = (time.monotonic() - started) * (total - done) / done if done else None
                self.line.send({"id": asked.number, "done": done, "total": total, "left": left})

        place, uploads = self.server.site.tasks[task], self.files.uploads
        context = {
            "folder": str(self.files.folder),
            "files": {key: str(each.path) for key, each in uploads.items()},
            "names": {str(each.path): each.name for each in uploads.values()},
            "max_points": self.server.settings.max_points,
            "room": self.server.room_of_task(),
        }
        in_session, answer = {**arguments, "session": context}, partial(self._tell, slot, asked)
        lane = self.server.quick if place.is_quick else self.server.slow
        lane.submit(Request(self.address, self.token, slot, place, in_session, answer, progress))

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
            held = [each.outcome for each in self.asked.values() if each.outcome is not None]
            size = sum(len(each.answer or b"") for each in (*held, outcome))
            if len(held) < _MOST_HELD and size <= _MOST_HELD_BYTES:
                asked.outcome = outcome
            else:
                del self.asked[slot]  # it is done anew when it is asked again


class Server:
    """What all requests share; the files of all sessions are in the folder `root`."""

    def __init__(self, site: Site, settings: ServerSettings, root: Path) -> None:
        self.site, self.settings, self.root = site, settings, root
        self.sessions: dict[str, Session] = {}
        self.key, self.logins = Key(settings.password), Logins()
        # how often each address may ask, and try passwords, whatever number of pages it has open
        self.questions, self.tries = allowances(2000, 8000), allowances(1 / 12, 5)
        quick, slow = limits_within(settings.memory, settings.max_memory, settings.max_seconds)
        self.quick, self.slow = Lane(quick, lasting=True), Lane(slow, lasting=False)
        self._disk, self.processes = Disk(root, settings.max_disk), quick.most + slow.most
        self._sweeping = PeriodicCallback(self.sweep, 1000 * _SWEEP_INTERVAL)
        self._sweeping.start()

    def session_for(self, line: PageLine, address: str, login: str, token: str) -> Session | None:
        """The session of a page that opens: the one with its token, or a new one.

        There is none where all places are taken by open pages: from afar, an address has half of
        all places. Those that wait for their pages give way, of the same address first.
        """
        before = self.sessions.get(token)
        if before is not None and before.login == login:
            older, before.line = before.line, line
            if older is not None:  # it still seems open
                older.close(_ELSEWHERE, "another page goes on with this one's file")
            return before
        most = self.settings.max_sessions
        most_per_address = max(1, most // 2) if self.settings.lets_others_in else most
        while True:
            is_full = len(self.sessions) >= most
            own = sum(session.address == address for session in self.sessions.values())
            if not is_full and own < most_per_address:
                break
            if not (self.end_waiting(address) or (is_full and self.end_waiting())):
                return None
        session = Session(self, line, address, login)
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
        elif len(self._waiting(session.address)) > _MOST_WAITING:
            self.end_waiting(session.address)

    def _waiting(self, address: str | None) -> list[Session]:
        """Sessions that wait for their pages, at an address or anywhere."""
        waiting = [each for each in self.sessions.values() if each.line is None]
        return [each for each in waiting if address in (None, each.address)]

    def end_waiting(self, address: str | None = None) -> bool:
        """End the session that has waited longest for its page, if one waits at an address."""
        waiting = self._waiting(address)
        if waiting:
            min(waiting, key=lambda each: each.since).end()
        return bool(waiting)

    def sweep(self) -> None:
        """End sessions whose login has ended or that nobody came back for, and first their work.

        Memory is given back when no page is open.
        """
        now = time.monotonic()
        for session in list(self.sessions.values()):
            waits = session.line is None
            if waits and session.is_left and now - session.since > _RELOAD_WITHIN:
                session.withdraw()
            is_over = waits and (now - session.since > _PAGE_WITHIN or not session.has_something)
            if is_over or not self.logins.lasts(session.login):
                if session.line is not None:
                    reason = "this browser is no longer logged in: reload the page to log in"
                    session.line.close(_REFUSED, reason)
                session.end()
        if all(session.line is None for session in self.sessions.values()):
            self.quick.renew()
            self.slow.renew()

    def has_room(self, size: float) -> bool:
        """Whether there is room on the disk now for files of a size. [bytes]"""
        self._disk.look()
        return self._made_room(size) >= size

    def room_of_task(self) -> float:
        """Size of the largest file that a task may write: all tasks may write at once. [bytes]"""
        return self._made_room(self.settings.max_upload) / self.processes

    def _made_room(self, wanted: float) -> float:
        """The room on the disk; if it is less than wanted, those go that have waited longest."""
        while True:
            room = self._disk.room(each.files.folder for each in self.sessions.values())
            if room >= wanted or wanted > self._disk.most or not self.end_waiting():
                return room

    async def close(self) -> None:
        """End everything."""
        self._sweeping.stop()
        await asyncio.gather(self.quick.close(), self.slow.close())
        for session in list(self.sessions.values()):
            session.end()
