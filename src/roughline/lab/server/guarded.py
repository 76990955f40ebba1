"""Requests that are answered only to pages that may ask."""

from __future__ import annotations

from typing import Any

from tornado.web import HTTPError, RequestHandler

from roughline.lab.server.access import cookie_name, host_is_ours, opens, origin_is_ours
from roughline.lab.server.sessions import Server, Session

_HEADERS = {
    # everything is loaded from this server only, and no text of a page is run as a program
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; "
    "style-src 'self' 'unsafe-inline'; "  # BokehJS writes its styles into the page
    "img-src 'self' data: blob:; connect-src 'self'; form-action 'self'; base-uri 'none'; "
    "frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Server": "roughline",
}


class Guarded(RequestHandler):
    """A request that is answered only to pages that may ask, of a browser that has the token."""

    open_to_all = False
    server: Server
    has_token: bool

    def set_default_headers(self) -> None:
        """Say what a browser may do with the answer."""
        for name, value in _HEADERS.items():
            self.set_header(name, value)

    def prepare(self) -> None:
        """Refuse other names than ours, pages of other servers, and who has no token."""
        request, self.server = self.request, self.application.settings["server"]
        host, origin, settings = request.host, request.headers.get("Origin"), self.server.settings
        if not host_is_ours(host, settings):
            raise HTTPError(403, reason="This is not a name of this server")
        reads = request.method in ("GET", "HEAD")
        if (origin is not None or not reads) and not origin_is_ours(origin, host, settings):
            raise HTTPError(403, reason="Requests from pages of other servers are refused")
        self.has_token = opens(self.get_cookie(cookie_name(host)), self.server.token)
        if not self.open_to_all and not self.has_token:
            raise HTTPError(401, reason="Open the lab with its token first")

    def write_error(self, status_code: int, **kwargs: Any) -> None:
        """Answer in one line, without a trace."""
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(f"{status_code}: {self._reason}\n")

    def known_session(self, token: str) -> Session:
        """Return the session with a token."""
        session = self.server.sessions.get(token)
        if session is None:
            raise HTTPError(404, reason="This page is no longer connected: reload it")
        return session
