"""Bodies that stick in Explore, ticked, refused, dragged, linked and saved as a person would."""

from functools import partial
from urllib.parse import urlencode

import numpy as np
import pytest

from lab.explore_driven import (
    address,
    assert_linked,
    assert_taken_away,
    drawn,
    image,
    model,
    sentence,
    settled,
    source,
    strip,
    table,
    typed,
)
from lab.looks import texts_stand_out
from lab.test_explore_adhesion import LAW, STICKS
from roughline import press
from roughline.lab.explore.reading import read_state

WITHOUT = "?" + urlencode({"view": "explore", "v": "1", **STICKS, "w": ""})
WITH = WITHOUT.replace("w=&", "w=1&")


def at_rest(page, **wanted):
    """Wait until everything at rest is drawn, with both ways."""
    settled(page, **wanted)
    drawn(page, "cycle", what="w")
    page.wait_for_selector("#explore .cancel", state="hidden")


def both_ways_are_shown(page, elastic):
    """With this load on each."""
    assert page.is_visible("#plot-explore-cycle")
    depths, forces = source(page, "cycle here")
    assert forces == pytest.approx([0.08, 0.08])
    assert depths[0] < depths[1]
    assert model(page, "cycle cursor", "location") == pytest.approx(0.08)
    [_], [pull] = source(page, "cycle pull-off")
    assert pull == pytest.approx(min(source(page, "cycle back")[1]), rel=0.1)
    said = strip(page)
    assert said.keys() - elastic.keys() == {"retreat", "pull_off", "pulling", "zone"}
    assert float(said["pull_off"][0]) == pytest.approx(pull, rel=0.01)
    assert {row[-1] for row in table(page, "cycle")} == {"there", "back"}
    assert set(image(page, "contact")) == {0, 1, 2}
    assert address(page)["w"] == "1"
    page.select_option('#explore [data-key="shown"]', "retreat")
    wider = np.count_nonzero(np.array(image(page, "contact")) == 1)
    surface = read_state(STICKS).surface(64)
    there = press(surface, E_star=110e9, law=LAW, forces=[0.08 * 110], fields=True)
    assert wider > there.fields[0].contact.sum()


def range_that_the_grid_does_not_resolve_is_refused_and_the_rest_lives(page):
    typed(page, "h0", "0.1")
    refused = sentence(page, "h0")
    refused.filter(has_text="too short for the grid").wait_for()
    typed(page, "F", "0.05")
    at_rest(page, points=64, F=0.05)
    page.wait_for_selector("[data-answer=pull_off]")
    assert "0.5 is used meanwhile" in refused.inner_text()
    typed(page, "h0", "0.35")
    at_rest(page, points=64, h0=0.35)
    assert refused.inner_text() == ""
    value, below = strip(page)["zone"]
    assert value == "2.5 cells *"
    assert "4 are needed" in below


def hardness_beside_is_refused_at_its_control(page):
    page.check("#explore-adds-hardness_bar")
    sentence(page, "hardness_bar").filter(has_text="stick and yield").wait_for()
    page.uncheck("#explore-adds-hardness_bar")
    at_rest(page, points=64)
    assert sentence(page, "hardness_bar").inner_text() == ""
    assert "pull_off" in strip(page)


def line_of_the_load_is_dragged(page):
    page.evaluate(
        """() => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name("cycle cursor"));
            made.get_model_by_name("cycle cursor").location = 0.04;
        }"""
    )
    at_rest(page, points=64, F=0.04)
    page.wait_for_function(
        """() => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name("cycle here"));
            return Math.abs(made.get_model_by_name("cycle here").data.y[0] - 0.04) < 1e-9;
        }"""
    )


@pytest.mark.parametrize(("theme", "all_of_it"), [("light", False), ("dark", True)])
def test_walk_over_bodies_that_stick(pages, theme, all_of_it):
    page = pages.open(WITHOUT, theme=theme)
    settled(page, points=64)
    elastic = strip(page)
    assert not page.is_visible("#tab-cycle")
    assert not page.is_visible('#explore [data-text="w"]')
    page.check("#explore-adds-w")
    at_rest(page, points=64)
    both_ways_are_shown(page, elastic)
    texts_stand_out(page, "explore")
    if all_of_it:
        assert_linked(page, pages, "w", "cycle", partial(at_rest, points=64))
        page.select_option("#saved", "curve.csv")
        with page.expect_download() as coming:
            page.click("#save")
        assert coming.value.suggested_filename == "curve.csv"
    assert_taken_away(page, "w", "cycle", elastic)
    page.context.close()


def test_what_bodies_that_stick_cannot_have_is_refused_and_the_load_is_dragged(tab):
    page = tab(WITH)
    at_rest(page, points=64)
    line_of_the_load_is_dragged(page)
    hardness_beside_is_refused_at_its_control(page)
    range_that_the_grid_does_not_resolve_is_refused_and_the_rest_lives(page)


def test_both_ways_can_be_cancelled(pages):
    page = pages.open(WITH.replace("n=64", "n=256"))
    page.wait_for_selector("#explore .cancel:visible")
    drawn(page, points=256)
    page.click("#explore .cancel")
    page.locator("#explore [data-status]").filter(has_text="stopped").wait_for()
    page.wait_for_selector("#explore .cancel", state="hidden")
    page.context.close()
