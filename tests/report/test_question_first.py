"""What something was asked for beside the contact comes first, wherever answers stand."""

import json

import numpy as np
import pytest

import roughline as rl
from lab.test_measured import Page
from roughline.report.answers import figure_keys, groups, headline
from roughline.report.document import _sections
from roughline.report.json_output import assessment_json, to_json
from roughline.report.terminal import print_assessment, print_part

SEAL = {"inlet": "6 bar", "outlet": "1 bar", "seal": "100 mm x 2 mm"}
METALS, GEL = "steel,copper", "E=5 MPa nu=0.49, rigid"
OPTIONS = {
    "adhesion": (GEL, [rl.Adhesion("50 mJ/m^2 over 2 um")], ["pull_off_force"]),
    "friction": (METALS, [rl.Friction(0.3)], ["slip_displacement"]),
    "ultrasound": (METALS, [rl.Ultrasound("5 MHz")], ["reflection"]),
    "closure": (METALS, [rl.Fluid(closure=True)], ["sealing_pressure", "reopening"]),
    "fluid": (METALS, [rl.Fluid("water")], ["hydraulic_aperture"]),
    "gas": (METALS, [rl.Fluid("air")], ["hydraulic_aperture", "joint_conductance"]),
    "leak": (METALS, [rl.Fluid("water", **SEAL)], ["leak_rate"]),
    "leak of a gas": (METALS, [rl.Fluid("helium", **SEAL)], ["leak_throughput"]),
    "seal": (
        METALS,
        [rl.Fluid("water", **SEAL, closure=True)],
        ["sealing_pressure", "reopening", "leak_rate"],
    ),
    "fluid and closure": (
        METALS,
        [rl.Fluid("water", closure=True)],
        ["sealing_pressure", "reopening"],
    ),
    "two things": (
        METALS,
        [rl.Friction(0.3), rl.Ultrasound("5 MHz")],
        ["slip_displacement", "reflection"],
    ),
    "nothing": (METALS, [], []),
}


@pytest.fixture(scope="module")
def surface():
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=1e4, q_high=4e4)
    return spectrum.surface(32, rng=7)


@pytest.fixture(scope="module", params=OPTIONS)
def answered(request, surface):
    """An assessment, and the keys of what was asked for."""
    materials, ask, expected = OPTIONS[request.param]
    load = "50 kPa" if materials is GEL else "20 MPa"
    given = {"loads": load, "ask": ask, "elastic": True, "periodic": True, "grid_error": False}
    return rl.assess(rl.Question(surface, materials, **given)), expected


def test_it_leads_all_answers_and_its_group_all_groups(answered):
    result, expected = answered
    first = [key for group in groups(result) for key in group.headlines]
    assert first[: len(expected)] == expected
    assert figure_keys(result)[: len(expected)] == expected
    names = [result.answers[key].name for key in expected]
    assert [each.name for each in headline(result).figures][: len(names)] == names
    asked = [key for key, each in result.answers.items() if each.answers_question]
    assert asked == expected


def test_groups_stay_together_in_the_order_of_rules(answered):
    result, expected = answered
    found = list(dict.fromkeys(each.rule.group for each in result.answers.values()))
    begin = list(dict.fromkeys(result.answers[key].rule.group for key in expected))
    rest = [rule.group for rule in rl.rules if rule.group in found and rule.group not in begin]
    assert found == [*begin, *dict.fromkeys(rest)]
    each = [answer.rule.group for answer in result.answers.values()]
    assert each == sorted(each, key=found.index)


@pytest.mark.parametrize("unfolded_by", ["", "--all"])
def test_it_is_the_first_figure_on_the_terminal(answered, unfolded_by, capsys):
    result, expected = answered
    print_assessment(result, unfolded_by=unfolded_by)
    lines = capsys.readouterr().out.split("\n\n")[1].splitlines()
    for key, line in zip(expected, lines[1:], strict=False):
        assert line.startswith(f"  {result.answers[key].name}")


def test_every_other_group_keeps_a_figure(answered):
    result, _ = answered
    shown = {result.answers[key].rule.group for key in figure_keys(result)}
    leading = {each.rule.group for each in result.answers.values() if each.leads}
    assert shown == leading


def test_its_section_is_the_first_of_a_document(answered):
    result, expected = answered
    sections = [each.heading for each in _sections(result, [], [])]
    first = next(iter(result.answers.values())).rule.group
    assert sections[:2] == ["Answers", first.capitalize()]
    if expected:
        assert result.answers[expected[0]].rule.group == first


def test_it_is_the_first_answer_in_json(answered):
    result, expected = answered
    written = json.loads(to_json(assessment_json(result)))["answers"].values()
    assert [each["key"] for each in written][: len(expected[:1])] == expected[:1]


def test_it_leads_a_part(surface, capsys):
    maps = [surface, rl.Surface(surface.heights[::-1].copy(), surface.sizes)]
    given = {"loads": ["20 MPa", "30 MPa"], "elastic": True, "grid_error": False}
    part = rl.assess(rl.Question(maps, METALS, ask=[rl.Friction(0.3)], **given))
    assert figure_keys(part)[0] == "slip_displacement"
    print_part(part, unfolded_by="--all")
    out = capsys.readouterr().out
    assert "friction: displacement" in out
    assert out.index("friction: displacement") < out.index("mechanics: contact")


def test_it_leads_the_lab(surface, tmp_path):
    page = Page(tmp_path, tmp_path)
    rl.write(rl.Surface(surface.heights, surface.sizes, unit="m"), tmp_path / "map.nc")
    said = {"first": "steel", "second": "copper", "loads": "2 MPa", "frequency": "5 MHz"}
    header, _ = page.ask("answer", page.bring(tmp_path / "map.nc") | said)
    assert header["figures"]["answers"][0]["name"] == "reflection at 5 MHz"
    _, rows, counted, _ = header["tables"]["measured-answers"]
    assert rows[0][0] == "reflection at 5 MHz |r|"
    assert counted[0][0] == "acoustic"


def test_elastic_bodies_slip_as_the_closed_form_says(surface):
    """From no load on, u_x = mu E*/G* d: the whole approach is taken back."""
    given = {"loads": ["10 MPa", "20 MPa"], "elastic": True, "grid_error": False}
    result = rl.assess(rl.Question(surface, METALS, ask=[rl.Friction(0.3)], **given))
    pair, slip = result.question.pair, result.answers["slip_displacement"]
    expected = 0.3 * pair.E_star / pair.G_star * result.curve.depth[-1]
    np.testing.assert_allclose(slip.values, expected, rtol=1e-12)
    assert slip.low is None
    assert slip.validity.startswith("coefficient of friction 0.3, sliding from 6 N on")
