"""A shear force that goes to and fro on pressed bodies, from the question to the report."""

import json
import math

import numpy as np
import pytest

import roughline as rl
from roughline.exact.cattaneo_mindlin import CattaneoMindlin
from roughline.exact.indenters import PowerLawIndenter

MU = 0.3
ALIKE = ("E=3 GPa nu=0.38", "E=3 GPa nu=0.38")  # of no known hardness: elastic
COUPLED = ("E=3 GPa nu=0.2", "rigid")
PER_CYCLE = 16


def rough(n=32):
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=2e-7, q_roll=2.5e4)
    return rl.Surface(spectrum.surface(n, rng=7).heights, (1e-3, 1e-3), "m")


def asked(body, pair=ALIKE, loads="1 N", shear="0.2 N", ask=(), cycles=None, **others):
    wanted = [rl.Friction(MU), rl.Shear(shear, cycles), *ask]
    return rl.Question(body, pair, loads=loads, ask=wanted, **others)


def by_hand(body, half_space, forces, shears):
    """The path, pressed as one would without a question."""
    return rl.press(
        body,
        half_space=half_space,
        friction=rl.Friction(MU),
        forces=forces,
        shear_forces=shears,
        fields=True,
    )


def test_answers_are_those_of_press_and_cycle():
    body, Q = rough(), 0.2
    answers = {key: each.values for key, each in rl.assess(asked(body)).answers.items()}
    shears = rl.cycle(Q, per_cycle=PER_CYCLE, cycles=1)
    modulus = rl.contact_modulus(*map(rl.material, ALIKE))
    half_space = rl.Homogeneous(modulus, poisson=0.38)
    curve = by_hand(body, half_space, [1.0] * len(shears), shears)
    turn = len(shears) - 1 - PER_CYCLE
    slide, energy = curve.slide[:, 0], curve.dissipated[-PER_CYCLE:].sum()

    def along(tensors, load):
        return 1 / np.linalg.inv(tensors[load])[0, 0]

    way = (slide[-1] - slide[-1 - PER_CYCLE // 2]) / 2
    slipped = curve.fields[-1].slip_total - curve.fields[turn].slip_total
    contact, stuck = curve.fields[-1].contact, slipped <= 1e-3 * slipped.max()
    expected = {
        "shear_displacement": slide[turn],
        "stiffness_before_slip": along(curve.shear_stiffness_back, 0),
        "stiffness_on_further_shear": along(curve.shear_stiffness, turn),
        "stiffness_on_return": along(curve.shear_stiffness_back, turn),
        "micro_slip": slide[turn] - Q / along(curve.shear_stiffness_back, 0),
        "cycle_energy": energy,
        "loss_factor": energy / (2 * np.pi * Q * way / 2),
        "sticking_share": (contact & stuck).sum() / contact.sum(),
        "fretting": (MU * curve.fields[-1].pressure * slipped).max(),
        "sliding_force": MU * 1.0,
    }
    for key, value in expected.items():
        assert answers[key] == pytest.approx(value, rel=1e-6), key
    # what points dissipate adds up to what the cycle does
    each = MU * curve.fields[-1].pressure * slipped
    assert each.sum() * np.prod(body.spacing) == pytest.approx(energy, rel=1e-4)


@pytest.mark.parametrize(("n", "error"), [(32, 0.03), (64, 0.015)])
def test_a_ball_slips_as_cattaneo_and_mindlin_say(n, error):
    """With no Poisson's ratio, for which their formulas are exact; the grid is what is off."""
    radius, share = 0.3, 0.7
    x = (np.arange(n) + 0.5) / n - 0.5
    ball = rl.Surface(-(x[:, np.newaxis] ** 2 + x**2) / 2, (1.0, 1.0), "m")
    young, force = 2e9, 4 / 3 * 1e9 * radius**3
    pair = (f"E={young / 1e9} GPa nu=0",) * 2
    shear = share * MU * force
    result = rl.assess(asked(ball, pair, loads=force, shear=shear))
    exact = CattaneoMindlin(PowerLawIndenter(2.0, 0.5, 1e9), radius**2, 1e9, MU)
    answers = {key: float(each.values[0]) for key, each in result.answers.items()}
    bracket = 1 - (1 - share) ** (5 / 3) - 5 * share / 6 * (1 + (1 - share) ** (2 / 3))
    expected = {
        "shear_displacement": MU * radius**2 * (1 - (1 - share) ** (2 / 3)),
        "stiffness_before_slip": 2 * 1e9 * radius,
        "stiffness_on_further_shear": 2 * 1e9 * radius * (1 - share) ** (1 / 3),
        "cycle_energy": 3.6 * (MU * force) ** 2 / (1e9 * radius) * bracket,
        "sliding_force": exact.largest_force,
    }
    for key, value in expected.items():
        assert answers[key] == pytest.approx(value, rel=error), key
    assert answers["sticking_share"] == pytest.approx((1 - share) ** (2 / 3), abs=3 / (radius * n))
    # the cheap answer is exact here, too
    closed = result.sought.sheared.closed_form
    assert closed.displacement == pytest.approx(answers["shear_displacement"], rel=1e-4)
    assert closed.energy == pytest.approx(answers["cycle_energy"], rel=2e-3)


def test_what_but_sticks_dissipates_nothing():
    found = rl.assess(asked(rough(), loads="1 uN", shear="0.1 uN")).answers
    for key in ("micro_slip", "cycle_energy", "loss_factor", "fretting"):
        answer = found[key]
        assert answer.values.tolist() == [0.0], key
        assert answer.low is None or not (answer.low > 0).any()
    assert found["sticking_share"].values.tolist() == [1.0]


@pytest.mark.parametrize("nu", [0.0, 0.38])
def test_full_contact_that_is_repeated_is_as_stiff_as_can_be(nu):
    pair = (f"E=3 GPa nu={nu}",) * 2
    found = rl.assess(asked(rough(16), pair, loads="1000 N", shear="200 N", periodic=True)).answers
    for key in ("stiffness_before_slip", "stiffness_on_further_shear", "stiffness_on_return"):
        assert np.isposinf(found[key].values).all(), key
    assert found["shear_displacement"].values == pytest.approx([0.0], abs=1e-15)
    assert found["cycle_energy"].values == pytest.approx([0.0], abs=1e-12)


def test_two_materials_give_the_coupling_of_the_sum_of_their_half_spaces():
    first, second = (70e9, 0.33), (3e9, 0.4)
    pair = rl.Question(
        rough(), tuple(f"E={E / 1e9} GPa nu={nu}" for E, nu in (first, second)), loads=1.0
    ).pair
    half_space, q = pair.sheared_half_space(), np.geomspace(1.0, 1e6, 5)
    both = rl.Homogeneous.of(*second) + rl.Homogeneous.of(*first)  # the first slides
    assert half_space.E_star == pytest.approx(both.E_star, rel=1e-13)
    for ours, theirs in zip(half_space.shear_spectrum(q), both.shear_spectrum(q), strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=1e-13)
    np.testing.assert_allclose(
        half_space.coupling_spectrum(q), both.coupling_spectrum(q), rtol=1e-12
    )
    assert pair.beta == half_space.beta > 0
    assert pair.G_star == pytest.approx(half_space.E_star / (1 + half_space._n / 2), rel=1e-13)


def test_coupled_bodies_are_pressed_in_steps_and_go_to_and_fro_three_times():
    result = rl.assess(asked(rough(16), COUPLED, loads="0.2 N", shear="0.04 N"))
    sheared = result.sought.sheared
    assert (sheared.cycles, sheared.pressed) == (3, 7)
    assert result.question.sheared_half_space.beta == pytest.approx(-0.3 / 0.8)
    facts = {each.kind: each for each in result.facts}
    assert "left open by the grid" in str(facts["shear_left_open"])
    reasons = {each.cause: each for each in result.answers["cycle_energy"].why()}
    assert reasons["steps"].is_known
    assert not reasons["grid"].is_known
    once = rl.assess(asked(rough(16), COUPLED, loads="0.2 N", shear="0.04 N", cycles=1))
    assert "cycles_still_change" in {each.kind for each in once.facts}


def test_the_closed_form_of_coupled_bodies_says_by_how_much_it_is_off():
    for pair, is_told in ((COUPLED, True), (ALIKE, False), (("steel", "copper"), False)):
        question = rl.Question(rough(16), pair, loads="0.2 N", ask=rl.Friction(MU), elastic=True)
        told = {each.kind: each for each in rl.assess(question).facts}
        assert ("slip_of_coupled_bodies" in told) == is_told
        if is_told:
            excess = told["slip_of_coupled_bodies"].numbers["excess"]
            assert 0.10 < excess < 0.23  # between those of 0.952 and 1.667 times friction


def test_a_joint_moves_as_far_and_is_as_much_stiffer_as_it_is_larger():
    body = rough()
    alone = rl.assess(asked(body, periodic=True)).answers
    ten = rl.assess(asked(body, loads="10 N", shear="2 N", ask=[rl.Joint(10 * body.area)])).answers
    for key, factor in (
        ("shear_displacement", 1),
        ("loss_factor", 1),
        ("sticking_share", 1),
        ("stiffness_before_slip", 10),
        ("cycle_energy", 10),
        ("sliding_force", 10),
    ):
        assert ten[key].values == pytest.approx(factor * alone[key].values, rel=1e-3), key
    assert ten["cycle_energy"].ends is None  # other places of the joint are not known


def test_intervals_on_odd_sides_hold_what_twice_as_many_points_find():
    spectrum = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=2e-7, q_roll=2.5e4, q_high=5e4)
    fine = rl.Surface(spectrum.surface(66, rng=7).heights, (1e-3, 1e-3), "m")
    coarse = fine.coarsened()
    assert coarse.shape == (33, 33)
    told = rl.assess(asked(coarse, grid_error=True)).answers
    truth = rl.assess(asked(fine)).answers
    for key in ("shear_displacement", "cycle_energy", "stiffness_before_slip"):
        (low,), (high,), (value,) = told[key].low, told[key].high, truth[key].values
        assert low <= value <= high, key
        assert high < 2 * low, key


def test_a_layer_of_what_lies_below_it_changes_nothing():
    """As far as layers know shear: repeated, that is as a joint."""
    stuff = rl.material("E=3 GPa nu=0.38")
    layered = rl.Coated(layers=[(stuff, 1e-4)], base=stuff)
    plain, coated = (
        rl.assess(asked(rough(), (each, "E=5 GPa nu=0.3"), periodic=True, cycles=1)).answers
        for each in (stuff, layered)
    )
    for key in ("shear_displacement", "stiffness_before_slip", "cycle_energy", "sticking_share"):
        assert coated[key].values == pytest.approx(plain[key].values, rel=1e-4), key
    assert "slip_displacement" not in coated  # which follows from one ratio of stiffnesses


def test_bodies_that_yield_slip_as_their_unloading_says():
    """Jäger's theorem is exact without displacement across the shear, from where it was pressed."""
    pair = ("E=3 GPa nu=0", "E=3 GPa nu=0")
    result = rl.assess(asked(rough(), pair, hardness="5 MPa", grid_error=True))
    sheared = result.sought.sheared
    assert 0.1 < result.curve.plastic_fraction[0] < 0.9
    closed = sheared.closed_form
    assert sheared.displacement == pytest.approx(closed.displacement, rel=1e-5)
    assert result.answers["shear_displacement"].ends is not None
    elastic = rl.assess(asked(rough(), pair, elastic=True)).sought.sheared
    assert sheared.micro_slip < 0.9 * elastic.micro_slip


@pytest.mark.parametrize(
    ("pair", "half_space"),
    [
        (("rigid", "E=3 GPa nu=0.2"), rl.Homogeneous.of(3e9, 0.2)),
        (
            ("rigid", "E=3 GPa nu=0.2 0.1 mm on E=9 GPa nu=0.3"),
            rl.Layered(3e9, 0.2, 1e-4, 9e9, 0.3),
        ),
    ],
    ids=["two materials", "coated"],
)
def test_of_two_materials_that_yield_answers_are_those_of_press(pair, half_space):
    body, hardness = rough(16), 5e6
    result = rl.assess(asked(body, pair, loads="0.4 N", shear="40 mN", cycles=1, hardness="5 MPa"))
    sheared = result.sought.sheared
    assert sheared.curve.half_space.is_coupled
    shears = [(0, 0)] * 7 + rl.cycle(0.04, per_cycle=PER_CYCLE, cycles=1)
    forces = [0.4 * i / 8 for i in range(1, 8)] + [0.4] * (len(shears) - 7)
    curve = rl.press(
        body,
        half_space=half_space,
        hardness=hardness,
        friction=rl.Friction(MU),
        forces=forces,
        shear_forces=shears,
    )
    assert 0.1 < curve.plastic_fraction[7] < 0.95
    assert curve.largest_pressure.max() <= hardness * (1 + 1e-9)
    energy = curve.dissipated[-PER_CYCLE:].sum()
    assert result.answers["cycle_energy"].values == pytest.approx([energy], rel=1e-5)
    slide = curve.slide[-1 - PER_CYCLE, 0] - curve.slide[7, 0]
    assert result.answers["shear_displacement"].values == pytest.approx([slide], rel=1e-6)


def test_intervals_hold_bodies_as_soft_and_as_hard_as_they_may_be():
    body, copper = rough(), rl.material("copper")
    given = {"loads": "20 N", "shear": "4 N", "grid_error": True}
    result = rl.assess(asked(body, "copper,copper", **given))
    softest, hardest = (
        rl.assess(asked(body, "copper,copper", hardness=copper.hardness * times, **given))
        for times in (1 / copper.hardness_factor, copper.hardness_factor)
    )
    for key in ("shear_displacement", "cycle_energy", "stiffness_before_slip"):
        values = result.answers[key].values
        ratios = [each.answers[key].values / values for each in (softest, hardest)]
        least, most = result.hardness_scatter[key]
        assert least == pytest.approx(min([*ratios, 1.0]), rel=1e-6)
        assert most == pytest.approx(max([*ratios, 1.0]), rel=1e-6)
        assert most > 1.001 * least
        low, high = result.answers[key].ends
        assert low < values * least
        assert high > values * most


REFUSED = {
    "no friction": ({"ask": rl.Shear("0.2 N")}, "needs friction that bears it"),
    "no shear": ({"ask": [rl.Friction(MU), rl.Shear(cycles=2)]}, "without a shear force"),
    "no load": ({"loads": ()}, "under one load"),
    "two loads": ({"loads": ["1 N", "2 N"]}, "and there are 2"),
    "depth": ({"loads": (), "depths": "1 um"}, "under one load"),
    "unloading": ({"unload": True}, "under one load"),
    "sliding": (
        {"ask": [rl.Friction(MU), rl.Shear("0.4 N")]},
        "is 400 mN, and friction bears less than mu F = 0.3 x 1 N = 300 mN: it is too large by 100",
    ),
    "adhesion": (
        {"ask": [rl.Friction(MU), rl.Shear("0.2 N"), rl.Adhesion("50 mJ/m^2")]},
        "stick .* and are sheared",
    ),
    "no materials": ({"materials": None, "E_star": "1 GPa"}, "needs two materials"),
    "a line": (
        {"body": rl.Line(np.sin(np.arange(256.0)) * 1e-7, length=1e-3, unit="m")},
        "answers of stick and slip are those of maps",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_not_solved_is_refused_before_it_is_pressed(case):
    given, told = REFUSED[case]
    whole = {
        "body": rough(16),
        "materials": ALIKE,
        "loads": "1 N",
        "ask": [rl.Friction(MU), rl.Shear("0.2 N")],
    } | given
    with pytest.raises(rl.InputError, match=told) as refused:
        rl.Question(**whole)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"force": -1.0}, "positive"),
        ({"force": math.nan}, "positive"),
        ({"force": "1 m"}, "total force"),
        ({"force": "1 N", "cycles": 0}, "at least 1"),
        ({"force": "1 N", "cycles": 1.5}, "at least 1"),
    ],
)
def test_a_shear_force_is_checked_as_it_is_made(given, told):
    with pytest.raises(rl.InputError, match=told):
        rl.Shear(**given)


