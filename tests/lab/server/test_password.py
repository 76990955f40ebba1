"""A lab that other machines can reach."""

import signal
import sys
from contextlib import contextmanager

import pytest
from tornado.httpclient import HTTPClientError

from lab.server.serving import lab_here, log_in, run, running_lab, upload
from roughline.lab.server import serve as server

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
PASSWORD = "correct horse"
SMALL = {"n": "64"}


@contextmanager
def lab_of_its_own(temporary):
    """Run a lab with a password in a process of its own."""
    with running_lab(*options_in(temporary), temporary=temporary) as running:
        yield running


def options_in(folder):
    """Return the options of a lab with a password, which is written into a folder."""
    (folder / "password").write_text(f"{PASSWORD}\n")
    (folder / "password").chmod(0o600)
    return "--host", "0.0.0.0", "--password-file", str(folder / "password")


@pytest.fixture(scope="module", params=["here", "in a process"])
def closed_lab(request, tmp_path_factory):
    """A lab with a password, in a thread of this process or in a process of its own."""
    temporary = tmp_path_factory.mktemp("closed")
    here = lab_here(temporary, host="0.0.0.0", password=PASSWORD)
    with here if request.param == "here" else lab_of_its_own(temporary) as running:
        yield running


def test_a_password_is_asked_for_everything(closed_lab):
    async def scenario():
        page = await closed_lab.fetch("/")
        assert page.code == 302
        assert page.headers["Location"] == "/login"
        assert b"Password" in (await closed_lab.fetch("/login")).body
        for path in ("/here", "/results/a/b", "/nothing"):
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
        assert (await closed_lab.fetch("/here", headers=elsewhere)).code == 401
        forged = {"Cookie": "roughline_lab=yes"}
        assert (await closed_lab.fetch("/here", headers=forged)).code == 401

    run(scenario)


def test_a_login_leads_to_what_was_linked_though_the_first_password_was_wrong(closed_lab):
    linked = "/?view=explore&D_f=2.4"

    async def scenario():
        asked = await closed_lab.fetch(linked)
        assert asked.headers["Location"] == "/login?next=%2F%3Fview%3Dexplore%26D_f%3D2.4"
        for answer in (
            await closed_lab.fetch(asked.headers["Location"]),
            await log_in(closed_lab, "wrong password", linked),
        ):
            assert b'name="next" value="/?view=explore&amp;D_f=2.4"' in answer.body
        right = await log_in(closed_lab, PASSWORD, linked)
        assert (right.code, right.headers["Location"]) == (303, linked)

    run(scenario)


def test_wrong_passwords_are_counted(closed_lab):
    async def scenario():
        for _ in range(8):  # right ones are not
            assert (await log_in(closed_lab, PASSWORD)).code == 303
        codes = [(await log_in(closed_lab, f"wrong {i}")).code for i in range(6)]
        assert codes[0] == 403
        assert codes[-1] == 429
        assert (await log_in(closed_lab, PASSWORD)).code == 429

    run(scenario)


@pytest.fixture
def printed(closed_lab, invoke, monkeypatch):
    """The first lines that such a lab prints."""
    if closed_lab.process:
        return closed_lab.first, closed_lab.process.stdout.readline()

    serve = server.serve

    def serve_shortly(site, settings, ready, interrupted):
        def stop(address):
            ready(address)
            signal.raise_signal(signal.SIGINT)

        serve(site, settings, stop, interrupted)

    monkeypatch.setattr(server, "serve", serve_shortly)
    options = options_in(closed_lab.temporary)
    code, said, errors = invoke("lab", "--no-browser", "--port", "0", *options)
    assert (code, errors) == (0, "")
    return said.splitlines()[:2]


def test_an_open_lab_says_what_it_opens(printed):
    first, said = printed
    assert "127.0.0.1" in first
    assert "upload files up to 200 MB" in said
    assert "not encrypted" in said
