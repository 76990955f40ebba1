"""What is let loose on a lab: sockets, sessions and requests that mean no good, drawn at random.

Each kind comes from addresses of its own of this machine, which Linux has as many of as one likes.
"""

import asyncio
import json
import socket
from contextlib import suppress
from io import BytesIO
from urllib.parse import urlencode

import numpy as np

from mutated_questions import SLOW, STATES, mutated
from roughline.lab.site import TASKS

CROWDS = {"127.0.0.11": 350, "127.0.0.12": 350, "127.0.0.13": 150, "127.0.0.14": 150}
"""How many of 1,000 sockets come from each address."""
PAGES_FROM, REQUESTS_FROM = "127.0.0.21", "127.0.0.31"
_KEY = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
_UPGRADE = f"Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n{_KEY}"
_SLOTS = 8  # of a page, so that questions replace each other
_PATIENCE = 300  # until the last answers are there [s]
_MESSAGES = (
    *("", "no json", "[]", "7", "[" * 30_000, '{"id": 1' + "0" * 9000 + "}", '{"id": 1e999}'),
    *('{"id": 1, "slot": "", "task": 5}', '{"id": {}, "slot": "s", "task": {"a": []}}'),
    *(json.dumps({"slot": "0", "stop": True}), json.dumps({"forget": True, "slot": "f"})),
)


class Lab:
    """The lab that is attacked, with headers of its own pages, and counts of what was done."""

    def __init__(self, address, cookie, counts):
        self.host = address.removeprefix("http://")
        self.port = int(self.host.rpartition(":")[2])
        self.stranger = f"Host: {self.host}\r\nOrigin: {address}\r\n"
        self.head = f"{self.stranger}Cookie: {cookie}\r\n"
        self.counts = counts

    async def connect(self, source, *, reads=True):
        """Open a connection from an address of this machine."""
        made = socket.socket()
        made.setblocking(False)
        if not reads:
            made.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        try:
            made.bind((source, 0))
            await asyncio.get_running_loop().sock_connect(made, ("127.0.0.1", self.port))
            return await asyncio.open_connection(sock=made, limit=2**16 if reads else 1)
        except BaseException:
            made.close()
            raise


class Crowd:
    """A share of 1,000 sockets, each held open by the next one as soon as the lab closes it."""

    def __init__(self, lab, share):
        self.lab, self.share, self.is_over = lab, share, asyncio.Event()
        host, own = lab.host, lab.stranger
        unread = f"GET /bokeh/bokeh.min.js HTTP/1.1\r\n{own}\r\n" * 20
        shake = f"GET /link HTTP/1.1\r\n{own}{_UPGRADE}"
        self.kinds = {
            "says nothing": "",
            "half a request line": "GET /lab/la",
            "half of the headers": f"GET / HTTP/1.1\r\nHost: {host}\r\nX-Half",
            "a byte a second": f"GET / HTTP/1.1\r\nHost: {host}\r\nX-Slow: ",
            "half of a body": f"POST /login HTTP/1.1\r\n{own}Content-Length: 999\r\n\r\nhalf",
            "half of a handshake": shake,
            "a handshake of a stranger": f"{shake}\r\n",
            "asks for a megabyte 20 times and reads none": unread,
            "another protocol": "\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03",
        }

    async def run(self):
        kinds = list(self.kinds.items())
        sources = [each for each, count in CROWDS.items() for _ in range(round(count * self.share))]
        held = (self._hold(each, *kinds[i % len(kinds)]) for i, each in enumerate(sources))
        await asyncio.gather(*held)

    async def _hold(self, source, kind, said):
        while not self.is_over.is_set():
            self.lab.counts[kind] += 1
            with suppress(OSError):
                await self._hold_one(source, kind, said)
            await self._pause(1)

    async def _hold_one(self, source, kind, said):
        reader, writer = await self.lab.connect(source, reads="reads none" not in kind)
        try:
            writer.write(said.encode("latin-1"))
            while not (self.is_over.is_set() or writer.transport.is_closing()):
                if kind == "a byte a second":
                    writer.write(b"x")
                if "reads none" not in kind and reader.at_eof():
                    break
                if "reads none" not in kind:
                    with suppress(TimeoutError):
                        await asyncio.wait_for(reader.read(2**16), 0.01)
                await self._pause(1)
        finally:
            writer.transport.abort()

    async def _pause(self, seconds):
        with suppress(TimeoutError):
            await asyncio.wait_for(self.is_over.wait(), seconds)


