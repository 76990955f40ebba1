"""In the repository, too, links of the handbook lead on, and its code is shown."""

import ast
import re
import subprocess
from pathlib import Path
from posixpath import dirname, join, normpath

import made
import pytest

ROOT = Path(__file__).parents[2]
LINK = re.compile(r"(?<=\]\()[^)\s]+(?=\))")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
LABEL = re.compile(r"^\((.*)\)=$", re.MULTILINE)
FENCED = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
FOREIGN = {"add_a_contact_law": "test_foreign_law", "add_a_half_space": "test_foreign_half_space"}


@pytest.fixture(scope="module")
def committed():
    """All files of the repository and their folders."""
    listed = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    if listed.returncode:
        pytest.skip("no clone: a reader of a package has no pages")
    files = set(listed.stdout.splitlines())
    return files | {str(folder) for file in files for folder in Path(file).parents}


def pages():
    for path in (*sorted((ROOT / "docs").rglob("*.md")), ROOT / "README.md"):
        yield path.relative_to(ROOT).as_posix(), path.read_text("utf-8")
    yield "CONTRIBUTING.md", (ROOT / "CONTRIBUTING.md").read_text("utf-8")


def anchors(text):
    """What a code host, and the handbook, call the headings of a page."""
    plain = (re.sub(r"[^\w\- ]", "", each.lower()) for each in HEADING.findall(text))
    return {each.strip().replace(" ", "-") for each in plain} | set(LABEL.findall(text))


def test_every_link_leads_to_something_committed(committed):
    lost, count = [], 0
    for page, text in pages():
        if page not in committed:  # a page that is made
            continue
        for link in LINK.findall(FENCED.sub("", text)):
            if re.match(r"[a-z]+:", link):
                continue
            count += 1
            path, _, anchor = link.partition("#")
            target = normpath(join(dirname(page), path)) if path else page
            if target not in committed or (
                anchor and anchor not in anchors((ROOT / target).read_text("utf-8"))
            ):
                lost.append(f"{page}: {link}")
    assert lost == []
    assert count > 300


def test_in_the_handbook_links_lead_to_pages_that_are_made():
    text = "[a](../gallery/hertz.py) [b](../../src/roughline/engineering/materials.csv) [c](x.md)"
    there = "[a](../made/gallery/hertz.rst) [b](../made/materials.md) [c](x.md)"
    assert made.with_made_pages("how-to/page", text) == there
    assert made.with_made_pages("index", "[a](gallery) [b](#c)") == (
        "[a](made/gallery/index.rst) [b](#c)"
    )


@pytest.mark.parametrize(("page", "test"), FOREIGN.items())
def test_code_of_laws_and_half_spaces_is_that_of_their_tests(page, test):
    """Whole functions and classes of the file that is tested, where they are not sketches of it."""
    text = (ROOT / "docs" / "tutorials" / f"{page}.md").read_text("utf-8")
    source = (ROOT / "tests" / "halfspace" / f"{test}.py").read_text("utf-8")
    tested = {
        each.name: "\n".join(source.splitlines()[first_line(each) - 1 : each.end_lineno])
        for each in ast.parse(source).body
        if isinstance(each, ast.FunctionDef | ast.ClassDef)
    }
    shown = re.findall(r"^```python\n(.*?)\n```$", text, re.MULTILINE | re.DOTALL)
    of_tests = [code for code in shown if code in tested.values()]
    assert len(of_tests) == {"add_a_contact_law": 3, "add_a_half_space": 3}[page]
    others = [code for code in shown if code not in of_tests]
    assert not any(re.search(rf"^(def|class) {name}\b", "\n".join(others), re.M) for name in tested)


def first_line(node):
    return min([node.lineno, *(each.lineno for each in node.decorator_list)])
