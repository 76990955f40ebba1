"""Who may speak to the server: who has its token, by a name of it, from a page of it."""

from __future__ import annotations

import hmac
from urllib.parse import SplitResult, urlsplit

from roughline.lab.server.settings import LOCAL_NAMES, ServerSettings


def host_is_ours(host: str, settings: ServerSettings) -> bool:
    """Whether a request names this server; other names that lead here are refused.

    Any port will do, since a tunnel may lead here from another one. Where other machines are let in
    their names for this one are not known here, and the token protects.
    """
    name = _split(f"//{host}").hostname
    ours = (*LOCAL_NAMES, settings.host, _split(settings.address).hostname)
    return name is not None and (not settings.is_local or name in ours)


def origin_is_ours(origin: str | None, host: str, settings: ServerSettings) -> bool:
    """Whether a request comes from a page of this server; not if its origin is none or "null"."""
    named, outside = _split(origin or ""), _split(settings.address)
    if named.scheme not in ("http", "https") or not named.netloc:
        return False
    if (named.scheme, named.netloc.lower()) == (outside.scheme, outside.netloc.lower()):
        return True
    is_same = named.netloc.lower() == host.lower()
    return is_same and _split(f"//{host}").hostname != outside.hostname


def cookie_name(host: str) -> str:
    """Name of the cookie with the token; it has the port, as cookies are shared by all ports."""
    port = _split(f"//{host}").port
    return "roughline_lab" if port is None else f"roughline_lab_{port}"


def cookie_scope(settings: ServerSettings) -> tuple[str, bool]:
    """The path that the cookie is for, and whether it is sent encrypted only."""
    outside = _split(settings.address)
    return outside.path or "/", outside.scheme == "https"


def opens(attempt: str | None, token: str) -> bool:
    """Whether a text is the token."""
    return hmac.compare_digest((attempt or "").strip().encode(), token.encode())


def _split(address: str) -> SplitResult:
    """The parts of an address; empty for text that is not an address."""
    try:
        parts = urlsplit(address)
        parts.hostname, parts.port  # noqa: B018 - they are checked when they are read
    except ValueError:
        return urlsplit("")
    return parts
