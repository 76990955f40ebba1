"""A lab for who has its address: other users of the machine have not."""

import stat
import sys
from contextlib import ExitStack
from urllib.parse import unquote, urlencode, urlsplit

import pytest
from tornado.httpclient import HTTPClientError

from lab.server.serving import run, upload
from roughline.lab.server import opening

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
STATE = "view=explore&n=64&theories=a%2Cb"
NOBODY = {"Cookie": ""}


@pytest.fixture(scope="module")
def lab(any_lab):
    """A lab in a thread or in a process of its own."""
    return any_lab


async def posted(lab, token, address="/"):
    """Send the form with a token, as who has none."""
    return await lab.fetch(
        address,
        method="POST",
        body=urlencode({"token": token}),
        headers={"Origin": lab.address, **NOBODY},
    )


def test_nothing_but_static_parts_is_answered_without_the_token(lab):
    async def scenario():
        for path in ("/", "/results/a/b", "/nothing", "/here"):
            assert (await lab.fetch(path, headers=NOBODY)).code == 401, path
        for path in ("/lab/lab.js", "/lab/icon.svg", "/bokeh/bokeh.min.js"):
            assert (await lab.fetch(path, headers=NOBODY)).code == 200, path
        with pytest.raises(HTTPClientError, match="401"):
            async with lab.page({"Origin": lab.address, **NOBODY}):
                pass
        async with lab.page() as page:
            own, lab.cookie = lab.cookie, ""
            assert (await upload(lab, page.token, b"1", "a")).code == 401
            lab.cookie = own
            assert (await upload(lab, page.token, b"1", "a")).code == 200
        assert (await lab.fetch("/here")).code == 204

    run(scenario)


def test_the_address_with_the_token_opens_the_lab_and_leads_to_the_same_without_it(lab):
    token = urlsplit(lab.opened).query

    async def scenario():
        for query in (f"{token}&{STATE}", f"{STATE}&{token}", f"{STATE}&%74{token[1:]}"):
            answer = await lab.fetch(f"/?{query}", headers=NOBODY)
            assert answer.headers["Location"] == f"./?{STATE}"
            said = answer.headers["Set-Cookie"]
            assert "HttpOnly" in said
            assert "SameSite=Lax" in said
        cookie = {"Cookie": said.partition(";")[0]}
        assert (await lab.fetch(f"/?{STATE}", headers=cookie)).code == 200
        again = await lab.fetch(f"/?{token}&{STATE}", headers=cookie)
        assert again.headers["Location"] == f"./?{STATE}"
        assert "Set-Cookie" not in again.headers
        assert (await lab.fetch(f"/?{token}", headers=NOBODY)).headers["Location"] == "./"

    run(scenario)


def test_who_has_no_token_is_told_where_it_stands_and_comes_back_to_the_same_state(lab):
    async def scenario():
        asked = await lab.fetch(f"/?{STATE}", headers=NOBODY)
        assert asked.code == 401
        assert "in the terminal where <code>roughline lab</code>" in asked.body.decode()
        for wrong in ("", "0" * 32, "token=", lab.opened[:-1], "<script>"):
            refused = await posted(lab, wrong, f"/?{STATE}")
            assert refused.code == 403
            assert b"This is not the token of the lab that runs now." in refused.body
            assert b"<script>" not in refused.body
        for right in (lab.opened, f" {lab.opened.partition('=')[2]}\n", f"{lab.opened}&n=64"):
            opened = await posted(lab, right, f"/?{STATE}")
            assert (opened.code, opened.headers["Location"]) == (303, f"./?{STATE}")

    run(scenario)


@pytest.mark.parametrize("path", ["//evil.example", "//evil.example/?a=1", "/\\evil.example"])
def test_the_form_leads_to_this_page_only(lab, path):
    async def scenario():
        opened = await posted(lab, lab.opened, path)
        assert opened.code in (401, 403, 404, 405) or opened.headers["Location"].startswith("./")

    run(scenario)


def test_labs_of_one_machine_do_not_shut_each_other_out(lab):
    """Their cookies go to all of them, because cookies know no ports."""
    token = lab.opened.partition("?")[2]

    async def scenario():
        names = set()
        for host in ("127.0.0.1:8000", "127.0.0.1:8001", "127.0.0.1"):  # such as through tunnels
            answer = await lab.fetch(f"/?{token}", headers={"Host": host, **NOBODY})
            cookie = answer.headers["Set-Cookie"].partition(";")[0]
            names.add(cookie.partition("=")[0])
            both = f"{lab.cookie}; {cookie}"
            assert (await lab.fetch("/here", headers={"Cookie": both})).code == 204
            there = {"Cookie": both, "Host": host}
            assert (await lab.fetch("/here", headers=there)).code == 204
            assert (await lab.fetch("/here", headers={"Cookie": cookie})).code == 401
        assert len(names) == 3

    run(scenario)


def test_the_browser_is_opened_without_telling_other_users_the_token(tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr(opening.subprocess, "run", lambda words, **_: asked.append(words))
    address = "http://127.0.0.1:5107/?token=f00d"
    for parent in (tmp_path / "temporary", tmp_path / "home"):
        parent.mkdir()
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    for has_snaps in (False, True):
        monkeypatch.setattr(opening, "_SNAPS", tmp_path if has_snaps else tmp_path / "none")
        with ExitStack() as opened:
            opening.open_page(address, opened)
            *command, said = asked.pop()
            assert "f00d" not in f"{command} {said}"
            page = opening.Path(unquote(urlsplit(said).path))
            assert page.is_relative_to(tmp_path / ("home" if has_snaps else "temporary"))
            assert stat.S_IMODE(page.stat().st_mode) == 0o600
            assert stat.S_IMODE(page.parent.stat().st_mode) == 0o700
            assert f"0;url={address}" in page.read_text()
        assert not page.parent.exists()
