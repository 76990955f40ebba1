"""A lab behind a real nginx with TLS, set up as the guide to the lab says."""

import asyncio
import re
import shutil
import socket
import ssl
import subprocess
import sys
from pathlib import Path

import pytest
from tornado.httpclient import AsyncHTTPClient, HTTPRequest

from lab.server.serving import log_in, run, running_lab, wait_until
from lab_in_browser import Pages

NGINX = shutil.which("nginx", path="/usr/sbin:/usr/local/sbin:/usr/bin:/usr/local/bin")
pytestmark = [
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="many addresses of loopback"),
    pytest.mark.skipif(NGINX is None, reason="nginx is not installed"),
    pytest.mark.skipif(shutil.which("openssl") is None, reason="openssl is not installed"),
]
PASSWORD = "correct horse"
GUIDE = Path(__file__).parents[3] / "docs" / "lab.md"
ANNA, BORIS, NOBODY = "127.0.0.2", "127.0.0.3", "127.0.0.9"
CONFIGURATION = """
daemon off;
master_process off;
pid nginx.pid;
error_log stderr;
events {{}}
http {{
    access_log off;
    client_body_temp_path bodies;
    proxy_temp_path proxied;
    fastcgi_temp_path fastcgi;
    uwsgi_temp_path uwsgi;
    scgi_temp_path scgi;
{block}
}}
"""


class Proxied:
    """A lab, asked through its proxy from one address of this machine or another."""

    def __init__(self, lab, address):
        self.lab, self.address, self.source = lab, address, ANNA

    async def fetch(self, path, **options):
        """Ask by HTTPS; returns the response, whatever its status."""
        options = {"follow_redirects": False, "network_interface": self.source} | options
        request = HTTPRequest(f"{self.address}{path}", validate_cert=False, **options)
        return await AsyncHTTPClient().fetch(request, raise_error=False)

    def seen_from(self, source):
        """The same lab from another address."""
        other = Proxied(self.lab, self.address)
        other.source = source
        return other


@pytest.fixture(scope="module")
def proxied(tmp_path_factory):
    """A lab and the nginx of the guide before it."""
    temporary, folder = tmp_path_factory.mktemp("lab"), tmp_path_factory.mktemp("nginx")
    (temporary / "password").write_text(PASSWORD)
    (temporary / "password").chmod(0o600)
    options = ("--behind-proxy", "127.0.0.1", "--password-file", str(temporary / "password"))
    with running_lab(*options, temporary=temporary) as lab, socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
        free.close()
        (folder / "nginx.conf").write_text(
            CONFIGURATION.format(block=_block_of_guide(lab.address, port, folder))
        )
        with subprocess.Popen(
            [NGINX, "-p", str(folder), "-c", "nginx.conf"], stderr=(folder / "said").open("w")
        ) as nginx:
            try:
                wait_until(lambda: _answers(port) or nginx.poll() is not None)
                assert nginx.poll() is None, (folder / "said").read_text()
                yield Proxied(lab, f"https://127.0.0.1:{port}")
            finally:
                nginx.terminate()


def _block_of_guide(lab, port, folder):
    """The block of the guide, with the addresses and a certificate of this test."""
    key, certificate = folder / "key.pem", folder / "certificate.pem"
    made = "openssl req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=lab.example.org"
    command = [*made.split(), "-keyout", str(key), "-out", str(certificate)]
    subprocess.run(command, check=True, capture_output=True)
    (block,) = re.findall(r"```nginx\n(.*?)```", GUIDE.read_text(), re.DOTALL)
    for old, new in {
        "listen 443": f"listen 127.0.0.1:{port}",
        "http://127.0.0.1:5107": lab,
        "/etc/ssl/certs/lab.example.org.pem": str(certificate),
        "/etc/ssl/private/lab.example.org.key": str(key),
    }.items():
        assert block.count(old) == 1
        block = block.replace(old, new)
    return block


def _answers(port):
    context = ssl.create_default_context()
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    try:
        with socket.create_connection(("127.0.0.1", port)) as each:
            context.wrap_socket(each).close()
    except OSError:
        return False
    return True


