"""Connections that keep the server waiting, or are too many: others are served all the same."""

import asyncio
import socket
import sys
import time
from contextlib import ExitStack, asynccontextmanager, contextmanager, suppress
from pathlib import Path

import psutil
import pytest
from tornado.netutil import bind_sockets
from tornado.web import Application

from lab.server.serving import Lab, becomes, run, running_lab, wait_until
from lab.server.test_resumed_sessions import Lane
from reference import patience
from roughline.lab.server import connections
from roughline.lab.server.connections import Connections, most_connections
from roughline.lab.server.handlers import application
from roughline.lab.server.sessions import Server
from roughline.lab.server.settings import ServerSettings
from roughline.lab.site import site

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="limits of Unix")
linux = pytest.mark.skipif(sys.platform != "linux", reason="addresses and limits of Linux")
HALF = b"GET / HTTP/1.1\r\nHo"
PATIENT = (  # nobody has a place because others have waited too long
    "from roughline.lab.server import connections",
    "connections._REQUEST_WITHIN = 1e9",
)
FAILING = (
    "import json",
    "from roughline.lab.site import TASKS",
    "from roughline.lab.server.tasks import Place",
    "TASKS['fails'] = Place(json.loads, 'no JSON', is_quick=True)",
)


@pytest.fixture(scope="module", autouse=True)
def many_files():
    """Let the attackers in this process open as many files as the system allows."""
    import resource

    before, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    yield
    resource.setrlimit(resource.RLIMIT_NOFILE, (before, most))


@pytest.fixture(scope="module")
def small_lab(tmp_path_factory):
    """A lab that may open few files, and has a task that fails."""
    temporary = tmp_path_factory.mktemp("small")
    with running_lab(temporary=temporary, files=256, statements=PATIENT + FAILING) as running:
        yield running


def connected(lab, sent=b"", origin="127.0.0.1"):
    """Return a socket of an attacker that has sent something."""
    made = socket.create_connection(
        ("127.0.0.1", port(lab)), patience(), source_address=(origin, 0)
    )
    with suppress(ConnectionError):  # others have taken its place
        made.sendall(sent)
    return made


@contextmanager
def half_requests(lab, number, origins):
    """Hold connections of some addresses, each with half of a request."""
    with ExitStack() as held:
        for origin in origins:
            for _ in range(number):
                held.enter_context(connected(lab, HALF, origin))
        yield


def port(lab):
    """Where a lab listens."""
    return int(lab.address.rpartition(":")[2])


def held_by(lab):
    """Number of connections, and of files of sessions, that a lab has open."""
    process = psutil.Process(lab.process.pid)
    files = [each for each in process.open_files() if "roughline-lab-" in each.path]
    return len(process.net_connections()), len(files)


def is_at_rest(lab):
    """Whether the server computes nothing and writes nothing for a moment."""
    process = psutil.Process(lab.process.pid)
    before, written = sum(process.cpu_times()[:2]), lab.log.stat().st_size
    time.sleep(0.5)
    return (
        sum(process.cpu_times()[:2]) - before < 0.1
        and lab.log.stat().st_size - written < 200
        and lab.log.stat().st_size < 2000
    )


@pytest.mark.parametrize(
    ("number", "origins"),
    [
        (1000, ["127.0.0.1"]),
        pytest.param(1000, ["127.0.0.2"], marks=linux),
        pytest.param(60, [f"127.0.0.{last}" for last in range(2, 21)], marks=linux),
    ],
)
def test_a_page_is_served_while_others_hold_half_requests(small_lab, number, origins):
    async def scenario():
        async with small_lab.page() as open_before:
            with half_requests(small_lab, number, origins):
                assert (await small_lab.fetch("/")).code == 200
                async with small_lab.page() as page:
                    for each in (page, open_before):
                        await each.ask("explore.code", state={"n": "64"})
                        assert (await each.answer())[0] == 1
                assert sum(held_by(small_lab)) < 120
                wait_until(lambda: is_at_rest(small_lab))

    run(scenario)


