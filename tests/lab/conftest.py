"""One lab and one browser for the tests that drive a page."""

import pytest

from lab_in_browser import WANTED, Pages, RunningLab, chromium_of, launched


def pytest_collection_modifyitems(items):
    """Mark what needs a browser."""
    for item in items:
        if "browser" in getattr(item, "fixturenames", ()):
            item.add_marker(pytest.mark.browser)


@pytest.fixture(scope="session")
def lab(tmp_path_factory):
    """Return a lab on a free port; at its end it must have stopped by Ctrl-C without a trace."""
    running = RunningLab(tmp_path_factory.mktemp("lab") / "log")
    yield running
    code, said = running.close()
    assert code == 0
    assert said == ""


@pytest.fixture(scope="module")
def browser():
    """Return a headless Chromium."""
    api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    with api.sync_playwright() as playwright:
        if chromium_of(playwright) is None:
            pytest.skip(WANTED)
        started = launched(playwright)
        yield started
        started.close()


@pytest.fixture(scope="module")
def pages(browser, lab):
    """Return what opens pages of the lab, for the tests of a file."""
    opened = Pages(browser, lab.address)
    yield opened
    opened.close()


@pytest.fixture
def page(pages):
    """Open a page of its own, as one opens the lab."""
    page = pages.open()
    yield page
    page.context.close()


@pytest.fixture(autouse=True)
def _no_complaints(request):
    """Fail a test whose pages complained: on the console, by an error, by leaving the machine."""
    yield
    if "pages" in request.fixturenames:
        pages = request.getfixturevalue("pages")
        came, pages.complaints = pages.complaints, []
        assert not came
