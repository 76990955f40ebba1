"""The requests of a page other than its websocket: the page, its parts, uploads and downloads."""

from __future__ import annotations

import mimetypes
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

from tornado.iostream import StreamClosedError
from tornado.web import HTTPError, RequestHandler, StaticFileHandler, stream_request_body

from roughline.server.access import (
    HEADERS,
    RESULTS_POLICY,
    host_is_ours,
    neighbourhood,
    origin_is_ours,
    passwords_match,
)
from roughline.server.session import Session, Upload

if TYPE_CHECKING:
    from roughline.server.serve import Server

_COOKIE = "roughline_lab"
_DAYS = 7  # that a page stays logged in
_LATER = 3600  # that a browser keeps the parts of the page [s]
_DOCUMENTS = ("text/html", "image/svg+xml", "application/xhtml+xml", "text/xml", "application/xml")


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
        return neighbourhood(self.request.remote_ip or "")

    def set_default_headers(self) -> None:
        """Say what a browser may do with the answer."""
        for name, value in HEADERS.items():
            self.set_header(name, value)
        self.set_header("Server", "roughline")

    def prepare(self) -> None:
        """Refuse names that are not ours, pages of other servers, and who has not logged in."""
        settings = self.server.settings
        if not host_is_ours(self.request.host, settings):
            raise HTTPError(403, reason="This is not a name of this server")
        origin = self.request.headers.get("Origin")
        reads = self.request.method in ("GET", "HEAD")
        if (origin is not None or not reads) and not origin_is_ours(origin, self.request.host):
            raise HTTPError(403, reason="Requests from pages of other servers are refused")
        if not self.open_to_all and settings.password is not None and not self._is_logged_in():
            if self.request.path == "/":
                self.redirect("/login")
            else:
                raise HTTPError(401, reason="Log in first")

    def write_error(self, status_code: int, **kwargs: Any) -> None:
        """Answer in one line, without a trace."""
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(f"{status_code}: {self._reason}\n")

    def session_of(self, token: str) -> Session:
        """Return the session with a token."""
        session = self.server.sessions.get(token)
        if session is None:
            raise HTTPError(404, reason="This page is no longer connected: reload it")
        return session

    def _is_logged_in(self) -> bool:
        """Whether the password was given, for the name by which the server is called now."""
        said = self.get_signed_cookie(_COOKIE, max_age_days=_DAYS)
        return said == self.request.host.lower().encode()


class Nothing(Guarded):
    """An address at which there is nothing."""

    def prepare(self) -> None:
        """Say so to pages that may ask."""
        super().prepare()
        if not self._finished:
            raise HTTPError(404, reason="There is nothing at this address")


class Page(Guarded):
    """The page itself."""

    def get(self) -> None:
        """Send it."""
        self.set_header("Cache-Control", "no-store")
        self.finish(self.server.site.page())


class Login(Guarded):
    """Where the password is asked for."""

    open_to_all = True

    def set_default_headers(self) -> None:
        """Let the form state its origin, which "no-referrer" hides."""
        super().set_default_headers()
        self.set_header("Referrer-Policy", "same-origin")
        self.set_header("Cache-Control", "no-store")

    def get(self) -> None:
        """Ask."""
        if self.server.settings.password is None:
            self.redirect("/")
        else:
            self.finish(self.server.site.login_page(""))

    def post(self) -> None:
        """Check what was given."""
        password = self.server.settings.password
        if password is None:
            self.redirect("/")
        elif not self.server.visitors.may_try(self.address):
            self.set_status(429)
            self.finish(self.server.site.login_page("Too many tries: wait a minute."))
        elif passwords_match(self.get_body_argument("password", "", strip=False), password):
            self.set_signed_cookie(
                _COOKIE,
                self.request.host.lower(),
                expires_days=_DAYS,
                httponly=True,
                samesite="Strict",
                secure=self.request.protocol == "https",
            )
            self.redirect("/", status=303)
        else:
            self.set_status(403)
            self.finish(self.server.site.login_page("This is not the password."))


