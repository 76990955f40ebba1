"""Requests that are answered only to pages that may ask."""

from __future__ import annotations

from typing import Any

from tornado.web import HTTPError, RequestHandler

from roughline.lab.server.access import (
    comes_through_proxy,
    cookie_name,
    host_is_ours,
    is_encrypted,
    origin_is_ours,
    visitor,
)
from roughline.lab.server.connections import Connection, Stage
from roughline.lab.server.logins import DAYS
from roughline.lab.server.server import Server
from roughline.lab.server.session import Session

_CONTENT_POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self' 'unsafe-inline'",  # BokehJS writes its styles into the page
        "img-src 'self' data:",
        "connect-src 'self'",
        "form-action 'self'",
        "base-uri 'none'",
        "frame-ancestors 'none'",
    )
)
"""Everything is loaded from this server only, and no text of a page is run as a program."""

_HEADERS = {
    "Content-Security-Policy": _CONTENT_POLICY,
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}


class Guarded(RequestHandler):
    """A request that is answered only to pages that may ask."""

    open_to_all = False

    @property
    def server(self) -> Server:
        """The server that is asked."""
        server: Server = self.application.settings["server"]
        return server

    @property
    def address(self) -> str:
        """Where the request comes from."""
        return visitor(self.request, self.server.settings)

    @property
    def login_name(self) -> str:
        """Name of the browser's login, as its cookie says; empty if it has none."""
        said = self.get_signed_cookie(cookie_name(self.request.host), max_age_days=DAYS)
        return (said or b"").decode()

    @property
    def is_logged_in(self) -> bool:
        """Whether the browser is, for the name by which the server is called now."""
        return self.server.logins.know(self.login_name, self.request.host.lower())

    def note(self, stage: Stage) -> None:
        """Note what the connection of the request does from now on."""
        connection = getattr(self.request.connection, "stream", None)
        if isinstance(connection, Connection):
            connection.enter(stage)

    def set_default_headers(self) -> None:
        """Say what a browser may do with the answer."""
        for name, value in _HEADERS.items():
            self.set_header(name, value)
        self.set_header("Server", "roughline")

    def prepare(self) -> None:
        """Refuse other ways than ours, pages of other servers, and who has not logged in."""
        self.note(Stage.IS_SERVED)
        settings = self.server.settings
        if settings.proxies and not comes_through_proxy(self.request, settings):
            raise HTTPError(403, reason="This lab is reached through its proxy only")
        if not host_is_ours(self.request.host, settings):
            raise HTTPError(403, reason="This is not a name of this server")
        origin = self.request.headers.get("Origin")
        reads = self.request.method in ("GET", "HEAD")
        if (origin is not None or not reads) and not origin_is_ours(origin, self.request.host):
            raise HTTPError(403, reason="Requests from pages of other servers are refused")
        if not self.open_to_all and not self.is_logged_in:
            raise HTTPError(401, reason="Log in first")

    def write_error(self, status_code: int, **kwargs: Any) -> None:
        """Answer in one line, without a trace."""
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(f"{status_code}: {self._reason}\n")

    def session_of(self, token: str) -> Session:
        """Return the session with a token."""
        session = self.server.sessions.get(token)
        if session is None or session.login != self.login_name:
            raise HTTPError(404, reason="This page is no longer connected: reload it")
        return session

    def enter(self, given: str, leads_to: str) -> None:
        """Let in who has given the password or token, and go on; ask again otherwise."""
        key, visitors = self.server.key, self.server.visitors
        may_try = visitors.may_try(self.address)
        # nobody guesses a token, so a stranger's tries need not keep out who has it
        if (may_try or key.is_token) and key.opens(given):
            if may_try:
                visitors.succeeded(self.address)
            self.set_signed_cookie(
                cookie_name(self.request.host),
                self.server.logins.begin(self.request.host.lower()),
                expires_days=DAYS,
                httponly=True,
                samesite="Strict",
                secure=is_encrypted(self.request, self.server.settings),
            )
            self.redirect(leads_to, status=303)
        elif not may_try:
            self.set_status(429)
            self.ask_for_key("Too many tries: wait a minute.", leads_to)
        else:
            self.set_status(403)
            wanted = "token of the lab that runs now" if key.is_token else "password"
            self.ask_for_key(f"This is not the {wanted}.", leads_to)

    def ask_for_key(self, complaint: str, leads_to: str) -> None:
        """Send the page that asks for the password or token."""
        self.set_header("Referrer-Policy", "same-origin")  # "no-referrer" hides a form's origin
        self.set_header("Cache-Control", "no-store")
        key = self.server.key
        self.finish(self.server.site.login_page(key.is_token, complaint, leads_to))
