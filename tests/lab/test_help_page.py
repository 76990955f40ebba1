"""Help is one quiet line under its control, and never in the way."""

TOLD = """() => {
    const told = document.querySelector("#explore-D_f-meaning");
    return told.offsetHeight > 0 && getComputedStyle(told).visibility === "visible";
}"""


def until(page, wanted):
    """Wait until the help is there, or gone."""
    page.wait_for_function(f"() => ({TOLD})() === {str(wanted).lower()}")


def test_help_comes_after_a_while_under_its_control_and_never_while_a_button_is_down(fresh):
    slider = fresh.locator("#explore-D_f")
    place = slider.bounding_box()
    slider.hover()
    assert not fresh.evaluate(TOLD)
    until(fresh, True)
    assert slider.bounding_box() == place
    line = fresh.locator("#explore-D_f-meaning").bounding_box()
    assert line["y"] >= place["y"] + place["height"]
    assert line["x"] + line["width"] <= fresh.locator(".answers").first.bounding_box()["x"]
    fresh.mouse.down()
    until(fresh, False)
    fresh.mouse.move(place["x"] + 90, place["y"] + place["height"] / 2)
    assert not fresh.evaluate(TOLD)
    fresh.mouse.up()


def test_help_comes_at_once_to_keys_and_escape_takes_it_away(fresh):
    fresh.focus("#explore-D_f-text")
    until(fresh, True)
    fresh.keyboard.press("Escape")
    until(fresh, False)
    fresh.keyboard.press("Tab")
    fresh.keyboard.press("Shift+Tab")
    until(fresh, True)
