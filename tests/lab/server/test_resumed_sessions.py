"""Sessions that wait for their pages: what goes on, and how long."""

import json
import sys

import pytest

from lab.server.serving import becomes, opened, upload
from roughline.lab.server import sessions
from roughline.lab.server.tasks import TaskOutcome

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")


class Lane:
    """Takes requests, and answers them when a test says so."""

    def __init__(self):
        self.requests, self.withdrawn, self.renewed = [], [], 0

    def submit(self, request):
        self.requests.append(request)

    def withdraw(self, session, slot=None):
        self.withdrawn.append((session, slot))
        return []

    def renew(self):
        self.renewed += 1

    async def close(self):
        pass


@pytest.fixture(autouse=True)
def _sweeps(monkeypatch):
    """Look often for what is over."""
    monkeypatch.setattr(sessions, "_SWEEP_INTERVAL", 0.02)


async def dropped(server, page):
    """Drop the line of a page, and wait until the server knows."""
    page.drop()
    await becomes(lambda: getattr(server.sessions.get(page.token), "line", None) is None)


async def test_what_runs_while_the_line_is_down_is_answered_after_it_and_not_done_twice(tmp_path):
    async with opened(tmp_path, (Lane(), Lane())) as (lab, server):
        async with lab.page() as page:
            assert page.said["resumed"] is False
            await upload(lab, page.token, b"1 2", "a.txt")
            for slot in ("ended", "running", "changed"):
                await page.ask("measured.answer", slot, state={"loads": slot})
            await becomes(lambda: len(server.slow.requests) == 3)
            await dropped(server, page)
            ended, running, _ = server.slow.requests
            running.progress(1, 2)
            ended.answer(TaskOutcome(error="answered while nobody heard"))
        async with lab.page(before=page.token) as again:
            assert again.said["session"] == page.token
            assert again.said["resumed"] is True
            ((_, file),) = again.said["files"].items()
            assert file["name"] == "a.txt"
            assert len(file["digest"]) == 12
            number = await again.ask("measured.answer", "ended", state={"loads": "ended"})
            assert await again.answer() == (number, "answered while nobody heard")
            number = await again.ask("measured.answer", "running", state={"loads": "running"})
            await again.ask("measured.answer", "changed", state={"loads": "other"})
            await becomes(lambda: len(server.slow.requests) == 4)
            running.progress(2, 2)
            assert json.loads(await again.heard())["id"] == number
            running.answer(TaskOutcome(error="went on"))
            assert await again.answer() == (number, "went on")


async def test_what_a_page_says_of_its_session_does_not_count(tmp_path):
    async with opened(tmp_path, (Lane(), Lane())) as (lab, server), lab.page() as page:
        await page.ask("explore.full", state={}, session={"folder": "/etc", "names": None})
        await becomes(lambda: server.slow.requests)
        told = server.slow.requests[0].arguments
        assert told["state"] == {}
        assert told["session"]["folder"] == str(server.root / page.token)


async def test_a_session_ends_with_its_time_and_at_once_if_it_has_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(sessions, "_PAGE_WITHIN", 0.2)

    async with opened(tmp_path, (Lane(), Lane())) as (lab, server):
        async with lab.page() as page, lab.page() as bare:
            await upload(lab, page.token, b"1 2", "a.txt")
            before = server.slow.renewed  # as often as it was looked when no page was open
            bare.drop()
            await becomes(lambda: list(server.sessions) == [page.token])
            assert server.slow.renewed == before
            page.drop()
            await becomes(lambda: not server.sessions)
            assert server.slow.renewed > before
            await becomes(lambda: not list(server.root.iterdir()))
        for token in (page.token, "unknown", "\u00e4", "x" * 3000):
            async with lab.page(before=token) as fresh:
                assert fresh.said["resumed"] is False
                assert fresh.token != token


async def test_a_page_that_is_left_stops_its_work_soon_unless_it_is_loaded_again(
    tmp_path, monkeypatch
):
    async with opened(tmp_path, (Lane(), Lane())) as (lab, server):
        async with lab.page() as page:
            await page.ask("explore.full")
            await becomes(lambda: server.slow.requests)
        async with lab.page(before=page.token) as again:
            assert again.said["resumed"] is True
            monkeypatch.setattr(sessions, "_RELOAD_WITHIN", 0.0)
            server.sweep()
            assert server.slow.withdrawn == []
        await becomes(lambda: (page.token, None) in server.slow.withdrawn)
        await becomes(lambda: not server.sessions)


async def test_a_page_takes_over_from_another_that_is_told_so(tmp_path):
    async with (
        opened(tmp_path, (Lane(), Lane())) as (lab, server),
        lab.page() as page,
        lab.page(before=page.token) as copied,
    ):
        assert copied.said["resumed"] is True
        assert await page.heard() is None
        assert page.socket.close_code == 4001
        await copied.ask("explore.code")
        await becomes(lambda: server.quick.requests)
        server.quick.requests[0].answer(TaskOutcome(error="told to the other"))
        assert (await copied.answer())[1] == "told to the other"
        assert list(server.sessions) == [copied.token]


async def test_a_page_that_vanishes_without_a_word_is_closed(tmp_path, monkeypatch):
    monkeypatch.setattr("roughline.lab.server.handlers._PONG_WITHIN", 0.3)
    monkeypatch.setattr(sessions, "_PAGE_WITHIN", 0.3)

    async with opened(tmp_path, (Lane(), Lane())) as (lab, server), lab.page() as page:
        handle, pings = page.socket.protocol._handle_message, []

        def noted(opcode, data):
            pings.extend([data] * (opcode == 0x9))
            return handle(opcode, data)

        page.socket.protocol._handle_message = noted
        await becomes(lambda: len(pings) >= 2)
        assert page.token in server.sessions
        await upload(lab, page.token, b"1 2", "a.txt")
        page.socket.protocol._handle_message = lambda opcode, data: None  # nor any pong
        await becomes(lambda: not server.sessions and not list(server.root.iterdir()))
