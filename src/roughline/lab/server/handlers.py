"""The requests of a page other than its websocket: the page, its parts, uploads and downloads."""

from __future__ import annotations

import mimetypes
from contextlib import suppress
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import Any, BinaryIO
from urllib.parse import urlencode

from tornado.iostream import StreamClosedError
from tornado.web import HTTPError, RequestHandler, StaticFileHandler, stream_request_body

from roughline.lab.server.access import (
    HEADERS,
    RESULTS_POLICY,
    address_of_page,
    comes_through_proxy,
    cookie_name,
    host_is_ours,
    is_encrypted,
    origin_is_ours,
    own_page,
    visitor,
)
from roughline.lab.server.connections import Connection, Stage
from roughline.lab.server.logins import DAYS
from roughline.lab.server.server import Server
from roughline.lab.server.session import Session, Upload

_MOST_DIGITS = 15  # of the size of a file that is to come
_DIGEST = 12  # letters of the digest by which a page knows a file again
_LATER = 3600  # that a browser keeps the parts of the page [s]
_NO_ROOM = "The lab has no room for this file now: close other pages of it, or come back later"
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
        for name, value in HEADERS.items():
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


class Nothing(Guarded):
    """An address at which there is nothing."""

    def prepare(self) -> None:
        """Say so to pages that may ask."""
        super().prepare()
        if not self._finished:
            raise HTTPError(404, reason="There is nothing at this address")


class Page(Guarded):
    """The page itself."""

    open_to_all = True

    def get(self) -> None:
        """Send it, to who is logged in."""
        self.set_header("Cache-Control", "no-store")
        token = self.get_query_argument("token", None)
        address = address_of_page(self.request.query)
        if not self.is_logged_in and token is not None and self.server.key.is_token:
            self.enter(token, address)
        elif not self.is_logged_in:
            self.redirect("/login" if address == "/" else f"/login?{urlencode({'next': address})}")
        elif token is not None:
            self.redirect(address)
        else:
            self.finish(self.server.site.page())


class Login(Guarded):
    """Where the password or token is asked for."""

    open_to_all = True

    def get(self) -> None:
        """Ask who is not logged in."""
        leads_to = own_page(self.get_query_argument("next", "/"))
        if not self.is_logged_in:
            self.ask_for_key("", leads_to)
        else:
            self.redirect(leads_to)

    def post(self) -> None:
        """Check what was given."""
        given = "token" if self.server.key.is_token else "password"
        leads_to = own_page(self.get_body_argument("next", "/"))
        self.enter(self.get_body_argument(given, "", strip=False), leads_to)


class Logout(Guarded):
    """Where a browser logs out."""

    def post(self) -> None:
        """End its login, and with it all its pages."""
        self.server.logins.end(self.login_name)
        self.clear_cookie(cookie_name(self.request.host))
        self.redirect("/login", status=303)


class Here(Guarded):
    """Where a page asks whether its browser is still logged in."""

    def get(self) -> None:
        """Say yes; who is not logged in was refused before."""
        self.set_header("Cache-Control", "no-store")
        self.set_status(204)


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


@stream_request_body
class Uploads(Guarded):
    """A file that a page brings, written to disk as it comes."""

    _session: Session | None = None
    _key = ""
    _upload: Upload | None = None
    _file: BinaryIO | None = None
    _is_full = False

    def prepare(self) -> None:
        """Refuse a file that is too large before it comes, or that there is no room for."""
        super().prepare()
        session = self.session_of(self.get_query_argument("session", ""))
        most = self.server.settings.max_upload
        self.request.connection.set_max_body_size(int(most))  # type: ignore[union-attr]
        if not session.allowance.take():
            raise HTTPError(429, reason="Too many files at once: wait a moment")
        length = self.request.headers.get("Content-Length", "")
        if not (length.isascii() and length.isdigit()):
            raise HTTPError(411, reason="The size of the file must be stated first")
        if len(length) > _MOST_DIGITS or int(length) > most:
            raise HTTPError(413, reason=f"The file is larger than {most / 1e6:g} MB")
        self.note(Stage.BRINGS)
        if not self.server.has_room(int(length)):
            self._is_full = True  # said when the file has come, as browsers listen only then
            return
        name = self.get_query_argument("name", "file")
        self._session = session
        self._digest = sha256()
        try:
            self._key, self._upload = session.new_upload(name, int(length))
            self._file = self._upload.path.open("wb")
        except OSError:
            self._is_full = True

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
            self._digest.update(chunk)
        except OSError:
            self._is_full = True

    def post(self) -> None:
        """Tell the page what its file is called here."""
        self.note(Stage.IS_SERVED)
        try:
            if self._file is not None:
                self._file.close()
        except OSError:
            self._is_full = True
        if self._is_full:
            raise HTTPError(507, reason=_NO_ROOM)
        if self._session is None or self._upload is None:
            raise HTTPError(410, reason="The page of this file is closed, or sent too many files")
        digest = self._digest.hexdigest()[:_DIGEST]
        if self._key in self._session.uploads:  # it was not forgotten meanwhile
            self._session.uploads[self._key] = replace(self._upload, digest=digest)
        self._session = None  # the file is whole, and stays
        self.finish({"file": self._key, "name": self._upload.name, "digest": digest})

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