class Page:
    """A page that asks mutated questions and brings files; chance draws them and how it ends."""

    def __init__(self, lab, chance):
        self.lab, self.chance, self.token, self.file = lab, chance, "", "key"
        self.number, self.unanswered = 0, {}
        self.reader = self.writer = self.reading = None

    async def live(self, messages, seconds):
        """Send so many messages over some time, and go."""
        end = self.chance.choice(("answered", "closed", "left", "dropped", "resumed", "unheard"))
        try:
            if not await self.open():
                return
            for number in range(messages):
                await asyncio.sleep(self.chance.expovariate(messages / seconds))
                if end == "resumed" and number == messages // 2:
                    await self.close("dropped")
                    await asyncio.sleep(self.chance.uniform(0, 5))
                    await self.open()
                if self.chance.random() < 0.02:
                    await self.bring()
                self.say()
                await self.writer.drain()
            await self.close(end)
        except OSError:
            self.lab.counts["pages that lost their line"] += 1
        finally:
            await self.close("dropped")

    async def open(self):
        """Open the websocket, with the token of the session before; whether there is a place."""
        self.reader, self.writer = await self.lab.connect(PAGES_FROM)
        query = f"?session={self.token}" if self.token else ""
        self.writer.write(f"GET /link{query} HTTP/1.1\r\n{self.lab.head}{_UPGRADE}\r\n".encode())
        try:
            head = await self.reader.readuntil(b"\r\n\r\n")
            kind, said = await self._frame() if b" 101 " in head else (8, b"")
        except asyncio.IncompleteReadError:
            kind, said = 8, b""
        if kind != 1:
            self.lab.counts["pages that were refused"] += 1
            return False
        told = json.loads(said)
        if not self.token:
            self.lab.counts["sessions"] += 1
        elif told["session"] == self.token:
            self.lab.counts["sessions resumed"] += 1
        else:
            self.lab.counts["sessions gone when their page came back"] += 1
        self.token = told["session"]
        self.reading = asyncio.create_task(self._read())
        return True

    def say(self):
        self.lab.counts["messages"] += 1
        if self.chance.random() < 0.05:
            self._send(1, self.chance.choice(_MESSAGES).encode())
            return
        task = self.chance.choice(list(TASKS))
        if task in SLOW and self.chance.random() < 0.8:
            task = "explore.coarse"
        state = STATES[task.partition(".")[0]]
        if "file" in state:
            state = state | {"file": self.file}
        self.number += 1
        slot = str(self.chance.randrange(_SLOTS))
        self.unanswered[slot] = self.number
        said = {"id": self.number, "slot": slot, "task": task}
        self._send(1, json.dumps({**said, "arguments": mutated(self.chance, state)}).encode())

    async def bring(self):
        """Send a file over a connection of its own: whole, cut off, or no topography at all."""
        content = self.chance.choice(_files())
        sent = content[: self.chance.choice((len(content), len(content) // 2))]
        query = urlencode({"session": self.token, "name": self.chance.choice(("a.npy", "b.xyz"))})
        head = f"POST /upload?{query} HTTP/1.1\r\n{self.lab.head}Content-Length: {len(content)}"
        said = await _asked(self.lab, PAGES_FROM, f"{head}\r\n\r\n".encode() + sent)
        self.lab.counts["files brought" if b" 200 " in said else "files broken off or refused"] += 1
        if b" 200 " in said:
            self.file = json.loads(said[said.index(b"{") :])["file"]

    async def close(self, end):
        """End: politely, by leaving, by a broken line, or by not reading any more."""
        if self.writer is None:
            return
        if end in ("answered", "resumed"):
            await self._until_answered()
        if end == "unheard":
            self.reading.cancel()
            await asyncio.sleep(30)  # the server asks whether it is there every 20 s
        elif end != "dropped":
            self._send(8, (1001 if end == "left" else 1000).to_bytes(2, "big"))
            with suppress(TimeoutError):
                await asyncio.wait_for(self.reading, 5)
        self.writer.transport.abort()
        if self.reading is not None:
            self.reading.cancel()
        self.writer = None

    async def _until_answered(self):
        """Wait for the last question of each slot, which nothing has replaced."""
        for slot in range(_SLOTS):  # which also ends what was withdrawn
            self.number += 1
            self.unanswered[str(slot)] = self.number
            said = {"id": self.number, "slot": str(slot), "task": "explore.code"}
            self._send(1, json.dumps({**said, "arguments": {"state": {}}}).encode())
        for _ in range(_PATIENCE):
            if not self.unanswered or self.reading.done():
                break
            await asyncio.sleep(1)
        is_lost = bool(self.unanswered) and not self.reading.done()
        self.lab.counts["pages that waited in vain" if is_lost else "pages answered"] += 1

    async def _read(self):
        """Read what comes, and answer the server's pings."""
        with suppress(asyncio.IncompleteReadError, OSError):
            while True:
                kind, said = await self._frame()
                if kind == 8:
                    return
                if kind == 9:
                    self._send(10, said)
                elif kind == 2 or (kind == 1 and b'"error"' in said):
                    whose = int.from_bytes(said[:8], "little") if kind == 2 else 0
                    self._answered(whose or json.loads(said)["id"], kind == 2)

    def _answered(self, number, is_answer):
        self.lab.counts["answers" if is_answer else "refusals"] += 1
        for slot in [each for each, asked in self.unanswered.items() if asked == number]:
            del self.unanswered[slot]

    async def _frame(self):
        """The next frame of the server: its kind and content."""
        first, length = await self.reader.readexactly(2)
        if length > 125:
            size = {126: 2, 127: 8}[length]
            length = int.from_bytes(await self.reader.readexactly(size), "big")
        return first & 15, await self.reader.readexactly(length)

    def _send(self, kind, content):
        self.writer.write(_framed(kind, content))


class Requests:
    """Requests of which path, method, headers and body are mutated."""

    def __init__(self, lab, chance):
        self.lab, self.chance = lab, chance

    async def send(self):
        said = await _asked(self.lab, REQUESTS_FROM, self._drawn())
        status = said.partition(b"\r\n")[0].split(b" ")
        answered = f"{status[1][:1].decode(errors='replace')}xx" if len(status) > 1 else "no answer"
        self.lab.counts[f"requests: {answered}"] += 1
        self.lab.counts["requests"] += 1

    def _drawn(self):
        choose = self.chance.choice
        path, method = choose(_paths()), choose(_METHODS)
        head = choose((self.lab.head, self.lab.head, self.lab.stranger, ""))
        for _ in range(self.chance.randrange(4)):
            head += f"{choose(_HEADERS)}: {choose(_HEADER_TEXTS)}\r\n"
        body = choose(_BODIES)
        if self.chance.random() < 0.7:
            head += f"Content-Length: {len(body)}\r\n"
        if path.startswith("/link"):
            frames = [_framed(choose(range(16)), choose(_FRAMES)) for _ in range(3)]
            head, body = head + _UPGRADE, b"".join(frames)
        request = f"{method} {path} {choose(_VERSIONS)}\r\n{head}\r\n".encode("latin-1", "replace")
        request += body
        if self.chance.random() < 0.1:
            flipped = {self.chance.randrange(len(request)) for _ in range(5)}
            request = bytes(b ^ 1 << i % 8 if i in flipped else b for i, b in enumerate(request))
        return request[: self.chance.choice((len(request), len(request), len(request) // 2))]


_METHODS = ("GET", "GET", "POST", "POST", "HEAD", "PUT", "DELETE", "OPTIONS", "TRACE", "FOO", "")
_VERSIONS = (*4 * ("HTTP/1.1",), "HTTP/1.0", "HTTP/2.0", "HTTP/9", "")
_HEADERS = (
    *("Host", "Origin", "Cookie", "Content-Length", "Content-Type", "Transfer-Encoding", "Expect"),
    *("Range", "If-Modified-Since", "If-None-Match", "Connection", "Upgrade", "Content-Encoding"),
    *("Sec-WebSocket-Key", "Sec-WebSocket-Version", "Sec-WebSocket-Extensions", "X-Real-IP"),
    *("X-Forwarded-For", "X-Forwarded-Proto", "Forwarded", "Authorization", "Referer", "", "X y"),
)
_HEADER_TEXTS = (
    *("", "null", "localhost", "http://[", "[::1", "127.0.0.1:999999", "\0", "\xff", "9" * 5000),
    *("-1", "10", "5, 5", "0x5", "²", "chunked", "gzip, chunked", "bytes=0-1,2-3", "bytes=a-b"),
    *("bytes=" + "9" * 400 + "-", "Mon, 99 Jan 2020 99:99:99 GMT", "*", 'W/"', "100-continue"),
    *("multipart/form-data", "multipart/form-data; boundary=a", "application/json", "close"),
    *("roughline_lab=2|1:0|10:1|1:a|1:a|a", "roughline_lab=" + "x" * 3000, "=;=;", 'a="', "https"),
    *("permessage-deflate; client_max_window_bits=99", "1.2.3.4, 5.6.7.8", "::1%eth0", "x" * 9000),
)
_BODIES = (
    *(b"", b"password=a", b"password=%ff&next=%ff", b"password=" + b"a" * 60_000, b"\xff" * 100),
    *(b"--a\r\nContent-Disposition: form-data; name=x\r\n\r\nx\r\n--a--\r\n", b"--a\r\n\r\n--a--"),
    *(b"5\r\nhello\r\n0\r\n\r\n", b"zz\r\n", b"&" * 3000, b"x" * 100_000),
)
_FRAMES = (b"", b"x", b"\xff\xfe", b"{}", b"[" * 3000, b"x" * 200, b"\x03\xe8bye", b"\0\1")


def _paths():
    """Every route of the lab, and some that it has not."""
    tokens = ("", "x", "%00", "a" * 2000)
    return [
        *("/", "/login", "/logout", "/link", "/upload", "/here", "/lab/lab.js", "/no"),
        *("/bokeh/bokeh.min.js", "/?%ff=%ff", "/?token=%ff&token=a", "/?" + "a=1&" * 3000, "*"),
        *("/here/..", "/lab/%00", "/lab/..%5c..", "/lab/" + "a" * 5000, "//", "/%", "/\x01", ""),
        *(f"/results/{token}/{name}" for token in tokens for name in ("a.nc", "..", "a" * 5000)),
        *(f"/upload?session={token}&name=%ff" for token in tokens),
        *(f"/link?session={token}" for token in tokens),
        *(f"/login?next={token}" for token in ("//evil.example", "%ff", "/?v=1")),
    ]


def _files():
    """Files: two topographies, one that declares more than it has, and one that is none."""
    contents = []
    for n in (16, 96):
        content = BytesIO()
        np.save(content, np.random.default_rng(n).normal(size=(n, n)) * 1e-6)
        contents.append(content.getvalue())
    declares = contents[0].replace(b"(16, 16), }      ", b"(20000, 20000), }")
    return [*contents, declares, np.random.default_rng(0).bytes(5000)]


def _framed(kind, content):
    """A frame of a websocket, as a browser sends it."""
    size = len(content)
    length = bytes([128 | size]) if size < 126 else bytes([128 | 126, *size.to_bytes(2, "big")])
    return bytes([128 | kind]) + length + bytes(4) + content


async def _asked(lab, source, request):
    """Send bytes; returns the beginning of what comes back, if it comes soon."""
    try:
        reader, writer = await lab.connect(source)
    except OSError:
        return b""
    try:
        writer.write(request)
        return await asyncio.wait_for(reader.read(4000), 1)
    except (OSError, TimeoutError):
        return b""
    finally:
        writer.transport.abort()
