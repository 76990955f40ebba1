"""The connections of the server: nobody holds one for ever, or too many of them."""

from __future__ import annotations

import asyncio
import logging
import socket
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterable
from contextlib import suppress
from enum import IntEnum
from typing import Any

from tornado.httpserver import HTTPServer
from tornado.httputil import HTTPConnection, HTTPMessageDelegate
from tornado.ioloop import PeriodicCallback
from tornado.iostream import IOStream

from roughline.lab.server.access import neighbourhood

_log = logging.getLogger(__name__)
# that the other side has to complete a request, from the connection or from the answer before [s]
_REQUEST_WITHIN = 20.0
_MOVED_INTERVAL = 60.0  # after which it is asked how much of a file, or of an answer, has moved [s]
_LEAST_SPEED = 1000.0  # at which it has to move on average over that time [bytes / s]
_PAUSE_WHEN_FULL = 1.0  # when no connection can be taken [s]
_MOST_BODY, _MOST_HEADERS = 2**16, 2**14  # of a request that brings no file [bytes]
_SEND_BUFFER = 2**17  # so that it is seen within a minute whether somebody reads [bytes]
_MOST_CONNECTIONS, _MOST_PER_ADDRESS = 2000, 200  # connections in all, and of one address
_PROXY = "proxy"  # what stands for the address of any proxy: it has no limit of its own
_FEWEST_CONNECTIONS = 10
_MOST_FILES = 4096  # that the process asks the system for
_OTHER_FILES, _FILES_PER_PROCESS = 64, 3  # that are no connections


class Stage(IntEnum):
    """What a connection is doing; the first ones are dropped first."""

    WAITS = 0  # for a request, or the rest of it
    BRINGS = 1  # a file
    IS_SERVED = 2
    IS_LINKED = 3  # the websocket of a page, which is never dropped for others


class Connection(IOStream):
    """One connection of an address, among all that are held, and how it gets on."""

    def __init__(self, taken: socket.socket, address: str, held: set[Connection]) -> None:
        super().__init__(taken)
        self.address, self._held = address, held
        held.add(self)
        self.enter(Stage.WAITS)

    def enter(self, stage: Stage) -> None:
        """Note what it does from now on."""
        self.stage, self.since = stage, time.monotonic()
        self._moved, self._counted = 0, self.since  # bytes, since when

    def read_from_fd(self, buf: bytearray | memoryview) -> int | None:
        """Read, and count; while an answer is sent, that alone counts."""
        count = super().read_from_fd(buf)
        self._moved += 0 if self.writing() else count or 0
        return count

    def write_to_fd(self, data: memoryview) -> int:
        """Write, and count."""
        count = super().write_to_fd(data)
        self._moved += count
        return count

    def close_fd(self) -> None:
        """Close."""
        super().close_fd()
        self._held.discard(self)

    def is_overdue(self) -> bool:
        """Whether the other side has kept the server waiting for too long."""
        now, moved = time.monotonic(), self._moved
        if self.stage is Stage.WAITS:
            return now - self.since > _REQUEST_WITHIN
        has_to_move = self.writing() or self.stage is Stage.BRINGS
        is_time = now - self._counted >= _MOVED_INTERVAL
        if is_time or not has_to_move:
            self._moved, self._counted = 0, now
        return has_to_move and is_time and moved < _LEAST_SPEED * _MOVED_INTERVAL


