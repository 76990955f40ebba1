"""Shear in Explore, ticked, dragged, refused and linked as a person would."""

from functools import partial

import numpy as np
import pytest

from lab.explore_driven import (
    SMALL,
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

SHEAR = {"slide", "tangential", "lost", "stuck"}


def at_rest(page, **wanted):
    """Wait until everything at rest is drawn, with the loop."""
    settled(page, **wanted)
    drawn(page, "loop", what="mu")
    page.wait_for_selector("#explore .cancel", state="hidden")


def loop_is_shown(page, elastic):
    assert page.is_visible("#plot-explore-loop")
    said = strip(page)
    assert said.keys() - elastic.keys() == SHEAR
    assert {key: said[key] for key in elastic} == elastic  # the contact is that without shear
    slides, shares = (np.array(each) for each in source(page, "loop loop"))
    assert shares.max() == pytest.approx(0.15)
    assert shares.min() == pytest.approx(-0.15)
    assert slides[0] == pytest.approx(slides[-1], rel=1e-4)  # 16 loads, each solved to 1e-6
    assert model(page, "loop cursor", "location") == pytest.approx(0.15)
    assert {row[-1] for row in table(page, "loop")} == {"from no shear", "a cycle"}
    page.select_option('#explore [data-key="shown"]', "stick")
    assert set(image(page, "contact")) == {0, 1, 2}


def line_of_the_shear_is_dragged_and_too_much_is_refused(page):
    page.evaluate(
        """() => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name("loop cursor"));
            made.get_model_by_name("loop cursor").location = 0.1;
        }"""
    )
    at_rest(page, points=64, Q=0.1)
    page.wait_for_function(
        """() => {
            const made = Bokeh.documents.find((each) => each.get_model_by_name("loop here"));
            return Math.abs(made.get_model_by_name("loop here").data.y[0] - 0.1) < 1e-9;
        }"""
    )
    typed(page, "Q", "0.4")
    refused = sentence(page, "Q").filter(has_text="under which the bodies slide")
    refused.wait_for()
    assert "0.1 is used meanwhile" in refused.inner_text()
    typed(page, "mu", "0.5")
    at_rest(page, points=64, mu=0.5, Q=0.4)
    assert sentence(page, "Q").inner_text() == ""


@pytest.mark.parametrize(("theme", "all_of_it"), [("light", False), ("dark", True)])
def test_walk_over_shear(pages, theme, all_of_it):
    page = pages.open(SMALL, theme=theme)
    settled(page, points=64)
    elastic = strip(page)
    assert not page.is_visible("#tab-loop")
    page.check("#explore-adds-mu")
    at_rest(page, points=64, mu=0.3)
    loop_is_shown(page, elastic)
    texts_stand_out(page, "explore")
    if all_of_it:
        line_of_the_shear_is_dragged_and_too_much_is_refused(page)
        assert_linked(page, pages, "mu", "loop", partial(at_rest, points=64, mu=0.5, Q=0.4))
    assert_taken_away(page, "mu", "loop", elastic)
    page.context.close()
