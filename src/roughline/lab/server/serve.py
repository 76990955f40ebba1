"""The server from its start to its end."""

from __future__ import annotations

import asyncio
import logging
import os
import signal
import socket
from collections.abc import Callable, Coroutine
from contextlib import ExitStack, suppress
from ipaddress import ip_address
from pathlib import Path
from typing import Any

from tornado.httpserver import HTTPServer
from tornado.iostream import IOStream
from tornado.netutil import bind_sockets

from roughline.errors import InputError
from roughline.errors.checks import refuse
from roughline.errors.words import called
from roughline.lab.server.files import folder_of_files
from roughline.lab.server.handlers import application
from roughline.lab.server.sessions import Server
from roughline.lab.server.settings import ServerSettings
from roughline.lab.server.tasks import Site

_WARM_WITHIN = 1.5  # that the first page waits for what it will need first [s]
_MOST_KNOCKING = 1024  # connections that wait to be taken
_REQUEST_WITHIN = 60.0  # that a connection has to bring its next request [s]
_PAUSE_WHEN_FULL = 1.0  # when no connection can be taken [s]
_MOST_BODY, _MOST_HEADERS = 2**16, 2**14  # of a request that brings no file [bytes]


def serve(
    site: Site,
    settings: ServerSettings,
    ready: Callable[[str], None],
    interrupted: Callable[[], bool],
) -> None:
    """Serve until Ctrl-C.

    `ready` is told the address of the page, with its token if it has one, as soon as it can be
    opened; `interrupted` says whether Ctrl-C came before the server listens to it.
    """
    logging.getLogger("tornado.general").setLevel(logging.ERROR)  # refusals are told to the page

    async def run(root: Path, sockets: list[socket.socket]) -> None:
        stopped = asyncio.Event()
        for name in ("SIGINT", "SIGTERM"):
            with suppress(NotImplementedError, AttributeError):  # Windows raises KeyboardInterrupt
                asyncio.get_running_loop().add_signal_handler(getattr(signal, name), stopped.set)
        server = Server(site, settings, root)
        listening = [asyncio.create_task(each) for each in taking(server, sockets)]
        preparing = asyncio.gather(server.quick.prepare(), server.slow.prepare())
        try:
            site.page()
            await asyncio.wait([preparing], timeout=_WARM_WITHIN)
            if not interrupted() and not stopped.is_set():
                ready(_address(server, sockets[0]))
                await stopped.wait()
        finally:
            for each in listening:
                each.cancel()
            await server.close()
            await preparing

    with suppress(KeyboardInterrupt), ExitStack() as opened:
        sockets = [opened.enter_context(each) for each in _listening(settings)]
        asyncio.run(run(opened.enter_context(folder_of_files()), sockets))


def taking(server: Server, sockets: list[socket.socket]) -> list[Coroutine[Any, Any, None]]:
    """What takes the connections that come, without end, for each socket.

    Where the system lets no further file be opened, as when somebody holds many connections, those
    wait that come; who is connected goes on.
    """
    served = HTTPServer(
        application(server),
        max_body_size=_MOST_BODY,
        max_header_size=_MOST_HEADERS,
        idle_connection_timeout=_REQUEST_WITHIN,
    )

    async def take(listening: socket.socket) -> None:
        while True:
            try:
                taken, name = await asyncio.get_running_loop().sock_accept(listening)
                served.handle_stream(IOStream(taken), name)
            except OSError:
                await asyncio.sleep(_PAUSE_WHEN_FULL)

    return [take(each) for each in sockets]


def _listening(settings: ServerSettings) -> list[socket.socket]:
    """Sockets on the address of the settings."""
    try:
        sockets = bind_sockets(settings.port, settings.host, backlog=_MOST_KNOCKING)
    except socket.gaierror:
        needed = "it is no address of this machine: give one, or 127.0.0.1 for this machine alone"
        refuse("host", settings.host, needed)
    except (OSError, UnicodeError) as error:
        why = os.strerror(error.errno) if isinstance(error, OSError) and error.errno else error
        raise InputError(
            f"cannot listen on {settings.host}, port {settings.port} ({why}): take another "
            f"{called('port')}, or 0 for any free one, and an address of this machine"
        ) from error
    found = {each.getsockname()[0] for each in sockets}
    if settings.is_local and not all(ip_address(each).is_loopback for each in found):
        for each in sockets:
            each.close()
        refuse("host", settings.host, "it leads to other machines here: give 127.0.0.1")
    return sockets


def _address(server: Server, listening: socket.socket) -> str:
    """The address of the page, with its token."""
    port, host = listening.getsockname()[1], server.settings.host
    host = {"0.0.0.0": "127.0.0.1", "::": "::1"}.get(host, host)
    here = f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"
    return f"{(server.settings.address or here).rstrip('/')}/?token={server.token}"
