"""What is answered at which address: the page, its parts, uploads and downloads."""

from __future__ import annotations

import mimetypes
import re
from contextlib import suppress
from hashlib import sha256
from importlib.metadata import distribution
from typing import BinaryIO
from urllib.parse import parse_qsl, urlencode

from tornado.iostream import StreamClosedError
from tornado.web import Application, HTTPError, StaticFileHandler, stream_request_body

from roughline.lab.server.access import DAYS, cookie_name, is_encrypted
from roughline.lab.server.connections import Stage
from roughline.lab.server.files import Files, Upload
from roughline.lab.server.guarded import Guarded
from roughline.lab.server.link import MOST_BYTES, Link
from roughline.lab.server.sessions import Server

_PONG_WITHIN = 20  # a page that does not answer within this time is gone [s]
_MOST_DIGITS = 15  # of the size of a file that is to come
_DIGEST_LETTERS = 12  # letters of the digest by which a page knows a file again
_CACHED_FOR = 3600  # that a browser keeps the parts of the page [s]
_NO_ROOM = "The lab has no room for this file now: close other pages of it, or come back later"
_DOCUMENTS = ("text/html", "image/svg+xml", "application/xhtml+xml", "text/xml", "application/xml")
_PAGE = re.compile(r"/(\?[!-~]*)?")  # with what is set in it
_RESULTS_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; sandbox"
"""Documents that tasks have written run no program, and load nothing."""


def application(server: Server) -> Application:
    """The handlers, by address."""
    bokeh = distribution("bokeh").locate_file("bokeh/server/static/js")
    return Application(
        [
            (r"/", _Page),
            (r"/login", _Login),
            (r"/logout", _Logout),
            (r"/here", _Here),
            (r"/link", Link),
            (r"/upload", _Uploads),
            (r"/results/([A-Za-z0-9_-]+)/([A-Za-z0-9_.-]{1,100})", _ResultFiles),
            (r"/lab/([\w./-]+)", _Parts, {"path": str(server.site.parts)}),
            (r"/bokeh/(bokeh(?:-[a-z]+)?\.min\.js)", _Parts, {"path": str(bokeh)}),
        ],
        default_handler_class=_Nothing,
        server=server,
        websocket_max_message_size=MOST_BYTES,
        websocket_ping_interval=_PONG_WITHIN,
        log_function=lambda handler: None,
    )


class _Nothing(Guarded):
    """An address at which there is nothing, as is said to pages that may ask."""

    def prepare(self) -> None:
        super().prepare()
        raise HTTPError(404, reason="There is nothing at this address")


class _Door(Guarded):
    """Where one comes in, with the password or token."""

    open_to_all = True

    def enter(self, attempt: str, leads_to: str) -> None:
        """Let in who has given the password or token, and go on; ask again otherwise."""
        key, tries, host = self.server.key, self.server.tries(self.address), self.request.host
        # nobody guesses a token, so a stranger's tries need not keep out who has it
        if key.opens(attempt) and (key.is_token or not tries.is_empty):
            self.set_cookie(
                cookie_name(host),
                self.server.logins.begin(host.lower()),
                expires_days=DAYS,
                httponly=True,
                samesite="Strict",
                secure=is_encrypted(self.request, self.server.settings),
            )
            self.redirect(leads_to, status=303)
        elif not tries.take():  # only wrong ones count
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
        self.finish(self.server.site.login_page(self.server.key.is_token, complaint, leads_to))


class _Page(_Door):
    """The page itself, for who is logged in."""

    def get(self) -> None:
        self.set_header("Cache-Control", "no-store")
        token = self.get_query_argument("token", None)
        address = _address_of_page(self.request.query)
        if not self.login and token is not None and self.server.key.is_token:
            self.enter(token, address)
        elif not self.login:
            self.redirect("/login" if address == "/" else f"/login?{urlencode({'next': address})}")
        elif token is not None:
            self.redirect(address)
        else:
            self.finish(self.server.site.page())


class _Login(_Door):
    """Where the password or token is asked for."""

    def get(self) -> None:
        leads_to = _own_page(self.get_query_argument("next", "/"))
        if not self.login:
            self.ask_for_key("", leads_to)
        else:
            self.redirect(leads_to)

    def post(self) -> None:
        argument = "token" if self.server.key.is_token else "password"
        leads_to = _own_page(self.get_body_argument("next", "/"))
        self.enter(self.get_body_argument(argument, "", strip=False), leads_to)


class _Logout(Guarded):
    """Where a browser ends its login, and with it all its pages."""

    def post(self) -> None:
        self.server.logins.end(self.login)
        self.server.sweep()
        self.clear_cookie(cookie_name(self.request.host))
        self.redirect("/login", status=303)


