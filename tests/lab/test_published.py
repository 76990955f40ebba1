import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import roughline as rl
from roughline.lab.published import controls, state
from roughline.lab.server.tasks import outcome_of
from roughline.lab.site import TASKS
from roughline.paper.claims import claims_section, judge_claims
from roughline.paper.gallery import Gallery
from roughline.paper.laws import exponent_estimate
from roughline.paper.plan import ENSEMBLE_FULL, paper_plan
from roughline.paper.stated import stated_exponents
from roughline.paper.tables import constant_table, exponent_table
from roughline.paper.windows import WINDOW_AREA, Windows

PAGE = Path(__file__).parents[2] / "docs" / "paper.md"
SESSION = {"names": {}, "files": {}, "max_points": 64}


def outcome(task, said=None, **more):
    arguments = {"state": said or {}, "session": SESSION, "crowded": False, **more}
    return outcome_of(TASKS[f"published.{task}"], arguments, lambda done, total: None)


def ask(task, said=None, **more):
    """Return the header of an answer, with its arrays."""
    found = outcome(task, said, **more)
    assert not found.error, found.error
    length = int.from_bytes(found.answer[:4], "little")
    header, data = json.loads(found.answer[4 : 4 + length]), found.answer[4 + length :]
    for name, place in header["arrays"].items():
        values = np.frombuffer(data, place["dtype"], np.prod(place["shape"]), place["offset"])
        header["arrays"][name] = values.reshape(place["shape"])
    return header


@pytest.fixture(scope="module")
def fits():
    return {model: ask("fits", model=model) for model in controls.MODELS}


def test_the_controls_are_those_of_the_study(published_results):
    dimensions = paper_plan("full").ensemble(ENSEMBLE_FULL).fractal_dimensions
    assert dimensions == controls.DIMENSIONS
    assert tuple(published_results.full.fractal_dimension.values) == dimensions
    default = state.state_of({})
    assert default.windows == {"1D": Windows().reduced, "3D": Windows().full}
    gallery = Gallery.of(paper_plan("full")).fractal_dimensions
    shown = [eval(text) for text in controls.GALLERY]
    assert np.allclose(shown, gallery)


def test_the_published_windows_give_the_published_exponents(fits, published_results):
    for laws, (of_lines, of_surfaces) in zip(
        published_results.laws,
        zip(fits["1D"]["laws"], fits["3D"]["laws"], strict=True),
        strict=True,
    ):
        for law, shown in ((laws.reduced, of_lines), (laws.full, of_surfaces)):
            assert shown["exponent"] == law.exponent
            assert tuple(shown["interval"]) == law.exponent_interval
        assert of_lines["prefactor"] == laws.reduced.prefactor


def test_the_cells_are_those_of_the_published_page(fits, published_results):
    text = PAGE.read_text(encoding="utf-8")
    rows = exponent_table(published_results.laws).rows
    for i, row in enumerate(rows):
        assert f"| {' | '.join(row)} |" in text
        assert fits["1D"]["rows"][i][:2] == [row[0], row[3]]
        assert fits["3D"]["rows"][i][:2] == [row[0], row[6]]
    raw = ask("fits", {"punch": "raw"}, model="3D")
    for shown, row in zip(raw["rows"], constant_table(published_results.laws).rows, strict=True):
        assert shown[2] == row[2]
    prefactors = [fit["prefactor"] for fit in ask("fits", {"punch": "exact"}, model="3D")["laws"]]
    assert np.allclose(prefactors, [fit["prefactor"] / 1.1523 for fit in raw["laws"]])


def test_the_verdicts_are_those_of_the_claims(fits, published_results):
    claims = {claim.statement: claim for claim in judge_claims(published_results)}
    scaling = claims["3D: α = 1 / (4 - D_f) extremely well for D_f ≤ 2.6 (eq. 14, §7)"]
    assert scaling.cases == "undecided at D_f = 2.6; confirmed at D_f = 2.0, 2.2, 2.4"
    assert [row[3].split(", ")[1] for row in fits["3D"]["rows"]] == [
        *["confirmed"] * 3,
        *["undecided"] * 2,
        "refuted",
    ]
    assert claims["3D: α ≈ 0.2567 D_f (§7)"].cases == "confirmed"
    assert {row[4].split(", ")[1] for row in fits["3D"]["rows"]} == {"confirmed"}
    ends = claims["1D: α from 0.5 to 0.75 as D_f goes from 2 to 3 (§6)"]
    assert ends.cases == "refuted at D_f = 3.0; confirmed at D_f = 2.0"
    cells = [row[4] for row in fits["1D"]["rows"]]
    assert cells == ["0.500, confirmed", *["not stated"] * 4, "0.750, refuted"]
    by_key = {item["key"]: item for model in fits.values() for item in model["strip"]}
    assert by_key["stated_3D"]["value"] == "confirmed"


