"""Pages for everyone: by keyboard alone, at any width, read aloud, in both themes."""

import numpy as np
import pytest

from lab.drawn_plots import held
from lab.explore_driven import SMALL, address, sentence, settled, typed
from lab.looks import asked, cut_off, faint, tabbed, texts_stand_out
from lab.measured_driven import EXAMPLE, LINE_SCAN
from lab.test_published_page import ready


def explore(page):
    settled(page, points=64)
    ranges = page.locator("#explore [type=range]")
    assert all(ranges.evaluate_all("(all) => all.map((each) => each.ariaValueText)"))


def surface(example):
    def shown(page):
        page.click(example)
        page.wait_for_selector('#measured [data-result="file"]')
        page.click("#measured-step-preparation > summary")
        page.wait_for_selector('#measured [data-result="preparation"]')

    return shown


@pytest.mark.parametrize(
    ("query", "shown"),
    [
        (SMALL, explore),
        ("?view=measured", surface(LINE_SCAN)),
        ("?view=measured", surface(EXAMPLE)),
        ("?view=published&v=1&D_f=2,2.4&low_3D=0.02", ready),
    ],
    ids=["explore", "line scan", "surface", "paper"],
)
def test_walk_over_a_view_by_keys_at_any_width_in_both_themes_where_all_has_a_name(
    pages, query, shown
):
    page = pages.open(query, theme="dark")
    shown(page)
    view = page.locator("main:visible").get_attribute("id")
    wanted, reached, unseen = tabbed(page, view)
    assert reached == wanted
    assert unseen == []
    texts_stand_out(page, view)
    page.click("#theme")
    assert faint(page) == []
    page.context.close()


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


def test_tabs_are_changed_by_arrows(fresh):
    fresh.focus("#tab-area")
    fresh.keyboard.press("ArrowRight")
    assert fresh.evaluate("() => document.activeElement.id") == "tab-spectrum"
    assert fresh.is_visible("#plot-explore-spectrum")
    assert not fresh.is_visible("#plot-explore-area")
    fresh.keyboard.press("ArrowLeft")
    assert fresh.is_visible("#plot-explore-area")
    assert fresh.get_attribute("#tab-area", "aria-selected") == "true"


def test_what_rests_is_spoken(fresh):
    typed(fresh, "F", "0.3")
    settled(fresh, points=64, F=0.3)
    spoken = fresh.locator("#explore [data-spoken]").inner_text()
    assert "stiffness k" in spoken
    assert "certified" in spoken


def test_walk_over_all_kinds_of_controls_by_keys(fresh):
    page = fresh
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
    ends = ("explore-stiffness", "x_range.end", "x_range.start")
    whole = np.divide(*held(page, *ends))
    page.focus("#plot-explore-stiffness")
    page.keyboard.press("+")
    assert np.divide(*held(page, *ends)) < whole
    page.keyboard.press("0")
    assert np.divide(*held(page, *ends)) == pytest.approx(whole)


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
