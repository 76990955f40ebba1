"""The handbook's look on a phone: a small site with its theme and its style sheet."""

import subprocess
import sys
from pathlib import Path

import pytest

STYLE = Path(__file__).parents[2] / "docs" / "static"
NAMES = (
    "roughline.engineering.formulas.yovanovich_conductance",
    "Which model, which boundary, which grid, which error?",
    "roughline.exact.westergaard.mean_pressure_of_a_share",
)
CUT = """() => [...document.querySelectorAll("header *, nav *, .prev-next-area *, h1")].filter(
  (each) => {
    const place = each.getBoundingClientRect();
    const style = getComputedStyle(each);
    const shortened = style.textOverflow === "ellipsis" && each.scrollWidth > each.clientWidth + 1;
    const beyond = place.right > innerWidth + 1 || place.left < -1;
    return place.width > 0 && style.visibility !== "hidden" && (beyond || shortened);
  }).map((each) => each.textContent.trim())"""


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """Return a folder with pages of long names."""
    pytest.importorskip("pydata_sphinx_theme")
    source = tmp_path_factory.mktemp("site")
    settings = f"""
html_theme = "pydata_sphinx_theme"
html_title = "roughline 0.2.0"
html_static_path = [{str(STYLE)!r}]
html_css_files = ["handbook.css"]
"""
    (source / "conf.py").write_text(settings, encoding="utf-8")
    heading = f"Handbook\n{'=' * 8}\n\n.. toctree::\n\n   all\n"
    (source / "index.rst").write_text(heading, encoding="utf-8")
    listed = "\n".join(f"   page{i}" for i in range(len(NAMES)))
    whole = f"All\n===\n\n.. toctree::\n\n{listed}\n"
    (source / "all.rst").write_text(whole, encoding="utf-8")
    for i, name in enumerate(NAMES):
        text = f"{name}\n{'=' * len(name)}\n\nText.\n"
        (source / f"page{i}.rst").write_text(text, encoding="utf-8")
    built = source / "built"
    command = [sys.executable, "-m", "sphinx", "-q", "-b", "html", str(source), str(built)]
    subprocess.run(command, check=True, capture_output=True)
    return built


@pytest.mark.parametrize("width", [390, 1200])
def test_navigation_is_not_cut(browser, site, width):
    page = browser.new_page(viewport={"width": width, "height": 844})
    for i in range(len(NAMES)):
        page.goto((site / f"page{i}.html").as_uri())
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        assert page.evaluate(CUT) == []
    page.close()
