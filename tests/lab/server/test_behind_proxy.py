"""A lab behind a proxy that others keep: its own, or that of a JupyterHub, which adds a path."""

import sys
from urllib.parse import urlsplit

import pytest

from lab.server.serving import lab_here, run

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
HUB = "https://hub.example.org"
PATH = "/user/ann/proxy/5107/"


@pytest.fixture(scope="module", params=["", PATH], ids=["own", "JupyterHub"])
def proxied(request, tmp_path_factory):
    """A lab whose address is that of a proxy."""
    with lab_here(tmp_path_factory.mktemp("behind"), address=f"{HUB}{request.param}") as lab:
        yield lab, request.param or "/"


@pytest.mark.parametrize("host", ["hub.example.org", "127.0.0.1:5107"])
def test_pages_of_the_proxy_are_answered_whatever_name_it_calls(proxied, host):
    lab, path = proxied

    async def scenario():
        token = urlsplit(lab.opened).query
        entered = await lab.fetch(f"/?{token}&view=measured", headers={"Host": host, "Cookie": ""})
        assert entered.headers["Location"] == "./?view=measured"
        cookie, *said = entered.headers["Set-Cookie"].split("; ")
        assert {"Secure", f"Path={path}"} <= set(said)
        through = {"Host": host, "Cookie": cookie, "Origin": HUB}
        assert (await lab.fetch("/here", headers=through)).code == 204
        for origin in ("https://evil.example", "null", "http://hub.example.org"):
            assert (await lab.fetch("/here", headers={**through, "Origin": origin})).code == 403
        page = (await lab.fetch("/", headers=through)).body.decode()
        assert 'href="/' not in page
        assert 'src="/' not in page

    run(scenario)
