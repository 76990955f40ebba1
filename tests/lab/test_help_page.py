"""Help is one quiet line under its control, and never in the way."""

import pytest

from lab.explore_driven import SMALL, settled


@pytest.fixture
def page(tab):
    """Explore, at rest."""
    opened = tab(SMALL)
    settled(opened, points=64)
    return opened


TOLD = """() => {
    const told = document.querySelector("#explore-D_f-meaning");
    return told.offsetHeight > 0 && getComputedStyle(told).visibility === "visible";
}"""


def until(page, wanted):
    """Wait until the help is there, or gone."""
    page.wait_for_function(f"() => ({TOLD})() === {str(wanted).lower()}")


def test_help_comes_after_a_while_under_its_control_and_never_while_a_button_is_down(page):
    slider = page.locator("#explore-D_f")
    place = slider.bounding_box()
    slider.hover()
    assert not page.evaluate(TOLD)
    until(page, True)
    assert slider.bounding_box() == place
    help_line = page.locator("#explore-D_f-meaning").bounding_box()
    assert help_line["y"] >= place["y"] + place["height"]
    assert help_line["x"] + help_line["width"] <= page.locator(".answers").first.bounding_box()["x"]
    page.mouse.down()
    until(page, False)
    page.mouse.move(place["x"] + 90, place["y"] + place["height"] / 2)
    assert not page.evaluate(TOLD)
    page.mouse.up()


def test_help_comes_at_once_to_keys_and_escape_takes_it_away(page):
    page.focus("#explore-D_f-text")
    until(page, True)
    page.keyboard.press("Escape")
    until(page, False)
    page.keyboard.press("Tab")
    page.keyboard.press("Shift+Tab")
    until(page, True)
