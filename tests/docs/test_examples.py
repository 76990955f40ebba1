"""The README and the docs: snippets run as they stand, links lead somewhere."""

import re
from pathlib import Path

import pytest
from matplotlib import pyplot

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
PAGES = [page for page in PAGES if "made" not in page.parts]  # those that Sphinx checks
PYTHON = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)
OF_TESTS = "All of this page's code is part of `tests/"  # test_links.py compares it
OTHER_PROGRAMS = {"tamaas", "ContactMechanics", "aspher"}
FILE = re.compile(r"`((?:src|tests|studies|benchmarks|docs)/[\w/.-]+)`")
LINK = re.compile(r"\]\((?!https?:|#)([^)#\s]+)")


def name_of(page):
    return str(page.relative_to(ROOT))


def has_snippets(page):
    text = page.read_text("utf-8")
    return PYTHON.search(text) is not None and OF_TESTS not in text


@pytest.mark.parametrize("page", [*filter(has_snippets, PAGES)], ids=name_of)
def test_snippets_run_in_order(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    namespace, missing = {"__name__": "snippet"}, set()
    for block in PYTHON.findall(page.read_text("utf-8")):
        try:
            exec(compile(block, name_of(page), "exec"), namespace)
        except ModuleNotFoundError as error:
            if error.name not in OTHER_PROGRAMS:
                raise
            missing.add(error.name)
    pyplot.close("all")
    if missing:
        pytest.skip(f"what needs {', '.join(sorted(missing))} was left out, which is not installed")


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_files_that_are_named_are_there(page):
    for path in FILE.findall(page.read_text("utf-8")):
        assert (ROOT / path).exists(), path


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_links_lead_somewhere(page):
    for target in LINK.findall(page.read_text("utf-8")):
        if "made" in Path(target).parts:  # made when the handbook is built, which checks them
            continue
        assert (page.parent / target).exists(), target
