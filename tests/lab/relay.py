"""A relay between a browser and a lab, as a network is one: it can drop, and lead elsewhere."""

import asyncio
import threading
from contextlib import suppress
from urllib.parse import urlsplit

from reference import patience


class Relay:
    """Hands bytes on to a lab.

    Attributes
    ----------
    address : str
        Of the page, through the relay.
    """

    def __init__(self, address):
        self._open, self._tasks, self._is_down = set(), set(), False
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, daemon=True)
        self._thread.start()
        self._server = self._call(asyncio.start_server(self._relay, "127.0.0.1", 0))
        self.lead_to(address)
        self.address = self.through(address)

    def through(self, address):
        """The same address through the relay."""
        port = self._server.sockets[0].getsockname()[1]
        return urlsplit(address)._replace(netloc=f"127.0.0.1:{port}").geturl()

    def lead_to(self, address):
        """Hand on to another lab from now on."""
        self._port = urlsplit(address).port

    def drop(self):
        """Cut all connections, and let none come."""
        self._is_down = True
        self._call(self._cut())

    def restore(self):
        """Let connections come again."""
        self._is_down = False

    def close(self):
        """Cut all, and stop."""
        self.drop()
        self._server.close()
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()

    def _call(self, doing):
        return asyncio.run_coroutine_threadsafe(doing, self._loop).result(patience())

    async def _cut(self):
        for writer in self._open:
            writer.transport.abort()
        await asyncio.gather(*self._tasks)

    async def _relay(self, reader, writer):
        task = asyncio.current_task()
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        if self._is_down:
            writer.transport.abort()
            return
        there, back = await asyncio.open_connection("127.0.0.1", self._port)
        if self._is_down:  # since it was asked for
            writer.transport.abort()
            back.transport.abort()
            return
        self._open |= {writer, back}
        await asyncio.gather(self._pass(reader, back), self._pass(there, writer))
        self._open -= {writer, back}

    async def _pass(self, reader, writer):
        with suppress(OSError):
            while piece := await reader.read(2**16):
                writer.write(piece)
                await writer.drain()
        writer.close()