@pytest.mark.usefixtures("few_loads")
def test_terminal_json_and_report_tell_the_same(tmp_path, invoke):
    file, out = tmp_path / "map.nc", tmp_path / "out"
    rl.write(rough(), file)
    options = {"materials": ",".join(ALIKE), "load": "1 N", "friction": "0.3", "shear": "0.2 N"}
    code, told, errors = invoke("press", file, "--grid-error", report=out, json=True, **options)
    assert code == 0, errors
    told = json.loads(told)
    path, answers = told["sheared"], {each["key"]: each for each in told["answers"].values()}
    energy = answers["cycle_energy"]
    assert path["dissipated"][-1] >= 0
    assert sum(path["dissipated"][-16:]) == pytest.approx(energy["values"][0])
    assert path["energy_of_cycles"] == pytest.approx(energy["values"])
    assert energy["low"][0] < energy["values"][0] < energy["high"][0]
    assert [each["cause"] for each in energy["margins"]] == ["grid"]
    asked_of_file = rl.Question(
        file, ALIKE, loads="1 N", ask=[rl.Friction(0.3), rl.Shear("0.2 N")], grid_error=True
    )
    result = rl.assess(asked_of_file)
    code, text, errors = invoke("press", file, "--grid-error", "--all", **options)
    assert code == 0, errors
    page = (out / "report.html").read_text("utf-8")
    assert "Stick and slip at 1 N, sheared by 200 mN" in page
    assert {"stick_and_slip.png", "report.pdf"} <= {each.name for each in out.iterdir()}
    for key in ("cycle_energy", "shear_displacement", "loss_factor", "stiffness_on_return"):
        answer = result.answers[key]
        assert answers[key]["values"] == pytest.approx(answer.values.tolist(), rel=1e-9)
        assert answer.name in text
        assert answer.name in page


def test_after_ctrl_c_there_is_no_answer_of_a_path_that_is_not_whole():
    def stop(done, total):
        if done > 0.5 * total:
            raise KeyboardInterrupt

    question = asked(rough(16), loads="0.2 N", shear="0.04 N")
    result = rl.assess(question, progress=stop)
    assert result.interrupted
    assert not result.is_solved
    assert "cycle_energy" not in result.answers
    assert "shear_not_solved" in {each.kind for each in result.facts}