def test_another_window_and_mean_are_fitted_as_the_library_fits_them(published_results):
    said = {"D_f": "2.4", "mean": "geometric", "low_3D": "0.02", "high_3D": "0.4"}
    answer = ask("fits", said, model="3D")
    one = published_results.full.sel(fractal_dimension=2.4)
    force, stiffness = one.force_bar.values, one.stiffness.values
    law = rl.fit_power_law(force, stiffness, (0.02, 0.4), averaging="geometric")
    (shown,) = answer["laws"]
    assert shown["exponent"] == law.exponent
    stated = stated_exponents("3D", 2.4)[1].verdict(exponent_estimate(law))
    assert answer["rows"][0][4].endswith(stated)
    assert answer["state"]["low_3D"] == "0.02"
    assert "geometric mean of 60 surfaces" in answer["note"]


def test_an_edge_that_the_address_has_rounded_is_the_load_again(published_results):
    force = published_results.reduced.force_bar.values
    low, high = float(force[12]), float(force[27])
    said = {"D_f": "3", "low_1D": f"{low:.4g}", "high_1D": f"{high:.4g}"}
    assert float(said["low_1D"]) > low
    (shown,) = ask("fits", said, model="1D")["laws"]
    stiffness = published_results.reduced.sel(fractal_dimension=3.0).stiffness.values
    assert shown["exponent"] == rl.fit_power_law(force, stiffness, (low, high)).exponent


def test_a_window_that_the_grid_decides_is_marked():
    answer = ask("fits", {"low_3D": "0.001", "D_f": "2,3"}, model="3D")
    assert [" *" in row[1] for row in answer["rows"]] == [False, True]
    assert "fewer than ten cells" in answer["note"]


@pytest.mark.parametrize("averaging", ["arithmetic", "geometric"])
def test_curves_are_means_with_their_standard_error(averaging, published_results):
    answer = ask("curves", {"mean": averaging, "D_f": "2.2", "punch": "exact"})
    for model, data, punch in (
        ("1D", published_results.reduced, 1.0),
        ("3D", published_results.full, 1.1523),
    ):
        (curve,) = answer["models"][model]["curves"]
        values = data.sel(fractal_dimension=2.2).stiffness.values / punch
        mean = rl.average(values, averaging)
        assert np.allclose(curve["mean"], mean.mean)
        error = mean.standard_error
        if averaging == "geometric":
            assert np.allclose(np.log(curve["high"]), np.log(mean.mean) + error)
        else:
            assert np.allclose(curve["high"], mean.mean + error)
        assert len(answer["models"][model]["rows"]) == data.force_bar.size
    assert answer["models"]["3D"]["saturated"] == pytest.approx(1)


def test_the_published_exponents_are_kept():
    answer = ask("exponents")
    assert [window["label"] for window in answer["windows"]] == [
        "F̄ = 0.0001 to 0.01",
        "F̄ = 0.001 to 0.1",
        "F̄ = 0.01 to 0.3",
    ]
    assert answer["scaling"][-1] == 1
    assert answer["linear"][0] == pytest.approx(2 * 0.2567)


def test_the_area_law_is_the_published_one(published_results):
    answer = ask("area", {"D_f": "2,3"})
    assert tuple(answer["window"]) == WINDOW_AREA
    kappas = [laws.corrected.kappa.value for laws in published_results.laws]
    assert answer["kappas"]["corrected"]["y"] == kappas
    in_cells = [laws.cells.kappa.high for laws in published_results.laws]
    assert answer["kappas"]["cells"]["high"] == in_cells
    for shown, row in zip(answer["rows"], constant_table(published_results.laws).rows, strict=True):
        assert shown == [row[0], *row[4:8]]
    assert [curve["D_f"] for curve in answer["curves"]] == ["2.0", "3.0"]


