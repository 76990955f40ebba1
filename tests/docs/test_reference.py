"""The reference names what the code has: public names, their parameters, commands, options."""

import inspect
import re
from operator import attrgetter
from pathlib import Path

import pytest
import typer

import roughline as rl
from roughline.cli import app

ROOT = Path(__file__).parents[2]
REFERENCE = (ROOT / "docs" / "reference.md").read_text("utf-8")
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
SIGNATURES = {
    name: re.findall(r"\w+", re.sub(r"=[^,]*", "", parameters))
    for name, parameters in re.findall(r"`rl\.([\w.]+)\((.*?)\)`", REFERENCE)[::-1]
}
DOCUMENTED_PACKAGES = {"campaign", "engineering", "exact"}


def commands(command, name="roughline"):
    for key, each in getattr(command, "commands", {}).items():
        yield from commands(each, f"{name} {key}")
    if not hasattr(command, "commands"):
        yield pytest.param(name, command, id=name)


@pytest.mark.parametrize("name", [name for name in rl.__all__ if name != "__version__"])
def test_every_public_name_is_listed(name):
    assert re.search(rf"`rl\.{name}\b", REFERENCE)


@pytest.mark.parametrize("name", rl.plot.__all__)
def test_every_picture_is_listed(name):
    assert f"plot.{name}" in SIGNATURES


@pytest.mark.parametrize("name", SIGNATURES)
def test_listed_parameters_are_those_of_the_code(name):
    assert SIGNATURES[name] == list(inspect.signature(attrgetter(name)(rl)).parameters)


@pytest.mark.parametrize(("name", "command"), [*commands(typer.main.get_command(app))])
def test_every_command_and_option_is_listed(name, command):
    assert f"`{name} " in REFERENCE
    for parameter in command.params:
        for option in (*parameter.opts, *parameter.secondary_opts):
            listed = re.search(rf"{option}\b(?!-)", REFERENCE)
            assert listed or not option.startswith("--"), option


@pytest.mark.parametrize("status", rl.Status)
def test_every_status_is_listed(status):
    assert f"`{status.name}`" in REFERENCE


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_users_type_public_names_only(page):
    text = page.read_text("utf-8")
    packages = re.findall(r"\b(?:from|import) roughline\.([\w.]+)|`roughline\.(\w[\w.]*)", text)
    assert {name for pair in packages for name in pair if name} <= DOCUMENTED_PACKAGES
