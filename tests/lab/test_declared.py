"""Texts of the views: what they declare is what the page has and what its code names."""

import pytest

from roughline.lab import declared
from roughline.lab.explore import physics
from roughline.lab.explore.state import FIGURES, ExploreState
from roughline.lab.site import page

ROOMS = {view: f"roughline.lab.{view}" for view in ("explore", "published")}


@pytest.mark.parametrize("view", ROOMS)
def test_every_control_of_a_text_is_on_the_page_with_its_words(view):
    for name in ("numbers", "choices"):
        entries = declared.section(ROOMS[view], name)
        assert entries
        for key, entry in entries.items():
            assert f'id="{view}-{key}' in page() or f'data-key="{key}"' in page()
            assert entry.meaning.endswith(".")


def test_entries_without_words_have_those_of_the_next():
    edges = [declared.section(ROOMS["published"], "numbers")[key] for key in ("low_1D", "high_3D")]
    assert edges[0].meaning == edges[1].meaning != ""


def test_a_number_lies_between_its_ends_and_is_read_over_what_it_is_over():
    for number in physics.numbers().values():
        assert number.low <= number.default <= number.high
        if number.unit:
            text = f"{number.default * number.state_scale(ExploreState())!r} {number.unit}"
            assert number.read(text, ExploreState()) == pytest.approx(number.default)


def test_every_figure_of_the_strip_is_told_by_the_contact_or_by_one_physics():
    told = physics.declared()["strip"]
    assert {*told, "stiffness_1d"} == {*FIGURES}
    assert len(told) == len({*told})