def test_it_says_what_it_trusts(proxied):
    said = proxied.lab.process.stdout.readline()
    assert "answers only what comes through 127.0.0.1, and believes from there who asks" in said


def test_visitors_do_not_lock_each_other_out_and_cannot_pretend_to_be_others(proxied):
    anna, boris = proxied.seen_from("127.0.0.5"), proxied.seen_from(BORIS)

    async def scenario():
        codes = [(await log_in(anna, "wrong password")).code for _ in range(6)]
        assert codes == [403] * 5 + [429]
        assert (await log_in(anna, PASSWORD)).code == 429
        for forged in ("1.2.3.4", "127.0.0.1", "1.2.3.4, 127.0.0.1", "junk", "", "x" * 5000):
            headers = {"Origin": anna.address, "X-Forwarded-For": forged, "X-Real-Ip": forged}
            answer = await anna.fetch(
                "/login", method="POST", body="password=wrong", headers=headers
            )
            assert answer.code == 429, forged
        for _ in range(8):  # a class that comes by one address
            assert (await log_in(boris, PASSWORD)).code == 303

    run(scenario)


def test_the_cookie_is_secure_whatever_a_visitor_says_and_no_other_way_leads_in(proxied):
    async def scenario():
        headers = {"Origin": proxied.address, "X-Forwarded-Proto": "http"}
        body = f"password={PASSWORD}"
        answer = await proxied.fetch("/login", method="POST", body=body, headers=headers)
        assert "secure" in answer.headers["Set-Cookie"].lower()
        around = {"network_interface": NOBODY, "headers": {"X-Forwarded-For": ANNA}}
        for path in ("/login", "/", "/lab/lab.js", "/here"):
            answer = await proxied.lab.fetch(path, **around)
            assert answer.code == 403
            assert b"through its proxy only" in answer.body
        # the proxy itself asks whether the lab is there
        assert (await proxied.lab.fetch("/login")).code == 200

    run(scenario)


def test_pages_of_others_are_refused_through_it_too(proxied):
    async def scenario():
        for origin in ("https://evil.example", "null", proxied.lab.address):
            headers = {"Origin": origin}
            answer = await proxied.fetch("/login", method="POST", body="", headers=headers)
            assert answer.code == 403

    run(scenario)


def test_a_proxy_may_have_more_connections_than_one_visitor(proxied):
    port = int(proxied.lab.address.rpartition(":")[2])

    async def scenario():
        opened = [await asyncio.open_connection("127.0.0.1", port) for _ in range(230)]
        assert (await proxied.fetch("/login")).code == 200
        assert not opened[0][0].at_eof()  # it was not closed for the others
        for _, writer in opened:
            writer.close()

    run(scenario)


def test_the_page_is_used_through_it(proxied, browser):
    pages = Pages(browser, proxied.address)
    page = pages.open("?view=measured", ignore_https_errors=True)
    with pages.expecting("/here|/login"):
        page.fill("#password", "wrong password")
        page.keyboard.press("Enter")
        page.locator('[role="alert"]').filter(has_text="not the password").wait_for()
        page.fill("#password", PASSWORD)
        page.keyboard.press("Enter")
        page.wait_for_url("**/?view=measured*")
    (cookie,) = page.context.cookies()
    assert cookie["secure"]
    assert cookie["httpOnly"]
    assert cookie["sameSite"] == "Strict"
    rows = b"\n".join(b" ".join(b"%d" % (i * j % 7) for i in range(64)) for j in range(64))
    file = {"name": "map.txt", "mimeType": "text/plain", "buffer": rows}
    page.wait_for_selector("#plot-measured-file >> nth=0", state="attached")  # the view is ready
    page.set_input_files("#measured [data-file]", file)
    page.wait_for_selector('#measured [data-result="file"]')
    page.goto(f"{proxied.address}/?view=explore&v=1&n=64")
    page.wait_for_selector("#plot-explore-contact[data-shown]")
    # nginx ends idle connections; a browser that meets several such in a row gives up a request
    with pages.expecting("/here|WebSocket|ERR_TOO_MANY_RETRIES"):
        page.click("#log-out")
        page.wait_for_selector("#password")
    pages.close()
    assert not [each for each in pages.complaints if "certificate" not in each]
