"""The server of the lab against pages that mean well, and others."""

import asyncio
import json
import re
import socket
import sys

import psutil
import pytest

from lab.server.serving import alive, becomes, held, upload

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
SMALL = {"n": "64"}
FINE_PULL = {"w": "0.1", "h0": "0.05"}  # which 512 points and fewer do not resolve


async def test_the_page_and_its_parts_come_under_a_strict_policy(lab):
    for path in (
        *("/", "/lab/lab.js", "/bokeh/bokeh.min.js", "/bokeh/bokeh-api.min.js"),
        *("/lab/nothing", "/no"),
    ):
        answer = await lab.fetch(path)
        assert answer.code == (404 if "no" in path.split("/")[-1] else 200), path
        policy = answer.headers["Content-Security-Policy"]
        assert "default-src 'none'; script-src 'self';" in policy
        assert "unsafe-eval" not in policy
        assert answer.headers["X-Content-Type-Options"] == "nosniff"
        assert answer.headers["Referrer-Policy"] == "no-referrer"
        assert answer.headers["Server"] == "roughline"
        assert not re.search("tornado", str(dict(answer.headers)), re.IGNORECASE)


@pytest.mark.parametrize(
    "path",
    [
        "/lab/../server.py",
        "/lab/%2e%2e/server.py",
        "/lab/..%2fserver.py",
        "/lab//etc/passwd",
        "/lab/%00",
        "/bokeh/bokeh.js.map",
        "/bokeh/../../server.py",
        "/results/x/y",
        "/results/..%2f/..",
        "/here/server",
        "/here/%3Cscript%3E",
    ],
)
async def test_nothing_else_can_be_read(lab, path):
    answer = await lab.fetch(path)
    assert answer.code in (403, 404)
    assert b"<" not in answer.body
    assert len(answer.body) < 100


@pytest.mark.parametrize(
    "text",
    [
        "",
        "no json",
        "[]",
        "null",
        "7",
        "[" * 30_000,
        '{"id": 1' + "0" * 9000 + "}",
        b"\x00\xff binary",
        '{"id": 1}',
        '{"id": 1, "slot": 5, "task": "explore.coarse", "arguments": {}}',
        '{"id": 1, "slot": "", "task": "explore.coarse", "arguments": {}}',
        '{"id": 1, "slot": "' + "s" * 41 + '", "task": "explore.coarse", "arguments": {}}',
        '{"id": 1, "slot": "s", "task": "os.system", "arguments": {}}',
        '{"id": 1, "slot": "s", "task": ["explore.coarse"], "arguments": {}}',
        '{"id": 1, "slot": "s", "task": {"a": 1}, "arguments": {}}',
        '{"id": 1, "slot": "s", "task": "explore.coarse", "arguments": []}',
        '{"id": 1, "slot": "s", "task": "explore.coarse"}',
        '{"id": -1, "slot": "s", "task": "none", "arguments": {}}',
        '{"id": 1e999, "slot": "s", "task": "none", "arguments": {}}',
        '{"id": {"a": []}, "slot": "s", "task": "none", "arguments": {}}',
    ],
)
async def test_messages_that_make_no_sense_are_answered_in_one_sentence(lab, text):
    async with lab.page() as page:
        await page.say(text)
        number, sentence = await page.answer()
        assert number in (0, 1)
        assert "reload the page" in sentence
        number = await page.ask("explore.code", state=SMALL)
        assert (await page.answer())[0] == number


async def test_a_message_that_is_too_large_closes_the_page_and_only_it(lab):
    async with lab.page() as other:
        async with lab.page() as page:
            await page.say("x" * 70_000)
            assert await page.heard() is None
            assert page.socket.close_code == 1009
        await other.ask("explore.code", state=SMALL)
        assert (await other.answer())[0] == 1


async def test_a_page_that_does_not_read_is_not_sent_more_and_more(lab):
    """Its questions are held; the server's memory stays bounded."""
    before = psutil.Process(lab.process.pid).memory_info().rss
    reader, writer = await lab.connected(
        "GET /link",
        "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13",
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
    )
    writer.transport.set_write_buffer_limits(high=2**24)
    writer.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    await reader.readuntil(b"\r\n\r\n")
    reader._transport.pause_reading()
    for number in range(150):
        said = json.dumps(
            {
                "id": number,
                "slot": "s",
                "task": "explore.coarse",
                "arguments": {"state": {"n": "128", "F": f"{0.1 + number / 1000}"}},
            }
        ).encode()
        writer.write(bytes((0x81, 0x80 | 126, *divmod(len(said), 256), 0, 0, 0, 0)) + said)
        await asyncio.sleep(0.02)
    async with lab.page() as other:  # which waits until those are answered
        await other.ask("explore.coarse", state=SMALL)
        await other.answer()
    grown = psutil.Process(lab.process.pid).memory_info().rss - before
    writer.transport.abort()
    assert grown < 40e6


async def test_a_killed_process_is_one_sentence_and_the_next_question_is_answered(lab):
    async with lab.page() as page:
        # both ways on the finest grid: far from done when the first progress is told
        await page.ask("explore.further", of="w", refines=True, state={"n": "1024", **FINE_PULL})
        assert "done" in json.loads(await page.heard())
        for child in alive(lab):
            child.kill()
        assert (await page.answer())[1].startswith("the process that computed this ended")
        await page.ask("explore.coarse", state=SMALL)
        assert (await page.answer())[1]["points"] == 64


@pytest.mark.parametrize("count", [10, 50])
async def test_pages_opened_and_closed_leave_no_memory_and_no_files(lab, count):
    async def visit(seed):
        async with lab.page() as page:
            await page.ask("explore.full", state={"n": "128", "seed": str(seed)})
            await page.answer()
            await upload(lab, page.token, b"1 2\n3 4\n", "a.txt")
            await page.forget()

    for seeds in (range(5), range(5, 5 + count)):
        before = held(lab)
        for seed in seeds:
            await visit(seed)
    await becomes(lambda: held(lab)[0] - before[0] < 15e6)
    await becomes(lambda: held(lab)[1] - before[1] < 60e6)
    await becomes(lambda: not list(lab.folder.iterdir()))
