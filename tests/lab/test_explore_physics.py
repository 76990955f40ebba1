"""A physics that a test declares is on the page, in the address and in what is pressed."""

import re
from html import unescape
from pathlib import Path

import pytest

import roughline as rl
from lab.explore_asked import E_STAR, SCALE, SMALL, answer, loads, said
from lab.explore_driven import SMALL as LINK
from lab.explore_driven import address, settled, strip
from lab.softer import Softer
from lab_in_browser import Pages, RunningLab
from roughline.lab.explore import physics, pictures
from roughline.lab.explore.reading import read_state
from roughline.lab.site import page


@pytest.fixture
def _added(monkeypatch):
    monkeypatch.setattr(physics, "PHYSICS", (*physics.PHYSICS, Softer))
    page.cache_clear()  # which is made once
    yield
    page.cache_clear()


@pytest.mark.usefixtures("_added")
def test_it_is_pressed_and_kept_in_the_address():
    softer = SMALL | {"times": "2"}
    header, _ = answer(pictures.full, softer)
    pressed = rl.press(read_state(SMALL).surface(64), E_star=E_STAR / 2, forces=[0.2 * SCALE])
    assert loads(header, "area", "here")[1] == pytest.approx(pressed.area_fraction_corrected)
    assert header["state"]["times"] == "2"
    assert read_state(header["state"]) == read_state(softer)
    assert "times" in said(header)
    assert answer(pictures.coarse, softer)[0]["line"]["strip"][0]["below"] == "on the harder body"


@pytest.mark.usefixtures("_added")
def test_the_page_has_its_tick_its_control_and_its_place_in_the_strip():
    text = unescape(page())
    assert re.search(r'data-tick="times".*the body is softer', text)
    assert 'data-text="times"' in text
    assert '"pressure", "times"' in text  # below the three that lead


_WITH_IT = """from lab.softer import Softer
from roughline.lab.explore import physics
physics.PHYSICS = (*physics.PHYSICS, Softer)
"""


def test_a_person_ticks_it(browser, tmp_path, monkeypatch):
    (tmp_path / "sitecustomize.py").write_text(_WITH_IT)  # for the server and its processes
    for folder in (Path(__file__).parents[1], tmp_path):
        monkeypatch.setenv("PYTHONPATH", str(folder), prepend=":")
    lab = RunningLab(tmp_path / "log")
    pages = Pages(browser, lab.address)
    try:
        page = pages.open(LINK)
        settled(page, points=64)
        assert not page.is_visible("#explore-times-text")
        page.check("#explore-adds-times")
        settled(page, points=64, times=2)
        assert list(strip(page)).index("times") == list(strip(page)).index("pressure") + 1
        assert address(page)["times"] == "2"
        page.uncheck("#explore-adds-times")
        page.wait_for_function("() => !document.querySelector('[data-answer=times]')")
        pages.close()
    finally:
        assert lab.close() == (0, "")
