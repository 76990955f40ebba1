"""A cause that the program does not know, defined here: it stands wherever intervals stand."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from lab.test_measured import Page
from roughline.assessment.presses import list_presses
from roughline.facts.fact import Fact
from roughline.facts.kinds import INTERVALS, KINDS, FactKind
from roughline.margins.variant import AS_ASKED, Curves
from roughline.question.case import Case
from roughline.report.contact_report import write_contact_report
from roughline.report.json_output import assessment_json, to_json
from roughline.report.terminal import print_assessment

PAIR = "steel,copper"
RMS = 3e-8  # [m]


NOISY = FactKind(
    "the instrument is noisy by {rms:in m}",
    "the instrument is noisy by {rms:in m}",
    INTERVALS,
    "note",
)


class Noise(rl.OtherBodies):
    """The instrument's noise: the map pressed twice more with other noise."""

    name = "noise"
    title = "the noise of the instrument"
    remedy = "an instrument of less noise"
    takes = "with other noise"
    count = 2

    def __init__(self, rms=RMS):
        self.rms = rms

    def body(self, case, i):
        noise = np.random.default_rng(i).normal(scale=self.rms, size=case.body.shape)
        return replace(case.body, heights=case.body.heights + noise)

    def facts(self, case, curves):
        return [Fact("noisy", rms=self.rms)]


@pytest.fixture
def noise(monkeypatch):
    monkeypatch.setitem(KINDS, "noisy", NOISY)
    rl.causes.add(cause := Noise())
    yield cause
    rl.causes.remove("noise")


@pytest.fixture(scope="module", params=[64, 128])
def surface(request):
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=5e4, q_high=4e5)
    return spectrum.surface(request.param, rng=7)


@pytest.fixture(scope="module")
def piece(surface):
    half = len(surface.heights) // 2
    return surface.cropped((0, half), (0, half))


def question(body, **more):
    return rl.Question(body, PAIR, **{"loads": ["3 N", "10 N"], "grid_error": True, **more})


def test_it_adds_in_squares_to_what_others_leave_open(noise, surface):
    """Bodies are elastic, so that nothing but the grid and the noise leaves them open."""
    found = rl.assess(question(surface, elastic=True)).answers["contact_stiffness"]
    rl.causes.remove("noise")
    without = rl.assess(question(surface, elastic=True)).answers["contact_stiffness"]
    rl.causes.add(noise)
    assert (found.values == without.values).all()
    k = found.values
    noisy = [
        rl.press(Noise().body(Case.of(question(surface)), i), **pressed(surface)) for i in (0, 1)
    ]
    of_noise = np.sqrt(np.mean([np.log(each.stiffness / k) ** 2 for each in noisy], axis=0))
    of_grid = np.log(without.high / k)
    assert np.log(found.high / k) == pytest.approx(np.hypot(of_noise, of_grid), rel=1e-6)
    assert np.log(k / found.low) == pytest.approx(np.hypot(of_noise, of_grid), rel=1e-6)
    (margin,) = (each for each in found.margins if each.cause == "noise")
    assert np.log(margin.high / k) == pytest.approx(of_noise, rel=1e-6)


def pressed(surface):
    E_star = rl.Question(surface, PAIR).pair.E_star
    return {"E_star": E_star, "forces": [3.0, 10.0]}


def test_an_answer_says_that_it_is_why(noise, piece):
    """Of a map that yields and is a piece of a larger surface, with all causes beside it."""
    answer = rl.assess(question(piece)).answers["interface_stiffness"]
    reasons = {each.cause: each for each in answer.why()}
    assert reasons.keys() == {"grid", "place", "hardness", "noise"}
    factors = [each.factor for each in answer.why()]
    assert factors == sorted(factors, reverse=True)
    assert "an instrument of less noise would narrow it" in str(reasons["noise"])
    together = math.hypot(*(math.log(reasons[each].high) for each in ("grid", "place", "noise")))
    bound = reasons["hardness"].high
    assert answer.high[-1] / answer.values[-1] == pytest.approx(
        bound * math.exp(together), rel=1e-6
    )


def test_its_presses_are_in_the_list_the_cost_and_the_progress(noise, piece, monkeypatch):
    from roughline.assessment import cost

    monkeypatch.setattr(cost, "_ANNOUNCED_POINTS", 1)
    listed = list_presses(Case.of(question(piece)))
    assert sum(each.purpose == "noise" for each in listed) == 4  # as asked, and repeated
    told, steps = [], []
    rl.assess(question(piece), announce=told.append, progress=lambda *step: steps.append(step))
    assert " with other noise" in told[0]
    assert steps == sorted(steps)
    assert steps[-1][0] == steps[-1][1]


