"""A lab for who has its address: other users of the machine have not."""

import stat
import sys
from contextlib import ExitStack
from urllib.parse import quote, unquote, urlencode, urlsplit

import pytest
from tornado.httpclient import HTTPClientError

from lab.server.serving import becomes, entered, run, upload
from roughline.lab.server import opening
from roughline.lab.server.access import Key, Logins

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
STATE = "view=explore&n=64&theories=a%2Cb"
NOBODY = {"Cookie": ""}


@pytest.fixture(scope="module")
def lab(any_lab):
    """A lab in a thread or in a process of its own."""
    return any_lab


async def posted(lab, token, leads_to="/"):
    """Send the form with a token, as who is not logged in."""
    return await lab.fetch(
        "/login",
        method="POST",
        body=urlencode({"token": token, "next": leads_to}),
        headers={"Origin": lab.address, **NOBODY},
    )


def test_nothing_but_static_parts_is_answered_without_the_token(lab):
    async def scenario():
        assert (await lab.fetch("/", headers=NOBODY)).headers["Location"] == "/login"
        for path in ("/results/a/b", "/nothing", "/here"):
            assert (await lab.fetch(path, headers=NOBODY)).code == 401, path
        for path in ("/lab/lab.js", "/lab/icon.svg", "/bokeh/bokeh.min.js", "/login"):
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


def test_the_address_with_the_token_logs_in_and_leads_to_the_same_without_it(lab):
    token = urlsplit(lab.opened).query

    async def scenario():
        for query in (f"{token}&{STATE}", f"{STATE}&{token}", f"{STATE}&%74{token[1:]}"):
            answer = await lab.fetch(f"/?{query}", headers=NOBODY)
            assert answer.headers["Location"] == f"/?{STATE}"
            said = answer.headers["Set-Cookie"]
            assert "HttpOnly" in said
            assert "SameSite=Strict" in said
            assert token.partition("=")[2] not in said
        cookie = {"Cookie": said.partition(";")[0]}
        assert (await lab.fetch(f"/?{STATE}", headers=cookie)).code == 200
        again = await lab.fetch(f"/?{token}&{STATE}", headers=cookie)
        assert again.headers["Location"] == f"/?{STATE}"
        assert "Set-Cookie" not in again.headers
        assert (await lab.fetch(f"/?{token}", headers=NOBODY)).headers["Location"] == "/"

    run(scenario)


def test_who_has_no_token_is_told_where_it_stands_and_comes_back_to_the_same_state(lab):
    async def scenario():
        asked = await lab.fetch(f"/?{STATE}", headers=NOBODY)
        assert asked.headers["Location"] == f"/login?next={quote(f'/?{STATE}', safe='')}"
        form = (await lab.fetch(asked.headers["Location"], headers=NOBODY)).body.decode()
        assert "in the terminal where <code>roughline lab</code> was started" in form
        assert f'value="/?{STATE}"'.replace("&", "&amp;") in form
        wrong = await posted(lab, "0" * 32, f"/?{STATE}")
        assert wrong.code == 403
        assert b"This is not the token of the lab that runs now." in wrong.body
        assert STATE.replace("&", "&amp;") in wrong.body.decode()
        right = await posted(lab, f"{lab.opened} - Ctrl-C closes it.", f"/?{STATE}")
        assert (right.code, right.headers["Location"]) == (303, f"/?{STATE}")
        right = await posted(lab, f" {lab.opened.partition('=')[2]}\n")
        assert (right.code, right.headers["Location"]) == (303, "/")
        here = await lab.fetch(asked.headers["Location"])
        assert (here.code, here.headers["Location"]) == (302, f"/?{STATE}")

    run(scenario)


@pytest.mark.parametrize(
    "elsewhere",
    [
        "//evil.example",
        "/\\evil.example",
        "\\\\evil.example",
        "https://evil.example/",
        "javascript:alert(1)",
        "/?a=1\r\nSet-Cookie: b=1",
        "/\t/evil.example",
        "/?a\0b",
        "/%2f/evil.example",
        "/logout",
        "/ü",
        "",
    ],
)
def test_a_login_leads_to_this_page_only(lab, elsewhere):
    async def scenario():
        right = await posted(lab, lab.opened, elsewhere)
        assert (right.code, right.headers["Location"]) == (303, "/")
        here = await lab.fetch(f"/login?{urlencode({'next': elsewhere})}")
        assert (here.code, here.headers["Location"]) == (302, "/")

    run(scenario)


def test_wrong_tokens_are_counted_and_do_not_keep_out_who_has_the_right_one(lab):
    async def scenario():
        codes = {(await lab.fetch(f"/?token={i}", headers=NOBODY)).code for i in range(8)}
        assert codes == {403, 429}
        assert (await posted(lab, "")).code == 429
        assert (await posted(lab, lab.opened)).code == 303
        assert (await lab.fetch(f"/?{lab.opened.partition('?')[2]}", headers=NOBODY)).code == 303

    run(scenario)


def test_labs_of_one_machine_do_not_log_each_other_out(lab):
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


def test_who_logs_out_closes_the_pages_of_that_login_and_a_stolen_cookie_is_worthless(lab):
    cookie = {"Cookie": entered(lab.opened)[1], "Origin": lab.address}

    async def scenario():
        async with lab.page() as other, lab.page(cookie) as page:
            await upload(lab, page.token, b"1 2\n", "a.txt")
            foreign = {**cookie, "Origin": "http://evil.example"}
            options = {"method": "POST", "body": ""}
            assert (await lab.fetch("/logout", headers=foreign, **options)).code == 403
            assert (await lab.fetch("/logout", headers=cookie)).code == 405
            assert (await lab.fetch("/here", headers=cookie)).code == 204
            out = await lab.fetch("/logout", headers=cookie, **options)
            assert (out.code, out.headers["Location"]) == (303, "/login")
            assert await page.heard() is None
            assert page.socket.close_code == 1008
            await becomes(lambda: not (lab.folder / page.token).exists())
            assert (await lab.fetch("/here", headers=cookie)).code == 401
            with pytest.raises(HTTPClientError, match="401"):
                async with lab.page(cookie):
                    pass
            await other.ask("explore.code", state={"n": "64"})
            assert (await other.answer())[0] == 1

    run(scenario)


def test_logins_end_with_time_and_their_number_is_bounded(monkeypatch):
    now = [0.0]
    monkeypatch.setattr("roughline.lab.server.access.time.monotonic", lambda: now[0])
    monkeypatch.setattr("roughline.lab.server.access.MOST_REMEMBERED", 3)
    logins = Logins()
    names = [logins.begin("a:1") for _ in range(3)]
    assert not logins.know(names[0], "b:1")
    assert logins.know(names[0], "a:1")  # it is used, so the next is the oldest
    names.append(logins.begin("a:1"))
    assert [logins.lasts(name) for name in names] == [True, False, True, True]
    now[0] = 7 * 86_400.0
    assert not any(map(logins.lasts, names))
    assert not any(logins.know(name, "a:1") for name in names)


def test_a_token_is_new_at_each_start_and_told_in_any_case():
    assert Key(None).secret != Key(None).secret
    key = Key(None)
    key.secret = "f00d"
    for given in ("f00d", " f00d\n", "http://127.0.0.1:1/?view=a&token=f00d&b=1", "?token=f00d x"):
        assert key.opens(given), given
    for given in ("", "f00", "token=", "http://127.0.0.1:1/?token=f00&x=f00d", "tökén"):
        assert not key.opens(given), given


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
