"""The websocket of a page: questions come in, answers go out; the session may outlive it."""

from __future__ import annotations

import asyncio
import json
from typing import Any

from tornado.iostream import StreamClosedError
from tornado.web import HTTPError
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from roughline._version import __version__
from roughline.lab.server.access import Allowance, origin_is_ours
from roughline.lab.server.guarded import Guarded
from roughline.lab.server.session import Session, Visit

MOST_BYTES = 2**16  # longest message of a page; files come another way
_SLOT_LENGTH, _TEXT_LENGTH, _MOST_DEPTH = 40, 2000, 6
_MOST_UNSENT = 10_000_000  # answers on their way to a page until its questions are held [bytes]
_MOST_HELD = 16
_LEFT = 1001  # with which a browser closes the websocket of a page that is left or loaded again
_ELSEWHERE = 4001  # with which a websocket is closed whose session another page has taken over


class Link(Guarded, WebSocketHandler):
    """The websocket of one page."""

    session: Session | None = None

    def prepare(self) -> None:
        """Refuse requests without an origin: every browser states it."""
        super().prepare()
        if self.request.headers.get("Origin") is None:
            raise HTTPError(403, reason="Only pages of this server may ask")
        self._before = self.get_query_argument("session", "")

    def check_origin(self, origin: str) -> bool:
        """Refuse pages of other servers."""
        return origin_is_ours(origin, self.request.host)

    def open(self, *args: str, **kwargs: str) -> None:
        """Begin a session, or go on with the one that the page had before."""
        self.set_nodelay(True)
        self._unsent, self._refusals = 0, Allowance(rate=1, most=300)
        self._held: dict[str, dict[str, Any]] = {}
        self._sending: set[asyncio.Task[None]] = set()
        visit = Visit(self.address, self.login_name, self._before)
        self.session, resumed = self.server.session_for(self, visit)
        if self.session is None:
            self.close(1013, "no more pages may be open at once: close one, or come back later")
            return
        said = {"session": self.session.token, "resumed": resumed, "files": self.session.files()}
        self.send({**said, "version": __version__})

    def on_message(self, message: str | bytes) -> None:
        """Take a question, or the wish to stop one."""
        if self.session is None:
            return
        said = _plain_message(message)
        number, slot, task = _number(said.get("id")), said.get("slot"), said.get("task")
        if not (self.session.allowance.take() and self.server.visitors.may_ask(self.address)):
            if self._refusals.take():
                self._refuse(number, "too many questions at once: wait a moment, then go on")
            else:
                self.close(1008, "this page asked too much: reload it")
        elif not isinstance(slot, str) or not 0 < len(slot) <= _SLOT_LENGTH:
            self._refuse(number, "this message is not one of the lab: reload the page")
        elif said.get("stop") is True:
            self._held.pop(slot, None)
            self.session.withdraw(slot)
        elif said.get("forget") is True:
            self.session.forget_files()
        elif not isinstance(task, str) or task not in self.server.site.tasks:
            self._refuse(number, "the lab has no such task: reload the page")
        elif not isinstance(said.get("arguments"), dict) or not _is_plain(said["arguments"]):
            self._refuse(number, "what is set here is too long, or not in a form the lab knows")
        else:
            self._ask(slot, said)

    def give_way(self) -> None:
        """Close, because another page goes on with the session."""
        self.session = None
        self.close(_ELSEWHERE, "another page goes on with this one's file")

    def log_out(self) -> None:
        """Close, because the login of the browser has ended, and the session with it."""
        self.session = None
        self.close(1008, "this browser is no longer logged in: reload the page to log in")

    def on_close(self) -> None:
        """Let the session wait for its page."""
        if self.session is not None and self.session.line is self:
            self.server.line_closed(self.session, is_left=self.close_code == _LEFT)
        self.session = None

    def _ask(self, slot: str, said: dict[str, Any]) -> None:
        """Ask, or hold a question until a page has taken what it was sent; the latest counts."""
        if self.session is None:
            return
        number = _number(said.get("id"))
        if self._unsent <= _MOST_UNSENT:
            self.session.ask(number, slot, said["task"], said["arguments"])
        elif slot in self._held or len(self._held) < _MOST_HELD:
            self._held[slot] = said
        else:
            self._refuse(number, "too many requests of this page wait: let some end first")

    def _refuse(self, number: int, why: str) -> None:
        self.send({"id": number, "error": why, "at": ""})

    def send(self, content: dict[str, Any]) -> None:
        """Send plain content."""
        self._write(json.dumps(content))

    def send_answer(self, number: int, answer: bytes) -> None:
        """Send an answer with the number of its question."""
        self._write(number.to_bytes(8, "little") + answer)

    def _write(self, message: str | bytes) -> None:
        task = asyncio.ensure_future(self._deliver(message))
        self._sending.add(task)
        task.add_done_callback(self._sending.discard)

    async def _deliver(self, message: str | bytes) -> None:
        """Send a message; when the page has taken it, ask what was held."""
        self._unsent += len(message)
        try:
            await self.write_message(message, binary=isinstance(message, bytes))
        except (WebSocketClosedError, StreamClosedError):
            self.on_close()
        self._unsent -= len(message)
        while self._held and self._unsent <= _MOST_UNSENT:
            slot = next(iter(self._held))
            self._ask(slot, self._held.pop(slot))


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
