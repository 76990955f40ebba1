"""Who may speak to the lab."""

import os
import shlex
import sys

import pytest

from roughline.errors import InputError
from roughline.lab.server.access import (
    MOST_REMEMBERED,
    Allowance,
    Key,
    allowances,
    host_is_ours,
    is_encrypted,
    is_proxy,
    neighbourhood,
    origin_is_ours,
    visitor,
)
from roughline.lab.server.settings import ServerSettings, networks_in, password_in


@pytest.mark.parametrize("host", ["127.0.0.1:5107", "localhost", "LOCALHOST:1", "[::1]:5107"])
def test_names_of_this_machine_are_ours(host):
    assert host_is_ours(host, ServerSettings())


@pytest.mark.parametrize(
    "host", ["rebound.example:5107", "127.0.0.1.example", "", "[::1", "localhost:x", "a@evil", "0"]
)
def test_names_that_others_point_here_are_not_ours(host):
    assert not host_is_ours(host, ServerSettings())


def test_other_names_lead_to_a_lab_with_a_password():
    settings = ServerSettings(host="0.0.0.0", password="long enough")
    assert host_is_ours("laboratory.example:5107", settings)
    assert not host_is_ours("", settings)


def test_only_pages_of_the_same_name_and_port_may_ask():
    assert origin_is_ours("http://localhost:5107", "localhost:5107")
    for origin in (
        None,
        "null",
        "",
        "http://localhost",
        "http://localhost:5108",
        "http://[",
        "ftp:",
    ):
        assert not origin_is_ours(origin, "localhost:5107")
    assert not origin_is_ours("null", "")


def test_an_allowance_fills_up_with_time(monkeypatch):
    now = [0.0]
    monkeypatch.setattr("roughline.lab.server.access.time.monotonic", lambda: now[0])
    allowance = Allowance(rate=2.0, most=3.0)
    assert [allowance.take() for _ in range(4)] == [True, True, True, False]
    now[0] = 0.5
    assert [allowance.take() for _ in range(2)] == [True, False]
    now[0] = 1e6
    assert [allowance.take() for _ in range(4)] == [True, True, True, False]


def test_tries_of_a_password_are_counted_for_each_address():
    tries = allowances(1 / 12, 5)
    assert [tries("10.0.0.1").take() for _ in range(6)] == [True] * 5 + [False]
    assert tries("10.0.0.2").take()


def test_addresses_that_are_remembered_are_bounded():
    tries = allowances(1 / 12, 1)
    for number in range(MOST_REMEMBERED + 10):
        tries("used again and again").take()
        tries(str(number)).take()
    assert not tries("used again and again").take()
    assert not tries(str(number)).take()
    assert tries("0").take()  # it is forgotten


def test_a_customer_with_many_addresses_counts_once():
    assert neighbourhood("2001:db8:1:2:3::4") == neighbourhood("2001:db8:1:2:ffff::1")
    assert neighbourhood("2001:db8:1:3::1") != neighbourhood("2001:db8:1:2::1")
    assert neighbourhood("::ffff:10.0.0.1") == "10.0.0.1"
    assert neighbourhood("::1") == "::1"
    assert neighbourhood("") == ""


class Asked:
    """A request as a server sees it."""

    protocol = "http"

    def __init__(self, remote_ip, **headers):
        self.remote_ip = remote_ip
        self.headers = {name.replace("_", "-"): each for name, each in headers.items()}


BEHIND = ServerSettings(
    host="0.0.0.0", password="long enough", proxies=networks_in("127.0.0.1, 10.0.0.0/8,fd00::/8")
)


@pytest.mark.parametrize(
    ("peer", "said", "who"),
    [
        ("127.0.0.1", "192.0.2.7", "192.0.2.7"),
        ("127.0.0.1", "198.51.100.1, 192.0.2.7", "192.0.2.7"),
        ("127.0.0.1", "198.51.100.1,192.0.2.7 ,10.1.2.3", "192.0.2.7"),
        ("127.0.0.1", "192.0.2.7:5123", "192.0.2.7"),
        ("127.0.0.1", "[2001:db8:1:2:3::4]:443", "2001:db8:1:2::"),
        ("127.0.0.1", "2001:db8:1:2:3::4", "2001:db8:1:2::"),
        ("127.0.0.1", "::ffff:192.0.2.7", "192.0.2.7"),
        ("::ffff:127.0.0.1", "192.0.2.7", "192.0.2.7"),
        ("fd00::1", "192.0.2.7", "192.0.2.7"),
        ("127.0.0.1", "10.0.0.9, 10.0.0.8", "10.0.0.9"),  # within the trusted network
        ("127.0.0.1", "junk, 10.0.0.9", "10.0.0.9"),
        ("127.0.0.1", "192.0.2.7, junk", "127.0.0.1"),
        ("127.0.0.1", "192.0.2.7,", "127.0.0.1"),
        ("127.0.0.1", "\u0661.2.3.4", "127.0.0.1"),
        ("127.0.0.1", "[", "127.0.0.1"),
        ("127.0.0.1", "", "127.0.0.1"),
        ("192.0.2.9", "198.51.100.1", "192.0.2.9"),
        ("2001:db8:1:2:3::4", "198.51.100.1", "2001:db8:1:2::"),
        ("", "198.51.100.1", ""),
    ],
)
def test_a_visitor_is_who_the_trusted_proxies_say(peer, said, who):
    assert visitor(Asked(peer, X_Forwarded_For=said), BEHIND) == who


