"""An answer that the program does not know, defined here: it stands wherever answers stand."""

from dataclasses import replace

import made
import numpy as np
import pytest

import roughline as rl
from lab.test_measured import Page
from roughline.report.contact_report import write_contact_report
from roughline.report.contact_tables import symbol_table
from roughline.report.json_output import assessment_json, part_json, to_json
from roughline.report.terminal import print_assessment

LIMIT = 1.05  # of its value at the first load, beyond which no interval reaches


def _resonance(pressed):
    """Natural frequency of a mass of a kilogram on the contact, in rows. [Hz]"""
    return np.sqrt(pressed.unloading / 1.0) / (2 * np.pi)


def _lacking(pair, frequency):
    return pair.lacks("density", "resonance")


RESONANCE = rl.Rule(
    key="resonance",
    name="resonance of one kilogram",
    symbol="f_0",
    unit="Hz",
    group="acoustic",
    formula="sqrt(k_u / m_1) / (2 pi)",
    symbols=lambda pressed: [rl.Symbol("m_1", "mass on the contact", "kg", 1.0)],
    validity="small vibrations",
    source="Rayleigh 1877",
    value=_resonance,
    lacking=_lacking,
    limits=lambda pressed: (0.0, LIMIT * _resonance(pressed)[0]),
    leads=lambda pressed: True,
    is_extensive=True,
)


@pytest.fixture
def resonance():
    rl.rules.add(RESONANCE)
    yield RESONANCE
    rl.rules.remove("resonance")


@pytest.fixture(scope="module", params=[64, 128])
def surface(request):
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=5e4, q_high=4e5)
    return spectrum.surface(request.param, rng=7)


def asked(surface, **more):
    given = {"loads": ["3 N", "10 N"], "grid_error": True, **more}
    return rl.assess(rl.Question(surface, "steel,copper", **given))


def test_it_has_the_interval_of_what_it_follows_from(resonance, surface):
    result = asked(surface, elastic=True)
    found, k = result.answers["resonance"], result.answers["contact_stiffness"]
    assert found.values == pytest.approx(np.sqrt(k.values) / (2 * np.pi), rel=1e-12)
    assert found.low == pytest.approx(np.sqrt(k.low) / (2 * np.pi), rel=1e-12)
    high = np.minimum(np.sqrt(k.high) / (2 * np.pi), LIMIT * found.values)
    assert found.high == pytest.approx(high, rel=1e-12)
    assert found.formula == "sqrt(k / m_1) / (2 pi)"  # by the name that the table has


def test_its_symbols_stand_in_the_table_of_the_page(resonance, surface):
    _, rows = symbol_table(asked(surface, elastic=True))
    assert ["m_1", "mass on the contact", "1 kg"] in rows


@pytest.mark.parametrize(
    ("symbol", "formula", "is_in"),
    [
        *(("E*", "F/(E* m)", True), ("E*", "E*_e", False), ("k", "k_u / 2", False)),
        *(("P1", "(P1² - P2²)", True), ("W/B", "B/(W P)", True), ("W/B", "W + b", False)),
        *(("u", "1 / (u + M)", True), ("t", "sum(t / E_c)", True), ("t", "at two", False)),
    ],
)
def test_a_symbol_is_in_a_formula_where_it_stands_for_itself(symbol, formula, is_in):
    assert rl.Symbol(symbol, "").is_in(formula) == is_in


def test_the_scatter_of_the_hardness_widens_it_up_to_its_limits(resonance, surface):
    result = asked(surface)
    found, k_u = result.answers["resonance"], result.answers["unloading_stiffness"]
    assert found.formula.startswith("sqrt(k_u / m_1)")
    wide = np.sqrt(k_u.high / k_u.values)
    assert found.high / found.values == pytest.approx(np.minimum(wide, LIMIT), rel=1e-12)
    assert (wide > LIMIT).any()  # or the limits are not seen
    least, largest = result.hardness_scatter["resonance"]
    assert least == pytest.approx(np.sqrt(result.hardness_scatter["unloading_stiffness"][0]))
    assert (least <= 1).all()
    assert (largest >= 1).all()
    assert "resonance" in result.elastic
    assert "hardness" in [each.cause for each in found.why()]


def test_it_is_that_of_a_joint(resonance, surface):
    half = len(surface.heights) // 2
    piece = surface.cropped((0, half), (0, half))
    result = asked(piece, ask=rl.Joint("4 mm^2"), elastic=True)
    found, k_i = result.answers["resonance"], result.answers["interface_stiffness"]
    assert found.values == pytest.approx(np.sqrt(k_i.values) / (2 * np.pi), rel=1e-12)
    assert found.formula == "sqrt(k_i / m_1) / (2 pi)"


def test_it_is_averaged_over_maps(resonance, surface):
    n = len(surface.heights) // 4
    maps = [surface.cropped((x, x + n), (0, n)) for x in (0, 2 * n)]
    part = asked(maps, elastic=True, loads=["2 MPa"], grid_error=False)
    found = part.answers["resonance"]
    of_maps = [each.answers["resonance"].values for each in part.assessments]
    assert found.mean == pytest.approx(np.sqrt(of_maps[0] * of_maps[1]), rel=1e-12)
    assert part_json(part)["part"]["f_0"]["key"] == "resonance"


