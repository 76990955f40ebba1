"""Tables of an assessment: their loads, their stars, and the symbols of their formulas."""

import re
from dataclasses import replace

import pytest
from attrs import evolve

import roughline as rl
from roughline.report.answers import answer_table, has_star
from roughline.report.contact_tables import symbol_table
from roughline.report.json_output import assessment_json
from roughline.report.terminal import print_assessment
from roughline.report.typeset import formula_in_symbols

PAIR = ("steel", "copper")


def test_no_star_is_explained_that_is_not_shown(rough, loads_of_curve, capsys):
    asked = rl.Question(rough, PAIR, loads="10 N", whole_curve=True)
    if loads_of_curve == "few loads":
        asked = evolve(asked, grid_error=False)
    pressed = rl.assess(asked)
    assert not pressed.curve.resolved.all()  # lighter loads of a report's figure
    print_assessment(pressed)
    assert "fewer than ten points in contact" not in capsys.readouterr().out
    assert not has_star(pressed)


def test_a_table_has_the_loads_that_are_wanted(rough):
    pressed = rl.assess(rl.Question(rough, PAIR, loads=["30 N", "10 N", "20 N"]))
    header, rows = answer_table(pressed, range(1, 3))
    assert header == ["", "10 N", "20 N"]
    assert rows[0] == ["normal force F", "10 N", "20 N"]


@pytest.fixture(params=["map", "generated", "line", "scan"])
def body(request):
    surface = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6).surface(64, 3)
    surface = replace(surface, unit="m")
    if request.param in ("map", "generated"):
        return surface.cropped((0, 24), (0, 24)) if request.param == "map" else surface
    kind = "profile" if request.param == "scan" else "reduced"
    return rl.Line(surface.heights[0], 1e-3, "m", kind=kind)


@pytest.mark.parametrize(
    "asked", [{}, {"elastic": True}, {"periodic": True}, {"ask": [rl.Joint(1e-4)]}]
)
def test_every_symbol_of_a_formula_stands_in_a_table_and_means_one_thing(body, asked):
    if isinstance(body, rl.Line) and asked:
        pytest.skip("a line has no yield, no borders and no joint")
    asked = {**asked, "ask": [rl.Ultrasound("5 MHz"), *asked.get("ask", ())]}
    pressed = rl.assess(rl.Question(body, PAIR, loads="10 N", **asked))
    answers = [formula_in_symbols(each.symbol) for each in pressed.answers.values()]
    assert len({*answers}) == len(answers)
    _, rows = symbol_table(pressed)
    names = [name for name, _, _ in rows]
    assert len({*names}) == len(names)
    assert not {*names} & {*answers}
    written = " ".join(map(formula_in_symbols, formulas_of(pressed)))
    assert all(re.search(rf"(?<!\w){re.escape(each)}", written) for each in names)
    known = {*names, *(part.strip("|") for each in answers for part in each.split("/"))}
    for formula in formulas_of(pressed):
        for name in re.findall(r"[A-Za-z]+(?:_[A-Za-z0]+)?\d?\*?", formula):
            is_word = name.isalpha() and (len(name) > 2 or name in WORDS)
            if name in ("dF", "dd", "pi") or (is_word and name not in GREEK):
                continue
            assert formula_in_symbols(name) in known, (name, formula)


GREEK = ("kappa", "sigma", "omega")
WORDS = ("a", "at", "in", "no", "of", "on", "or", "s")


def formulas_of(pressed):
    return [each.formula for each in pressed.answers.values()]


@pytest.mark.parametrize("grid_error", [False, True])
def test_of_a_joint_the_interface_comes_first_and_says_which_stiffness_it_is(rough, grid_error):
    asked = rl.Question(rough, PAIR, loads="1 kN", ask=rl.Joint("2 cm^2"), grid_error=grid_error)
    pressed = rl.assess(asked)
    _, rows = answer_table(pressed)
    names = [row[0] for row in rows]
    stiffnesses = [name for name in names if "stiffness" in name]
    assert stiffnesses == [
        "interface stiffness on unloading k_i",
        "interface stiffness on further loading k_load",
        "stiffness per area k_i/A_0",
        "tangential stiffness k_t",
    ]
    answers = pressed.answers
    k_i, k_load = answers["interface_stiffness"].values, answers["contact_stiffness"].values
    assert k_i > k_load
    assert answers["stiffness_per_area"].values == pytest.approx(k_i / 2e-4)
    assert answers["constriction_resistance"].formula.endswith("(2 k_i)")
    elastic = rl.assess(evolve(asked, elastic=True))
    assert "contact_stiffness" not in elastic.answers  # equal to that on unloading
    assert elastic.answers["interface_stiffness"].name == "interface stiffness"


@pytest.mark.parametrize("joint", [None, "2 cm^2"])
def test_json_and_the_curve_say_of_what_they_are(rough, joint):
    pressed = rl.assess(
        rl.Question(rough, PAIR, loads="5 MPa", ask=rl.Joint(joint) if joint else ())
    )
    told = assessment_json(pressed)
    whose = "body" if joint is None else "map"
    assert (told["curve"]["of"], told["intervals_of"]) == (whose, whose)
    assert told["answers_of"] == ("body" if joint is None else "joint")
    assert pressed.curve.to_dataset().attrs.get("curve_of") == (None if joint is None else "map")
    force = pressed.answers["normal_force"].values
    assert force == pytest.approx(pressed.curve_as_asked.force * pressed.scale)
