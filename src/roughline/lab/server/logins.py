"""What opens the lab, and who has opened it."""

from __future__ import annotations

import asyncio
import re
import secrets
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass

from roughline.lab.server.access import passwords_match

DAYS = 7  # how long a login lasts
_MOST = 10_000  # logins that are remembered
_TOKEN = re.compile(r"token=([^&\s]*)")


@dataclass(frozen=True)
class Key:
    """What a visitor must know."""

    secret: str  # the password, or the token
    # whether it is a random token, which cannot be guessed; tries of it need not wait
    is_token: bool

    @classmethod
    def of(cls, password: str | None) -> Key:
        """Return the key to a lab with a password; without one, a new token."""
        if password is None:
            return cls(secrets.token_hex(16), is_token=True)
        return cls(password, is_token=False)

    def opens(self, given: str) -> bool:
        """Whether it is what was given; a token may come in the address that carries it."""
        if self.is_token:
            found = _TOKEN.search(given)
            given = found[1] if found else given.strip()
        return passwords_match(given, self.secret)


class Logins:
    """All logins, by a random name that only the browser's cookie has besides.

    `ended` is told the name of a login that has ended, to close its pages.
    """

    def __init__(self, ended: Callable[[str], None]) -> None:
        self._ended = ended
        # the host by which each called the server, and what ends it when its time is over
        self._known: OrderedDict[str, tuple[str, asyncio.TimerHandle]] = OrderedDict()

    def begin(self, host: str) -> str:
        """Begin a login, which ends by itself after some days; returns its name."""
        while len(self._known) >= _MOST:
            self.end(next(iter(self._known)))
        name = secrets.token_urlsafe(16)
        timer = asyncio.get_running_loop().call_later(DAYS * 86_400, self.end, name)
        self._known[name] = host, timer
        return name

    def know(self, name: str, host: str) -> bool:
        """Whether there is a login of a name, for the host that is called now."""
        if name not in self._known or self._known[name][0] != host:
            return False
        self._known.move_to_end(name)  # the oldest unused one goes first
        return True

    def end(self, name: str) -> None:
        """End a login, and close its pages."""
        known = self._known.pop(name, None)
        if known is not None:
            known[1].cancel()
            self._ended(name)
