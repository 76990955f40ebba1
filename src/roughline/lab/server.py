"""The server of the lab: it hands questions to processes, and answers to pages."""

from __future__ import annotations

import asyncio
import os
import secrets
import signal
import socket
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets
from tornado.web import Application

from roughline.computing.fft import available_cores
from roughline.errors import InputError
from roughline.lab.access import Allowance
from roughline.lab.handlers import (
    Figures,
    Login,
    Page,
    Parts,
    Results,
    Uploads,
    bokeh_folder,
    static_folder,
)
from roughline.lab.lanes import Lane, Limits
from roughline.lab.link import MOST_BYTES, Link
from roughline.lab.process import start_forking
from roughline.lab.session import Session
from roughline.lab.settings import LabSettings

_QUICK = Limits(seconds=20.0, memory=1_000_000_000)
_PING = 20  # a page that does not answer within this time is gone [s]
_FIGURES = {
    "explore": ("explore.figures", "figures"),
    "measured": ("measured.figures", "figures"),
    "published": ("published.figures", "figures"),
    "bodies": ("published.body_figures", "figures"),
}
"""Sets of figures that a page embeds at once: module and function of each."""


class Lab:
    """What all requests share.

    Parameters
    ----------
    settings : LabSettings
        Of the server.
    root : Path
        Folder for the files of all sessions, which is deleted at the end.
    """

    def __init__(self, settings: LabSettings, root: Path) -> None:
        self.settings, self.root = settings, root
        self.sessions: dict[str, Session] = {}
        self.logins = Allowance(rate=5 / 60, most=5)
        cores = available_cores()
        self.quick = Lane(cores, _QUICK, lasting=True)
        slow = Limits(settings.max_seconds, settings.max_memory)
        self.slow = Lane(cores, slow, lasting=False)
        self._figures: dict[str, asyncio.Task[bytes]] = {}

    def application(self) -> Application:
        """The handlers, by address."""
        return Application(
            [
                (r"/", Page),
                (r"/login", Login),
                (r"/link", Link),
                (r"/upload", Uploads),
                (rf"/figures/({'|'.join(_FIGURES)})", Figures),
                (r"/results/([\w-]+)/([\w.-]+)", Results),
                (r"/lab/(.*)", Parts, {"path": str(static_folder())}),
                (r"/bokeh/(bokeh(?:-[a-z]+)?\.min\.js)", Parts, {"path": str(bokeh_folder())}),
            ],
            lab=self,
            cookie_secret=secrets.token_hex(32),
            websocket_max_message_size=MOST_BYTES,
            websocket_ping_interval=_PING,
            log_function=lambda handler: None,
        )

    def open_session(
        self, send: Callable[[dict[str, Any]], None], send_answer: Callable[[int, bytes], None]
    ) -> Session:
        """Begin a session."""
        session = Session(self.root, self.settings, self.quick, self.slow, send, send_answer)
        self.sessions[session.token] = session
        return session

    def close_session(self, session: Session) -> None:
        """End a session, and all that it has."""
        self.sessions.pop(session.token, None)
        session.close()

    async def figures_of(self, view: str) -> bytes:
        """The empty figures of a view, made once."""
        if view not in self._figures:
            self._figures[view] = asyncio.create_task(asyncio.to_thread(_figures, view))
        return await asyncio.shield(self._figures[view])

    def close(self) -> None:
        """End everything."""
        for session in list(self.sessions.values()):
            self.close_session(session)
        self.quick.close()
        self.slow.close()


def _figures(view: str) -> bytes:
    """The empty figures of a view."""
    module, function = _FIGURES[view]
    made: bytes = getattr(import_module(f"roughline.lab.{module}"), function)()
    return made


def serve(settings: LabSettings, ready: Callable[[str], None]) -> None:
    """Serve until Ctrl-C.

    Parameters
    ----------
    settings : LabSettings
        What to listen to, and the limits of a session.
    ready : callable
        Told the address of the page as soon as it can be opened.

    Raises
    ------
    InputError
        If the address is not free, or not one of this machine.
    """
    sockets = _listening(settings)
    with TemporaryDirectory(prefix="roughline-lab-") as root, suppress(KeyboardInterrupt):
        asyncio.run(_serve(settings, sockets, Path(root), ready))


async def _serve(
    settings: LabSettings, sockets: list[socket.socket], root: Path, ready: Callable[[str], None]
) -> None:
    lab = Lab(settings, root)
    server = HTTPServer(lab.application(), max_body_size=2**20)
    server.add_sockets(sockets)
    stopped = asyncio.Event()
    for name in ("SIGINT", "SIGTERM"):
        with suppress(NotImplementedError, AttributeError):  # Windows raises KeyboardInterrupt
            asyncio.get_running_loop().add_signal_handler(getattr(signal, name), stopped.set)
    try:
        ready(_address(settings, sockets[0]))
        figures = asyncio.create_task(lab.figures_of("explore"))
        await asyncio.to_thread(start_forking)
        await lab.quick.prepare()
        await lab.slow.prepare()
        await figures
        await stopped.wait()
    finally:
        server.stop()
        lab.close()


def _listening(settings: LabSettings) -> list[socket.socket]:
    """Sockets on the address of the settings."""
    try:
        return bind_sockets(settings.port, settings.host)
    except OSError as error:
        raise InputError(
            f"cannot listen on {settings.host}, port {settings.port} "
            f"({os.strerror(error.errno) if error.errno else error}): take another port=, or 0 "
            "for any free one"
        ) from error


def _address(settings: LabSettings, listening: socket.socket) -> str:
    """The address of the page."""
    port = listening.getsockname()[1]
    host = settings.host if ":" not in settings.host else f"[{settings.host}]"
    return f"http://{host}:{port}/"
