"""The server of the lab against pages that mean well, and others."""

import asyncio
import json
import os
import re
import signal
import socket
import subprocess
import sys
import time

import psutil
import pytest
from tornado.httpclient import HTTPClientError

from lab.serving import assert_tells_nothing, becomes, running_lab, wait_until

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
PASSWORD = "correct horse"
SMALL = {"n": "64"}


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """A lab for this machine alone, with small limits."""
    temporary = tmp_path_factory.mktemp("open")
    with running_lab("--max-upload", "1", "--max-points", "256", temporary=temporary) as running:
        yield running
    assert running.process.returncode == 0
    assert not list(temporary.glob("roughline-lab-*"))


@pytest.fixture(scope="module")
def closed_lab(tmp_path_factory):
    """A lab with a password."""
    temporary = tmp_path_factory.mktemp("closed")
    (temporary / "password").write_text(f"{PASSWORD}\n")
    options = ("--host", "0.0.0.0", "--password-file", str(temporary / "password"))
    with running_lab(*options, temporary=temporary) as running:
        yield running


def run(scenario):
    """Run a scenario, and fail if something in it was forgotten."""
    asyncio.run(scenario(), debug=False)


def test_the_page_and_its_parts_come_under_a_strict_policy(lab):
    async def scenario():
        paths = (
            "/",
            "/lab/lab.js",
            "/bokeh/bokeh.min.js",
            "/figures/explore",
            "/lab/nothing",
            "/no",
        )
        for path in paths:
            answer = await lab.fetch(path)
            assert answer.code == (404 if "no" in path.split("/")[-1] else 200), path
            policy = answer.headers["Content-Security-Policy"]
            assert "default-src 'none'; script-src 'self';" in policy
            assert "unsafe-eval" not in policy
            assert answer.headers["X-Content-Type-Options"] == "nosniff"
            assert answer.headers["Referrer-Policy"] == "no-referrer"
            assert answer.headers["Server"] == "roughline"
            assert not re.search("tornado", str(dict(answer.headers)), re.IGNORECASE)

    run(scenario)


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
        "/figures/server",
        "/figures/%3Cscript%3E",
    ],
)
def test_nothing_else_can_be_read(lab, path):
    async def scenario():
        answer = await lab.fetch(path)
        assert answer.code in (403, 404)
        assert b"<" not in answer.body
        assert len(answer.body) < 100

    run(scenario)


def test_other_names_and_pages_of_others_are_refused(lab):
    async def scenario():
        port = lab.address.rpartition(":")[2]
        for host in (f"rebound.example:{port}", f"127.0.0.1.example:{port}", "[::1"):
            for path in ("/", "/lab/lab.js", "/figures/explore"):
                answer = await lab.fetch(path, headers={"Host": host})
                assert answer.code in (400, 403), (host, path)
        for origin in ("http://evil.example", "null", f"http://localhost:{port}", "http://["):
            answer = await lab.fetch("/figures/explore", headers={"Origin": origin})
            assert answer.code == 403
            answer = await lab.fetch("/login", method="POST", body="", headers={"Origin": origin})
            assert answer.code == 403
            with pytest.raises(HTTPClientError, match="403"):
                async with lab.page({"Origin": origin}):
                    pass
        assert (await lab.fetch("/login", method="POST", body="")).code == 403
        with pytest.raises(HTTPClientError, match="403"):
            async with lab.page({}):
                pass

    run(scenario)


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
def test_messages_that_make_no_sense_are_answered_in_one_sentence(lab, text):
    async def scenario():
        async with lab.page() as page:
            await page.say(text)
            number, sentence = await page.answer()
            assert number in (0, 1)
            assert "reload the page" in sentence or "in no form the lab knows" in sentence
            number = await page.ask("explore.code", state=SMALL)
            assert (await page.answer())[0] == number

    run(scenario)


