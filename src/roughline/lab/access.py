"""Who may speak to the server: host and origin, password, and how often."""

from __future__ import annotations

import hmac
import time
from dataclasses import dataclass, field
from urllib.parse import urlsplit

from roughline.lab.settings import LabSettings

CONTENT_POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self' 'unsafe-inline'",  # BokehJS writes its styles into the page
        "img-src 'self' data: blob:",
        "font-src 'self' data:",
        "connect-src 'self'",
        "form-action 'self'",
        "base-uri 'none'",
        "frame-ancestors 'none'",
    )
)
"""Nothing is loaded but from this server, and no text is run as a program."""

HEADERS = {
    "Content-Security-Policy": CONTENT_POLICY,
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}

_OWN_NAMES = ("localhost", "127.0.0.1", "::1")


def host_is_ours(host: str, settings: LabSettings) -> bool:
    """Whether a request names this server; a name that others point here is refused.

    Where other machines are let in, by names that are not known here, the password protects.
    """
    if not settings.is_local:
        return True
    return urlsplit(f"//{host}").hostname in (*_OWN_NAMES, settings.host)


def origin_is_ours(origin: str | None, host: str) -> bool:
    """Whether a request comes from a page of this server; no origin is not ours."""
    return origin is not None and urlsplit(origin).netloc.lower() == host.lower()


def passwords_match(given: str, wanted: str) -> bool:
    """Compare two passwords in a time that tells nothing of them."""
    return hmac.compare_digest(given.encode(), wanted.encode())


@dataclass
class Allowance:
    """How often something may be done: a supply that fills up with time.

    Parameters
    ----------
    rate : float
        Of filling up. [1 / s]
    most : float
        When it is full.
    """

    rate: float
    most: float
    _left: float = field(init=False)
    _at: float = field(init=False)

    def __post_init__(self) -> None:
        self._left, self._at = self.most, time.monotonic()

    def take(self) -> bool:
        """Take one, if there is one left."""
        now = time.monotonic()
        self._left = min(self.most, self._left + self.rate * (now - self._at))
        self._at = now
        if self._left < 1:
            return False
        self._left -= 1
        return True
