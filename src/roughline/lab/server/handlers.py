"""What is answered at which address: the page, its parts, uploads and downloads."""

from __future__ import annotations

import mimetypes
from contextlib import suppress
from hashlib import sha256
from importlib.metadata import distribution
from typing import BinaryIO
from urllib.parse import parse_qsl, urlencode

from tornado.iostream import StreamClosedError
from tornado.web import Application, HTTPError, StaticFileHandler, stream_request_body

from roughline.lab.server import files
from roughline.lab.server.access import cookie_name, cookie_scope, opens
from roughline.lab.server.files import Files, Upload
from roughline.lab.server.guarded import Guarded
from roughline.lab.server.link import MOST_BYTES, Link
from roughline.lab.server.sessions import Server

_PONG_WITHIN = 20  # a page that does not answer within this time is gone [s]
_MOST_DIGITS = 15  # of the size of a file that is to come
_DIGEST_LETTERS = 12  # letters of the digest by which a page knows a file again
_CACHED_FOR = 3600  # that a browser keeps the parts of the page [s]
_DAYS = 7  # that a browser keeps the token
_NO_ROOM = "The disk has no room for this file: make some, and choose it again"
_DOCUMENTS = ("text/html", "image/svg+xml", "application/xhtml+xml", "text/xml", "application/xml")
_RESULTS_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; sandbox"
"""Documents that tasks have written run no program, and load nothing."""


def application(server: Server) -> Application:
    """The handlers, by address."""
    bokeh = distribution("bokeh").locate_file("bokeh/server/static/js")
    return Application(
        [
            (r"/", _Page),
            (r"/here", _Here),
            (r"/link", Link),
            (r"/upload", _Uploads),
            (r"/results/([A-Za-z0-9_-]+)/([A-Za-z0-9_.-]{1,100})", _ResultFiles),
            (r"/lab/([\w./-]+)", _Parts, {"path": str(server.site.parts)}),
            (r"/bokeh/(bokeh(?:-[a-z]+)?\.min\.js)", _Parts, {"path": str(bokeh)}),
        ],
        default_handler_class=_Unknown,
        server=server,
        websocket_max_message_size=MOST_BYTES,
        websocket_ping_interval=_PONG_WITHIN,
        compress_response=True,
        log_function=lambda handler: None,
    )


class _Unknown(Guarded):
    """Any other address."""

    open_to_all = True

    def prepare(self) -> None:
        super().prepare()
        raise HTTPError(404, reason="unknown")


class _Page(Guarded):
    """The page itself, for who has the token; others are asked for it."""

    open_to_all = True

    def get(self) -> None:
        self.set_header("Cache-Control", "no-store")
        token = self.get_query_argument("token", None)
        if token is not None and not self.has_token:
            self._enter(token)
        elif token is not None:
            self.redirect(self._without_token)
        elif self.has_token:
            self.finish(self.server.site.page())
        else:
            self._ask_for_token(401, "")

    def post(self) -> None:
        self._enter(self.get_body_argument("token", ""))

    def _enter(self, attempt: str) -> None:
        """Let in who has the token, and go on; ask again otherwise."""
        # who pastes the whole address has it, too
        attempt = dict(parse_qsl(attempt.partition("?")[2])).get("token", attempt)
        if not opens(attempt, self.server.token):
            self._ask_for_token(403, "This is not the token of the lab that runs now.")
            return
        path, secure = cookie_scope(self.server.settings)
        self.set_cookie(
            cookie_name(self.request.host),
            self.server.token,
            expires_days=_DAYS,
            path=path,
            httponly=True,
            samesite="Lax",  # a link that leads here from elsewhere finds the browser known
            secure=secure,
        )
        self.redirect(self._without_token, status=303)

    def _ask_for_token(self, status: int, complaint: str) -> None:
        self.set_status(status)
        self.set_header("Referrer-Policy", "same-origin")  # "no-referrer" hides a form's origin
        self.finish(self.server.site.door(complaint))

    @property
    def _without_token(self) -> str:
        """The address of this page, less the token in it; behind a proxy it has a path before."""
        parts = parse_qsl(self.request.query, keep_blank_values=True)
        rest = [part for part in parts if part[0] != "token"]
        return f"./?{urlencode(rest)}" if rest else "./"


class _Here(Guarded):
    """Where a page asks whether the lab still knows its browser: no error, as a browser tells."""

    open_to_all = True

    def get(self) -> None:
        self.set_header("Cache-Control", "no-store")
        self.finish("known" if self.has_token else "unknown")


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
        name, most = self.get_query_argument("name", "file"), files.MOST_UPLOAD
        self.request.connection.set_max_body_size(most)  # type: ignore[union-attr]
        length = self.request.headers.get("Content-Length", "")
        if not (length.isascii() and length.isdigit()):
            raise HTTPError(411, reason="The size of the file must be stated first")
        if len(length) > _MOST_DIGITS or int(length) > most:
            raise HTTPError(413, reason=f"The file is larger than {most / 1e6:g} MB")
        self._files, self._digest = session.files, sha256()
        try:
            self._upload = self._files.new(name, int(length))
            self._file = self._upload.path.open("wb")
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