def test_claims_are_those_of_the_published_page(published_results):
    answer = ask("claims")
    section = claims_section(judge_claims(published_results))
    assert answer["rows"] == [list(row) for row in section.tables[0].rows]
    assert answer["note"] == section.note
    text = PAGE.read_text(encoding="utf-8")
    assert all(f"| {' | '.join(row)} |" in text for row in answer["rows"])
    assert sum(answer["counts"].values()) == len(answer["rows"]) == len(answer["verdicts"])


def test_the_trust_map_is_that_of_the_package():
    answer, whole = ask("trust"), rl.trust_map()
    assert len(answer["panels"]) == whole.roll_off_ratios.size
    assert len(answer["legend"]) == 10
    for i, panel in enumerate(answer["panels"]):
        assert panel["roll_off"] == f"{whole.roll_off_ratios[i]:g}"
        assert panel["resolved"] == whole.resolved[i].ravel().tolist()
        middles = np.sqrt(np.multiply(panel["left"], panel["right"])).reshape(11, 15)
        assert np.allclose(middles, whole.force_bars, rtol=1e-4)
    strongest = answer["panels"][-1]["colour"][int(np.argmax(whole.difference[-1]))]
    assert strongest == answer["legend"][-1]["colour"]


def test_a_point_of_the_map_is_one_sentence():
    said = {"roll_off": "4", "map_D_f": "2.3", "map_F": "0.05", "tolerance": "0.2"}
    answer = ask("point", said)
    here = rl.trust_map().at(2.3, 0.05, 4)
    assert answer["difference"]["value"] == here.value
    assert answer["verdict"] == here.verdict(0.2)
    sentence = answer["sentence"]
    assert sentence.count(".") == len(re.findall(r"\d\.\d", sentence)) + 1
    for part in (f"{here.value:.0%} stiffer", f"{here.low:+.0%} to {here.high:+.0%}", "within 20%"):
        assert part in sentence
    assert "the grid decides" in ask("point", {"map_D_f": "3", "map_F": "0.001"})["sentence"]


def test_bodies_are_those_of_the_plan():
    answer = ask("body", row=3)
    found = replace(Gallery.of(paper_plan("full")), n=64).bodies(3.0)
    assert np.array_equal(answer["arrays"]["contact"].T, found["contact"])
    assert np.allclose(answer["arrays"]["deflection"].T, found["displacement"])
    assert np.allclose(answer["arrays"]["line"], found["line_heights"], atol=1e-6)
    springs = np.mean(found["line_heights"] > answer["level"])
    assert answer["springs"] == f"{springs:.1%}"


def test_the_address_holds_all_that_is_chosen():
    said = {
        **{"v": "1", "D_f": "2,2.6", "mean": "geometric", "punch": "raw", "claims": "refuted"},
        **{"low_1D": "0.001", "high_1D": "0.1", "low_3D": "0.01", "high_3D": "0.5"},
        **{"tolerance": "0.05", "roll_off": "8", "map_D_f": "2.5", "map_F": "1"},
    }
    chosen = state.state_of(said)
    assert chosen.address() == said
    assert state.state_of(chosen.address()) == chosen
    default = state.state_of({})
    assert state.state_of(default.address()) == default


@pytest.mark.parametrize(("said", "words"), [({"v": "2"}, "version 1"), ({"seed": "3"}, '"seed"')])
def test_an_address_of_another_version_is_refused_in_one_sentence(said, words):
    found = outcome("fits", said, model="3D")
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
        ({"claims": "some"}, "claims", "allowed are all"),
    ],
)
def test_what_cannot_be_used_is_one_sentence_at_its_control_and_the_others_count(said, at, words):
    answer = ask("fits", {"mean": "geometric", **said}, before={"low_3D": "0.001"}, model="3D")
    assert list(answer["refused"]) == [at]
    assert words in answer["refused"][at]
    assert answer["refused"][at].endswith("is used meanwhile")
    assert "\n" not in answer["refused"][at]
    if at != "mean":
        assert "geometric mean" in answer["note"]


@pytest.mark.parametrize("row", [-1, 4, "1", None, 1.0, [0]])
def test_a_row_that_is_none_is_refused(row):
    assert "no such row" in outcome("body", row=row).error


def test_a_model_that_is_none_is_refused():
    assert "no such model" in outcome("fits", model="2D").error
