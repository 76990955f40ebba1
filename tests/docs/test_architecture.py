"""The page on the architecture: its picture, its rooms and its paths are those of the code."""

import re

import pytest
from architecture import PICTURE, ROOT, facts_in, import_graph, layers, rooms
from draw_architecture import HUNDREDS, ONE_BODY
from seams import FILE, PAGE, changes, written

import roughline as rl

AGAIN = "the picture is not of this code any more: run `make architecture`"
LINES_MAY_DIFFER = 0.2  # the picture shows them as bars

TEXT = PAGE.read_text("utf-8")
ROOMS = re.findall(r"^\| `(\w+)/?` \|", TEXT, re.MULTILINE)
PATHS = sorted(set(re.findall(r"`((?:src|tests|docs|studies)/[^`]*)`", TEXT)))


@pytest.fixture(scope="module")
def found():
    return rooms(import_graph())


@pytest.fixture(scope="module")
def known(found):
    """What each room knows of others, those of which it only names the types among them."""
    return {name: {name, *room.imports} for name, room in found.items()}


def test_the_picture_has_the_layers_and_imports_of_today(found):
    drawn = facts_in(PICTURE)
    assert drawn["layers"] == layers(), AGAIN
    assert {name: room["imports"] for name, room in drawn["rooms"].items()} == {
        name: list(room.imports) for name, room in found.items()
    }, AGAIN


def test_the_picture_has_about_the_lines_of_today(found):
    for name, room in facts_in(PICTURE)["rooms"].items():
        assert room["lines"] == pytest.approx(found[name].lines, LINES_MAY_DIFFER, abs=50), AGAIN


@pytest.mark.parametrize("step", [*ONE_BODY, *HUNDREDS], ids=str)
def test_each_step_of_the_walk_is_made_by_a_room_that_knows_both_ends(step, known):
    assert {step.giver, step.taker} <= known[step.by]


def test_every_room_has_its_line_and_its_layer(found):
    assert sorted(ROOMS) == sorted(found)
    assert sorted(name for row in layers() for name in row) == sorted(found)


@pytest.mark.parametrize("path", PATHS)
def test_every_path_is_there(path):
    assert (ROOT / path).exists()


def test_the_counts_are_those_of_today():
    assert written(TEXT) == TEXT, (
        "the counts are not of this code any more: run `make architecture`"
    )


def test_what_changes_touched_is_that_of_the_history():
    assert changes() == FILE.read_text("utf-8")


def test_no_room_has_the_name_of_something_public(found):
    assert not set(found) & set(rl.__all__)
