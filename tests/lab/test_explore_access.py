"""Explore for everyone: by keyboard alone, at any width, read aloud, in both themes."""

import pytest

from lab.explore_driven import SMALL, address, sentence, settled, typed
from lab.looks import asked, cut_off, faint, tabbed


@pytest.fixture(scope="module")
def small(pages):
    """Return one page on a small grid."""
    page = pages.open(SMALL)
    settled(page, points=64)
    return page


def test_the_theme_is_changed_and_kept_and_texts_stand_out_in_both(pages):
    page = pages.open(SMALL)
    settled(page, points=64)
    typed(page, "D_f", "5")
    sentence(page, "D_f").filter(has_text="from 2 to 3").wait_for()
    page.click("#help")
    page.focus("#explore-h")  # what it means is shown
    for summary in page.locator("#explore summary:visible").all():
        summary.click()
    assert faint(page) == []
    paper = """() => [getComputedStyle(document.querySelector(".panel")).backgroundColor,
        Bokeh.documents[0].roots()[0].background_fill_color,
        Bokeh.documents[0].get_model_by_name("contact colours").palette.join()]"""
    light = page.evaluate(paper)
    page.click("#theme")
    dark = page.evaluate(paper)
    assert all(before != after for before, after in zip(light, dark, strict=True))
    page.focus("#explore-h")
    assert faint(page) == []
    page.reload()
    settled(page, points=64)
    assert page.evaluate(paper) == dark
    assert page.inner_text("#theme") == "light"
    page.context.close()


def test_all_controls_have_names_and_descriptions(small):
    assert asked(small, "nameless", "explore") == []
    assert asked(small, "undescribed", "explore") == []
    assert small.evaluate(
        """() => [...document.querySelectorAll("#explore [type=range]")].every(
            (each) => each.getAttribute("aria-valuetext"))"""
    )


def test_tabs_are_changed_by_arrows(small):
    small.focus("#tab-area")
    small.keyboard.press("ArrowRight")
    assert small.evaluate("() => document.activeElement.id") == "tab-spectrum"
    assert small.is_visible("#plot-explore-spectrum")
    assert not small.is_visible("#plot-explore-area")
    small.keyboard.press("ArrowLeft")
    assert small.is_visible("#plot-explore-area")
    assert small.get_attribute("#tab-area", "aria-selected") == "true"


def test_what_rests_is_spoken(small):
    typed(small, "F", "0.3")
    settled(small, points=64, F=0.3)
    spoken = small.locator("#explore [data-spoken]").inner_text()
    assert "stiffness k" in spoken
    assert "certified" in spoken


def test_walk_by_keys_alone(small):
    wanted, reached, unseen = tabbed(small, "explore")
    assert reached == wanted
    assert unseen == []
    press_by_keys(small)


def press_by_keys(page):
    """Set all kinds of controls, and see what follows."""
    page.focus("#explore-F")
    page.keyboard.press("End")
    settled(page, points=64, F=10)
    page.focus('#explore [data-key="n"]:checked')
    page.keyboard.press("ArrowDown")
    settled(page, points=128)
    page.focus('#explore [data-key="theories"][value="persson"]')
    page.keyboard.press("Space")
    page.locator('[data-remarks="area"]').filter(has_text="Persson").wait_for()
    page.focus('#explore [data-key="shown"]')
    page.keyboard.press("p")
    assert address(page)["shown"] == "pressure"
    page.focus("#explore [data-code=command]")
    page.keyboard.press("Enter")
    page.wait_for_selector("#explore-code[open]")
    page.keyboard.press("Escape")
    page.wait_for_selector("#explore-code", state="hidden")
    assert page.evaluate("() => document.activeElement.dataset.code") == "command"
    page.focus("#saved")
    for _ in range(2):
        page.keyboard.press("ArrowDown")
    assert page.input_value("#saved") == "curve.csv"
    page.focus("#save")
    with page.expect_download() as coming:
        page.keyboard.press("Enter")
    assert coming.value.suggested_filename == "curve.csv"
    ends = """() => {
        const {start, end} = Bokeh.documents[0].get_model_by_name("explore-stiffness").x_range;
        return end / start;
    }"""
    whole = page.evaluate(ends)
    page.focus("#plot-explore-stiffness")
    page.keyboard.press("+")
    assert page.evaluate(ends) < whole
    page.keyboard.press("0")
    assert page.evaluate(ends) == pytest.approx(whole)


def test_nothing_is_cut_off_at_any_width_and_on_a_phone_a_refusal_is_seen(pages):
    page = pages.open(SMALL + "&theories=persson,greenwood-williamson&F=abc", width=390, height=844)
    sentence(page, "").filter(has_text="load").wait_for()  # although controls are folded
    assert not page.is_visible("#explore-D_f")
    page.click("#explore .drawer")
    assert page.get_attribute("#explore .drawer", "aria-expanded") == "true"
    typed(page, "F", "0.2")
    typed(page, "D_f", "2.5")
    settled(page, D_f=2.5, F=0.2)
    page.mouse.wheel(0, 3000)
    page.wait_for_function(
        """() => {
            const {top} = document.querySelector("#explore .strip").getBoundingClientRect();
            return scrollY > 100 && top >= 0 && top < 10;
        }"""
    )
    for width, height in ((390, 844), (1200, 800), (1600, 1100), (3840, 2160)):
        assert cut_off(page, "explore", width, height) == []
        assert asked(page, "tiny", "explore") == []
    page.context.close()
