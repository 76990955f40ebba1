"""The handbook's pages that are made of the code, and its gallery; `make docs` builds both."""

import inspect
import json
import re
from pathlib import Path

import made
import pytest
import typer
import versions

import roughline as rl
from roughline.cli import app
from roughline.contact.quantities import QUANTITIES
from roughline.engineering.fluids import fluids
from roughline.engineering.materials import materials
from roughline.texture.parameters import PROFILE_PARAMETERS, SURFACE_PARAMETERS
from roughline.topography.files.formats import FORMATS

NUMBERS = {13: "thirteen", 14: "fourteen", 15: "fifteen", 16: "sixteen", 19: "nineteen"}
GALLERY = Path(__file__).parents[2] / "docs" / "gallery"


def test_every_public_name_has_a_page():
    page = made.page_of_names()
    for name in {*rl.__all__, *rl.plot.__all__} - made.CONSTANTS - {"__version__"}:
        assert f"   {name}\n" in page


def test_every_parameter_of_a_press_has_its_reason():
    page = (GALLERY.parent / "decisions" / "0027-parameters.md").read_text("utf-8")
    rows = re.findall(r"^\| `(\w+)` \| (.+) \| (.+) \|$", page, re.MULTILINE)
    assert [name for name, *_ in rows] == list(inspect.signature(rl.press).parameters)
    assert f"`rl.press` keeps {NUMBERS[len(rows)]}." in page


def test_no_two_pages_differ_in_capitals_alone():
    pages = [
        made.FILES_OF_NAMES.get(f"roughline.{name}", f"roughline.{name}") for name in rl.__all__
    ]
    assert len({page.lower() for page in pages}) == len(pages)
    assert set(made.FILES_OF_NAMES) == {
        "roughline.estimate",
        "roughline.flow",
        "roughline.material",
        "roughline.reopening",
    }


def test_a_name_without_a_section_is_refused(monkeypatch):
    monkeypatch.delitem(made.SECTIONS, "Bodies")
    with pytest.raises(
        ValueError, match=r"SECTIONS in made.py lacks Line, Missing, Preparation, Profile"
    ):
        made.page_of_names()


def test_every_option_of_every_command_is_listed():
    sections = made.page_of_commands().split("\n## ")
    for name, command in made._commands(typer.main.get_command(app)):
        (section,) = (each for each in sections if each.startswith(f"{name}\n"))
        for param in command.params:
            assert all(f"`{each}`" in section for each in param.opts)
    assert not any("{" in section for section in sections)


def test_every_material_is_listed_with_its_source():
    page = made.page_of_materials()
    for each in materials().values():
        (row,) = (line for line in page.splitlines() if line.startswith(f"| {each.name} |"))
        assert each.source in row


def test_every_fluid_is_listed_with_its_source():
    page = made.page_of_fluids()
    for each in fluids().values():
        (row,) = (line for line in page.splitlines() if line.startswith(f"| {each.name} |"))
        assert each.source in row
    assert "| helium | He | 0.0196 | 4.003 |" in page


def test_every_format_is_listed_with_who_reads_it():
    page = made.page_of_formats()
    for each in FORMATS:
        reader = "SurfaceTopography" if each.reader else "roughline"
        assert f"| {each.name} | `{each.suffixes[0]}`" in page
        assert f"| {each.is_read} | {each.is_not_read} | {reader} | {each.compared} |" in page


def test_every_quantity_is_listed_with_its_meaning():
    page = made.page_of_quantities()
    assert all(f"| `{each.name}` |" in page for each in QUANTITIES.values())
    assert all(each.meaning in page for each in QUANTITIES.values())


def test_every_parameter_of_texture_is_listed_with_its_meaning():
    page = made.page_of_texture()
    for each in (*SURFACE_PARAMETERS.values(), *PROFILE_PARAMETERS.values()):
        assert f"| `{each.name}` | {each.meaning}" in page


def test_each_exact_test_stands_on_the_page_of_validation():
    root = GALLERY.parents[1]
    page = made.page_of_validation(root / "docs" / "validation.json")
    told = {each["test"] for each in json.loads((root / "docs" / "validation.json").read_text())}
    files = ("halfspace/test_exact_solutions", "halfspace/test_hardness_exact")
    files += ("halfspace/friction/test_exact_friction",)
    found = {
        f"tests/{file}.py::{name}"
        for file in (*files, "reduction/test_exact_solutions")
        for name, arguments in re.findall(
            r"^def (test_\w+)\(([^)]*)\)", (root / "tests" / f"{file}.py").read_text("utf-8"), re.M
        )
        if "judged" in arguments
    }
    assert told == found
    assert len(found) == 18
    for each in told:
        assert each.partition("::")[2].removeprefix("test_").replace("_", " ") in page


def test_a_rate_is_told_only_where_errors_fall():
    row = {"solution": "s", "quantity": "q", "test": "tests/a.py::test_b"}
    falling = {"8": 4e-2, "16": 1e-2, "32": 2.5e-3}
    assert made._validated(row | {"errors": falling})[3] == "2.0"
    assert made._validated(row | {"errors": falling | {"64": 1e-2}})[3] == ""


def test_the_gallery_lists_its_examples():
    assert sorted(made.GALLERY) == sorted(path.stem for path in GALLERY.glob("*.py"))
    assert len(made.GALLERY) >= 18


@pytest.mark.parametrize("name", made.GALLERY)
def test_an_example_is_short_and_asks_a_question(name):
    lines = (GALLERY / f"{name}.py").read_text("utf-8").splitlines()
    assert len(lines) <= 40
    title = lines[1]
    assert title.endswith("?") or title.startswith("From ")
    assert set(lines[2]) == {"="}
    assert len(lines[2]) == len(title)


@pytest.mark.parametrize(
    "page", sorted((GALLERY.parent / "how-to").glob("*.md")), ids=lambda p: p.stem
)
def test_a_how_to_begins_with_what_one_gets(page):
    assert page.read_text("utf-8").split("\n\n")[1].startswith("You get ")


def test_a_release_fills_the_version_switch(tmp_path):
    for name in ("0.2.0", "0.10.0", "stable", ".git"):
        (tmp_path / name).mkdir()
    listed = versions.versions(tmp_path, "https://a.org/b")
    assert [each["version"] for each in listed] == ["0.10.0", "0.2.0"]
    assert listed[0] == {"version": "0.10.0", "url": "https://a.org/b/0.10.0/", "preferred": True}


def test_the_citation_is_of_this_version():
    root = GALLERY.parents[1]
    assert f"version = {{{rl.__version__}}}" in (root / "docs" / "cite.md").read_text("utf-8")
    assert f"\nversion: {rl.__version__}\n" in (root / "CITATION.cff").read_text("utf-8")
    assert json.loads((root / ".zenodo.json").read_text("utf-8"))["version"] == rl.__version__


def test_the_changelog_begins_with_this_version():
    text = (GALLERY.parents[1] / "CHANGELOG.md").read_text("utf-8")
    assert re.findall(r"^## \[(.+?)\]", text, re.MULTILINE)[0] in ("Unreleased", rl.__version__)