@linux
def test_without_free_files_the_server_waits_and_then_goes_on(small_lab):
    import resource

    def allow(most):
        resource.prlimit(small_lab.process.pid, resource.RLIMIT_NOFILE, (most, 256))

    wait_until(lambda: is_at_rest(small_lab))
    taken = [int(each.name) for each in Path(f"/proc/{small_lab.process.pid}/fd").iterdir()]
    allow(max(taken) + 1)
    with ExitStack() as held:
        for _ in range(30):
            held.enter_context(connected(small_lab))
        wait_until(lambda: is_at_rest(small_lab))
    allow(256)
    run(lambda: served(small_lab))


def test_twenty_pages_of_one_address_have_room_where_the_system_lets_the_server_open_more_files():
    import resource

    before = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(256, before[1]), before[1]))
    try:
        most = most_connections(processes=26)
        now = resource.getrlimit(resource.RLIMIT_NOFILE)
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, before)
    assert now[1] == before[1]
    assert 2 * most < now[0] or most == 10
    if before[1] >= 1024:
        assert most // 2 > 20 * 6


async def served(lab):
    """Fail unless the page is answered."""
    assert (await lab.fetch("/")).code == 200


@linux
def test_a_proxy_may_have_all_connections_and_loses_none_to_those_who_come_around_it():
    async def scenario():
        sockets = bind_sockets(0, "127.0.0.1")
        server = Connections(Application([]), most=10, proxies=lambda peer: peer == "127.0.0.2")
        server.add_sockets(sockets)

        async def connected(number, origin):
            to = sockets[0].getsockname()
            return [
                await asyncio.open_connection(*to, local_addr=(origin, 0)) for _ in range(number)
            ]

        def still_open(streams):
            return sum(not reader.at_eof() for reader, _ in streams)

        proxied = await connected(8, "127.0.0.2")
        around = await connected(10, "127.0.0.1")
        await becomes(lambda: (still_open(proxied), still_open(around)) == (8, 2))
        proxied += await connected(2, "127.0.0.2")
        await becomes(lambda: (still_open(proxied), still_open(around)) == (10, 0))
        server.stop()
        for _, writer in proxied + around:
            writer.close()
        await server.close_all_connections()

    run(scenario)


def test_a_task_that_fails_again_and_again_is_told_a_few_times_and_fills_no_log(small_lab):
    """It comes last, since that lab is at rest only while its log is short."""

    async def scenario():
        told_before = small_lab.log.read_text().count("Traceback")  # by tests of the same lab
        async with small_lab.page() as page:
            for _ in range(100):
                await page.ask("fails")
                assert "reason that the lab does not know" in (await page.answer())[1]
        await becomes(lambda: small_lab.log.read_text().count("JSONDecodeError: ") == 5)
        assert small_lab.log.read_text().count("Traceback") == told_before + 5
        assert small_lab.log.stat().st_size < 10_000

    run(scenario)


WAITS, LEAST = 0.1, 10_000  # of the clock below [s]; bytes that have to move meanwhile


class Clock:
    """The time as connections see it: it goes on when a test says so, by how much it says."""

    def __init__(self):
        self.now = 0.0

    def monotonic(self):
        return self.now

    @asynccontextmanager
    async def going(self):
        """Let it go on by itself."""

        async def go():
            while True:
                self.now += WAITS / 20
                await asyncio.sleep(0.01)

        goes = asyncio.create_task(go())
        yield
        goes.cancel()


@pytest.fixture
def clock(monkeypatch):
    """The clock of a server in this process, which has little patience."""
    found = Clock()
    monkeypatch.setattr(connections, "time", found)
    for name, value in (
        ("_REQUEST_WITHIN", WAITS),
        ("_MOVED_INTERVAL", WAITS),
        ("_LEAST_SPEED", LEAST / WAITS),
    ):
        monkeypatch.setattr(connections, name, value)
    return found


@pytest.fixture
def came(monkeypatch):
    """How many bytes have come to a server in this process, piece by piece."""
    read, found = connections.Connection.read_from_fd, []

    def counted(self, buffer):
        count = read(self, buffer)
        found.append(count or 0)
        return count

    monkeypatch.setattr(connections.Connection, "read_from_fd", counted)
    return found


