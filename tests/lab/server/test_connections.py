"""Connections that keep the server waiting, or are too many: others are served all the same."""

import asyncio
import socket
import sys
import time
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import psutil
import pytest
from tornado.netutil import bind_sockets
from tornado.web import Application

from lab.server.serving import PATIENCE, becomes, run, running_lab, wait_until
from roughline.lab.server.connections import Connections, most_connections

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="limits of Unix")
linux = pytest.mark.skipif(sys.platform != "linux", reason="addresses and limits of Linux")
HALF = b"GET / HTTP/1.1\r\nHo"
SHORT = (
    "import json",
    "from roughline.lab.server import connections",
    "connections._PATIENCE, connections._STALL, connections._SPEED = 1, 1, 10_000",
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
    """A lab that may open few files."""
    with running_lab(temporary=tmp_path_factory.mktemp("small"), files=256) as running:
        yield running


@pytest.fixture(scope="module")
def hasty_lab(tmp_path_factory):
    """A lab that waits for a second instead of many."""
    with running_lab(temporary=tmp_path_factory.mktemp("hasty"), statements=SHORT) as running:
        yield running


def connected(lab, sent=b"", origin="127.0.0.1"):
    """Return a socket of an attacker that has sent something."""
    made = socket.create_connection(("127.0.0.1", port(lab)), 10, source_address=(origin, 0))
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
                began = time.monotonic()
                assert (await small_lab.fetch("/", connect_timeout=5)).code == 200
                async with small_lab.page() as page:
                    for each in (page, open_before):
                        await each.ask("explore.code", state={"n": "64"})
                        assert (await each.answer())[0] == 1
                assert time.monotonic() - began < 5
                assert sum(held_by(small_lab)) < 120
                assert is_at_rest(small_lab)

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


def test_a_task_that_fails_again_and_again_is_told_a_few_times_and_fills_no_log(hasty_lab):
    async def scenario():
        async with hasty_lab.page() as page:
            for _ in range(100):
                await page.ask("fails")
                assert "reason that the lab does not know" in (await page.answer())[1]
        await becomes(lambda: hasty_lab.log.read_text().count("TypeError: loads()") == 5)
        assert hasty_lab.log.read_text().count("Traceback") == 5
        assert hasty_lab.log.stat().st_size < 10_000

    run(scenario)


def test_who_keeps_the_server_waiting_is_dropped_and_who_is_slow_is_not(hasty_lab):
    lab, drip = hasty_lab, b"x"

    async def seconds_open(sent, drop=b""):
        """Time until the server closes a connection; what is sent drips on meanwhile."""
        began = time.monotonic()
        reader, writer = await asyncio.open_connection("127.0.0.1", port(lab))
        writer.write(sent)
        reading = asyncio.create_task(reader.read())
        while not reading.done() and time.monotonic() - began < PATIENCE:
            writer.write(drop)
            await asyncio.wait([reading], timeout=0.1)
        with suppress(ConnectionError):
            await reading
        writer.close()
        return time.monotonic() - began

    async def slow_upload(token):
        reader, writer = await asyncio.open_connection("127.0.0.1", port(lab))
        writer.write(posted(f"/upload?session={token}&name=slow", 20 * 10_000))
        for _ in range(20):
            writer.write(bytes(10_000))
            await asyncio.sleep(0.2)
        assert b" 200 OK" in await reader.readline()
        writer.close()

    async def download(token, pause):
        """Read a large file in small pieces, or none of it; the number of bytes that came."""
        reader, writer = await asyncio.open_connection("127.0.0.1", port(lab), limit=2**14)
        writer.write(asked(f"/results/{token}/large"))
        count = 0
        if pause:
            await asyncio.sleep(pause)
        with suppress(ConnectionError):
            while piece := await reader.read(2**17):
                count += len(piece)
                await asyncio.sleep(0.002)
        writer.close()
        return count

    def asked(path, more=""):
        return f"GET {path} HTTP/1.1\r\n{lab.head}{more}\r\n".encode()

    def posted(path, length):
        return asked(path, f"Content-Length: {length}\r\n").replace(b"GET", b"POST", 1)

    async def scenario():
        async with lab.page() as page:
            before = held_by(lab)
            results = lab.folder / page.token / "results"
            results.mkdir(parents=True)
            (results / "large").write_bytes(bytes(large := 40_000_000))
            upload = f"/upload?session={page.token}&name=stalls"
            handshake = asked("/link", "Upgrade: websocket\r\nConnection: Upgrade\r\n")[:-2]
            short = [
                seconds_open(b""),
                seconds_open(HALF),
                seconds_open(HALF, drip),
                seconds_open(handshake, drip),
                seconds_open(asked("/login")),
                seconds_open(posted("/login", 5000), drip),
                seconds_open(posted(upload, 200_000)),
                seconds_open(posted(upload, 200_000), drip),
            ]
            *times, unread, slow, _ = await asyncio.gather(
                *short, download(page.token, 4), download(page.token, 0), slow_upload(page.token)
            )
            assert all(0.5 < each < 3.5 for each in times), times
            assert unread < large < slow
            await becomes(lambda: held_by(lab) == before)
            await page.ask("explore.code", state={"n": "64"})
            assert (await page.answer())[0] == 1

    run(scenario)
