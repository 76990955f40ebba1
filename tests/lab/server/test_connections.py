"""Connections that somebody holds half open: they may cost the page, never data or memory."""

import socket
import sys
import time
from contextlib import ExitStack
from pathlib import Path

import psutil
import pytest

from lab.server.serving import held, running_lab, upload, wait_until
from reference import patience

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="limits of Linux")
FILES = 160  # that the lab may open


@pytest.fixture(scope="module")
def small_lab(tmp_path_factory):
    """A lab that may open few files."""
    with running_lab(temporary=tmp_path_factory.mktemp("small"), files=FILES) as running:
        yield running


def half_open(lab, number):
    """Connections with half of a request each."""
    held_open, port = ExitStack(), int(lab.address.rpartition(":")[2])
    for _ in range(number):
        made = held_open.enter_context(socket.create_connection(("127.0.0.1", port), patience()))
        made.sendall(b"GET / HTTP/1.1\r\nHo")
    return held_open


async def test_while_all_places_are_held_an_open_page_goes_on_and_then_others_come(small_lab):
    process = psutil.Process(small_lab.process.pid)

    def is_at_rest():
        before = sum(process.cpu_times()[:2])
        time.sleep(0.5)
        return sum(process.cpu_times()[:2]) - before < 0.1

    async with small_lab.page() as page:
        await upload(small_lab, page.token, b"1 2", "a.txt")
        await page.ask("explore.code", state={"n": "64"})
        await page.answer()
        before = held(small_lab)[1]
        with half_open(small_lab, FILES):
            wait_until(lambda: len(process.net_connections()) > FILES // 2)
            wait_until(is_at_rest)
            for number in (2, 3):
                await page.ask("explore.code", state={"n": "64"})
                assert (await page.answer())[0] == number
            assert held(small_lab)[1] - before < 40e6
            assert len(list(Path(small_lab.folder, page.token).iterdir())) == 1
        wait_until(lambda: len(process.net_connections()) < 10)
        assert (await small_lab.fetch("/")).code == 200
    assert small_lab.log.stat().st_size < 2000
