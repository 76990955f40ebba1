"""The pages use what is public, and name every status."""

import re
from pathlib import Path

import pytest

import roughline as rl

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
DOCUMENTED_PACKAGES = {"campaign", "engineering", "exact"}


@pytest.mark.parametrize("status", rl.Status)
def test_every_status_is_listed(status):
    assert f"`{status.name}`" in (ROOT / "docs" / "conventions.md").read_text("utf-8")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_users_type_public_names_only(page):
    text = page.read_text("utf-8")
    packages = re.findall(r"\b(?:from|import) roughline\.([\w.]+)|`roughline\.(\w[\w.]*)", text)
    assert {name for pair in packages for name in pair if name} <= DOCUMENTED_PACKAGES
