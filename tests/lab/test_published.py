import json
import math
import re

import pytest

import roughline as rl
from roughline.lab.published import controls, state
from roughline.lab.server.tasks import run_task
from roughline.lab.site import TASKS, page
from roughline.paper.claims import judge_claims
from roughline.paper.laws import exponent_estimate
from roughline.paper.plan import ENSEMBLE_FULL, paper_plan
from roughline.paper.stated import stated_exponents
from roughline.paper.tables import constant_table, exponent_table, three_digits
from roughline.paper.windows import Windows

SESSION = {"names": {}, "files": {}}


def outcome(task, said=None, **more):
    arguments = {"state": said or {}, "session": SESSION, **more}
    return run_task(TASKS[f"published.{task}"], arguments, lambda done, total: None)


def ask(task, said=None, **more):
    """Return the header of an answer."""
    found = outcome(task, said, **more)
    assert not found.error, found.error
    length = int.from_bytes(found.answer[:4], "little")
    return json.loads(found.answer[4 : 4 + length])


def rows(answer, model):
    return answer["tables"][f"fit-{model}"]["rows"]


@pytest.fixture(scope="module")
def fits():
    return ask("fits")


def test_the_controls_are_those_of_the_study(published_results):
    dimensions = paper_plan("full").ensemble(ENSEMBLE_FULL).fractal_dimensions
    assert dimensions == controls.DIMENSIONS
    assert tuple(published_results.full.fractal_dimension.values) == dimensions
    default = state.read_state({})
    assert default.window("1D") == Windows().reduced
    assert default.window("3D") == Windows().full


def test_the_published_windows_give_the_published_exponents(fits, published_results):
    for model, name in (("1D", "reduced"), ("3D", "full")):
        laws = [getattr(each, name) for each in published_results.laws]
        shown = fits["panels"]["exponents"]["series"][model]
        assert shown["x"] == [each.fractal_dimension for each in published_results.laws]
        assert shown["y"] == [law.exponent for law in laws]
        ends = zip(shown["low"], shown["high"], strict=True)
        assert list(ends) == [law.exponent_interval for law in laws]


def test_the_cells_are_those_of_the_published_page(fits, published_results):
    def published(cell):
        return re.sub(r"(?<=\d)-(?=\d)", " to ", cell)

    for i, row in enumerate(exponent_table(published_results.laws).rows):
        assert rows(fits, "1D")[i][:2] == [row[0], published(row[3])]
        assert rows(fits, "3D")[i][:2] == [row[0], published(row[6])]
        of_figure_5 = fits["tables"]["published-exponents"]["rows"][i]
        assert of_figure_5 == [row[0], published(row[3]), published(row[6]), row[1], row[2]]
    raw = rows(ask("fits", {"punch": "raw"}), "3D")
    for shown, row in zip(raw, constant_table(published_results.laws).rows, strict=True):
        assert shown[2] == published(row[2])
    exact = [float(row[2].split()[0]) for row in rows(ask("fits", {"punch": "exact"}), "3D")]
    assert exact == pytest.approx([float(row[2].split()[0]) / 1.1523 for row in raw], abs=1e-3)


def test_verdicts_are_those_of_the_claims_and_say_against_what_and_within_what(
    fits, published_results
):
    claims = {claim.statement: claim for claim in judge_claims(published_results)}
    scaling = claims["3D: α = 1 / (4 - D_f) extremely well for D_f ≤ 2.6 (eq. 14, §7)"]
    assert scaling.cases == "undecided at D_f = 2.6; confirmed at D_f = 2.0, 2.2, 2.4"
    assert scaling.allowed == "-0.050 to +0.050"
    assert [row[3] for row in rows(fits, "3D")] == [
        *(f"{value} ± 0.05: confirmed" for value in ("0.500", "0.556", "0.625")),
        *("0.714 ± 0.05: undecided", "0.833 ± 0.1: undecided", "1.000 ± 0.1: refuted"),
    ]
    assert claims["3D: α ≈ 0.2567 D_f (§7)"].cases == "confirmed"
    assert all(row[4].endswith(" ± 0.05: confirmed") for row in rows(fits, "3D"))
    ends = claims["1D: α from 0.5 to 0.75 as D_f goes from 2 to 3 (§6)"]
    assert ends.cases == "refuted at D_f = 3.0; confirmed at D_f = 2.0"
    assert [row[4] for row in rows(fits, "1D")] == [
        "0.500 ± 0.05: confirmed",
        *["not stated"] * 4,
        "0.750 ± 0.05: refuted",
    ]
    by_key = {item["key"]: item for item in fits["strip"]}
    assert by_key["stated_3D"]["value"] == "confirmed"
    assert by_key["stated_1D"]["below"] == "within ± 0.05 or 0.1: at every D_f"


@pytest.mark.parametrize("model", controls.MODELS)
def test_a_window_in_the_saturation_is_not_judged_and_says_so(model):
    """However the stiffness is normalised."""
    for punch in ("paper", "raw"):
        answer = ask("fits", {f"low_{model}": "1", f"high_{model}": "10", "punch": punch})
        assert "reaches into the saturation" in answer["words"][f"doubt-{model}"]
        assert not any("refuted" in cell for row in rows(answer, model) for cell in row)
        assert all(row[3].endswith(": not judged") for row in rows(answer, model))
        by_key = {item["key"]: item for item in answer["strip"]}
        assert by_key[f"stated_{model}"]["value"] == "not judged"
        (other,) = {*controls.MODELS} - {model}
        assert answer["words"][f"doubt-{other}"] == ""


