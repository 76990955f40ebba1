"""Who may speak to the lab: who has its token, by a name of it, from a page of it."""

import re
import stat
import sys
from contextlib import ExitStack
from urllib.parse import unquote, urlencode, urlsplit

import pytest
from tornado.httpclient import HTTPClientError

from lab.server.serving import lab_here, upload
from roughline.errors import InputError
from roughline.lab.server import opening
from roughline.lab.server.access import cookie_name, host_is_ours, opens, origin_is_ours
from roughline.lab.server.settings import ServerSettings

on_unix = pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
PATH = "/user/ann/proxy/5107/"  # that a JupyterHub adds
HUB = "https://hub.example.org"
HERE, BEHIND = ServerSettings(), ServerSettings(address=HUB + PATH)
STATE = "view=explore&n=64&theories=a%2Cb"
NOBODY = {"Cookie": ""}


def test_names_of_this_machine_are_ours_and_not_those_that_others_point_here():
    for settings in (HERE, BEHIND):
        for host in ("127.0.0.1:5107", "localhost", "LOCALHOST:1", "[::1]:5107"):
            assert host_is_ours(host, settings)
        strange = ("rebound.example:5107", "127.0.0.1.example", "", "[::1", "localhost:x", "a@evil")
        for host in (*strange, "0"):
            assert not host_is_ours(host, settings)


def test_the_name_before_a_proxy_is_ours_and_any_where_others_are_let_in():
    assert host_is_ours("hub.example.org", BEHIND)
    assert not host_is_ours("hub.example.org", HERE)
    settings = ServerSettings(host="0.0.0.0")
    assert host_is_ours("laboratory.example:5107", settings)
    assert not host_is_ours("", settings)


def test_only_pages_of_the_same_name_and_port_or_of_the_proxy_may_ask():
    assert origin_is_ours("http://localhost:5107", "localhost:5107", HERE)
    others = ("null", "", "http://localhost", "http://localhost:5108", "http://[", "ftp:", None)
    for origin in others:
        for settings in (HERE, BEHIND):
            assert not origin_is_ours(origin, "localhost:5107", settings)
    assert not origin_is_ours("null", "", HERE)
    for host in ("127.0.0.1:5107", "hub.example.org"):  # whatever the proxy calls this server
        assert origin_is_ours(HUB, host, BEHIND)
        assert not origin_is_ours("https://evil.example.org", host, BEHIND)
    assert not origin_is_ours("http://hub.example.org", "127.0.0.1:5107", BEHIND)


def test_the_token_is_taken_as_a_whole():
    assert opens(" f00d\n", "f00d")
    for attempt in ("", "f00", "f00d f00d", "tökén", None):
        assert not opens(attempt, "f00d")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"host": ""}, "host is empty"),
        ({"port": -1}, "port is -1"),
        ({"port": 65536}, "port is 65536"),
        ({"address": "lab.example.org"}, 'address is "lab.example.org"; the address of the page'),
        ({"address": "ftp://lab.example.org"}, "is needed, https://lab.example.org/"),
        ({"address": "https://"}, "is needed"),
        ({"address": "https://a:port/"}, "is needed"),
        ({"address": "https://a/?token=1"}, "is needed"),
    ],
)
def test_a_lab_that_makes_no_sense_is_refused(options, said):
    with pytest.raises(InputError, match=re.escape(said)):
        ServerSettings(**options)


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "::1", "127.9.9.9"])
def test_this_machine_alone_is_reached_by_its_own_addresses(host):
    assert ServerSettings(host=host).is_local
    assert not ServerSettings(host="0.0.0.0").is_local
    assert not ServerSettings(host="laboratory").is_local


@on_unix
async def test_pages_of_others_are_refused(here):
    port = here.address.rpartition(":")[2]
    for host in (f"rebound.example:{port}", f"127.0.0.1.example:{port}", "[::1"):
        for path in ("/", "/lab/lab.js", "/here", "/nothing"):
            answer = await here.fetch(path, headers={"Host": host})
            assert answer.code in (400, 403), (host, path)
    for origin in ("http://evil.example", "null", f"http://localhost:{port}", "http://["):
        for method, path, body in (("GET", "/here", None), ("POST", "/", "")):
            said = {"method": method, "body": body, "headers": {"Origin": origin}}
            assert (await here.fetch(path, **said)).code == 403
        with pytest.raises(HTTPClientError, match="403"):
            async with here.page({"Origin": origin}):
                pass
    assert (await here.fetch("/", method="POST", body="")).code == 403
    with pytest.raises(HTTPClientError, match="403"):
        async with here.page({}):
            pass


