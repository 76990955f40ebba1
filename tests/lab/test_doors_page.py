"""How one comes in."""

import re

import pytest

from roughline.lab.server import opening

STATE = "view=explore&v=1&D_f=2.4&n=64"
# what is refused on purpose, and the file that leads in
ASKED = r"401|403|WebSocket|leaves for file:"


@pytest.mark.parametrize(
    "context", [{}, {"width": 390, "height": 800, "has_touch": True}], ids=["desk", "phone"]
)
def test_walk_in_by_the_opened_file_and_by_the_form(pages, lab, tmp_path, monkeypatch, context):
    monkeypatch.setattr(opening.subprocess, "run", lambda *words, **options: None)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    page = pages.blank(**context)
    page.context.clear_cookies()
    with pages.expecting(ASKED), opening.ExitStack() as opened:
        opening.open_page(f"{lab.address}&{STATE}", opened)
        (file,) = tmp_path.rglob("open.html")
        page.goto(file.as_uri())
        page.wait_for_url(f"{pages.address}?{STATE}")
        page.wait_for_selector("#plot-explore-contact[data-shown]")
        assert page.evaluate("() => document.cookie") == ""

        page.context.clear_cookies()
        page.goto(f"{pages.address}?{STATE}")
        page.locator("form").filter(has_text="in the terminal where").wait_for()
        assert page.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0
        page.fill("#token", "wrong")
        page.keyboard.press("Enter")
        page.locator('[role="alert"]').filter(has_text="This is not the token").wait_for()
        page.fill("#token", lab.address)
        (page.tap if context else page.click)("form button")
        page.wait_for_url(f"{pages.address}?{STATE}")
        page.wait_for_selector("#plot-explore-contact[data-shown]")
        assert not re.search("token", page.content() + page.url)
    page.context.close()
