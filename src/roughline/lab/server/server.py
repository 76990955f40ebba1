"""What all requests to the server share: sessions, logins, lanes and the room on the disk."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from pathlib import Path

from roughline.lab.server.access import Visitors
from roughline.lab.server.budget import Disk, limits_within
from roughline.lab.server.lanes import Lane
from roughline.lab.server.logins import Key, Logins
from roughline.lab.server.session import Line, Session, Visit
from roughline.lab.server.settings import ServerSettings
from roughline.lab.server.tasks import Site

_WAITS = 600.0  # that a session waits for its page [s]
_RELOADS = 20.0  # that tasks go on when a page was left, as it may be loaded again [s]
_MOST_WAITING = 20  # sessions of one address that wait for their pages


class Server:
    """What all requests share; the files of all sessions are in the folder `root`."""

    def __init__(self, site: Site, settings: ServerSettings, root: Path) -> None:
        self.site, self.settings, self.root = site, settings, root
        self.sessions: dict[str, Session] = {}
        self.visitors, self.key = Visitors(), Key.of(settings.password)
        self.logins = Logins(self.end_login)
        quick, slow = limits_within(settings.memory, settings.max_memory, settings.max_seconds)
        self.quick, self.slow = Lane(quick, lasting=True), Lane(slow, lasting=False)
        self._disk, self._writers = Disk(root, settings.max_disk), quick.most + slow.most
        self._waiting: dict[str, list[asyncio.TimerHandle]] = {}  # of sessions without a page
        self._is_closing = False

    def has_place(self, address: str) -> bool:
        """Whether one more page may be open there; from afar, an address has half of all places."""
        most = self.settings.max_sessions
        own = sum(session.address == address for session in self.sessions.values())
        return len(self.sessions) < most and (
            not self.settings.lets_others_in or own < max(1, most // 2)
        )

    def session_for(self, line: Line, visit: Visit) -> tuple[Session | None, bool]:
        """The session of a page that opens, and whether it is the one that the page had before.

        There is none where all places are taken by open pages. Those that wait for their pages give
        way, of the same address first.
        """
        before = self.sessions.get(visit.token)
        if before is not None and before.login == visit.login:
            for timer in self._waiting.pop(before.token, ()):
                timer.cancel()
            before.go_on(line)
            return before, True
        while not self.has_place(visit.address):
            is_full = len(self.sessions) >= self.settings.max_sessions
            if not (self.end_waiting(visit.address) or (is_full and self.end_waiting())):
                return None, False
        session = Session(
            visit.address,
            visit.login,
            self.root,
            self.site,
            self.settings,
            self.quick,
            self.slow,
            self.room_of_task,
            line,
        )
        self.sessions[session.token] = session
        return session, False

    def line_closed(self, session: Session, *, is_left: bool) -> None:
        """Let a session wait for its page, if it has something to wait with.

        What runs goes on while a line is down. If the page was left, which may be to load it
        again, it is stopped soon.
        """
        session.line = None
        if not session.has_something:
            self.end_session(session)
            return
        later = asyncio.get_running_loop().call_later
        timers = self._waiting[session.token] = [later(_WAITS, self.end_session, session)]
        if is_left:
            timers.append(later(_RELOADS, self._stop_work, session))
        if len(list(self._waiting_sessions(session.address))) > _MOST_WAITING:
            self.end_waiting(session.address)
        self._renew()

    def end_waiting(self, address: str | None = None) -> bool:
        """End the session that has waited longest for its page, if one waits at an address."""
        for session in self._waiting_sessions(address):
            self.end_session(session)
            return True
        return False

    def end_session(self, session: Session) -> None:
        """End a session, and all that it has."""
        for timer in self._waiting.pop(session.token, ()):
            timer.cancel()
        self.sessions.pop(session.token, None)
        session.close()
        self._renew()

    def end_login(self, name: str) -> None:
        """End the sessions of a browser that has logged out."""
        for session in [each for each in self.sessions.values() if each.login == name]:
            if session.line is not None:
                session.line.log_out()
            self.end_session(session)

    def _waiting_sessions(self, address: str | None) -> Iterator[Session]:
        """Sessions that wait for their pages, at an address or anywhere, the longest first."""
        for session in [self.sessions[token] for token in self._waiting]:
            if address in (None, session.address):
                yield session

    def _stop_work(self, session: Session) -> None:
        """Stop what nobody came back for."""
        session.withdraw()
        if not session.has_something:
            self.end_session(session)

    def _renew(self) -> None:
        """Give memory back when no page is open."""
        is_open = any(session.line is not None for session in self.sessions.values())
        if not is_open and not self._is_closing:
            self.quick.renew()
            self.slow.renew()

    def has_room(self, size: float) -> bool:
        """Whether there is room on the disk for files of a size. [bytes]

        Sessions that wait for their pages give way, those first that have waited longest.
        """
        if self._room() < size:
            self._disk.look()
        return self._has_made_room(size)

    def room_of_task(self) -> float:
        """Size of the largest file that a task may write: all tasks may write at once. [bytes]"""
        self._has_made_room(self.settings.max_upload)
        return self._room() / self._writers

    def _has_made_room(self, size: float) -> bool:
        while self._room() < size:
            if size > self._disk.most or not self.end_waiting():
                return False
        return True

    def _room(self) -> float:
        coming = {
            upload.path: upload.size
            for session in self.sessions.values()
            for upload in session.uploads.values()
        }
        return self._disk.room(self.sessions, coming)

    async def prepare(self) -> None:
        """Start processes ahead of the first page."""
        await self.quick.prepare()
        await self.slow.prepare()

    async def close(self) -> None:
        """End everything."""
        self._is_closing = True
        for session in list(self.sessions.values()):
            self.end_session(session)
        await asyncio.gather(self.quick.close(), self.slow.close())