def test_nobody_is_believed_where_no_proxy_is_named():
    asked = Asked("127.0.0.1", X_Forwarded_For="192.0.2.7", X_Forwarded_Proto="https")
    assert visitor(asked, ServerSettings()) == "127.0.0.1"
    assert not is_encrypted(asked, ServerSettings())
    assert not is_proxy("127.0.0.1", ServerSettings())


def test_only_a_proxy_says_that_the_way_is_encrypted():
    for said, is_so in {"https": True, "HTTPS ": True, "http": False, "https, http": False}.items():
        assert is_encrypted(Asked("10.0.0.1", X_Forwarded_Proto=said), BEHIND) is is_so
    assert not is_encrypted(Asked("10.0.0.1"), BEHIND)
    assert not is_encrypted(Asked("192.0.2.9", X_Forwarded_Proto="https"), BEHIND)
    assert not is_proxy("192.0.2.9", BEHIND)


def test_any_name_leads_through_a_proxy():
    behind = ServerSettings(password="long enough", proxies=networks_in("127.0.0.1"))
    assert host_is_ours("lab.example.org", behind)
    assert behind.is_local
    assert behind.lets_others_in
    assert BEHIND.names_of_proxies == "127.0.0.1,10.0.0.0/8,fd00::/8"


def test_passwords_of_any_letters_are_compared():
    assert Key("größer als acht").opens("größer als acht")
    assert not Key("größer als acht").opens("größer als ach")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"host": "0.0.0.0"}, "lets other machines in"),
        ({"host": "::"}, "lets other machines in"),
        ({"host": "laboratory.example"}, "lets other machines in"),
        ({"host": ""}, "host is empty"),
        ({"proxies": networks_in("127.0.0.1")}, "behind_proxy is .* put a password into a file"),
        (
            {"proxies": networks_in("10.0.0.5"), "password": "long enough"},
            "proxies on other machines do not reach 127.0.0.1",
        ),
        ({"password": "short"}, "fewer than 8"),
        ({"port": 65536}, "port is 65536"),
        ({"max_upload": 0}, "max_upload is 0; a positive"),
        ({"max_seconds": -1.0}, "max_seconds is -1.0; a positive"),
        ({"max_seconds": float("nan")}, "max_seconds is nan"),
        ({"max_seconds": float("inf")}, "max_seconds is inf"),
        ({"max_memory": 1e6}, "1 MB of memory is too little"),
    ],
)
def test_a_lab_that_makes_no_sense_is_refused(options, said):
    with pytest.raises(InputError, match=said):
        ServerSettings(**options)


@pytest.mark.parametrize("text", ["", "proxy.example", "10.0.0.1,", "10.0.0.0/99", "1.2.3.4:80"])
def test_proxies_are_addresses_or_networks(text):
    with pytest.raises(InputError, match="addresses or networks are needed"):
        networks_in(text)


@pytest.mark.parametrize("text", ["0.0.0.0/0", "127.0.0.1,::/0"])
def test_not_everybody_is_a_proxy(text):
    with pytest.raises(InputError, match="this trusts everybody"):
        networks_in(text)


@pytest.mark.parametrize("host", ["127.0.0.1", "127.8.8.8", "::1", "localhost"])
def test_this_machine_alone_needs_no_password(host):
    assert ServerSettings(host=host).is_local


def test_a_password_is_the_first_line_of_its_file(tmp_path):
    file = tmp_path / "password"
    file.write_text("correct horse\nbattery\n")
    file.chmod(0o600)
    assert password_in(file) == "correct horse"
    link = tmp_path / "link"
    link.symlink_to(file)
    assert password_in(link) == "correct horse"
    file.write_text("größer als acht \r\n")
    assert password_in(file) == "größer als acht"
    file.write_text("\n")
    with pytest.raises(InputError, match="no password in its first line"):
        password_in(file)
    with pytest.raises(InputError, match="it cannot be read"):
        password_in(tmp_path / "missing")
    with file.open("wb") as opened:
        opened.truncate(10**12)  # of zeros, which take no room
    with pytest.raises(InputError, match="at most 1000 bytes"):
        password_in(file)
    file.write_bytes(b"\xff" * 20)
    with pytest.raises(InputError, match="it is no text"):
        password_in(file)


@pytest.mark.skipif(sys.platform == "win32", reason="who may read a file is said otherwise there")
def test_a_password_that_others_may_read_is_refused(tmp_path, monkeypatch):
    file, link = tmp_path / "pass word", tmp_path / "link"
    file.write_text("correct horse")
    link.symlink_to(file)
    for mode in (0o640, 0o604, 0o620, 0o602, 0o644):
        file.chmod(mode)
        for name in (file, link):
            with pytest.raises(InputError) as refusal:
                password_in(name)
            assert str(refusal.value).endswith(f"chmod 600 {shlex.quote(str(name))}")
    file.chmod(0o400)
    assert password_in(file) == "correct horse"
    os.mkfifo(tmp_path / "pipe", 0o600)
    for no_file in (tmp_path / "pipe", tmp_path):
        with pytest.raises(InputError, match="it is no file"):
            password_in(no_file)
    if os.geteuid() == 0:
        os.chown(file, 12345, -1)
    else:  # what belongs to root is taken
        monkeypatch.setattr("os.geteuid", lambda: file.stat().st_uid + 1)
    with pytest.raises(InputError, match="it belongs to somebody else"):
        password_in(file)
