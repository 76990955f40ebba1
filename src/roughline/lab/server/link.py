"""The websocket of a page: questions come in, answers go out; the session may outlive it."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Mapping
from contextlib import suppress
from typing import Any

from tornado.web import HTTPError
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from roughline._version import __version__
from roughline.lab.server.guarded import Guarded
from roughline.lab.server.sessions import Session
from roughline.lab.server.tasks import PACKING

MOST_BYTES = 2**16  # longest message of a page; files come another way
_LONGEST_SLOT = 40
_STRANGE = "this message is not one of the lab: reload the page"
_MOST_UNSENT = 1_000_000  # answers on their way to a page until its questions are held [bytes]
_LEFT = 1001  # with which a browser closes the websocket of a page that is left or loaded again


class Link(Guarded, WebSocketHandler):
    """The websocket of one page."""

    _begun: Session | None = None

    @property
    def session(self) -> Session | None:
        """What the page has, unless it is over or another page goes on with it."""
        return self._begun if self._begun is not None and self._begun.line is self else None

    def prepare(self) -> None:
        """Refuse requests without an origin: every browser states it."""
        super().prepare()
        if self.request.headers.get("Origin") is None:
            raise HTTPError(403, reason="Only pages of this server may ask")
        self._before = self.get_query_argument("session", "")

    def get_compression_options(self) -> dict[str, Any]:
        """Pack what is sent: pictures on a slow line wait for their bytes."""
        return {"compression_level": PACKING}

    def open(self, *args: str, **kwargs: str) -> None:
        """Begin a session, or go on with the one that the page had before."""
        self.set_nodelay(True)
        self._unsent = 0  # [bytes]
        # questions by their slots, as the session takes them; the latest of a slot counts
        self._held: dict[str, tuple[int, str, str, dict[str, Any]]] = {}
        self._begun = session = self.server.session_for(self, self._before)
        uploads = session.files.uploads.items()
        files = {key: {"name": it.name, "digest": it.digest} for key, it in uploads if it.digest}
        opened = {"session": session.token, "resumed": session.token == self._before}
        self.send({**opened, "files": files, "version": __version__})

    def on_message(self, message: str | bytes) -> None:
        """Take a question, or the wish to stop one."""
        if session := self.session:
            content = None
            with suppress(ValueError, RecursionError):
                content = json.loads(message)
            self._take(session, content if isinstance(content, dict) else {})
            self._ask()

    def _take(self, session: Session, content: dict[str, Any]) -> None:
        number, slot, task, arguments = map(content.get, ("id", "slot", "task", "arguments"))
        number = number if isinstance(number, int) and 0 <= number < 2**53 else 0
        if not isinstance(slot, str) or not 0 < len(slot) <= _LONGEST_SLOT:
            slot = task = ""
        if slot and content.get("stop") is True:
            self._held.pop(slot, None)
            session.withdraw(slot)
        elif slot and content.get("forget") is True:
            session.forget_files()
        elif (
            isinstance(task, str) and task in self.server.site.tasks and isinstance(arguments, dict)
        ):
            self._held[slot] = number, slot, task, arguments
        else:
            self.send({"id": number, "error": _STRANGE, "at": ""})

    def _ask(self) -> None:
        """Ask what is held, as far as the page has taken what it was sent."""
        while (session := self.session) and self._held and self._unsent <= _MOST_UNSENT:
            session.ask(*self._held.pop(next(iter(self._held))))

    def on_close(self) -> None:
        """Let the session wait for its page."""
        if session := self.session:
            self.server.line_closed(session, is_left=self.close_code == _LEFT)

    def send(self, message: Mapping[str, Any] | bytes) -> None:
        """Send a message, and when it is gone go on with what is held."""
        text = message if isinstance(message, bytes) else json.dumps(message)

        def sent(sending: asyncio.Future[None]) -> None:
            self._unsent -= len(text)
            if not sending.cancelled() and sending.exception() is None:
                self._ask()

        with suppress(WebSocketClosedError):
            sending = self.write_message(text, binary=text is message)
            self._unsent += len(text)
            sending.add_done_callback(sent)