class Parts(Guarded, StaticFileHandler):
    """Scripts and styles, ours and those of Bokeh."""

    open_to_all = True

    def parse_url_path(self, url_path: str) -> str:
        """Refuse a path that the system does not accept as a name."""
        if "\0" in url_path:
            raise HTTPError(404, reason="There is nothing at this address")
        return super().parse_url_path(url_path)

    def set_extra_headers(self, path: str) -> None:
        """Let a browser keep Bokeh's, which change with its version only."""
        is_bokehs = self.request.path.startswith("/bokeh/")
        self.set_header("Cache-Control", f"max-age={_LATER}" if is_bokehs else "no-cache")


class Figures(Guarded):
    """The empty figures of a view, as BokehJS reads them."""

    async def get(self, view: str) -> None:
        """Send them."""
        self.set_header("Content-Type", "application/octet-stream")
        figures = await self.server.figures.of_view(view)
        if figures is None:
            raise HTTPError(500, reason="The figures of this view could not be made")
        self.finish(figures)


@stream_request_body
class Uploads(Guarded):
    """A file that a page brings, written to disk as it comes."""

    _session: Session | None = None
    _key = ""
    _upload: Upload | None = None
    _file: BinaryIO | None = None
    _is_full = False

    def prepare(self) -> None:
        """Refuse a file that is too large before it comes."""
        super().prepare()
        session = self.session_of(self.get_query_argument("session", ""))
        most = self.server.settings.max_upload
        self.request.connection.set_max_body_size(int(most))  # type: ignore[union-attr]
        if not session.allowance.take():
            raise HTTPError(429, reason="Too many files at once: wait a moment")
        length = self.request.headers.get("Content-Length", "")
        if not (length.isascii() and length.isdigit()):
            raise HTTPError(411, reason="The size of the file must be stated first")
        if int(length) > most:
            raise HTTPError(413, reason=f"The file is larger than {most / 1e6:g} MB")
        name = self.get_query_argument("name", "file")
        self._session = session
        self._key, self._upload = session.new_upload(name, int(length))
        self._file = self._upload.path.open("wb")

    def data_received(self, chunk: bytes) -> None:
        """Write what has come, as long as somebody wants it."""
        if self._session is None or self._file is None or self._is_full:
            return
        if self._key not in self._session.uploads:
            self._file.close()
            self._session = None
            return
        try:
            self._file.write(chunk)
        except OSError:
            self._is_full = True

    def post(self) -> None:
        """Tell the page what its file is called here."""
        if self._session is None or self._upload is None or self._file is None:
            raise HTTPError(410, reason="The page of this file is closed, or sent too many files")
        try:
            self._file.close()
        except OSError:
            self._is_full = True
        if self._is_full:
            raise HTTPError(507, reason="The lab has no room for this file")
        self._session = None  # the file is whole, and stays
        self.finish({"file": self._key, "name": self._upload.name})

    def on_finish(self) -> None:
        """Delete what came of a file that was refused or could not be written."""
        self._forget()

    def on_connection_close(self) -> None:
        """Delete what came of a file that was broken off."""
        super().on_connection_close()
        self._forget()

    def _forget(self) -> None:
        if self._file is not None:
            with suppress(OSError):
                self._file.close()
        if self._session is not None:
            self._session.forget_upload(self._key)
            self._session = None


class Results(Guarded):
    """Files that tasks have written for a page: reports, pictures, data."""

    async def get(self, token: str, name: str) -> None:
        """Send one, piece by piece."""
        folder = (self.session_of(token).folder / "results").resolve()
        path = (folder / name).resolve()
        if path.parent != folder or not path.is_file():
            raise HTTPError(404, reason="This file no longer exists: make it again")
        kind = mimetypes.guess_type(path.name)[0] or "application/octet-stream"
        self.set_header("Content-Type", kind)
        self.set_header("Content-Length", str(path.stat().st_size))
        self.set_header("Cache-Control", "no-store")
        if kind in _DOCUMENTS:
            self.set_header("Content-Security-Policy", RESULTS_POLICY)
        if self.get_query_argument("save", ""):
            self.set_header("Content-Disposition", f'attachment; filename="{path.name}"')
        for piece in StaticFileHandler.get_content(str(path)):
            self.write(piece)
            try:
                await self.flush()
            except StreamClosedError:  # the page wants it no more
                return


def bokeh_folder() -> Path:
    """Folder of the scripts and styles of Bokeh, in its own package."""
    from importlib.util import find_spec

    found = find_spec("bokeh")  # without loading it, which takes long
    assert found is not None
    assert found.origin is not None
    return Path(found.origin).parent / "server" / "static" / "js"
