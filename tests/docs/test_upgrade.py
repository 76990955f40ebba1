"""The page on coming from 0.3: what it says is gone is gone, and what takes its place is there."""

import dataclasses
import importlib
import inspect
import re
from pathlib import Path

import attrs
import made
import pytest
import typer

import roughline as rl
from roughline.cli import app
from roughline.errors.earlier import EARLIER

PAGE = (Path(made.__file__).parent / "upgrade.md").read_text("utf-8")


def test_every_old_spelling_stands_beside_the_new_one():
    page = made.page_of_earlier()
    for old, new in EARLIER.items():
        assert f"| `{old}` | `{new}` |" in page
    assert "(../src/roughline/errors/earlier.py)" in PAGE


def test_options_of_the_lab_that_are_gone_are_gone():
    (lab,) = (
        each for name, each in made._commands(typer.main.get_command(app)) if name.endswith("lab")
    )
    offered = {option for param in lab.params for option in param.opts}
    (row,) = (line for line in PAGE.splitlines() if line.startswith("| `roughline lab`"))
    gone, there = (set(re.findall(r"--[a-z-]+", cell)) for cell in row.strip("| ").split(" | "))
    assert len(gone) == 7
    assert not gone & offered
    assert len(there) == 1
    assert there <= offered


def test_a_question_is_changed_by_attrs_alone():
    question = rl.Question("scan.x3p", materials="steel,copper", loads="10 N")
    assert attrs.evolve(question, loads="20 N").loads == ("20 N",)
    with pytest.raises(TypeError):
        dataclasses.replace(question, loads="20 N")


def test_what_is_gone_in_python_is_gone():
    with pytest.raises(ImportError):
        importlib.import_module("roughline.spectra.fit")
    assert "fit_self_affine" in rl.__all__
    asked = inspect.signature(rl.Rule).parameters
    assert {"warning", "note"}.isdisjoint(asked)
    assert "facts" in asked
    assert "is_cut_out" in inspect.signature(rl.Surface).parameters
