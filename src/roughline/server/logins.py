"""What opens the lab, and who has opened it."""

from __future__ import annotations

import asyncio
import re
import secrets
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, field

from roughline.server.access import passwords_match

DAYS = 7
"""How long a login lasts."""
_MOST = 10_000  # logins that are remembered
_TOKEN = re.compile(r"token=([^&\s]*)")


@dataclass(frozen=True)
class Key:
    """What a visitor must know.

    Attributes
    ----------
    secret : str
        The password, or the token.
    is_token : bool
        Whether it is a random token, which cannot be guessed; tries of it need not wait.
    """

    secret: str
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


@dataclass
class Login:
    """A browser that has logged in.

    Attributes
    ----------
    host : str
        Name and port by which it called the server.
    on_end : set of callable
        Called when the login ends; they close its pages.
    """

    host: str
    on_end: set[Callable[[], None]] = field(default_factory=set)


class Logins:
    """All logins, by a random name that only the browser's cookie has besides."""

    def __init__(self) -> None:
        self._known: OrderedDict[str, Login] = OrderedDict()

    def begin(self, host: str) -> str:
        """Begin a login, which ends by itself after some days; returns its name."""
        while len(self._known) >= _MOST:
            self.end(next(iter(self._known)))
        name = secrets.token_urlsafe(16)
        self._known[name] = Login(host)
        asyncio.get_running_loop().call_later(DAYS * 86_400, self.end, name)
        return name

    def of(self, name: str, host: str) -> Login | None:
        """Return the login of a name, for the host that is called now; None if there is none."""
        login = self._known.get(name)
        if login is None or login.host != host:
            return None
        self._known.move_to_end(name)  # the oldest unused one goes first
        return login

    def end(self, name: str) -> None:
        """End a login, and close its pages."""
        login = self._known.pop(name, None)
        if login is not None:
            for close in list(login.on_end):
                close()
