"""Questions of bodies that stick: what it takes to draw them apart, and what the rest is of."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

import roughline as rl
from roughline.contact import separation
from roughline.engineering.attraction import Attraction, attractions
from roughline.engineering.rules.adhesion import ADHESION
from roughline.exact.adhesion import MaugisSphere

E_STAR, RADIUS, WORK = 6.58e6, 20e-6, 0.05  # a silicone rubber on a stiff lens [Pa], [m], [J/m²]
RUBBER = ("E=5 MPa nu=0.49", "rigid")
CELL = 0.3125e-6  # of the rough maps [m]
RANGE = "50 mJ/m^2 over 250 nm"  # that eight cells of them resolve


def lens(n):
    """A lens on points, about twice as far out as it touches without a load."""
    side = 13e-6
    x = (np.arange(n) - (n - 1) / 2) * side / n
    return rl.Surface(-(x[:, None] ** 2 + x**2) / (2 * RADIUS), sizes=(side, side), unit="m")


def rough(n=32, rms_height=60e-9, rng=5):
    """A rough map of micrometres; the more points, the larger it is."""
    length = n * CELL
    q_roll = max(6.5e5, 2 * np.pi / length)
    spectrum = rl.SelfAffine(
        hurst=0.8, length=length, rms_height=rms_height, q_roll=q_roll, q_high=4e6
    )
    return replace(spectrum.surface(n, rng=rng), unit="m")


def asked(body, *ask, materials=RUBBER, loads=("1 uN",), **others):
    settings = {"elastic": True, "grid_error": False} | others
    return rl.assess(rl.Question(body, materials, loads=loads, ask=ask, **settings))


def value(result, key):
    return float(result.answers[key].values[-1])


@pytest.mark.parametrize("n", [48, 96])
def test_a_lens_comes_off_as_maugis_says(n):
    pair = rl.Question(lens(n), RUBBER).pair
    exact = MaugisSphere(RADIUS, WORK, 200e-9, pair.E_star)
    result = asked(lens(n), rl.Adhesion("50 mJ/m^2 over 200 nm"))
    assert value(result, "pull_off_force") == pytest.approx(-exact.pull_off_force, rel=0.01)
    unloaded = brentq(exact.force, 1 + 1e-6, exact.pull_off_ratio())
    touching = np.pi * exact.radius(unloaded) ** 2 / lens(n).area
    assert value(result, "area_without_load") == pytest.approx(touching, rel=0.03)


@pytest.mark.parametrize("n", [64, 96])
def test_the_interval_of_the_pull_off_holds_the_exact_one(n):
    pair = rl.Question(lens(n), RUBBER).pair
    exact = MaugisSphere(RADIUS, WORK, 200e-9, pair.E_star)
    result = asked(lens(n), rl.Adhesion("50 mJ/m^2 over 200 nm"), grid_error=True)
    answer = result.answers["pull_off_force"]
    assert answer.low[0] <= -exact.pull_off_force <= answer.high[0]


def test_what_follows_is_of_bodies_that_stick():
    plain, sticky = (asked(rough(), *ask, periodic=True) for ask in ([], [rl.Adhesion(WORK)]))
    assert value(sticky, "contact_area_fraction") > value(plain, "contact_area_fraction")
    assert value(sticky, "contact_stiffness") > value(plain, "contact_stiffness")
    assert sticky.curve.settings["work_of_adhesion"] == WORK
    assert plain.sought.separation is None
    assert not any(each.rule.group == "adhesion" for each in plain.answers.values())


@pytest.mark.parametrize("n", [16, 32])
def test_smooth_bodies_take_the_work_of_adhesion_and_no_more(n):
    result = asked(rough(n, rms_height=1e-9), rl.Adhesion("50 mJ/m^2 over 0.3 um"), periodic=True)
    assert value(result, "work_of_separation") == pytest.approx(1.0, rel=0.03)


@pytest.mark.parametrize("n", [16, 32, 64])
def test_a_joint_is_as_much_more_as_its_area(n):
    attraction = rl.Adhesion(RANGE)
    of_map = asked(rough(n), attraction, loads=["10 kPa"], periodic=True)
    of_joint = asked(rough(n), attraction, rl.Joint("1 cm^2"), loads=["10 kPa"])
    ratio = 1e-4 / rough(n).area
    force = ratio * value(of_map, "pull_off_force")
    assert value(of_joint, "pull_off_force") == pytest.approx(force, rel=1e-3)
    pressure = value(of_map, "pull_off_pressure")
    assert value(of_joint, "pull_off_pressure") == pytest.approx(pressure, rel=1e-3)
    assert of_joint.answers["pull_off_force"].low is None  # other places are not known


@pytest.mark.parametrize("n", [16, 32])
def test_a_range_that_was_not_given_is_in_the_name_and_resolved(n):
    result = asked(rough(n), rl.Adhesion("50 mJ/m^2"), periodic=True)
    answer = result.answers["pull_off_force"]
    reach = result.curve.settings["range"] * 1e9
    assert answer.name == f"pull-off force at a range of {reach:.4g} nm"
    assert result.curve.settings["pulling_zone_cells"] == pytest.approx(9)
    assert any("a finer grid would take a shorter one" in note for note in result.notes)
    assert answer.low is None
    given = asked(rough(n), rl.Adhesion(RANGE), periodic=True)
    assert given.answers["pull_off_force"].name == "pull-off force"


@pytest.mark.parametrize(("share", "told"), [(1e-3, True), (1.0, False)])
def test_a_pull_off_that_the_range_alone_sets_is_told(share, told):
    body = rl.Surface(share * rough(16).heights, rough(16).sizes, "m")
    result = asked(body, rl.Adhesion(RANGE), periodic=True)
    assert any("set by the range alone" in each for each in result.warnings) == told
    largest = WORK / float(result.curve.settings["range"])
    pull = value(result, "pull_off_pressure")
    assert pull <= largest * (1 + 1e-9)
    assert (pull >= 0.99 * largest) == told


@pytest.mark.parametrize("n", [16, 32])
def test_a_range_without_cells_enough_gives_no_pull_off_and_says_so(n):
    surface = rough(n)
    cell = max(surface.spacing)
    E_star = rl.Question(surface, RUBBER).modulus
    reach = 1e9 * np.sqrt(1.7 * np.pi * WORK * cell / E_star)
    result = asked(surface, rl.Adhesion(f"50 mJ/m^2 over {reach:.3f} nm"), periodic=True)
    assert "pull_off_force" not in result.answers
    assert any("no pull-off is given" in warning for warning in result.warnings)
    (said,) = (each for each in result.remarks if each.startswith("no pull-off force"))
    assert "no pull-off pressure: the grid does not resolve the range of the pull" in said


@pytest.mark.parametrize("n", [16, 32])
def test_depths_and_spaced_loads_may_be_asked_of_bodies_that_stick(n):
    attraction = rl.Adhesion(RANGE)
    spaced = asked(rough(n), attraction, loads=(), n_loads=3, periodic=True)
    assert (np.diff(spaced.curve.force) > 0).all()
    assert np.isfinite(spaced.answers["pull_off_force"].values).all()
    at_depths = asked(rough(n), attraction, loads=(), depths=["-50 nm", "100 nm"], periodic=True)
    assert at_depths.curve.on_approach.all()


@pytest.mark.parametrize("n", [16, 32, 64])
def test_a_load_that_is_taken_off_leaves_bodies_together(n):
    attraction = rl.Adhesion(RANGE)
    result = asked(rough(n), attraction, unload=True, loads=["20 kPa"], periodic=True)
    assert result.curve.force[-1] == 0
    touching = result.curve.area_fraction_corrected[-1]
    assert touching == pytest.approx(value(result, "area_without_load"), rel=1e-3)
    assert touching > 0.01


def test_a_contact_modulus_alone_gives_a_curve_and_no_answers():
    question = rl.Question(
        rough(), E_star=E_STAR, loads=["10 kPa"], ask=[rl.Adhesion(WORK)], grid_error=False
    )
    result = rl.assess(question)
    assert not result.answers
    assert result.curve.pulling_fraction[0] > 0


@pytest.mark.parametrize("n", [16, 32])
def test_several_maps_are_averaged(n):
    maps = [rough(n), rough(n, rng=6)]
    result = asked(maps, rl.Adhesion(RANGE), loads=["10 kPa"], periodic=True)
    of_maps = [value(each, "pull_off_pressure") for each in result.assessments]
    mean = np.exp(np.mean(np.log(of_maps)))
    assert float(result.answers["pull_off_pressure"].mean[0]) == pytest.approx(mean)


@pytest.mark.parametrize(
    ("given", "work", "reach", "law"),
    [
        ("50 mJ/m^2", 0.05, None, "dugdale"),
        ("50 mJ/m² over 2 nm", 0.05, 2e-9, "dugdale"),
        ("0.05 N/m OVER 2nm, Exponential", 0.05, 2e-9, "exponential"),
        ("PDMS over 0.3 um", 0.044, 0.3e-6, "dugdale"),
        ("challenge", 0.05, 2.071e-9, "exponential"),
        (0.05, 0.05, None, "dugdale"),
        (rl.Exponential(0.05, 2e-9), 0.05, 2e-9, "exponential"),
        (rl.Dugdale(0.05, 2e-9), 0.05, 2e-9, "dugdale"),
    ],
)
def test_an_attraction_is_read_as_it_is_typed(given, work, reach, law):
    found = Attraction.of(given)
    assert (found.work, found.range, found.law) == (work, reach, law)
    assert rl.Adhesion(given).attraction == found


@pytest.mark.parametrize(
    "given",
    [
        *("", "50", "50 mJ", "0 mJ/m^2", "-50 mJ/m^2", "nan J/m^2", "inf J/m^2", "5,0 mJ/m^2"),
        *("50 mJ/m^2 over", "50 mJ/m^2 over 0 nm", "50 mJ/m^2 over 2", "50 mJ/m^2 over 2 nm, jkr"),
        *("velcro", "over 2 nm", True, None, 0, -0.05, np.nan, [0.05, 2e-9], rl.Unilateral()),
    ],
)
def test_an_attraction_that_cannot_be_is_refused_in_one_line(given):
    with pytest.raises((rl.InputError, rl.UnitError)) as refused:
        rl.Adhesion(given)
    assert "\n" not in str(refused.value)
    assert "adhesion" in str(refused.value)


def test_the_table_has_sources():
    assert {"rubber", "pdms", "challenge"} <= set(attractions())
    for name, found in attractions().items():
        assert Attraction.of(name) == found
        assert found.source[-4:].isdigit()


@pytest.mark.parametrize(
    ("others", "told"),
    [
        ({"materials": ("steel", "copper"), "elastic": False}, "also yield"),
        ({"hardness": "1 MPa", "elastic": False}, "also yield"),
        ({"ask": [rl.Friction(0.3)]}, "partial slip"),
        ({"ask": [rl.Fluid(closure=True)]}, "bisects loads"),
        ({"body": rl.Line(np.arange(16.0) * 1e-9, length=1e-3, unit="m")}, "belongs to a surface"),
    ],
)
def test_what_is_not_known_of_bodies_that_stick_is_refused(others, told):
    body, materials = others.pop("body", rough()), others.pop("materials", RUBBER)
    ask = [rl.Adhesion(WORK), *others.pop("ask", [])]
    settings = {"loads": ["1 uN"], "elastic": True, "ask": ask} | others
    with pytest.raises(rl.InputError, match=told):
        rl.Question(body, materials, **settings)


@pytest.mark.parametrize("n", [16, 32])
def test_the_command_line_asks_for_it(invoke, only_drawn, tmp_path, n):
    only_drawn()
    rl.write(rough(n), tmp_path / "map.nc")
    code, out, _ = invoke(
        "press", str(tmp_path / "map.nc"), "--materials", "E=5 MPa nu=0.49, rigid", "--load",
        "1 uN", "--adhesion", f"{RANGE}, exponential", "--periodic", "--json",
        "--report", str(tmp_path / "report"),
    )  # fmt: skip
    assert code == 0
    content = json.loads(out)
    assert content["settings"]["law"] == "Exponential"
    assert content["answers"]["F_po"]["values"][0] > 0
    assert content["curve"]["pulling_fraction"][0] > 0
    assert (tmp_path / "report" / "report.pdf").exists()


def with_few_steps(monkeypatch, which, steps):
    """Let what it takes to draw bodies apart end early, by depths or by forces."""
    whole = separation.press

    def press(*args, **given):
        few = which in given and len(given[which]) != 11  # what is looked for first is solved
        return whole(*args, **given, **({"solver": rl.Solver(steps)} if few else {}))

    monkeypatch.setattr(separation, "press", press)


def test_work_that_is_not_solved_is_told_with_its_limits(monkeypatch):
    known = asked(rough(20), rl.Adhesion(RANGE), periodic=True)
    with_few_steps(monkeypatch, "depths", 23)
    result = asked(rough(20), rl.Adhesion(RANGE), periodic=True)
    assert "work_of_separation" not in result.answers
    assert value(result, "pull_off_force") == value(known, "pull_off_force")
    (said,) = (each for each in result.remarks if each.startswith("no work of separation"))
    assert "were not solved at a depth of" in said
    joules = {"pJ": 1e-12, "fJ": 1e-15}
    found = re.findall(r"([\d.]+) ([pf]J)", said)
    least, most = (float(number) * joules[unit] for number, unit in found)
    assert least < known.sought.separation.work < most


def test_no_answer_about_bodies_that_stick_vanishes_in_silence(monkeypatch):
    asked_for = {each.key: each.name for each in ADHESION}
    with_few_steps(monkeypatch, "forces", 10)
    result = asked(rough(16), rl.Adhesion(RANGE), periodic=True)
    said = " ".join(result.remarks)
    for key, name in asked_for.items():
        assert key in result.answers or f"no {name}" in said
    assert "the load that is taken off was not solved" in said
