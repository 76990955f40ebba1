"""Commands of the handbook run as they stand, and print what its pages show."""

import math
import re
import shlex
from pathlib import Path

import pytest

import roughline as rl
from roughline import campaign

DOCS = Path(__file__).parents[2] / "docs"
PYTHON = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)
CONSOLE = re.compile(r"^```console\n(.*?)^```", re.DOTALL | re.MULTILINE)
NUMBER = re.compile(r"(?<![\w/])\d+(?:\.\d+)?(?:e[+-]?\d+)?")


@pytest.fixture
def type_in(invoke, only_drawn, tmp_path, monkeypatch):
    """Run a command of a page in a wide terminal; returns all that it says."""
    only_drawn()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "160")

    def run(command):
        program, *arguments = shlex.split(command)
        assert program == "roughline"
        _, out, err = invoke(*arguments)
        return out + err

    return run


def commands_of(page):
    """Each command of a page with the lines that it prints there."""
    for block in CONSOLE.findall(page.read_text("utf-8")):
        for entry in block.replace("\\\n", "").removeprefix("$ ").split("\n$ "):
            command, *lines = entry.splitlines()
            yield command, lines


def words(line):
    """A line's words in a row, and its numbers apart."""
    return " ".join(NUMBER.sub("#", line).split()), [float(each) for each in NUMBER.findall(line)]


def shows(said, line):
    """Whether a line is among those said, with numbers that agree to 2 %."""
    start, numbers = words(line.partition("...")[0])
    return any(
        sentence.startswith(start) and found[: len(numbers)] == pytest.approx(numbers, rel=0.02)
        for sentence, found in map(words, said.splitlines())
    )


def test_the_command_line(type_in):
    for command, lines in commands_of(DOCS / "tutorials" / "command_line.md"):
        if "paper" in command:  # takes minutes; tests/paper has it at a smaller size
            continue
        said = type_in(command)
        for line in lines:
            assert shows(said, line), f"{line}\nis not in\n{said}"


@pytest.mark.parametrize(("does", "times", "answers"), [("info", 2, 0), ("press", 1, 4)])
def test_an_engineer_with_a_file(type_in, does, times, answers):
    page = DOCS / "tutorials" / "your_file.md"
    text = page.read_text("utf-8")
    for block in PYTHON.findall(text):
        exec(compile(block, page.name, "exec"), {"__name__": "snippet"})
    commands = [each for each in commands_of(page) if each[0].startswith(f"roughline {does} ")]
    assert len(commands) == times
    rows = re.findall(r"^\| (\D+?) \| ([\d.][^|]+?) \|", text, re.MULTILINE)
    assert len(rows) == 4
    for command, lines in commands:
        said = type_in(command)
        for line in [*lines, *(f"{name} {answer}" for name, answer in rows[:answers])]:
            assert shows(said, line), f"{line}\nis not in\n{said}"


def test_the_three_stiffnesses_of_a_measured_map(type_in, topographies):
    page = (DOCS / "choices.md").read_text("utf-8")
    (values,) = re.findall(r"has ([\d.]+), ([\d.]+) and ([\d.]+) MN/m in this order", page)
    file = topographies / "al3d-1.al3d"
    asked = '--materials steel,copper --load "1 N" --no-grid-error --all'  # values alone
    said = type_in(f"roughline press {file} {asked}")
    names = ("contact stiffness k", "unloading stiffness k_u", "interface stiffness k_i")
    for name, value in zip(names, values, strict=True):
        assert shows(said, f"{name} {value} MN/m")


def test_the_plan_of_a_campaign_has_the_cases_that_the_page_tells(tmp_path):
    page = (DOCS / "how-to" / "campaign.md").read_text("utf-8")
    text, bodies, sheared = re.findall(r"^```toml\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    (tmp_path / "study.toml").write_text(text)
    plan = campaign.read_plan(tmp_path / "study.toml")
    assert f"{plan.name}: {plan.cases} cases to compute" in page
    for name in re.findall(r"^([\w-]+) +━", page, re.MULTILINE):
        assert plan.ensemble(name)
    elastic = "".join(each for each in text.splitlines(True) if "hardness_bar" not in each)
    (tmp_path / "study.toml").write_text(elastic + bodies)
    of_surfaces = campaign.read_plan(tmp_path / "study.toml").ensemble("surfaces-n256")
    assert of_surfaces.law == rl.Dugdale(work_of_adhesion=0.2, range=0.4)
    assert of_surfaces.half_space == rl.Layered(1.0, 0.3, 0.1, math.inf)
    surfaces = elastic[: elastic.index("[[")] + elastic[elastic.rindex("[[") :]
    frictionless = "".join(each for each in surfaces.splitlines(True) if "force_bars" not in each)
    (tmp_path / "study.toml").write_text(frictionless + sheared)
    of_surfaces = campaign.read_plan(tmp_path / "study.toml").ensemble("surfaces-n256")
    assert of_surfaces.friction == rl.Friction(0.3)
    assert len(of_surfaces.shear_bars) == len(of_surfaces.force_bars) == 4
