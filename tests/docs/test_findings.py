"""Findings have the form that CONTRIBUTING.md states, and stand on a page of the handbook."""

import re
from pathlib import Path

import made
import pytest

ROOT = Path(__file__).parents[2]
SCRIPTS = sorted((ROOT / "findings").glob("*.sh"))
CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text("utf-8")


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_a_finding_has_the_form(script):
    text = script.read_text("utf-8")
    head = made.FINDING.match(text)
    assert head is not None
    assert re.search(r"\d+\.\d", head["where"] or head["happens"]), "of which version?"
    assert len(re.findall(r"^#   ", head["output"], re.MULTILINE)) >= 3
    body = text[head.end() :]
    assert "trap 'rm -rf \"$folder\"' EXIT" in body
    assert "import roughline" not in body
    assert re.search(r"assert |raise SystemExit", body), "it fails where the behaviour has changed"


def test_the_page_has_every_finding():
    page = made.page_of_findings(ROOT / "findings")
    assert len(SCRIPTS) > 20
    for script in SCRIPTS:
        assert f"/findings/{script.name}))" in page
    assert page.count("\n## ") == page.count("**In roughline**") == len(SCRIPTS)


def test_a_script_without_the_form_is_refused(tmp_path):
    (tmp_path / "none.sh").write_text("#!/usr/bin/env bash\necho\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"none\.sh: its head is not of the form"):
        made.page_of_findings(tmp_path)


def test_the_form_is_stated_as_it_is_read():
    for part in (
        "One would guess",
        "What happens",
        "Output seen",
        "Why it matters",
        "In roughline",
    ):
        assert f"`{part}" in CONTRIBUTING
