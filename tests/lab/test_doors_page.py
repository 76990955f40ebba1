"""How one comes in, and out again."""

import re

from roughline.lab.server import opening

STATE = "view=explore&v=1&D_f=2.4&n=64"
# what is refused on purpose, and the file that leads in
ASKED = r"/(here|login|link|\?token=)\S*\)$|WebSocket|leaves for file:"


def test_walk_in_by_the_opened_file_and_out_of_all_pages(pages, lab, tmp_path, monkeypatch):
    monkeypatch.setattr(opening.subprocess, "run", lambda *words, **options: None)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    page = pages.blank()
    page.context.clear_cookies()
    with pages.expecting(ASKED), opening.ExitStack() as opened:
        opening.open_page(f"{lab.address}&{STATE}", opened)
        (file,) = tmp_path.rglob("open.html")
        page.goto(file.as_uri())
        page.wait_for_url(f"{pages.address}?{STATE}")  # though a browser asks for it without cookie
        page.wait_for_selector("#plot-explore-contact[data-shown]")
        assert page.evaluate("() => document.cookie") == ""

        other = page.context.new_page()
        other.goto(f"{pages.address}?view=published")
        other.wait_for_selector("#connection", state="hidden")
        page.click("#log-out")
        page.wait_for_url(f"{pages.address}login")
        other.locator("#connection").filter(has_text="log").wait_for()

        page.goto(f"{pages.address}?{STATE}")
        page.locator("form").filter(has_text="in the terminal where").wait_for()
        page.fill("#token", "wrong")
        page.keyboard.press("Enter")
        page.locator('[role="alert"]').filter(has_text="This is not the token").wait_for()
        page.fill("#token", lab.address)
        page.keyboard.press("Enter")
        page.wait_for_url(f"{pages.address}?{STATE}")
        other.wait_for_selector("#connection", state="hidden")
        assert not re.search("token", page.content() + page.url)
    page.context.close()


def test_on_a_phone_one_logs_in_and_out_too(pages, lab):
    page = pages.blank(width=390, height=800, has_touch=True)
    page.goto(f"{pages.address}?{STATE}")
    page.wait_for_selector("#plot-explore-contact[data-shown]")
    with pages.expecting(ASKED):
        page.tap("#log-out")
        page.wait_for_selector("#token")
        assert page.evaluate("() => document.documentElement.scrollWidth") <= 390
        page.fill("#token", lab.address)
        page.tap("form button")
        page.wait_for_selector("#log-out")
    page.context.close()