@on_unix
async def test_who_has_no_token_is_unknown_and_gets_static_parts_alone(here):
    for path in ("/", "/results/a/b"):
        assert (await here.fetch(path, headers=NOBODY)).code == 401, path
    for path in ("/lab/lab.js", "/lab/icon.svg", "/bokeh/bokeh.min.js"):
        assert (await here.fetch(path, headers=NOBODY)).code == 200, path
    with pytest.raises(HTTPClientError, match="401"):
        async with here.page({"Origin": here.address, **NOBODY}):
            pass
    async with here.page() as page:
        own, here.cookie = here.cookie, ""
        assert (await upload(here, page.token, b"1", "a")).code == 401
        here.cookie = own
        assert (await upload(here, page.token, b"1", "a")).code == 200
    for headers, said in ((NOBODY, b"unknown"), ({}, b"known")):
        told = await here.fetch("/here", headers=headers)
        assert (told.code, told.body) == (200, said)
        nothing = await here.fetch("/nothing", headers=headers)
        assert (nothing.code, nothing.body) == (404, b"404: unknown\n")


@on_unix
async def test_the_address_with_the_token_opens_the_lab_and_leads_to_the_same_without_it(here):
    token = urlsplit(here.opened).query

    for query in (f"{token}&{STATE}", f"{STATE}&{token}", f"{STATE}&%74{token[1:]}"):
        answer = await here.fetch(f"/?{query}", headers=NOBODY)
        assert answer.headers["Location"] == f"./?{STATE}"
        said = answer.headers["Set-Cookie"]
        flags = {*said.split("; ")}
        assert {"HttpOnly", "SameSite=Lax", "Path=/"} <= flags
        assert "Secure" not in flags
    cookie = {"Cookie": said.partition(";")[0]}
    assert (await here.fetch(f"/?{STATE}", headers=cookie)).code == 200
    again = await here.fetch(f"/?{token}&{STATE}", headers=cookie)
    assert again.headers["Location"] == f"./?{STATE}"
    assert "Set-Cookie" not in again.headers
    assert (await here.fetch(f"/?{token}", headers=NOBODY)).headers["Location"] == "./"


@on_unix
async def test_who_has_no_token_is_told_where_it_stands_and_comes_back_to_the_same_state(here):
    async def posted(token, address=f"/?{STATE}"):
        body = urlencode({"token": token})
        headers = {"Origin": here.address, **NOBODY}
        return await here.fetch(address, method="POST", body=body, headers=headers)

    asked = await here.fetch(f"/?{STATE}", headers=NOBODY)
    assert asked.code == 401
    assert "in the terminal where <code>roughline lab</code>" in asked.body.decode()
    for wrong in ("", "0" * 32, "token=", here.opened[:-1], "<script>"):
        refused = await posted(wrong)
        assert refused.code == 403
        assert b"This is not the token of the lab that runs now." in refused.body
        assert b"<script>" not in refused.body
    for right in (here.opened, f" {here.opened.partition('=')[2]}\n", f"{here.opened}&n=64"):
        entered = await posted(right)
        assert (entered.code, entered.headers["Location"]) == (303, f"./?{STATE}")
    for path in ("//evil.example", "//evil.example/?a=1", "/\\evil.example"):
        led = await posted(here.opened, path)
        assert led.code in (403, 404, 405) or led.headers["Location"].startswith("./")


@on_unix
async def test_labs_of_one_machine_do_not_shut_each_other_out(here):
    """Their cookies go to all of them, because cookies know no ports."""
    token = here.opened.partition("?")[2]
    assert cookie_name("127.0.0.1:1") != cookie_name("127.0.0.1:2") != cookie_name("127.0.0.1")

    async def told(**headers):
        return (await here.fetch("/here", headers=headers)).body

    for host in ("127.0.0.1:8000", "127.0.0.1:8001", "127.0.0.1"):  # such as through tunnels
        answer = await here.fetch(f"/?{token}", headers={"Host": host, **NOBODY})
        cookie = answer.headers["Set-Cookie"].partition(";")[0]
        assert await told(Cookie=f"{here.cookie}; {cookie}") == b"known"
        assert await told(Cookie=f"{here.cookie}; {cookie}", Host=host) == b"known"
        assert await told(Cookie=cookie) == b"unknown"


@on_unix
@pytest.mark.parametrize("path", ["", PATH], ids=["of its own", "of a JupyterHub"])
async def test_pages_of_a_proxy_are_answered_whatever_name_it_calls(path, tmp_path):
    with lab_here(tmp_path, address=f"{HUB}{path}") as lab:
        token = urlsplit(lab.opened).query
        for host in ("hub.example.org", "127.0.0.1:5107"):
            asked = {"Host": host, "Cookie": ""}
            entered = await lab.fetch(f"/?{token}&view=measured", headers=asked)
            assert entered.headers["Location"] == "./?view=measured"
            cookie, *said = entered.headers["Set-Cookie"].split("; ")
            assert {"Secure", f"Path={path or '/'}"} <= set(said)
            through = {"Host": host, "Cookie": cookie, "Origin": HUB}
            assert (await lab.fetch("/here", headers=through)).body == b"known"
            for origin in ("https://evil.example", "null", "http://hub.example.org"):
                refused = await lab.fetch("/here", headers={**through, "Origin": origin})
                assert refused.code == 403
            page = (await lab.fetch("/", headers=through)).body.decode()
            assert 'href="/' not in page
            assert 'src="/' not in page


@on_unix
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