class Connections(HTTPServer):
    """Takes connections up to a number, and drops those that keep it waiting.

    `proxies` says whether an address is that of a proxy, through which many visitors come: all
    connections may be its own, and none is closed for those who do not come through it.
    """

    def initialize(  # type: ignore[override]
        self, application: Any, most: int, proxies: Callable[[str], bool]
    ) -> None:
        """Begin without connections."""
        super().initialize(application, max_body_size=_MOST_BODY, max_header_size=_MOST_HEADERS)
        self._most, self._most_per_address = most, max(1, min(_MOST_PER_ADDRESS, most // 2))
        self._proxies = proxies
        self._held: set[Connection] = set()
        self._sweep = PeriodicCallback(self._drop_overdue, 250 * min(4.0, _REQUEST_WITHIN))

    def add_sockets(self, sockets: Iterable[socket.socket]) -> None:
        """Listen."""
        self._listening = [asyncio.ensure_future(self._listen(each)) for each in sockets]
        self._sweep.start()

    def stop(self) -> None:
        """Listen no more."""
        self._sweep.stop()
        for each in self._listening:
            each.cancel()

    def start_request(self, server_conn: Any, request_conn: HTTPConnection) -> HTTPMessageDelegate:
        """Wait for the next request of a connection."""
        server_conn.stream.enter(Stage.WAITS)
        return super().start_request(server_conn, request_conn)

    def on_close(self, server_conn: Any) -> None:
        """Note that a connection brings no more requests: it is closed, or a websocket now."""
        super().on_close(server_conn)
        server_conn.stream.enter(Stage.IS_LINKED)

    async def _listen(self, listening: socket.socket) -> None:
        """Take the connections that come; after a failure, go on a little later."""
        with listening:
            while True:
                await asyncio.sleep(0)  # others are served between two of them
                try:
                    taken, name = await asyncio.get_running_loop().sock_accept(listening)
                    self._take(taken, name)
                except ConnectionError:  # it was given up meanwhile
                    continue
                except Exception as error:  # such as no free descriptor, or no memory
                    _log.warning("no connection can be taken for a moment: %s", error)
                    await asyncio.sleep(_PAUSE_WHEN_FULL)

    def _take(self, taken: socket.socket, name: tuple[Any, ...]) -> None:
        """Begin with a connection if there is a place for it."""
        address = _PROXY if self._proxies(name[0]) else neighbourhood(name[0])
        if not self._has_place(address):
            taken.close()
            return
        with suppress(OSError):
            taken.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _SEND_BUFFER)
        self.handle_stream(Connection(taken, address, self._held), name)

    def _has_place(self, address: str) -> bool:
        """Whether an address may have one more connection; another one may have to go for it."""
        numbers = Counter(each.address for each in self._held if each.address != _PROXY)
        own = numbers[address]
        if own >= self._most_per_address:
            return self._drop(address, Stage.WAITS)
        if len(self._held) < self._most:
            return True
        greedier = [each for each, number in numbers.most_common() if number > own]
        return any(self._drop(each, Stage.IS_SERVED) for each in greedier) or (
            self._drop(address, Stage.WAITS)
        )

    def _drop(self, address: str, last: Stage) -> bool:
        """Close the oldest connection in the first stage that there is; whether one was closed."""
        may_go = [each for each in self._held if each.address == address and each.stage <= last]
        if may_go:
            min(may_go, key=lambda each: (each.stage, each.since)).close()
        return bool(may_go)

    def _drop_overdue(self) -> None:
        for connection in [each for each in self._held if each.is_overdue()]:
            connection.close()


def most_connections(processes: int) -> int:
    """How many connections leave descriptors for the files they read, and for processes.

    The number of files that this process may open is raised where the system lets it.
    """
    files = 512  # sockets that a loop can wait for on Windows
    if sys.platform != "win32":
        import resource

        limits = resource.getrlimit(resource.RLIMIT_NOFILE)
        unlimited = resource.RLIM_INFINITY
        files, most = (_MOST_FILES if each == unlimited else each for each in limits)
        if files < (wanted := min(most, _MOST_FILES)):
            with suppress(ValueError, OSError):  # the system has a limit of its own
                resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, limits[1]))
                files = wanted
    others = _OTHER_FILES + _FILES_PER_PROCESS * processes
    return max(_FEWEST_CONNECTIONS, min(_MOST_CONNECTIONS, (files - others) // 2))
