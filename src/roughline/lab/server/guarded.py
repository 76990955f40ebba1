"""Requests that are answered only to pages that may ask."""

from __future__ import annotations

from typing import Any

from tornado.web import HTTPError, RequestHandler

from roughline.lab.server.access import cookie_name, host_is_ours, is_proxy, origin_is_ours, visitor
from roughline.lab.server.connections import Connection, Stage
from roughline.lab.server.sessions import Server, Session

_HEADERS = {
    # everything is loaded from this server only, and no text of a page is run as a program
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; "
    "style-src 'self' 'unsafe-inline'; "  # BokehJS writes its styles into the page
    "img-src 'self' data:; connect-src 'self'; form-action 'self'; base-uri 'none'; "
    "frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Server": "roughline",
}


class Guarded(RequestHandler):
    """A request that is answered only to pages that may ask.

    `address` says where it comes from, and `login` is the name of the browser's login, as its
    cookie says; it is empty if it has none, or none for the name by which the server is called now.
    """

    open_to_all = False
    server: Server
    address: str
    login: str

    def note(self, stage: Stage) -> None:
        """Note what the connection of the request does from now on."""
        connection = getattr(self.request.connection, "stream", None)
        if isinstance(connection, Connection):
            connection.enter(stage)

    def set_default_headers(self) -> None:
        """Say what a browser may do with the answer."""
        for name, value in _HEADERS.items():
            self.set_header(name, value)

    def prepare(self) -> None:
        """Refuse other ways than ours, pages of other servers, and who has not logged in."""
        self.note(Stage.IS_SERVED)
        request, self.server = self.request, self.application.settings["server"]
        host, origin, settings = request.host, request.headers.get("Origin"), self.server.settings
        if settings.proxies and not is_proxy(request.remote_ip or "", settings):
            raise HTTPError(403, reason="This lab is reached through its proxy only")
        if not host_is_ours(host, settings):
            raise HTTPError(403, reason="This is not a name of this server")
        reads = request.method in ("GET", "HEAD")
        if (origin is not None or not reads) and not origin_is_ours(origin, host):
            raise HTTPError(403, reason="Requests from pages of other servers are refused")
        self.address, login = visitor(request, settings), self.get_cookie(cookie_name(host)) or ""
        self.login = login if self.server.logins.know(login, host.lower()) else ""
        if not self.open_to_all and not self.login:
            raise HTTPError(401, reason="Log in first")

    def write_error(self, status_code: int, **kwargs: Any) -> None:
        """Answer in one line, without a trace."""
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(f"{status_code}: {self._reason}\n")

    def known_session(self, token: str) -> Session:
        """Return the session with a token."""
        session = self.server.sessions.get(token)
        if session is None or session.login != self.login:
            raise HTTPError(404, reason="This page is no longer connected: reload it")
        return session