@pytest.mark.parametrize(
    "arguments",
    [
        {},
        {"state": None},
        {"state": []},
        {"state": "n=64"},
        {"state": {"n": 64}},
        {"state": {"n": None}},
        {"state": {"n": {"a": []}}},
        {"state": {"D_f": [1]}},
        {"state": {"seed": "9" * 60_000}},
        {"state": {"seed": "1e999"}},
        {"state": {"F": "nan"}},
        {"state": {"L": "<script>alert(1)</script>"}},
        {"state": {"L": "\x00\n\u202e"}},
        {"state": {"E": "1e-400 Pa"}},
        {"state": {"theories": "../../etc/passwd"}},
        {"state": {"n": "512"}},
        {"state": {"n": "64"}, "session": {"folder": "/etc", "names": None}, "crowded": 7},
        {"state": json.loads("[" * 200 + "]" * 200)},
    ],
)
@pytest.mark.parametrize("task", ["explore.reduced", "explore.full", "explore.code"])
def test_arguments_of_any_kind_are_answered(lab, task, arguments):
    async def scenario():
        async with lab.page() as page:
            number = await page.ask(task, **arguments)
            answered, said = await page.answer()
            assert answered == number
            if isinstance(said, str):
                assert 10 < len(said) < 1000
                assert "\n" not in said
            assert isinstance(said, str) or arguments.get("state", {}) == SMALL or arguments == {}

    run(scenario)


def test_a_message_that_is_too_large_closes_the_page_and_only_it(lab):
    async def scenario():
        async with lab.page() as other:
            async with lab.page() as page:
                await page.say("x" * 70_000)
                assert await page.heard() is None
                assert page.socket.close_code == 1009
            await other.ask("explore.code", state=SMALL)
            assert (await other.answer())[0] == 1

    run(scenario)


def test_a_flood_is_refused_and_then_closed_while_others_are_served(lab):
    async def scenario():
        async with lab.page() as other, lab.page() as flood:
            said = json.dumps({"id": 1, "slot": "s", "stop": True})
            for _ in range(3000):
                flood.socket.write_message(said)
            await other.ask("explore.code", state=SMALL)
            assert (await other.answer())[0] == 1
            while (message := await flood.heard()) is not None:
                assert "too many questions at once" in json.loads(message)["error"]
            assert flood.socket.close_code == 1008

    run(scenario)


def test_a_page_that_does_not_read_is_not_sent_more_and_more(lab):
    """Its questions are held; the server's memory stays bounded."""

    async def scenario():
        before = psutil.Process(lab.process.pid).memory_info().rss
        reader, writer = await asyncio.open_connection("127.0.0.1", lab.address.rpartition(":")[2])
        writer.transport.set_write_buffer_limits(high=2**24)
        writer.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        port = lab.address.rpartition(":")[2]
        writer.write(
            (
                f"GET /link HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nOrigin: {lab.address}\r\n"
                "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
            ).encode()
        )
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
        await asyncio.sleep(0.5)
        grown = psutil.Process(lab.process.pid).memory_info().rss - before
        writer.transport.abort()
        assert grown < 40e6

    run(scenario)


def test_uploads_lie_under_random_names_and_are_gone_with_the_page(lab):
    async def scenario():
        async with lab.page() as page:
            name = "<b>n\u00e4me</b>\n../../\x00 100%25.TXT"
            answer = await upload(lab, page.token, b"1 2\n3 4\n", name)
            assert answer.code == 200
            said = json.loads(answer.body)
            assert "<" not in said["name"]
            assert "/" not in said["name"]
            (file,) = (lab.folder / page.token).iterdir()
            assert file.read_bytes() == b"1 2\n3 4\n"
            assert re.fullmatch(r"[0-9a-f]{16}\.txt", file.name)
            assert file.parent.stat().st_mode & 0o077 == 0
            long = await upload(lab, page.token, b"1", "n" * 5000)
            assert len(json.loads(long.body)["name"]) == 100
            folder = lab.folder / page.token
        await becomes(lambda: not folder.exists())
        assert (await upload(lab, page.token, b"1", "late")).code == 404

    run(scenario)


