"""The websocket of a page: questions come in, answers go out, and the session ends with it."""

from __future__ import annotations

import json
from typing import Any

from tornado.websocket import WebSocketClosedError, WebSocketHandler

from roughline._version import __version__
from roughline.lab.access import origin_is_ours
from roughline.lab.handlers import Guarded
from roughline.lab.session import Session
from roughline.lab.tasks import TASKS

MOST_BYTES = 2**16
"""Longest message of a page; files come another way."""
_SLOT_LENGTH = 40


class Link(Guarded, WebSocketHandler):
    """The websocket of one page."""

    session: Session | None = None

    def check_origin(self, origin: str) -> bool:
        """Refuse pages of other servers."""
        return origin_is_ours(origin, self.request.host)

    def open(self, *args: str, **kwargs: str) -> None:
        """Begin a session."""
        self.set_nodelay(True)
        if len(self.lab.sessions) >= self.lab.settings.max_sessions:
            self.close(1013, "as many pages are open as may be: close one, or come back later")
            return
        self.session = self.lab.open_session(self._send, self._send_answer)
        self._send({"session": self.session.token, "version": __version__})

    def on_message(self, message: str | bytes) -> None:
        """Take a question, or the wish to stop one."""
        if self.session is None:
            return
        said = _plain_message(message)
        number = _number(said.get("id"))
        slot = said.get("slot")
        if not isinstance(slot, str) or not 0 < len(slot) <= _SLOT_LENGTH:
            self._refuse(number, "this message is none of the lab's: reload the page")
        elif not self.session.allowance.take():
            self._refuse(number, "too many questions at once: wait a moment, then go on")
        elif said.get("stop"):
            self.session.withdraw(slot)
        elif said.get("task") in TASKS and isinstance(said.get("arguments"), dict):
            self.session.ask(number, slot, said["task"], said["arguments"])
        else:
            self._refuse(number, "the lab has no such task: reload the page")

    def on_close(self) -> None:
        """End the session with its page."""
        if self.session is not None:
            self.lab.close_session(self.session)
            self.session = None

    def _refuse(self, number: Any, why: str) -> None:
        self._send({"id": number, "error": why, "at": ""})

    def _send(self, content: dict[str, Any]) -> None:
        self._write(json.dumps(content))

    def _send_answer(self, number: int, answer: bytes) -> None:
        self._write(number.to_bytes(8, "little") + answer)

    def _write(self, message: str | bytes) -> None:
        try:
            self.write_message(message, binary=isinstance(message, bytes))
        except WebSocketClosedError:
            self.on_close()


def _number(given: Any) -> int:
    """The number of a question; 0 if it has none."""
    return given if isinstance(given, int) and 0 <= given < 2**53 else 0


def _plain_message(message: str | bytes) -> dict[str, Any]:
    """What a page said; empty if it makes no sense."""
    try:
        said = json.loads(message)
    except (ValueError, RecursionError):
        return {}
    return said if isinstance(said, dict) else {}
