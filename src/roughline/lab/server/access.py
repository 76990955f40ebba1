"""Who may speak to the server: host and origin, password, and how often."""

from __future__ import annotations

import hmac
import re
import time
from collections import OrderedDict
from dataclasses import dataclass, field
from ipaddress import IPv4Address, IPv6Address, ip_address
from urllib.parse import SplitResult, urlsplit

from tornado.httputil import HTTPServerRequest

from roughline.lab.server.settings import ServerSettings

_WITH_PORT = re.compile(r"\[(.*)\](?::\d*)?|([0-9.]+):\d*")
_OWN_NAMES = ("localhost", "127.0.0.1", "::1")


def host_is_ours(host: str, settings: ServerSettings) -> bool:
    """Whether a request names this server; other names that lead here are refused.

    Any port will do, since a tunnel may lead here from another one. Where other machines are let
    in, by names that are not known here, the password protects.
    """
    name = _split(f"//{host}").hostname
    if name is None:
        return False
    return settings.lets_others_in or name in (*_OWN_NAMES, settings.host)


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


def comes_through_proxy(request: HTTPServerRequest, settings: ServerSettings) -> bool:
    """Whether a request comes from one of our proxies."""
    return is_proxy(request.remote_ip or "", settings)


def is_proxy(peer: str, settings: ServerSettings) -> bool:
    """Whether a connection from an address is one of our proxies'."""
    address = _address(peer)
    return address is not None and settings.is_proxy(address)


def visitor(request: HTTPServerRequest, settings: ServerSettings) -> str:
    """Return who asks: one address, or one customer's network.

    Each proxy adds at the right from whom it has the request. What stands left of the first address
    that is no proxy of ours can be invented.
    """
    address = _address(request.remote_ip or "")
    if address is None:
        return request.remote_ip or ""
    for hop in reversed(request.headers.get("X-Forwarded-For", "").split(",")):
        further = _address(hop)
        if further is None or not settings.is_proxy(address):
            break
        address = further
    return neighbourhood(str(address))


def is_encrypted(request: HTTPServerRequest, settings: ServerSettings) -> bool:
    """Whether the way from the browser is encrypted, as our proxy says."""
    if not comes_through_proxy(request, settings):
        return request.protocol == "https"
    said = request.headers.get("X-Forwarded-Proto", "")
    return said.rpartition(",")[2].strip().lower() == "https"


def _address(text: str) -> IPv4Address | IPv6Address | None:
    """An address, which may have a port; None if it is none."""
    bare = _WITH_PORT.fullmatch(text.strip())
    try:
        number = ip_address((bare[1] or bare[2]) if bare else text.strip())
    except ValueError:
        return None
    return getattr(number, "ipv4_mapped", None) or number


def passwords_match(given: str, wanted: str) -> bool:
    """Compare two passwords in a time that does not depend on them."""
    return hmac.compare_digest(given.encode(), wanted.encode())


@dataclass
class Allowance:
    """How often something may be done: a supply that fills up with time."""

    rate: float  # how fast it fills up [1 / s]
    most: float  # the supply when it is full
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

    def give_back(self) -> None:
        """Give back one that was taken."""
        self._left = min(self.most, self._left + 1)


class Visitors:
    """How often each address may ask, and try passwords, whatever number of pages it has open."""

    _MOST = 10_000  # addresses that are remembered

    def __init__(self) -> None:
        self._questions: OrderedDict[str, Allowance] = OrderedDict()
        self._logins: OrderedDict[str, Allowance] = OrderedDict()

    def may_ask(self, address: str) -> bool:
        """Take one question."""
        return self._of(self._questions, address, 2000, 8000).take()

    def may_try(self, address: str) -> bool:
        """Take one try of the password or token."""
        return self._tries(address).take()

    def succeeded(self, address: str) -> None:
        """Give a try back that was right: only wrong ones count."""
        self._tries(address).give_back()

    def _tries(self, address: str) -> Allowance:
        return self._of(self._logins, address, 1 / 12, 5)

    def _of(
        self, known: OrderedDict[str, Allowance], address: str, rate: float, most: float
    ) -> Allowance:
        allowance = known.pop(address, None) or Allowance(rate, most)
        known[address] = allowance  # the latest is last
        while len(known) > self._MOST:
            known.popitem(last=False)
        return allowance


def neighbourhood(address: str) -> str:
    """Return an IPv4 address, or the network of an IPv6 address that one customer commonly has."""
    try:
        number = ip_address(address.partition("%")[0])
    except ValueError:  # such as a socket file
        return address
    if isinstance(number, IPv6Address) and not number.is_loopback:
        if number.ipv4_mapped is not None:
            return str(number.ipv4_mapped)
        return str(IPv6Address(int(number) >> 64 << 64))
    return str(number)
