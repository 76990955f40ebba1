"""Bodies that stick in Explore, ticked, refused, dragged, linked and saved as a person would."""

from urllib.parse import urlencode

import numpy as np
import pytest

from lab.explore_driven import address, drawn, image, sentence, settled, strip, table, typed
from lab.looks import asked, cut_off, faint
from lab.test_explore_adhesion import LAW, STICKS
from lab.test_explore_fluid_page import source
from roughline import press
from roughline.lab.explore.reading import state_of

WITHOUT = "?" + urlencode({"view": "explore", "v": "1", **STICKS, "w": ""})
WITH = WITHOUT.replace("w=&", "w=1&")


@pytest.fixture(scope="module")
def small(pages):
    """Return one page on a small grid, for tests that set what they need."""
    page = pages.open(WITHOUT)
    settled(page, points=64)
    return page


@pytest.fixture(scope="module")
def sticking(pages):
    """Return another page with bodies that stick, which are long pressed: tests set what counts."""
    page = pages.open(WITH)
    at_rest(page, points=64)
    return page


def at_rest(page, **wanted):
    """Wait until everything at rest is drawn, with both ways."""
    settled(page, **wanted)
    drawn(page, "cycle", what="w")
    page.wait_for_selector("#explore .cancel", state="hidden")


def model(page, name, attribute):
    return page.evaluate(
        """([name, attribute]) => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name(name));
            return made.get_model_by_name(name)[attribute];
        }""",
        [name, attribute],
    )


def test_the_tick_shows_both_ways_with_this_load_on_each_and_takes_them_away_again(small):
    elastic = strip(small)
    assert not small.is_visible("#tab-cycle")
    assert not small.is_visible('#explore [data-text="w"]')
    small.check("#explore-adds-w")
    at_rest(small, points=64)
    drawn(small, "cycle", what="w")
    assert small.is_visible("#plot-explore-cycle")
    depths, forces = source(small, "cycle here")
    assert forces == pytest.approx([0.08, 0.08])
    assert depths[0] < depths[1]
    assert model(small, "cycle cursor", "location") == pytest.approx(0.08)
    [_], [pull] = source(small, "cycle pull-off")
    assert pull == pytest.approx(min(source(small, "cycle back")[1]), rel=0.1)
    said = strip(small)
    assert said.keys() - elastic.keys() == {"retreat", "pull_off", "pulling", "zone"}
    assert float(said["pull_off"][0]) == pytest.approx(pull, rel=0.01)
    assert {row[-1] for row in table(small, "cycle")} == {"there", "back"}
    assert set(image(small, "contact")) == {0, 1, 2}
    assert address(small)["w"] == "1"
    small.select_option('#explore [data-key="shown"]', "retreat")
    wider = np.count_nonzero(np.array(image(small, "contact")) == 1)
    surface = state_of(STICKS, 64).surface(64)
    there = press(surface, E_star=110e9, law=LAW, forces=[0.08 * 110], fields=True)
    assert wider > there.fields[0].contact.sum()
    small.uncheck("#explore-adds-w")
    settled(small, points=64)
    small.wait_for_function("() => !document.querySelector('[data-answer=pull_off]')")
    assert strip(small) == elastic
    assert not small.is_visible("#tab-cycle")
    assert small.is_visible("#plot-explore-area")
    assert set(image(small, "contact")) == {0, 1}
    assert small.input_value('#explore [data-key="shown"]') == "area"
    assert "w" not in address(small)


def test_a_link_shows_the_same_ways(sticking, pages):
    other = pages.open("?" + urlencode(address(sticking)))
    at_rest(other, points=64)
    assert other.is_checked("#explore-adds-w")
    assert other.is_visible("#plot-explore-cycle")
    assert strip(other) == strip(sticking)
    assert table(other, "cycle") == table(sticking, "cycle")
    other.context.close()


def test_a_range_that_the_grid_does_not_resolve_is_refused_and_the_rest_lives(sticking):
    typed(sticking, "h0", "0.1")
    refused = sentence(sticking, "h0")
    refused.filter(has_text="too short for the grid").wait_for()
    typed(sticking, "F", "0.05")
    at_rest(sticking, points=64, F=0.05)
    sticking.wait_for_selector("[data-answer=pull_off]")
    assert "0.5 is used meanwhile" in refused.inner_text()
    typed(sticking, "h0", "0.4")
    at_rest(sticking, points=64, h0=0.4)
    assert refused.inner_text() == ""


def test_a_hardness_beside_is_refused_at_its_control(sticking):
    sticking.check("#explore-adds-hardness_bar")
    sentence(sticking, "hardness_bar").filter(has_text="stick and yield").wait_for()
    sticking.uncheck("#explore-adds-hardness_bar")
    at_rest(sticking, points=64)
    assert sentence(sticking, "hardness_bar").inner_text() == ""
    assert "pull_off" in strip(sticking)


def test_a_zone_of_few_cells_is_warned_of_in_the_strip(sticking):
    typed(sticking, "h0", "0.35")
    at_rest(sticking, points=64, h0=0.35)
    value, below = strip(sticking)["zone"]
    assert value == "2.5 cells *"
    assert "4 are needed" in below


def test_the_line_of_the_load_can_be_dragged(sticking):
    sticking.evaluate(
        """() => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name("cycle cursor"));
            made.get_model_by_name("cycle cursor").location = 0.04;
        }"""
    )
    at_rest(sticking, points=64, F=0.04)
    sticking.wait_for_function(
        """() => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name("cycle here"));
            return Math.abs(made.get_model_by_name("cycle here").data.y[0] - 0.04) < 1e-9;
        }"""
    )


def test_both_ways_can_be_cancelled(pages):
    page = pages.open(WITH.replace("n=64", "n=256"))
    page.wait_for_selector("#explore .cancel:visible")
    drawn(page, points=256)
    page.click("#explore .cancel")
    page.locator("#explore [data-status]").filter(has_text="stopped").wait_for()
    page.wait_for_selector("#explore .cancel", state="hidden")
    page.context.close()


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_texts_stand_out_and_none_is_cut_off(pages, theme):
    page = pages.open(WITH, theme=theme)
    at_rest(page, points=64)
    assert faint(page) == []
    for width, height in ((390, 844), (1200, 800), (1600, 1100)):
        assert cut_off(page, "explore", width, height) == []
        assert asked(page, "tiny", "explore") == []
    assert asked(page, "nameless", "explore") == []
    assert asked(page, "undescribed", "explore") == []
    page.context.close()


def test_a_curve_arrives(sticking):
    sticking.select_option("#saved", "curve.csv")
    with sticking.expect_download() as coming:
        sticking.click("#save")
    assert coming.value.suggested_filename == "curve.csv"
