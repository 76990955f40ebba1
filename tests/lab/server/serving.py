"""A lab in a process of its own, and pages of it without a browser."""

import asyncio
import json
import logging
import os
import signal
import time
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import asynccontextmanager, contextmanager, suppress
from functools import partial
from http.client import HTTPConnection
from pathlib import Path
from urllib.parse import urlencode, urlsplit

import psutil
from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.netutil import bind_sockets
from tornado.websocket import websocket_connect

from lab_in_browser import RunningLab
from reference import patience
from roughline.lab.server.process import start_forking
from roughline.lab.server.serve import taking
from roughline.lab.server.sessions import Server
from roughline.lab.server.settings import ServerSettings
from roughline.lab.site import site
from roughline.lab.tasks import warm_up


@contextmanager
def running_lab(*options, temporary, closes=True, files=None, statements=()):
    """Run a lab with options and a folder for its files; give its address, process and output.

    It may open a number of files, and does some statements before anything else.
    """
    lines = "; ".join([*statements, "from roughline.cli import main", "main()"])
    log = Path(temporary) / "errors.txt"
    running = RunningLab(
        log,
        *options,
        program=("-c", lines) if statements else ("-m", "roughline"),
        env=os.environ | {"TMPDIR": str(temporary)},
        preexec_fn=partial(_allow_files, files) if files else None,
    )
    try:
        yield Lab(running.address, running.process, Path(temporary), log)
    finally:
        running.close(signal.SIGINT if closes else signal.SIGKILL)


def _allow_files(number):
    """Let this process open a number of files."""
    import resource

    resource.setrlimit(resource.RLIMIT_NOFILE, (number, number))


@asynccontextmanager
async def opened(temporary, lanes=None, **settings):
    """A lab with settings in this process, and its server; its lanes may be those of a test."""
    folder = Path(temporary) / "roughline-lab-here"
    folder.mkdir()
    server = Server(site(), ServerSettings(**settings), folder)
    server.quick, server.slow = lanes or (server.quick, server.slow)
    sockets = bind_sockets(0, "127.0.0.1")
    listening = [asyncio.create_task(each) for each in taking(server, sockets)]
    address = f"http://127.0.0.1:{sockets[0].getsockname()[1]}/?token={server.token}"
    try:
        log = Path(temporary) / "errors.txt"
        yield await asyncio.to_thread(Lab, address, None, Path(temporary), log), server
    finally:
        for each in listening:
            each.cancel()
        await server.close()
        for each in sockets:
            each.close()
    await becomes(lambda: not list(folder.iterdir()))


@contextmanager
def lab_here(temporary, **settings):
    """Run a lab with settings in a thread; its processes are forked from one for all such labs."""
    start_forking(warm_up, preloaded="roughline.lab.warm")
    errors, begun = logging.FileHandler(Path(temporary) / "errors.txt"), Future()
    errors.setLevel(logging.ERROR)

    async def serve():
        stopped = asyncio.Event()
        stop = partial(asyncio.get_running_loop().call_soon_threadsafe, stopped.set)
        async with opened(temporary, **settings) as (lab, _):
            begun.set_result((lab, stop))
            await stopped.wait()

    logging.getLogger().addHandler(errors)
    with ThreadPoolExecutor(1) as thread:
        served = thread.submit(asyncio.run, serve())
        lab, stop = begun.result(patience())
        try:
            yield lab
        finally:
            stop()
            served.result(patience())
            logging.getLogger().removeHandler(errors)
            errors.close()