class _Here(Guarded):
    """Where a page asks whether its browser is still logged in; who is not is refused before."""

    def get(self) -> None:
        self.set_header("Cache-Control", "no-store")
        self.set_status(204)


class _Parts(Guarded, StaticFileHandler):
    """Scripts and styles, ours and those of Bokeh."""

    open_to_all = True

    def set_extra_headers(self, path: str) -> None:
        """Let a browser keep Bokeh's, which change with its version only."""
        is_bokehs = self.request.path.startswith("/bokeh/")
        self.set_header("Cache-Control", f"max-age={_CACHED_FOR}" if is_bokehs else "no-cache")


@stream_request_body
class _Uploads(Guarded):
    """A file that a page brings, written to disk as it comes."""

    _files: Files
    _upload: Upload | None = None
    _file: BinaryIO | None = None
    _is_full = False  # said when the file has come, as browsers listen only then

    def prepare(self) -> None:
        """Refuse a file that is too large before it comes, or that there is no room for."""
        super().prepare()
        session = self.known_session(self.get_query_argument("session", ""))
        name, most = self.get_query_argument("name", "file"), self.server.settings.max_upload
        self.request.connection.set_max_body_size(int(most))  # type: ignore[union-attr]
        if not session.allowance.take():
            raise HTTPError(429, reason="Too many files at once: wait a moment")
        length = self.request.headers.get("Content-Length", "")
        if not (length.isascii() and length.isdigit()):
            raise HTTPError(411, reason="The size of the file must be stated first")
        if len(length) > _MOST_DIGITS or int(length) > most:
            raise HTTPError(413, reason=f"The file is larger than {most / 1e6:g} MB")
        self.note(Stage.BRINGS)
        self._files, self._digest = session.files, sha256()
        self._is_full = not self.server.has_room(int(length))
        if not self._is_full:
            try:
                self._upload = session.files.new(name, int(length))
                self._file = self._upload.path.open("r+b")
            except OSError:
                self._give_up(is_full=True)

    def data_received(self, chunk: bytes) -> None:
        """Write what has come, as long as somebody wants it."""
        if self._upload is None or self._file is None:
            return
        try:
            self._file.write(chunk)
            self._digest.update(chunk)
        except OSError:
            self._give_up(is_full=True)
        else:
            if self._upload.key not in self._files.uploads:
                self._give_up()

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
        if self._upload is None:
            raise HTTPError(410, reason="The page of this file is closed, or sent too many files")
        upload, self._upload = self._upload, None  # the file is whole, and stays
        upload.digest = self._digest.hexdigest()[:_DIGEST_LETTERS]
        self.finish({"file": upload.key, "name": upload.name, "digest": upload.digest})

    def on_finish(self) -> None:
        """Delete what came of a file that was refused or could not be written."""
        self._give_up()

    def on_connection_close(self) -> None:
        """Delete what came of a file that was broken off."""
        super().on_connection_close()
        self._give_up()

    def _give_up(self, *, is_full: bool = False) -> None:
        """Delete what has come, unless it is whole."""
        self._is_full = self._is_full or is_full
        if self._file is not None:
            with suppress(OSError):
                self._file.close()
        if self._upload is not None:
            self._files.forget(self._upload.key)
            self._upload = None


class _ResultFiles(Guarded):
    """Files that tasks have written for a page: reports, pictures, data."""

    async def get(self, token: str, name: str) -> None:
        """Send one, piece by piece."""
        folder = (self.known_session(token).files.folder / "results").resolve()
        path = (folder / name).resolve()
        if path.parent != folder or not path.is_file():
            raise HTTPError(404, reason="This file no longer exists: make it again")
        kind = mimetypes.guess_type(path.name)[0] or "application/octet-stream"
        self.set_header("Content-Type", kind)
        self.set_header("Content-Length", str(path.stat().st_size))
        self.set_header("Cache-Control", "no-store")
        if kind in _DOCUMENTS:
            self.set_header("Content-Security-Policy", _RESULTS_POLICY)
        if self.get_query_argument("save", ""):
            self.set_header("Content-Disposition", f'attachment; filename="{path.name}"')
        with suppress(StreamClosedError):  # the page wants it no more
            for piece in StaticFileHandler.get_content(str(path)):
                self.write(piece)
                await self.flush()


def _address_of_page(query: str) -> str:
    """The address of the page with a query, less the token in it."""
    rest = [part for part in parse_qsl(query, keep_blank_values=True) if part[0] != "token"]
    return f"/?{urlencode(rest)}" if rest else "/"


def _own_page(address: str) -> str:
    """An address to go on to if it is the page's own; that of the bare page otherwise."""
    return address if _PAGE.fullmatch(address) else "/"
