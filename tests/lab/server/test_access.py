"""Who may speak to the lab."""

import pytest

from roughline.errors import InputError
from roughline.lab.server.access import (
    cookie_name,
    cookie_scope,
    host_is_ours,
    opens,
    origin_is_ours,
)
from roughline.lab.server.settings import ServerSettings

HERE = ServerSettings()
BEHIND = ServerSettings(address="https://hub.example.org/user/ann/proxy/5107/")


@pytest.mark.parametrize("host", ["127.0.0.1:5107", "localhost", "LOCALHOST:1", "[::1]:5107"])
def test_names_of_this_machine_are_ours(host):
    assert host_is_ours(host, HERE)
    assert host_is_ours(host, BEHIND)


@pytest.mark.parametrize(
    "host", ["rebound.example:5107", "127.0.0.1.example", "", "[::1", "localhost:x", "a@evil", "0"]
)
def test_names_that_others_point_here_are_not_ours(host):
    assert not host_is_ours(host, HERE)
    assert not host_is_ours(host, BEHIND)


def test_the_name_before_a_proxy_is_ours_and_any_where_others_are_let_in():
    assert host_is_ours("hub.example.org", BEHIND)
    assert not host_is_ours("hub.example.org", HERE)
    settings = ServerSettings(host="0.0.0.0")
    assert host_is_ours("laboratory.example:5107", settings)
    assert not host_is_ours("", settings)


def test_only_pages_of_the_same_name_and_port_may_ask():
    assert origin_is_ours("http://localhost:5107", "localhost:5107", HERE)
    others = ("null", "", "http://localhost", "http://localhost:5108", "http://[", "ftp:", None)
    for origin in others:
        for settings in (HERE, BEHIND):
            assert not origin_is_ours(origin, "localhost:5107", settings)
    assert not origin_is_ours("null", "", HERE)


def test_pages_that_come_through_the_proxy_may_ask_whatever_it_calls_this_server():
    for host in ("127.0.0.1:5107", "hub.example.org"):
        assert origin_is_ours("https://hub.example.org", host, BEHIND)
        assert not origin_is_ours("https://evil.example.org", host, BEHIND)
    assert not origin_is_ours("http://hub.example.org", "127.0.0.1:5107", BEHIND)


def test_the_cookie_is_for_the_path_before_the_proxy_and_is_sent_encrypted():
    assert cookie_scope(BEHIND) == ("/user/ann/proxy/5107/", True)
    assert cookie_scope(HERE) == ("/", False)
    assert cookie_name("127.0.0.1:1") != cookie_name("127.0.0.1:2") != cookie_name("127.0.0.1")


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
    with pytest.raises(InputError, match=said.replace("?", r"\?")):
        ServerSettings(**options)


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "::1", "127.9.9.9"])
def test_this_machine_alone_is_reached_by_its_own_addresses(host):
    assert ServerSettings(host=host).is_local
    assert not ServerSettings(host="0.0.0.0").is_local
    assert not ServerSettings(host="laboratory").is_local
