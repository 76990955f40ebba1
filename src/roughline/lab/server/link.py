"""The websocket of a page: questions come in, answers go out; the session may outlive it."""

from __future__ import annotations

import asyncio
import json
from contextlib import suppress
from typing import Any

from tornado.iostream import StreamClosedError
from tornado.web import HTTPError
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from roughline._version import __version__
from roughline.lab.server.access import Allowance
from roughline.lab.server.guarded import Guarded
from roughline.lab.server.sessions import Session

MOST_BYTES = 2**16  # longest message of a page; files come another way
_SLOT_LENGTH, _TEXT_LENGTH, _MOST_DEPTH = 40, 2000, 6
_MOST_UNSENT = 10_000_000  # answers on their way to a page until its questions are held [bytes]
_MOST_HELD = 16
_LEFT = 1001  # with which a browser closes the websocket of a page that is left or loaded again


class Link(Guarded, WebSocketHandler):
    """The websocket of one page."""

    session: Session | None = None

    def prepare(self) -> None:
        """Refuse requests without an origin: every browser states it."""
        super().prepare()
        if self.request.headers.get("Origin") is None:
            raise HTTPError(403, reason="Only pages of this server may ask")
        self._before = self.get_query_argument("session", "")

    def open(self, *args: str, **kwargs: str) -> None:
        """Begin a session, or go on with the one that the page had before."""
        self.set_nodelay(True)
        self._refusals = Allowance(rate=1, most=300)
        self._sending: set[asyncio.Task[None]] = set()
        self._unsent = 0  # [bytes]
        # questions by their slots, as the session takes them; the latest of a slot counts
        self._held: dict[str, tuple[int, str, str, dict[str, Any]]] = {}
        found = self.server.session_for(self, self.address, self.login, self._before)
        self.session, resumed = found
        if self.session is None:
            self.close(1013, "no more pages may be open at once: close one, or come back later")
            return
        uploads = self.session.files.uploads.items()
        files = {key: {"name": it.name, "digest": it.digest} for key, it in uploads if it.digest}
        said = {"session": self.session.token, "resumed": resumed, "files": files}
        self.send(json.dumps({**said, "version": __version__}))

    def on_message(self, message: str | bytes) -> None:
        """Take a question, or the wish to stop one."""
        if self.session is not None and self.session.line is self:
            self._take(self.session, _plain_message(message))
            self._ask(self.session)

    def _take(self, session: Session, said: dict[str, Any]) -> None:
        number, slot, task = _number(said.get("id")), said.get("slot"), said.get("task")
        arguments, why = said.get("arguments"), ""
        if not (session.allowance.take() and self.server.questions(self.address).take()):
            why = "too many questions at once: wait a moment, then go on"
            if not self._refusals.take():
                return self.close(1008, "this page asked too much: reload it")
        elif not isinstance(slot, str) or not 0 < len(slot) <= _SLOT_LENGTH:
            why = "this message is not one of the lab: reload the page"
        elif said.get("stop") is True:
            self._held.pop(slot, None)
            session.withdraw(slot)
        elif said.get("forget") is True:
            session.forget_files()
        elif not isinstance(task, str) or task not in self.server.site.tasks:
            why = "the lab has no such task: reload the page"
        elif not isinstance(arguments, dict) or not _is_plain(arguments):
            why = "what is set here is too long, or not in a form the lab knows"
        elif slot not in self._held and len(self._held) >= _MOST_HELD:
            why = "too many requests of this page wait: let some end first"
        else:
            self._held[slot] = number, slot, task, arguments
        if why:
            self.send(json.dumps({"id": number, "error": why, "at": ""}))

    def _ask(self, session: Session) -> None:
        """Ask what is held, as far as the page has taken what it was sent."""
        while self._held and self._unsent <= _MOST_UNSENT:
            session.ask(*self._held.pop(next(iter(self._held))))

    def on_close(self) -> None:
        """Let the session wait for its page."""
        if self.session is not None and self.session.line is self:
            self.server.line_closed(self.session, is_left=self.close_code == _LEFT)

    def send(self, message: str | bytes) -> None:
        """Send a message."""
        sending = asyncio.ensure_future(self._deliver(message))
        self._sending.add(sending)
        sending.add_done_callback(self._sending.discard)

    async def _deliver(self, message: str | bytes) -> None:
        self._unsent += len(message)
        with suppress(WebSocketClosedError, StreamClosedError):
            await self.write_message(message, binary=isinstance(message, bytes))
        self._unsent -= len(message)
        if self.session is not None and self.session.line is self:
            self._ask(self.session)


def _is_plain(content: Any, depth: int = _MOST_DEPTH) -> bool:
    """Whether texts in what a page said are short, and lists and tables in it are not deep."""
    if isinstance(content, str):
        return len(content) <= _TEXT_LENGTH
    if isinstance(content, dict | list):
        parts = [*content, *content.values()] if isinstance(content, dict) else content
        return depth > 0 and all(_is_plain(part, depth - 1) for part in parts)
    return True


def _number(given: Any) -> int:
    """The number of a question; 0 if it has none."""
    return int(given) if isinstance(given, int) and 0 <= given < 2**53 else 0


def _plain_message(message: str | bytes) -> dict[str, Any]:
    """What a page said; empty if it makes no sense."""
    try:
        said = json.loads(message)
    except (ValueError, RecursionError):
        return {}
    return said if isinstance(said, dict) else {}
