"""Limits of size and of coupling, which keep the code readable; `make architecture` prints them."""

import pytest
from architecture import arrows, circles, import_graph, large_functions, long_files, rooms

MOST_ROOMS = 25
MOST_ARROWS = 110
LARGEST_SHARE = 0.15


@pytest.fixture(scope="module")
def graph():
    return import_graph()


def test_there_are_few_rooms_and_few_arrows_between_them(graph):
    found = rooms(graph)
    assert len(found) <= MOST_ROOMS
    assert len(arrows(found)) <= MOST_ARROWS


def test_no_room_is_much_larger_than_the_others(graph):
    lines = {name: room.lines for name, room in rooms(graph).items()}
    total = sum(lines.values())
    assert not [name for name in lines if lines[name] > LARGEST_SHARE * total]


def test_no_files_import_each_other(graph):
    assert circles(graph) == []


def test_no_file_is_too_long():
    assert long_files() == []


def test_no_function_is_too_large():
    assert large_functions() == []
