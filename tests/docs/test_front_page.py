"""The front pages: their numbers are those of the pages that they lead to."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_claims_in_short_stand_on_the_page_of_the_paper():
    page = "".join(
        (ROOT / "docs" / each).read_text(encoding="utf-8")
        for each in ("paper.md", "figures/paper/claims.html")
    )
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    found = readme.split("## What it found")[1].split("\n## ")[0]
    told = re.findall(r"\d+\.\d+", found)
    assert len(told) >= 4
    assert not [number for number in told if number not in page]
    (counted,) = re.findall(
        r"of (25 claims \d+ are confirmed, \d+ are refuted and \d+ are undecided)",
        (ROOT / "docs" / "studies.md").read_text(encoding="utf-8").replace("\n", " "),
    )
    assert f"Of {counted}." in page


def test_installing_is_told_as_it_works_without_a_release():
    """Wherever `pip install roughline` is told, `pip install .` stands before it."""
    for page in (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")):
        if "made" in page.parts:
            continue
        before, told, _ = page.read_text(encoding="utf-8").partition("pip install roughline")
        assert not told or "pip install ." in before, page
    assert "$ pip install ." in (ROOT / "docs" / "start.md").read_text(encoding="utf-8")


def test_the_start_page_of_the_handbook_shows_a_picture():
    page = (ROOT / "docs" / "index.md").read_text(encoding="utf-8")
    (picture,) = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", page.partition("\n- **")[0])
    assert (ROOT / "docs" / picture).is_file()
