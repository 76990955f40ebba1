"""One lab for the tests that drive a page, and what runs the code that a page gives."""

import json
import shlex

import pytest

from lab.explore_asked import answer
from lab.explore_driven import SMALL, settled
from lab_in_browser import Pages, RunningLab
from roughline.lab.explore import code


@pytest.fixture
def ran(invoke, capsys, tmp_path, monkeypatch):
    """Run what Explore gives as code: the lines that Python prints, or what the command tells."""
    monkeypatch.chdir(tmp_path)

    def run(state, which):
        text = answer(code.code, state, which=which)[0]["text"]
        if which == "python":
            exec(text, {})
            return capsys.readouterr().out.splitlines()
        commands = (shlex.split(line, comments=True)[1:] for line in text.splitlines())
        for words in filter(None, commands):
            done, told, errors = invoke(*words, *["--json"] * ("press" in words))
            assert done == 0, errors
        return json.loads(told)

    return run


@pytest.fixture(scope="session")
def lab(tmp_path_factory):
    """Return a lab; at its end it must stop by Ctrl-C without a trace."""
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


@pytest.fixture(scope="module")
def tab(pages):
    """Return what opens an address as in a new tab, in one that is used again: it is soon there.

    Before a file comes that is late, by its pattern, something may be done to the page.
    """
    page = pages.blank()
    page.add_init_script("sessionStorage.clear()")
    size = page.viewport_size

    def opened(query, late=None):
        page.unroute_all()
        page.set_viewport_size(size)
        if late:
            page.route(late[0], lambda route: (late[1](page), route.continue_()))
        page.goto(pages.address + query)
        return page

    return opened


@pytest.fixture
def fresh(tab):
    """Explore as it opens on a small grid, at rest."""
    page = tab(SMALL)
    settled(page, points=64)
    return page


@pytest.fixture(autouse=True)
def _no_complaints(request):
    """Fail a test whose pages complained: on the console, by an error, by leaving the machine."""
    yield
    if "pages" in request.fixturenames:
        pages = request.getfixturevalue("pages")
        came, pages.complaints = pages.complaints, []
        assert not came
