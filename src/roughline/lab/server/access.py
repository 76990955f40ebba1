"""Who may speak to the server: host, origin and address, password or token, and how often."""

from __future__ import annotations

import hmac
import re
import secrets
import time
from collections import OrderedDict
from collections.abc import Callable
from functools import lru_cache
from ipaddress import IPv4Address, IPv6Address, ip_address
from urllib.parse import SplitResult, urlsplit

from tornado.httputil import HTTPServerRequest

from roughline.lab.server.settings import ServerSettings

DAYS = 7  # how long a login lasts
MOST_REMEMBERED = 10_000  # logins, and addresses
_WITH_PORT = re.compile(r"\[(.*)\](?::\d*)?|([0-9.]+):\d*")
_LOCAL_NAMES = ("localhost", "127.0.0.1", "::1")
_TOKEN = re.compile(r"token=([^&\s]*)")


def host_is_ours(host: str, settings: ServerSettings) -> bool:
    """Whether a request names this server; other names that lead here are refused.

    Any port will do, since a tunnel may lead here from another one. Where other machines are let
    in, by names that are not known here, the password protects.
    """
    name = _split(f"//{host}").hostname
    if name is None:
        return False
    return settings.lets_others_in or name in (*_LOCAL_NAMES, settings.host)


def origin_is_ours(origin: str | None, host: str) -> bool:
    """Whether a request comes from a page of this server; not if its origin is none or "null"."""
    named = _split(origin or "")
    return named.scheme in ("http", "https") and named.netloc.lower() == host.lower() != ""


def _split(address: str) -> SplitResult:
    """The parts of an address; empty for text that is not an address."""
    try:
        parts = urlsplit(address)
        parts.hostname, parts.port  # noqa: B018 - they are checked when they are read
    except ValueError:
        return urlsplit("")
    return parts


def cookie_name(host: str) -> str:
    """Name of the cookie of a login; it has the port, because cookies are shared by all ports."""
    port = _split(f"//{host}").port
    return "roughline_lab" if port is None else f"roughline_lab_{port}"


def is_proxy(peer: str, settings: ServerSettings) -> bool:
    """Whether an address is that of one of our proxies."""
    address = _address(peer)
    return address is not None and any(address in each for each in settings.proxies)


def visitor(request: HTTPServerRequest, settings: ServerSettings) -> str:
    """Return who asks: one address, or one customer's network.

    Each proxy adds at the right from whom it has the request. What stands left of the first address
    that is no proxy of ours can be invented.
    """
    address = request.remote_ip or ""
    for hop in reversed(request.headers.get("X-Forwarded-For", "").split(",")):
        if not is_proxy(address, settings) or _address(hop) is None:
            break
        address = hop
    return neighbourhood(address)


def is_encrypted(request: HTTPServerRequest, settings: ServerSettings) -> bool:
    """Whether the way from the browser is encrypted, as our proxy says."""
    if not is_proxy(request.remote_ip or "", settings):
        return request.protocol == "https"
    protocols = request.headers.get("X-Forwarded-Proto", "")
    return protocols.rpartition(",")[2].strip().lower() == "https"


def neighbourhood(address: str) -> str:
    """Return an IPv4 address, or the network of an IPv6 address that one customer commonly has."""
    number = _address(address.partition("%")[0])
    if isinstance(number, IPv6Address) and not number.is_loopback:
        number = IPv6Address(int(number) >> 64 << 64)
    return address if number is None else str(number)  # it is none of a socket file


def _address(text: str) -> IPv4Address | IPv6Address | None:
    """An address, which may have a port; None if it is none."""
    without_port = _WITH_PORT.fullmatch(text.strip())
    try:
        number = ip_address((without_port[1] or without_port[2]) if without_port else text.strip())
    except ValueError:
        return None
    return getattr(number, "ipv4_mapped", None) or number


class Allowance:
    """How often something may be done: a supply that fills up with time, at a rate [1 / s]."""

    def __init__(self, rate: float, most: float) -> None:
        self._rate, self._most = rate, most
        self._left, self._at = most, time.monotonic()

    @property
    def is_empty(self) -> bool:
        """Whether none is left."""
        before, self._at = self._at, time.monotonic()
        self._left = min(self._most, self._left + self._rate * (self._at - before))
        return self._left < 1

    def take(self) -> bool:
        """Take one, if there is one left."""
        if self.is_empty:
            return False
        self._left -= 1
        return True


def allowances(rate: float, most: float) -> Callable[[str], Allowance]:
    """Return what gives each address an allowance; those that came last are remembered."""
    return lru_cache(MOST_REMEMBERED)(lambda address: Allowance(rate, most))


class Key:
    """What a visitor must know: the password, or a token that is new at each start."""

    def __init__(self, password: str | None) -> None:
        self.is_token = password is None
        self.secret = password or secrets.token_hex(16)

    def opens(self, attempt: str) -> bool:
        """Whether it is what was given; a token may come in the address that carries it."""
        if self.is_token:
            found = _TOKEN.search(attempt)
            attempt = found[1] if found else attempt.strip()
        return hmac.compare_digest(attempt.encode(), self.secret.encode())


class Logins:
    """All logins, by a random name that only the browser's cookie has besides."""

    def __init__(self) -> None:
        # the host by which each called the server, and when its time is over
        self._known: OrderedDict[str, tuple[str, float]] = OrderedDict()

    def begin(self, host: str) -> str:
        """Begin a login, which ends by itself after some days; returns its name."""
        while len(self._known) >= MOST_REMEMBERED:
            self._known.popitem(last=False)
        name = secrets.token_urlsafe(16)
        self._known[name] = host, time.monotonic() + DAYS * 86_400
        return name

    def lasts(self, name: str) -> bool:
        """Whether there is a login of a name."""
        return name in self._known and time.monotonic() < self._known[name][1]

    def know(self, name: str, host: str) -> bool:
        """Whether there is one for the host that is called now."""
        if not self.lasts(name) or self._known[name][0] != host:
            return False
        self._known.move_to_end(name)  # the oldest unused one goes first
        return True

    def end(self, name: str) -> None:
        """End a login."""
        self._known.pop(name, None)