def test_uploads_that_are_too_large_or_of_nobody_are_refused(lab):
    async def scenario():
        async with lab.page() as page:
            assert (await upload(lab, "nobody", b"1", "a")).code == 404
            assert (
                await upload(lab, page.token, b"1", "a", origin="http://evil.example")
            ).code == 403
            answer = await upload(lab, page.token, b"x" * 1_000_001, "a")
            assert answer.code in (413, 599)
            chunked = (
                f"POST /upload?session={page.token}&name=a HTTP/1.1\r\nHost: localhost\r\n"
                "Origin: http://localhost\r\nTransfer-Encoding: chunked\r\n\r\n2\r\nab\r\n0\r\n\r\n"
            )
            assert b" 411 " in await raw(lab, chunked.encode())
            folder = lab.folder / page.token
            assert not folder.exists() or not list(folder.iterdir())

    run(scenario)


def test_an_upload_that_is_broken_off_is_deleted(lab):
    async def scenario():
        async with lab.page() as page:
            _, writer = await asyncio.open_connection("127.0.0.1", lab.address.rpartition(":")[2])
            writer.write(
                f"POST /upload?session={page.token}&name=a HTTP/1.1\r\nHost: localhost\r\n"
                "Origin: http://localhost\r\nContent-Length: 900000\r\n\r\n".encode()
            )
            writer.write(b"x" * 300_000)
            folder = lab.folder / page.token
            await becomes(lambda: folder.exists() and any(folder.iterdir()))
            writer.transport.abort()
            await becomes(lambda: not any(folder.iterdir()))

    run(scenario)


def test_files_of_one_page_are_bounded(lab):
    async def scenario():
        async with lab.page() as page:
            sent = (upload(lab, page.token, bytes(900_000), f"{i}") for i in range(8))
            codes = [answer.code for answer in await asyncio.gather(*sent)]
            assert set(codes) <= {200, 410}
            found = list((lab.folder / page.token).iterdir())
            assert len(found) <= 3
            assert sum(file.stat().st_size for file in found) <= 3_000_000

    run(scenario)


def test_results_are_given_to_their_page_under_a_policy_of_their_own(lab):
    async def scenario():
        async with lab.page() as page, lab.page() as other:
            results = lab.folder / page.token / "results"
            results.mkdir(parents=True)
            (results / "report.html").write_text("<script>alert(1)</script>")
            (results / "large.nc").write_bytes(bytes(5_000_000))
            (results / "link.txt").symlink_to("/etc/hostname")
            answer = await lab.fetch(f"/results/{page.token}/report.html")
            assert answer.code == 200
            policy = answer.headers["Content-Security-Policy"]
            assert "default-src 'none'" in policy
            assert "script" not in policy
            assert policy.endswith("sandbox")
            saved = await lab.fetch(f"/results/{page.token}/large.nc?save=1")
            assert len(saved.body) == 5_000_000
            assert saved.headers["Content-Disposition"] == 'attachment; filename="large.nc"'
            for token, name in (
                (other.token, "report.html"),
                ("x", "report.html"),
                (page.token, ".."),
                (page.token, "."),
                (page.token, "link.txt"),
                (page.token, "%2e%2e"),
                (page.token, "..%2f..%2fserver"),
            ):
                assert (await lab.fetch(f"/results/{token}/{name}")).code == 404, name

    run(scenario)


def test_a_page_that_closes_stops_what_it_asked_for(lab):
    async def scenario():
        async with lab.page() as page:
            await page.ask("explore.curve", state={"n": "256", "boundary": "free", "h": "0.1"})
            await asyncio.sleep(0.1)
        await becomes(lambda: all(child.cpu_percent(0.05) < 50 for child in alive(lab)), 5)

    run(scenario)


def test_a_killed_process_is_one_sentence_and_the_next_question_is_answered(lab):
    async def scenario():
        async with lab.page() as page:
            await page.ask("explore.curve", state={"n": "256"})
            await asyncio.sleep(0.2)
            for child in alive(lab):
                child.kill()
            assert (await page.answer())[1].startswith("the process that computed this ended")
            await page.ask("explore.coarse", state=SMALL)
            assert (await page.answer())[1]["points"] == 64

    run(scenario)


def test_twenty_pages_are_answered(lab):
    async def scenario():
        pages = [lab.page() for _ in range(20)]
        opened = [await page.__aenter__() for page in pages]
        for seed, page in enumerate(opened):
            await page.ask("explore.coarse", state=SMALL | {"seed": str(seed)})
        for seed, page in enumerate(opened):
            assert (await page.answer())[1]["state"]["seed"] == str(seed)
        for page in pages:
            await page.__aexit__(None, None, None)

    run(scenario)


