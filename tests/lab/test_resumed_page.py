"""A line that drops, a page that is loaded again, a lab that is started anew: nothing is lost."""

import re
from contextlib import contextmanager
from urllib.parse import parse_qs, urlsplit

import numpy as np
import pytest

import roughline as rl
from lab.measured_driven import READY, answers, choose, fill, line_of, press
from lab.relay import Relay
from lab_in_browser import NO_LINE, Pages, RunningLab

NAME = "Ausschnitt, große Fläche; 1 (β).npy"
OTHER = "another place.npy"


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Two files that leave their unit and size open, by their names."""
    folder = tmp_path_factory.mktemp("files")
    for seed, name in enumerate((NAME, OTHER)):
        surface = rl.SelfAffine(hurst=0.7, length=1e-4, rms_height=1e-6).surface(16, seed)
        np.save(folder / name, surface.heights * 1e6)
    return {name: folder / name for name in (NAME, OTHER)}


@pytest.fixture(scope="module")
def relay(lab):
    """A relay to the lab."""
    made = Relay(lab.address)
    yield made
    made.close()


@pytest.fixture(scope="module")
def pages(browser, relay):
    """Return what opens pages of the lab through the relay."""
    opened = Pages(browser, relay.address)
    yield opened
    opened.close()


def said(page):
    """What is said of the file."""
    return page.inner_text('[data-note="file"]')


def is_set(page):
    keys = ("unit", "size", "loads", "low_pass")
    return {key: page.input_value(f"#measured-{key}-text") for key in keys}


def begin_long_press(page):
    """Press the whole curve of points enough to be seen, and wait until it is on its way."""
    fill(page, loads="", resample="64")
    page.locator("[data-changed]").wait_for()
    page.click(READY)
    page.wait_for_selector("#measured [data-waiting] .cancel")


@contextmanager
def dropped(pages, relay, page):
    """Drop the line of a page, and let the browser complain of it."""
    relay.drop()
    page.locator("#connection", has_text="does not answer").wait_for()
    yield
    pages.complaints = [each for each in pages.complaints if not re.search(NO_LINE, each)]


SET = {"unit": "um", "size": "100 um", "loads": "1 MPa; 3 MPa", "low_pass": "8 um"}


@pytest.fixture(scope="module")
def pressed(pages, files):
    """A page with a file, settings and answers; and these answers."""
    page = pages.open("?view=measured")
    page.wait_for_selector("#plot-measured-file >> nth=0", state="attached")
    choose(page, files[NAME])
    page.wait_for_selector('[data-asked="unit"]')
    press(page, **SET)
    return page, answers(page)


def test_walk_with_a_line_that_drops_and_a_press_that_goes_on(pressed, pages, relay):
    page, before = pressed
    begin_long_press(page)
    with dropped(pages, relay, page):
        assert page.is_visible("[data-prepared-numbers]")
        assert page.inner_text('[data-table="measured-answers"]') == before
        fill(page, loads="2 MPa")  # what is set meanwhile is asked as well
        fill(page, loads="")
        relay.restore()
        page.wait_for_selector("#connection", state="hidden")
    page.wait_for_selector("#measured [data-waiting] .cancel", state="hidden")
    assert answers(page) != before
    assert said(page) == ""
    press(page, loads=SET["loads"], resample="")
    page.wait_for_selector("[data-changed]", state="hidden")
    assert answers(page) == before


@pytest.mark.parametrize("made", ["answers", "report"])
def test_walk_with_a_page_that_is_loaded_again_with_file_settings_answers_and_report(pressed, made):
    page, before = pressed
    page.wait_for_selector('[data-result="answers"]:not(.dimmed)')
    links = page.locator("[data-links] a")
    if made == "report":
        page.click("[data-report]")
        links.first.wait_for()
        page.click("[data-compare]")
        page.wait_for_selector('[data-result="compare"]')
    page.reload()
    assert answers(page) == before
    line_of(page, "file").filter(has_text=NAME).wait_for()
    page.wait_for_selector('[data-result="preparation"]')
    assert is_set(page) == SET
    assert not page.is_visible("[data-changed]")
    assert said(page) == ""
    if made == "report":
        page.wait_for_selector('[data-result="compare"]')
        href = page.evaluate("(link) => link.href", links.last.element_handle())
        assert page.request.get(href).status == 200


def test_a_page_that_is_loaded_again_in_another_view_shows_the_same(pressed):
    page, before = pressed
    page.click('nav [data-view="published"]')
    page.wait_for_selector("#measured", state="hidden")
    page.reload()
    page.click('nav [data-view="measured"]')
    assert answers(page) == before
    assert is_set(page) == SET


def test_a_page_that_is_loaded_again_in_the_middle_of_a_press_has_its_answer(pressed):
    page, before = pressed
    press(page, loads="")
    page.reload()
    assert answers(page) != before
    press(page, loads=SET["loads"])
    page.wait_for_selector("[data-changed]", state="hidden")


def test_a_link_has_all_that_is_set_and_asks_for_the_file_by_its_name(pressed, pages, files):
    page, before = pressed
    link = urlsplit(page.url).query
    of = parse_qs(link)["of"][0]
    assert of.endswith(f"/{NAME}")
    assert {key: parse_qs(link)[key][0] for key in SET} == SET
    for file, is_same in ((OTHER, False), (NAME, True)):
        opened = pages.open(f"?{link}")
        opened.locator('[data-note="file"]', has_text=f"{NAME}: choose that file").wait_for()
        choose(opened, files[file])
        opened.wait_for_selector('[data-result="file"]')
        if is_same:
            assert is_set(opened) == SET
            assert said(opened) == ""
            press(opened)
            assert answers(opened) == before
        else:
            assert f"This is not {NAME}: unit" in said(opened)
            assert is_set(opened) == SET | {"unit": "", "size": ""}
        opened.context.close()


def test_a_copy_of_a_tab_takes_the_file_and_the_first_keeps_what_it_shows(pressed, files):
    page, before = pressed
    lines = {"first": [], "copied": []}
    page.on("websocket", lambda each: lines["first"].append(each))
    with page.context.expect_page() as coming:
        page.evaluate("open(location.href)")
    copied = coming.value
    assert answers(copied) == before
    copied.on("websocket", lambda each: lines["copied"].append(each))
    page.locator('[data-note="file"]', has_text="now with the other tab").wait_for()
    assert page.inner_text('[data-table="measured-answers"]') == before
    assert page.is_disabled("[data-press]")
    copied.wait_for_selector(READY)
    choose(page, files[NAME])
    page.click(READY)
    page.wait_for_selector('[data-result="answers"]:not(.dimmed)')
    assert answers(page) == before
    copied.click("[data-forget-file]")
    copied.locator('[data-note="file"]', has_text="are deleted").wait_for()
    assert copied.is_disabled("[data-press]")
    copied.wait_for_url(lambda address: "of=" not in address)
    assert not copied.is_visible("#connection")
    # neither has taken it from the other again
    assert {name: len(opened) for name, opened in lines.items()} == {"first": 1, "copied": 0}
    copied.close()


def test_a_lab_that_is_started_anew_asks_for_token_and_file_and_keeps_the_rest(
    pressed, pages, relay, lab, files, tmp_path
):
    page, before = pressed
    other = RunningLab(tmp_path / "log")
    try:
        with dropped(pages, relay, page):
            relay.lead_to(other.address)
            relay.restore()
            page.locator("#connection", has_text="started anew").wait_for()
            assert page.inner_text('[data-table="measured-answers"]') == before
            again = page.context.new_page()
            again.goto(relay.through(other.address))
            again.wait_for_selector("#connection", state="hidden")
            page.bring_to_front()
            page.wait_for_selector("#connection", state="hidden")
            page.locator('[data-note="file"]', has_text="choose that file again").wait_for()
        again.close()
        assert NAME in said(page)
        assert page.inner_text('[data-table="measured-answers"]') == before
        assert page.is_disabled("[data-press]")
        choose(page, files[NAME])
        page.wait_for_selector(READY)
        assert is_set(page) == SET
        assert said(page) == ""
        assert not page.is_visible("[data-changed]")
        assert page.inner_text('[data-table="measured-answers"]') == before
    finally:
        page.context.close()  # else it would ask the first lab, which does not know it any longer
        relay.lead_to(lab.address)
        assert other.close() == (0, "")