@asynccontextmanager
async def opened(folder):
    """A lab in this process without tasks, and its connections."""
    server = Server(site(), ServerSettings(), folder)
    server.quick, server.slow = Lane(), Lane()
    listening = Connections(application(server), most=100, proxies=lambda peer: False)
    sockets = bind_sockets(0, "127.0.0.1")
    listening.add_sockets(sockets)
    address = f"http://127.0.0.1:{sockets[0].getsockname()[1]}/?token={server.key.secret}"
    try:
        yield await asyncio.to_thread(Lab, address, None, folder, None, ""), listening
    finally:
        listening.stop()
        await listening.close_all_connections()
        await server.close()


def asked(lab, path, more=""):
    """The head of a request."""
    return f"GET {path} HTTP/1.1\r\n{lab.head}{more}\r\n".encode()


def posted(lab, path, length):
    """The head of a request that brings something."""
    return asked(lab, path, f"Content-Length: {length}\r\n").replace(b"GET", b"POST", 1)


def test_who_keeps_the_server_waiting_is_dropped(tmp_path, clock):
    async def seconds_open(lab, sent, drop=b""):
        """Time until the server closes a connection; what is sent drips on meanwhile."""
        began = clock.now
        reader, writer = await asyncio.open_connection("127.0.0.1", port(lab))
        writer.write(sent)
        reading = asyncio.create_task(reader.read())
        while not reading.done():
            writer.write(drop)
            await asyncio.wait([reading], timeout=0.01)
        with suppress(ConnectionError):
            await reading
        writer.close()
        return clock.now - began

    async def scenario():
        async with opened(tmp_path) as (lab, listening), lab.page() as page:
            upload = f"/upload?session={page.token}&name=stalls"
            handshake = asked(lab, "/link", "Upgrade: websocket\r\nConnection: Upgrade\r\n")[:-2]
            waited_for = [
                seconds_open(lab, b""),
                seconds_open(lab, HALF),
                seconds_open(lab, HALF, b"x"),
                seconds_open(lab, handshake, b"x"),
                seconds_open(lab, asked(lab, "/login")),
                seconds_open(lab, posted(lab, "/login", 5000), b"x"),
                seconds_open(lab, posted(lab, upload, 200_000)),
                seconds_open(lab, posted(lab, upload, 200_000), b"x"),
            ]
            async with clock.going():
                times = await asyncio.wait_for(asyncio.gather(*waited_for), patience())
            assert min(times) >= WAITS, times
            await becomes(lambda: len(listening._held) == 1)
            assert not any((tmp_path / page.token).iterdir())
            await page.say("is the page still open?")
            assert "not one of the lab" in (await page.answer())[1]

    run(scenario)


def test_who_does_not_read_is_dropped_and_who_is_slow_is_not(tmp_path, clock, came):
    large = 20_000_000

    async def begun(lab, head):
        reader, writer = await asyncio.open_connection("127.0.0.1", port(lab), limit=2**14)
        writer.write(head)
        return reader, writer

    async def read(reader):
        """Read what comes in small pieces, slowly; the number of bytes."""
        count = 0
        with suppress(ConnectionError):
            while piece := await reader.read(2**17):
                count += len(piece)
                clock.now += WAITS / 25
        return count

    async def scenario():
        async with opened(tmp_path) as (lab, listening), lab.page() as page:
            results = tmp_path / page.token / "results"
            results.mkdir(parents=True)
            (results / "large").write_bytes(bytes(large))
            download = asked(lab, f"/results/{page.token}/large", "Connection: close\r\n")
            reader, writer = await begun(lab, download)
            async with clock.going():
                await becomes(lambda: len(listening._held) == 1)  # of the page
            assert await read(reader) < large
            writer.close()
            reader, writer = await begun(lab, download)
            before = clock.now
            assert await read(reader) > large
            assert clock.now - before > 3 * WAITS
            writer.close()
            upload = posted(lab, f"/upload?session={page.token}&name=slow", 8 * LEAST)
            before, total = clock.now, sum(came) + len(upload)
            reader, writer = await begun(lab, upload)
            for _ in range(8):
                writer.write(bytes(LEAST))
                total += LEAST
                await becomes(lambda wanted=total: sum(came) >= wanted)
                clock.now += WAITS / 2
            assert b" 200 OK" in await reader.readline()
            assert clock.now - before > 3 * WAITS
            writer.close()

    run(scenario)