def test_fifty_pages_opened_and_closed_leave_no_memory_and_no_files(lab):
    async def visit(seed):
        async with lab.page() as page:
            await page.ask("explore.full", state={"n": "128", "seed": str(seed)})
            await page.answer()
            await upload(lab, page.token, b"1 2\n3 4\n", "a.txt")

    async def scenario():
        for seed in range(10):
            await visit(seed)
        before = held(lab)
        for seed in range(50):
            await visit(seed)
        await asyncio.sleep(0.5)
        assert held(lab)[0] - before[0] < 15e6
        assert held(lab)[1] - before[1] < 60e6
        assert not list(lab.folder.iterdir())

    run(scenario)


def test_a_password_is_asked_for_everything(closed_lab):
    async def scenario():
        page = await closed_lab.fetch("/")
        assert page.code == 302
        assert page.headers["Location"] == "/login"
        assert b"Password" in (await closed_lab.fetch("/login")).body
        for path in ("/figures/explore", "/results/a/b", "/nothing"):
            assert (await closed_lab.fetch(path)).code == 401
        assert (await upload(closed_lab, "x", b"1", "a")).code == 401
        with pytest.raises(HTTPClientError, match="401"):
            async with closed_lab.page():
                pass

    run(scenario)


def test_the_password_opens_the_lab_and_its_cookie_only_this_name_of_it(closed_lab):
    async def scenario():
        logged_in = await log_in(closed_lab, PASSWORD)
        assert logged_in.code == 303
        said = logged_in.headers["Set-Cookie"]
        assert "HttpOnly" in said
        assert "SameSite=Strict" in said
        cookie = said.partition(";")[0]
        origin = closed_lab.address
        assert (await closed_lab.fetch("/", headers={"Cookie": cookie})).code == 200
        async with closed_lab.page({"Origin": origin, "Cookie": cookie}) as page:
            await page.ask("explore.code", state=SMALL)
            assert (await page.answer())[0] == 1
        with pytest.raises(HTTPClientError, match="403"):
            async with closed_lab.page({"Origin": "http://evil.example", "Cookie": cookie}):
                pass
        elsewhere = {"Cookie": cookie, "Host": "rebound.example"}
        assert (await closed_lab.fetch("/figures/explore", headers=elsewhere)).code == 401
        forged = {"Cookie": "roughline_lab=yes"}
        assert (await closed_lab.fetch("/figures/explore", headers=forged)).code == 401

    run(scenario)


def test_wrong_passwords_are_counted(closed_lab):
    async def scenario():
        codes = [(await log_in(closed_lab, f"wrong {i}")).code for i in range(6)]
        assert codes[0] == 403
        assert codes[-1] == 429
        assert (await log_in(closed_lab, PASSWORD)).code == 429

    run(scenario)


def test_an_open_lab_says_what_it_opens(closed_lab):
    assert "127.0.0.1" in closed_lab.first
    said = closed_lab.process.stdout.readline()
    assert "upload files up to 200 MB" in said
    assert "not encrypted" in said


@pytest.mark.parametrize("stop", [signal.SIGINT, signal.SIGTERM])
def test_it_is_stopped_with_pages_open(stop, tmp_path):
    with running_lab(temporary=tmp_path) as lab:

        async def scenario():
            async with lab.page() as page:
                await upload(lab, page.token, b"1 2\n", "a.txt")
                await page.ask("explore.full", state={"n": "512"})
                await asyncio.sleep(0.1)
                children = psutil.Process(lab.process.pid).children(recursive=True)
                asked = time.monotonic()
                lab.process.send_signal(stop)
                while await page.heard() is not None:
                    pass
            lab.process.wait(10)
            assert time.monotonic() - asked < 5
            wait_until(lambda: not any(child.is_running() for child in children), 5)

        run(scenario)
        assert lab.process.returncode == 0
        assert lab.process.stdout.read() == "The lab is closed.\n"
        for word in ("Task was", "never retrieved", "KeyboardInterrupt", "ignored", "tornado"):
            assert word not in lab.log.read_text()
        assert not list(tmp_path.glob("roughline-lab-*"))


