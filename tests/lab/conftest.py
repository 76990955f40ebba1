"""One lab for the tests that drive a page."""

import pytest

from lab_in_browser import Pages, RunningLab


@pytest.fixture(scope="session")
def lab(tmp_path_factory):
    """Return a lab on a free port; at its end it must have stopped by Ctrl-C without a trace."""
    running = RunningLab(tmp_path_factory.mktemp("lab") / "log")
    yield running
    code, said = running.close()
    assert code == 0
    assert said == ""


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
