"""The page on what is not offered names every subject, is found, and says nothing that is wrong."""

import inspect
import re
import tomllib
from pathlib import Path

import attrs
import pytest
import typer
from typer.testing import CliRunner

import roughline as rl
from roughline.cli import NOT_OFFERED, app

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "not_offered.md").read_text("utf-8")
SECTIONS = dict(
    re.findall(r"^## ([^:\n]+):?[^\n]*\n(.*?)(?=^## |\Z)", PAGE, re.DOTALL | re.MULTILINE)
)
SUBJECTS = {
    "Adhesion of bodies that yield, and other laws of attraction": ("Adhesion", "Tamaas"),
    "Sheets, and layers that slip or come off": ("bonded", "finite elements"),
    "Rubber that recedes": ("viscoelastic", "loss modulus", "unloading", "Tamaas"),
    "Sliding, and friction of bodies that stick": ("sliding", "hysteresis", "ASPHER"),
    "Lubrication": ("EHL", "oil"),
    "Wear": ("Archard", "running-in"),
    "Heat and temperature": ("frictional heating", "flash temperature"),
    "Dynamics": ("impact", "damping"),
    "Steep roughness and large strains": ("finite deformation", "large slopes"),
    "Plasticity inside the body": ("hardening", "pile-up", "Tamaas"),
    "Anisotropic bodies": ("single crystals", "composites"),
}
"""Subjects of the page, with the words by which their readers search."""
OFFERED = re.compile(
    r"delamin|debond|viscoel|loss_mod"
    r"|lubric|wear|archard|temperature|heating|impact|damping|anisotrop|hardening",
    re.IGNORECASE,
)
"""What a name would be called that offers one of them: then the page has to change."""


@pytest.mark.parametrize("subject", SUBJECTS)
def test_each_subject_says_what_is_near_and_what_to_use(subject):
    (text,) = re.findall(rf"^## {subject}.*?(?=^## )", PAGE, re.DOTALL | re.MULTILINE)
    assert all(word in text for word in SUBJECTS[subject])
    assert "- **Here**:" in text
    assert "- **Use**:" in text


def test_no_subject_is_forgotten():
    assert set(SECTIONS) == {*SUBJECTS, "References"}


@pytest.mark.parametrize("name", ["start", "choices", "guides", "index"])
def test_the_page_is_linked(name):
    assert "](not_offered.md)" in (ROOT / "docs" / f"{name}.md").read_text("utf-8")
    assert "](docs/not_offered.md)" in (ROOT / "README.md").read_text("utf-8")


def test_the_page_has_a_place_in_the_handbook():
    toctree = (ROOT / "docs" / "start.md").read_text("utf-8").partition("```{toctree}")[2]
    assert "\nnot_offered\n" in toctree


@pytest.mark.parametrize("columns", [80, 120])
def test_help_names_its_address(columns):
    """In one piece, so that it can be copied."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    assert f"{project['urls']['Documentation']}/not_offered.md" == NOT_OFFERED
    told = CliRunner().invoke(app, ["--help"], terminal_width=columns)
    assert told.exit_code == 0
    assert NOT_OFFERED in told.output


def test_nothing_that_is_offered_is_called_missing():
    arguments = inspect.signature(rl.press).parameters
    options = [
        option
        for command in typer.main.get_command(app).commands.values()
        for param in command.params
        for option in param.opts
    ]
    names = [*rl.__all__, *arguments, *options, *(each.name for each in attrs.fields(rl.Question))]
    assert not [name for name in names if OFFERED.search(name)]