def test_another_window_and_mean_are_fitted_as_the_library_fits_them(published_results):
    said = {"D_f": "2.4", "mean": "geometric", "low_3D": "0.02", "high_3D": "0.4"}
    answer = ask("fits", said)
    one = published_results.full.sel(fractal_dimension=2.4)
    force, stiffness = one.force_bar.values, one.stiffness.values
    law = rl.fit_power_law(force, stiffness, (0.02, 0.4), averaging="geometric")
    assert answer["panels"]["exponents"]["series"]["3D"]["y"] == [law.exponent]
    stated = stated_exponents("3D", 2.4)[1].verdict(exponent_estimate(law))
    assert rows(answer, "3D")[0][4].endswith(stated)
    assert answer["state"]["low_3D"] == "0.02"
    assert "geometric mean of 60 surfaces" in answer["words"]["note-3D"]
    line = answer["panels"]["stiffness-3D"]["series"]["fits"]
    xs, ys = (line[each][:2] for each in "xy")
    slope = math.log(ys[1] / ys[0]) / math.log(xs[1] / xs[0])
    assert slope == pytest.approx(law.exponent)


def test_an_edge_that_the_address_has_rounded_is_the_load_again(published_results):
    force = published_results.reduced.force_bar.values
    low, high = float(force[12]), float(force[27])
    said = {"D_f": "3", "low_1D": f"{low:.4g}", "high_1D": f"{high:.4g}"}
    assert float(said["low_1D"]) > low
    (shown,) = ask("fits", said)["panels"]["exponents"]["series"]["1D"]["y"]
    stiffness = published_results.reduced.sel(fractal_dimension=3.0).stiffness.values
    assert shown == rl.fit_power_law(force, stiffness, (low, high)).exponent


def test_a_window_that_the_grid_decides_is_marked():
    answer = ask("fits", {"low_3D": "0.001", "D_f": "2,3"})
    assert [" *" in row[1] for row in rows(answer, "3D")] == [False, True]
    assert "fewer than ten cells" in answer["words"]["note-3D"]


def test_a_point_of_the_map_is_one_sentence():
    said = {"roll_off": "4", "map_D_f": "2.3", "map_F": "0.05", "tolerance": "0.2"}
    answer = ask("point", said)
    here = rl.trust_map().at(2.3, 0.05, 4)
    assert answer["verdict"] == here.verdict(0.2)
    sentence = answer["words"]["point"]
    assert sentence.count(".") == len(re.findall(r"\d\.\d", sentence)) + 1
    for part in (
        *(f"{here.value:.0%} stiffer", f"{here.low:+.0%} to {here.high:+.0%}", "within 20%"),
        "D_f = 2.30, F̄ = 0.0500 and",
    ):
        assert part in sentence
    near = ask("point", {"roll_off": "4", "map_D_f": "2.6", "map_F": "0.01"})
    assert "(95 % interval +0% to" in near["words"]["point"]
    there = ask("point", {"map_D_f": "3", "map_F": "0.001"})
    assert "the grid decides" in there["words"]["point"]


def test_numbers_keep_three_digits_and_their_zeros():
    told = [three_digits(value) for value in (0.2, 1.0, 10.0, 123.4, 1e-4, 3.16e-5)]
    assert told == ["0.200", "1.00", "10.0", "123", "0.000100", "3.16e-05"]


def test_the_page_has_no_symbol_as_plain_text():
    inside = page().partition('<main id="published"')[2].partition(">")[2]
    told = re.sub(r"<[^>]+>", "", inside)
    assert re.findall(r"\w*[A-Za-zα-ω]_[A-Za-z0-9]\w*|\S*\d\^\S*", told) == []


@pytest.mark.parametrize(("said", "words"), [({"v": "2"}, "version 1"), ({"seed": "3"}, '"seed"')])
def test_an_address_of_another_version_is_refused_in_one_sentence(said, words):
    found = outcome("fits", said)
    assert found.answer is None
    assert found.at == "v"
    assert words in found.error
    assert "\n" not in found.error


@pytest.mark.parametrize(
    ("said", "at", "words"),
    [
        ({"D_f": "2.3"}, "D_f", "choose one or more of 2, 2.2"),
        ({"D_f": ","}, "D_f", "no fractal dimension is chosen"),
        ({"mean": "median"}, "mean", "allowed are arithmetic, geometric"),
        ({"punch": "2"}, "punch", "allowed are paper, exact, raw"),
        ({"low_1D": "0,1"}, "low_1D", "no commas"),
        ({"low_1D": "1e-9"}, "low_1D", "from 1e-05 to 10"),
        ({"low_3D": "0.2"}, "low_3D", "its end must be the larger one"),
        ({"low_3D": "0.09"}, "low_3D", "widen it"),
        ({"low_3D": "0.001", "high_3D": "0.0011"}, "high_3D", "widen it"),
        ({"tolerance": "nan"}, "tolerance", "from 0.01 to 0.5"),
        ({"roll_off": "3"}, "roll_off", "allowed are 1, 2, 4, 8, 16"),
        ({"map_D_f": "4"}, "map_D_f", "from 2 to 3"),
        ({"map_F": "<b>"}, "map_F", "from 0.001 to 3.162"),
    ],
)
def test_what_cannot_be_used_is_one_sentence_at_its_control_and_the_others_count(said, at, words):
    answer = ask("fits", {"mean": "geometric", **said}, before={"low_3D": "0.001"})
    assert list(answer["refused"]) == [at]
    assert words in answer["refused"][at]
    assert answer["refused"][at].endswith("is used meanwhile")
    assert "\n" not in answer["refused"][at]
    for model in controls.MODELS:  # what is wrong with a window is said beside its figure, too
        is_of_it = at in {each.key for each in controls.WINDOWS[model]}
        assert answer["words"][f"error-{model}"] == is_of_it * answer["refused"][at]
    if at != "mean":
        assert "geometric mean" in answer["words"]["note-3D"]