def test_it_stands_on_the_terminal_in_json_and_in_the_report(
    resonance, surface, tmp_path, only_drawn, capsys
):
    only_drawn()
    result = asked(surface)
    print_assessment(result)
    assert "resonance of one kilogram f_0" in capsys.readouterr().out
    written = assessment_json(result)["answers"]["f_0"]
    assert written["key"] == "resonance"
    assert np.isfinite([written["low"], written["high"]]).all()
    assert "Rayleigh 1877" in to_json(assessment_json(result))
    files = write_contact_report(result, tmp_path, "")
    page = files[0].read_text("utf-8")
    assert page.count("esonance of one kilogram") >= 3  # headline, table, formulas
    assert "Rayleigh 1877" in page


def test_it_stands_in_the_lab(resonance, surface, tmp_path):
    page = Page(tmp_path, tmp_path)
    rl.write(replace(surface, unit="m"), tmp_path / "map.nc")
    state = page.bring(tmp_path / "map.nc") | {"first": "steel", "second": "copper"}
    header, _ = page.ask("answer", state | {"loads": "10 N"})
    _, rows, *_ = header["tables"]["measured-answers"]
    assert [row for row in rows if row[0] == "resonance of one kilogram f_0"]
    _, formulas, *_ = header["tables"]["measured-formulas"]
    assert [row for row in formulas if row[3] == "Rayleigh 1877"]


def test_it_stands_in_the_glossary(resonance):
    assert "resonance of one kilogram" in made.page_of_answers()


def test_a_material_that_lacks_a_value_is_named(resonance, surface):
    result = rl.assess(
        rl.Question(surface, "steel,E=100 GPa nu=0.3", loads="3 N", grid_error=False)
    )
    assert "resonance" not in result.answers
    assert any(note.startswith("no resonance: the density") for note in result.notes)


@pytest.mark.parametrize(
    ("value", "why"),
    [
        (lambda pressed: np.full(2, np.nan), "nan under a load that was solved"),
        (lambda pressed: pressed.force / 0.0, "inf under a load that was solved"),
        (lambda pressed: np.ones(3), "3 values, and there are 2 loads"),
    ],
)
def test_an_answer_that_cannot_be_used_is_left_out_and_named(surface, value, why):

    rl.rules.add(replace(RESONANCE, value=value, limits=lambda pressed: (0.0, 1.0)))
    try:
        with np.errstate(divide="ignore"):
            result = asked(surface, elastic=True)
    finally:
        rl.rules.remove("resonance")
    assert "resonance" not in result.answers
    (note,) = [each for each in result.notes if each.startswith("no resonance of one kilogram")]
    assert why in note


def test_what_is_told_with_it_is_in_words_of_its_own(surface):
    facts = [rl.own_words("it swings", "note"), None, rl.own_words("it breaks", "grave")]
    rl.rules.add(replace(RESONANCE, facts=lambda _pressed: facts))
    try:
        result = asked(surface, grid_error=False)
    finally:
        rl.rules.remove("resonance")
    assert result.warnings[0] == "it breaks"
    assert "it swings" in result.notes
    assert {fact.of for fact in result.answers["resonance"].facts} == {("resonance",)}


def test_two_answers_have_no_name_in_common(resonance):
    with pytest.raises(rl.InputError, match='key "resonance" of the resonance of one kilogram'):
        rl.rules.add(RESONANCE)

    with pytest.raises(rl.InputError, match='symbol "k" of the contact stiffness'):
        rl.rules.add(replace(RESONANCE, key="other", symbol="k"))
    with pytest.raises(rl.InputError, match="group"):
        rl.rules.add(replace(RESONANCE, key="other", symbol="f_1", group="optics"))
    with pytest.raises(rl.InputError, match="give a Rule"):
        rl.rules.add("resonance")
    with pytest.raises(rl.InputError, match="key"):
        rl.rules.remove("other")


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"value": lambda _pressed: "3 Hz"}, r'value of the rule "resonance" returned "3 Hz"'),
        ({"value": lambda _pressed: [None]}, r"returned \[None\]; numbers of shape"),
        (
            {"value": lambda pressed: np.ones((2, pressed.force.size))},
            "returned an array of",
        ),
        ({"limits": lambda _pressed: (np.inf, 0.0)}, r"limits of the rule .* in this order"),
        ({"limits": lambda _pressed: 3.0}, "limits of the rule .* returned 3.0"),
        (
            {"facts": lambda _pressed: "it swings"},
            r'facts of the rule "resonance" returned "it swings"; a fact is needed, such as rl.own',
        ),
        ({"lacking": lambda *_: True}, "lacking of the rule .* returned True; a fact is needed"),
    ],
)
def test_a_rule_that_returns_something_else_is_told_in_one_line(surface, changed, said):
    rl.rules.add(replace(RESONANCE, **changed))
    try:
        with pytest.raises(rl.InputError, match=said) as refused:
            asked(surface, loads="3 N", grid_error=False, elastic=True)
    finally:
        rl.rules.remove("resonance")
    assert "\n" not in str(refused.value)


def test_a_rule_without_a_function_is_refused():
    with pytest.raises(rl.InputError, match="value is 3; a function is needed"):
        replace(RESONANCE, value=3)