def test_terminal_report_json_and_page_show_it(noise, piece, tmp_path, only_drawn, capsys):
    result = rl.assess(question(piece))
    print_assessment(result)
    assert "noisy by 30 nm" in capsys.readouterr().out
    assert any("noisy by 30 nm" in each for each in result.notes)
    content = json.loads(to_json(assessment_json(result)))
    (margin,) = (each for each in content["answers"]["k_i"]["margins"] if each["cause"] == "noise")
    assert margin["title"] == "the noise of the instrument"
    assert margin["low"][0] < content["answers"]["k_i"]["values"][0] < margin["high"][0]
    only_drawn()
    write_contact_report(result, tmp_path, "")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "the noise of the instrument" in page
    assert "noisy by 30 nm" in page


def test_the_lab_shows_it(noise, piece, tmp_path):
    page = Page(tmp_path, tmp_path)
    rl.write(replace(piece, unit="m"), tmp_path / "map.nc")
    state = page.bring(tmp_path / "map.nc") | {"first": "steel", "second": "copper"}
    header, _ = page.ask("answer", state | {"loads": "10 N", "grid_error": "yes"})
    bars = [bar for each in header["bars"]["answers"]["groups"] for bar in each["bars"]]
    assert {(each["name"], each["remedy"]) for each in bars if each["name"] == noise.title} == {
        (noise.title, noise.remedy)
    }
    assert any("noisy by 30 nm" in told for each in header["remarks"].values() for told in each)


def test_one_whose_load_does_not_converge_leaves_the_interval_unknown(noise, surface):
    """That is said, and not taken as nothing."""
    case = Case.of(question(surface, elastic=True))
    curve = rl.press(surface, **pressed(surface))
    failed = replace(curve, stiffness=np.array([curve.stiffness[0], np.nan]))
    name = noise.presses(case, list_presses(case)[0])[1].name
    first = noise.presses(case, list_presses(case)[0])[0].name
    found = noise.spread(case, Curves({AS_ASKED: curve, first: curve, name: failed}), AS_ASKED)
    assert np.isnan(found.stiffness).tolist() == [[False, True]] * 2


def test_one_of_which_ctrl_c_left_a_body_out_is_not_known(noise, surface):
    case, curve = Case.of(question(surface, elastic=True)), rl.press(surface, **pressed(surface))
    first = noise.presses(case, list_presses(case)[0])[0].name
    known = {AS_ASKED: curve, first: curve}
    assert noise.spread(case, Curves(known, missing=("noise",)), AS_ASKED) is None
    assert noise.spread(case, Curves(known, missing=("place",)), AS_ASKED) is not None


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("grid", 'has the name "grid", as the grid has; give another'),
        ("", "has no name: give it one"),
    ],
)
def test_two_of_one_name_and_one_without_a_name_are_refused(name, told):
    class Other(Noise):
        pass

    Other.name = name
    with pytest.raises(rl.InputError, match=told):
        rl.causes.add(Other())
    with pytest.raises(rl.InputError, match="give an object of a class that is a Cause"):
        rl.causes.add(Other)


def test_it_is_asked_what_it_leaves_open_of_a_shear_force(noise):
    """The first of its bodies is sheared along the same path."""
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=2e-7, q_roll=2.5e4)
    body = replace(spectrum.surface(16, rng=7), unit="m", is_cut_out=False)
    alike = ("E=3 GPa nu=0.38",) * 2
    asked = rl.Question(body, alike, loads="1 N", ask=[rl.Friction(0.3), rl.Shear("0.2 N")])
    assert "sheared, noise" in {each.name for each in list_presses(Case.of(asked))}
    noise.rms = 1e-9
    answer = rl.assess(asked).answers["shear_displacement"]
    other = rl.Question(
        noise.body(Case.of(asked), 0), alike, loads="1 N", ask=[rl.Friction(0.3), rl.Shear("0.2 N")]
    )
    rl.causes.remove("noise")
    moved = rl.assess(other).answers["shear_displacement"]
    rl.causes.add(noise)
    (margin,) = (each for each in answer.margins if each.cause == "noise")
    ratio = max(moved.values[0] / answer.values[0], answer.values[0] / moved.values[0])
    assert margin.high[0] / answer.values[0] == pytest.approx(ratio, rel=1e-9)
