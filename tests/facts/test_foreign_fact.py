"""A kind of fact that the program does not know, defined here: it is told wherever facts are."""

import json
from dataclasses import replace

import pytest

import roughline as rl
from lab.test_measured import Page
from roughline.facts.fact import Fact
from roughline.facts.kinds import KINDS, FactKind
from roughline.report.contact_report import write_contact_report
from roughline.report.json_output import assessment_json, to_json
from roughline.report.terminal import print_assessment

WARM = FactKind(
    "stored for {hours:g} h", "stored for {hours:g} h: its hardness is that of a fresh one"
)

STORED = rl.Rule(
    key="storage",
    name="stiffness after storage",
    symbol="k_w",
    unit="N/m",
    group="mechanics",
    formula="k",
    value=lambda pressed: pressed.loading,
    facts=lambda pressed: Fact("stored_warm", hours=48.0),
    leads=lambda pressed: True,
)


SURFACE = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=5e4).surface(64, rng=7)


@pytest.fixture
def result(monkeypatch):
    """Of a rule that tells it."""
    monkeypatch.setitem(KINDS, "stored_warm", WARM)
    rl.rules.add(STORED)
    yield rl.assess(rl.Question(SURFACE, "steel,copper", loads="10 N"))
    rl.rules.remove("storage")


def test_it_is_a_warning_of_its_answer_in_python_json_and_on_the_screen(result, capsys):
    (fact,) = (each for each in result.facts if each.kind == "stored_warm")
    assert fact.of == ("storage",)
    assert str(fact) in result.warnings
    (found,) = (
        each
        for each in json.loads(to_json(assessment_json(result)))["facts"]
        if each["kind"] == "stored_warm"
    )
    assert found["numbers"] == {"hours": 48.0}
    print_assessment(result, unfolded_by="--all")
    first = capsys.readouterr().out
    assert first.count("warning: ") <= 3
    print_assessment(result)
    assert "warning: stored for 48 h: its hardness" in capsys.readouterr().out


def test_it_stands_in_the_report_and_in_the_lab(result, tmp_path):
    write_contact_report(result, tmp_path, "")
    assert "its hardness is that of a fresh one" in (tmp_path / "report.html").read_text("utf-8")
    page = Page(tmp_path, tmp_path)
    rl.write(replace(SURFACE, unit="m"), tmp_path / "map.nc")
    state = page.bring(tmp_path / "map.nc") | {"first": "steel", "second": "copper"}
    header, _ = page.ask("answer", state | {"loads": "10 N"})
    assert "its hardness is that of a fresh one" in json.dumps(header)


def test_one_without_words_is_refused():
    with pytest.raises(rl.InputError, match="stored"):
        Fact("stored", hours=48.0)