class Lab:
    """A running lab, asked by a browser that has opened the address with its token.

    Attributes
    ----------
    address : str
        Without the token, and without a slash at the end.
    opened : str
        As it was printed.
    cookie : str
        With the token.
    """

    def __init__(self, address, process, temporary, log):
        self.opened, self.process, self.temporary, self.log = address, process, temporary, log
        parts = urlsplit(address)
        self.address = f"http://{parts.netloc}"
        connection = HTTPConnection(parts.netloc, timeout=patience())
        connection.request("GET", f"/?{parts.query}")
        said = connection.getresponse().getheader("Set-Cookie", "")
        self.cookie = said.partition(";")[0]
        connection.close()

    async def connected(self, line, *headers):
        """Begin a request as pages of its own do; returns the reader and the writer."""
        host = self.address.partition("//")[2]
        reader, writer = await asyncio.open_connection(*host.split(":"))
        own = (f"Host: {host}", f"Origin: {self.address}", f"Cookie: {self.cookie}")
        writer.write("\r\n".join([f"{line} HTTP/1.1", *own, *headers, "", ""]).encode())
        return reader, writer

    @property
    def folder(self):
        """Where it keeps files."""
        (found,) = self.temporary.glob("roughline-lab-*")
        return found

    async def fetch(self, path, **options):
        """Ask by HTTP; returns the response, whatever its status."""
        limits = {"connect_timeout": patience(), "request_timeout": patience()}
        usual = {"follow_redirects": False, "decompress_response": False, **limits}
        options = usual | options
        options["headers"] = {"Cookie": self.cookie} | options.get("headers", {})
        request = HTTPRequest(f"{self.address}{path}", **options)
        response = await AsyncHTTPClient().fetch(request, raise_error=False)
        assert_tells_nothing(response.body)
        return response

    @asynccontextmanager
    async def page(self, headers=None, before=""):
        """Open a page; `before` is the token of the session that it had before."""
        query = f"?{urlencode({'session': before})}" if before else ""
        request = HTTPRequest(
            f"ws{self.address.removeprefix('http')}/link{query}",
            headers={"Cookie": self.cookie}
            | ({"Origin": self.address} if headers is None else headers),
        )
        socket = await websocket_connect(request, max_message_size=2**28)
        page = Page(socket)
        page.said = json.loads(await page.heard())
        page.token = page.said["session"]
        try:
            yield page
        finally:
            socket.close(1001, "left, as browsers say")
            while not page.is_closed and await page.heard() is not None:
                pass


class Page:
    """One page."""

    def __init__(self, socket):
        self.socket, self.number, self.is_closed = socket, 0, False

    async def heard(self):
        """Next message; None if the page is closed."""
        message = await asyncio.wait_for(self.socket.read_message(), patience())
        if message is None:
            self.is_closed = True
        else:
            assert_tells_nothing(message)
        return message

    async def say(self, text):
        """Send a text, or bytes."""
        await self.socket.write_message(text, binary=isinstance(text, bytes))

    async def forget(self):
        """Delete its files."""
        await self.say(json.dumps({"slot": "files", "forget": True}))

    def drop(self):
        """Be gone without a word."""
        self.socket.protocol.stream.close()

    async def ask(self, task, slot="slot", **arguments):
        """Send a question; returns its number."""
        self.number += 1
        said = {"id": self.number, "slot": slot, "task": task, "arguments": arguments}
        await self.say(json.dumps(said))
        return self.number

    async def answer(self):
        """Next answer or refusal: its number, and its header or the sentence."""
        while True:
            message = await self.heard()
            if isinstance(message, bytes):
                length = int.from_bytes(message[8:12], "little")
                return int.from_bytes(message[:8], "little"), json.loads(message[12 : 12 + length])
            said = json.loads(message)
            if "error" in said:
                return said["id"], said["error"]


def assert_tells_nothing(said):
    """Fail if an answer names a folder of the server, or a place in its program."""
    said = said if isinstance(said, bytes) else said.encode()
    for secret in (b"/tmp", b"Traceback", b"site-packages", b"roughline-lab-", b"/src/"):
        assert secret not in said, said[:2000]


def wait_until(is_so):
    """Wait until something is so, and fail if it does not become so."""
    end = time.monotonic() + patience()
    while not is_so():
        assert time.monotonic() < end
        time.sleep(0.01)


async def becomes(is_so):
    """Wait until something is so, while pages go on."""
    end = time.monotonic() + patience()
    while not is_so():
        assert time.monotonic() < end
        await asyncio.sleep(0.01)


async def upload(lab, token, content, name, origin=None):
    """Send a file as a page does."""
    return await lab.fetch(
        f"/upload?{urlencode({'session': token, 'name': name})}",
        method="POST",
        body=content,
        headers={"Origin": origin or lab.address},
    )


def alive(lab):
    """Processes of a lab that compute."""
    found = []
    for each in psutil.Process(lab.process.pid).children(recursive=True):
        with suppress(psutil.Error):  # it has ended meanwhile
            if "forkserver" in " ".join(each.cmdline()):
                found.append(each)
    return found[1:]  # the first is the one that the others are forked from


def alive_still(process):
    """Whether a process runs, and is not only waited for.

    The first of its threads may have ended before the others, which hold its pipes open.
    """
    try:
        ended = process.status() == psutil.STATUS_ZOMBIE and process.num_threads() <= 1
        return process.is_running() and not ended
    except (psutil.NoSuchProcess, psutil.ZombieProcess):
        return False


def held(lab):
    """Memory of the server, and of it with all its processes. [bytes]"""
    server = psutil.Process(lab.process.pid)
    children = 0
    for each in alive(lab):
        with suppress(psutil.Error):
            children += each.memory_full_info().uss
    return server.memory_info().rss, server.memory_full_info().uss + children
