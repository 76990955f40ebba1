"""Facts of every kind are shown in the same words on the terminal, in Python and in JSON."""

import html
import json
import re
from dataclasses import replace

import pytest
from rich.console import Console

import roughline as rl
from known_facts import examples
from roughline.facts.fact import LINE, Fact, by_weight
from roughline.facts.kinds import KINDS, FactKind
from roughline.report.document import write_document
from roughline.report.json_output import assessment_json, to_json
from roughline.report.terminal import print_assessment
from roughline.report.typeset import typeset

FACTS = by_weight(examples(each)[0] for each in KINDS)


@pytest.fixture(scope="module")
def answered():
    """An answer with a fact of every kind, be it a note or a warning."""
    surface = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(16, rng=7)
    asked = {"materials": "steel,copper", "loads": "10 N", "grid_error": False}
    return replace(rl.assess(rl.Question(surface, **asked)), facts=FACTS)


def screen(capsys, result, **options):
    print_assessment(result, console=Console(width=1000, markup=False), **options)
    return capsys.readouterr().out


def test_python_the_terminal_and_json_tell_every_kind_in_the_same_words(answered, capsys):
    told = [line.partition(": ")[2] for line in screen(capsys, answered).splitlines()]
    found = json.loads(to_json(assessment_json(answered)))
    assert set(answered.remarks) <= set(told)
    assert sorted(found["notes"]) == sorted(map(str, FACTS))
    assert [each["in_full"] for each in found["facts"]] == list(map(str, FACTS))
    assert [each["kind"] for each in found["facts"]] == [each.kind for each in FACTS]


def test_a_report_begins_with_the_same_three_and_folds_all_below_what_they_concern(
    answered, tmp_path
):
    key = "constriction_resistance"
    facts = [FACTS[0].concerning(key), *FACTS[1:]]
    write_document(replace(answered, facts=facts), tmp_path, "title", [], ["command"])
    page = (tmp_path / "report.html").read_text("utf-8")
    text = html.unescape(re.sub("<su[bp]>|</su[bp]>|<[^>]*>", "", page))
    first, _, folded = text.partition(answered.question.materials[0].name.capitalize())
    grave = [each.in_short for each in facts if each.is_grave][:3]
    assert first.count("Warning: ") == 3
    assert [each[1:] in first for each in grave] == [True] * 3
    told = {line.strip().removeprefix("Warning: ").lower() for line in folded.splitlines()}
    assert {f"{plain(each)}." for each in facts} <= told
    under = re.search("<h2>Electrical</h2>.*?</details>", page, re.DOTALL)[0]
    assert html.unescape(under).count("<li>") == 1


def plain(fact):
    """The words of a fact as a page has them, without what marks indices there."""
    text = re.sub("<[^>]*>", "", html.unescape(str(typeset(str(fact)))))
    return text.lower()


def test_the_first_screen_has_three_warnings_of_a_line_each_and_counts_the_rest(answered, capsys):
    lines = screen(capsys, answered, unfolded_by="--all").splitlines()
    warnings = [line for line in lines if line.startswith("warning: ")]
    grave = [each.in_short for each in FACTS if each.is_grave][:3]
    assert warnings == [f"warning: {each}" for each in grave]
    assert max(map(len, warnings)) <= LINE + len("warning: ") == 100
    assert not any(line.startswith("note: ") for line in lines)
    further, notes = len(answered.warnings) - 3, len(answered.notes)
    assert lines[-1].startswith(f"{further} further warnings, {notes} notes and ")
    assert lines[-1].endswith(": --all shows them")


MOON = FactKind(
    "the moon is {share:.0%} full",
    "the moon is {share:.0%} full, which no interval holds",
    weight="grave",
)
"""A fact that no file of the package knows."""


def test_a_foreign_fact_of_a_rule_is_shown_wherever_its_answer_is(capsys, monkeypatch):
    monkeypatch.setitem(KINDS, "moon_is_full", MOON)
    surface = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6).surface(16, rng=7)
    rl.rules.add(
        rl.Rule(
            key="tide",
            name="tide",
            symbol="T_m",
            unit="J",
            group="mechanics",
            formula="F² / (2 k_u)",
            value=lambda pressed: pressed.force**2 / (2 * pressed.unloading),
            facts=lambda _pressed: [
                Fact("moon_is_full", share=0.5),
                rl.own_words("tides are small", "note"),
            ],
        )
    )
    try:
        result = rl.assess(rl.Question(surface, materials="steel,copper", loads="10 N"))
    finally:
        rl.rules.remove("tide")
    (fact,) = [each for each in result.facts if each.kind == "moon_is_full"]
    assert fact.of == ("tide",)
    assert str(fact) in result.warnings
    assert "tides are small" in result.notes
    assert "warning: the moon is 50% full\n" in screen(capsys, result, unfolded_by="--all")
    assert "warning: the moon is 50% full, which no interval holds\n" in screen(capsys, result)
    (told,) = [each for each in assessment_json(result)["facts"] if each["kind"] == "moon_is_full"]
    assert (told["answers"], dict(told["numbers"])) == (("tide",), {"share": 0.5})
    assert str(fact) in re.sub("<[^>]*>", "", html.unescape(result._repr_html_()))