def test_what_a_killed_server_leaves_is_removed_by_the_next(tmp_path):
    with running_lab(temporary=tmp_path, closes=False) as lab:
        children = psutil.Process(lab.process.pid).children(recursive=True)
        left = lab.folder
    wait_until(lambda: not any(alive_still(child) for child in children), 10)
    assert left.is_dir()
    others = tmp_path / "roughline-lab-mine"
    others.mkdir()
    (tmp_path / "roughline-lab-999999-linked").symlink_to(others)
    with running_lab(temporary=tmp_path) as lab:
        assert not left.exists()
    assert others.is_dir()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--host", "0.0.0.0"), "--password-file"),
        (("--host", ""), "host is empty"),
        (("--host", "192.0.2.1", "--password-file", "password"), "cannot listen on 192.0.2.1"),
        (
            ("--host", "no.such.invalid", "--password-file", "password"),
            "no address of this machine",
        ),
        (("--password-file", "missing"), "cannot read the password"),
        (("--password-file", "empty"), "no password in its first line"),
        (("--password-file", "short"), "fewer than 8"),
        (("--port", "70000"), "port is 70000"),
        (("--max-upload", "0"), "positive --max-upload"),
        (("--max-upload", "nan"), "positive --max-upload"),
        (("--max-seconds", "-1"), "positive --max-seconds"),
        (("--max-memory", "inf"), "positive --max-memory"),
        (("--max-points", "0"), "positive --max-points"),
    ],
)
def test_options_that_make_no_sense_are_one_line(invoke, tmp_path, monkeypatch, options, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "password").write_text(PASSWORD)
    (tmp_path / "empty").write_text("")
    (tmp_path / "short").write_text("1234567")
    code, out, errors = invoke("lab", "--no-browser", *options)
    assert code == 2
    assert out == ""
    assert said in errors
    assert errors.count("\n") == 1


def test_a_port_that_is_taken_is_one_line(lab, invoke):
    port = lab.address.rpartition(":")[2]
    code, _, errors = invoke("lab", "--no-browser", "--port", port)
    assert code == 2
    assert f"port {port}" in errors
    assert "--port" in errors


def test_ctrl_c_before_it_is_up_ends_it_quietly(tmp_path):
    command = [sys.executable, "-m", "roughline", "lab", "--no-browser", "--port", "0"]
    for moment in (0.3, 0.6, 1.0):
        with subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env=os.environ | {"TMPDIR": str(tmp_path)},
        ) as process:
            time.sleep(moment)
            process.send_signal(signal.SIGINT)
            said = process.communicate(timeout=20)[0]
        assert "KeyboardInterrupt" not in said, (moment, said)
        assert not list(tmp_path.glob("roughline-lab-*"))


async def upload(lab, token, content, name, origin=None):
    """Send a file as a page does."""
    from urllib.parse import urlencode

    return await lab.fetch(
        f"/upload?{urlencode({'session': token, 'name': name})}",
        method="POST",
        body=content,
        headers={"Origin": origin or lab.address},
    )


async def log_in(lab, password):
    """Send the form with a password."""
    from urllib.parse import urlencode

    return await lab.fetch(
        "/login",
        method="POST",
        body=urlencode({"password": password}),
        headers={"Origin": lab.address},
    )


async def raw(lab, request):
    """Send bytes; returns what comes back first."""
    reader, writer = await asyncio.open_connection("127.0.0.1", lab.address.rpartition(":")[2])
    writer.write(request)
    said = await asyncio.wait_for(reader.read(2000), 10)
    writer.close()
    assert_tells_nothing(said)
    return said


def alive(lab):
    """Processes of a lab that compute."""
    found = psutil.Process(lab.process.pid).children(recursive=True)
    return [each for each in found if "forkserver" in " ".join(each.cmdline())][1:]


def alive_still(process):
    """Whether a process runs, and is not only waited for."""
    try:
        return process.is_running() and process.status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False


def held(lab):
    """Memory of the server, and of it with all its processes. [bytes]"""
    server = psutil.Process(lab.process.pid)
    children = sum(each.memory_full_info().uss for each in alive(lab))
    return server.memory_info().rss, server.memory_full_info().uss + children
