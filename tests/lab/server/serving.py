"""A lab in a process of its own, and pages of it without a browser."""

import asyncio
import json
import logging
import os
import signal
import subprocess
import sys
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
    program = ["-c", "; ".join([*statements, "from roughline.cli import main", "main()"])]
    program = program if statements else ["-m", "roughline"]
    command = [sys.executable, *program, "lab", "--no-browser", "--port", "0", *options]
    log = Path(temporary) / "errors.txt"
    with (
        log.open("w") as errors,
        subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=errors,
            text=True,
            env=os.environ | {"TMPDIR": str(temporary)},
            preexec_fn=partial(_allow_files, files) if files else None,
        ) as process,
    ):
        try:
            first = process.stdout.readline()
            assert " at http" in first, first + log.read_text()
            lab = Lab(first.split(" at ")[1].split(" ")[0], process, Path(temporary), log, first)
            yield lab
        finally:
            process.send_signal(signal.SIGINT if closes else signal.SIGKILL)
            process.wait(patience())


def _allow_files(number):
    """Let this process open a number of files."""
    import resource

    resource.setrlimit(resource.RLIMIT_NOFILE, (number, number))


@contextmanager
def lab_here(temporary, **settings):
    """Run a lab with settings in a thread; its processes are forked from one for all such labs."""
    start_forking(warm_up, preloaded="roughline.lab.warm")
    folder, log = Path(temporary) / "roughline-lab-here", Path(temporary) / "errors.txt"
    folder.mkdir()
    settings = ServerSettings(**settings)
    errors, begun = logging.FileHandler(log), Future()
    errors.setLevel(logging.ERROR)

    async def serve():
        stopped, server = asyncio.Event(), Server(site(), settings, folder)
        sockets = bind_sockets(0, settings.host)
        listening = [asyncio.create_task(each) for each in taking(server, sockets)]
        address = f"http://127.0.0.1:{sockets[0].getsockname()[1]}/?token={server.token}"
        begun.set_result(
            (address, partial(asyncio.get_running_loop().call_soon_threadsafe, stopped.set))
        )
        await stopped.wait()
        for each in listening:
            each.cancel()
        await server.close()
        for each in sockets:
            each.close()

    logging.getLogger().addHandler(errors)
    with ThreadPoolExecutor(1) as thread:
        served = thread.submit(asyncio.run, serve())
        address, stop = begun.result(patience())
        try:
            yield Lab(address, None, Path(temporary), log, "")
        finally:
            stop()
            served.result(patience())
            logging.getLogger().removeHandler(errors)
            errors.close()
    assert not list(folder.iterdir())


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

    def __init__(self, address, process, temporary, log, first):
        self.opened, self.process, self.log, self.first = address, process, log, first
        self.address, self.cookie = entered(address)
        self.temporary = temporary

    @property
    def head(self):
        """Headers that every request of its own pages has, for `raw`."""
        host = self.address.partition("//")[2]
        return f"Host: {host}\r\nOrigin: {self.address}\r\nCookie: {self.cookie}\r\n"

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


def entered(address):
    """Open an address that may have a token; gives the bare one, and the cookie of the login."""
    parts = urlsplit(address)
    connection = HTTPConnection(parts.netloc, timeout=patience())
    connection.request("GET", f"/?{parts.query}")
    cookie = connection.getresponse().getheader("Set-Cookie", "").partition(";")[0]
    connection.close()
    return f"http://{parts.netloc}", cookie


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


def run(scenario):
    """Run a scenario."""
    asyncio.run(scenario())


async def upload(lab, token, content, name, origin=None):
    """Send a file as a page does."""
    return await lab.fetch(
        f"/upload?{urlencode({'session': token, 'name': name})}",
        method="POST",
        body=content,
        headers={"Origin": origin or lab.address},
    )


async def raw(lab, request):
    """Send bytes; returns what comes back first."""
    reader, writer = await asyncio.open_connection("127.0.0.1", lab.address.rpartition(":")[2])
    writer.write(request)
    said = await asyncio.wait_for(reader.read(2000), patience())
    writer.close()
    assert_tells_nothing(said)
    return said


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
