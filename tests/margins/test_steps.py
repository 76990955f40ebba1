"""How finely the way of coupled bodies is cut: what half as many loads tell of far more."""

import math
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.assessment.presses import list_presses
from roughline.engineering.slip import ShearCycles
from roughline.question.case import Case
from roughline.question.shear_path import ShearPath

N, ROUNDING = 16, 1e-4
OF_SHEAR = (
    *("shear_displacement", "micro_slip", "stiffness_before_slip", "stiffness_on_return"),
    *("stiffness_on_further_shear", "cycle_energy", "loss_factor", "sticking_share", "fretting"),
)


def rough(hurst=0.8, seed=1, n=N):
    made = rl.SelfAffine(hurst=hurst, length=1e-3, rms_height=1e-5, q_roll=2.5e4).surface(n, seed)
    return rl.Surface(made.heights, (1e-3, 1e-3), "m")


def asked(body=None, poisson=0.3, mu=0.3, share=0.7, load=20.0, **others):
    """A rigid body on one of a Poisson's ratio, of E* = 1 GPa: beta = (1 - 2 nu) / (2 - 2 nu)."""
    pair = (f"E={1 - poisson**2} GPa nu={poisson}", "rigid")
    wanted = [rl.Friction(mu), rl.Shear(share * mu * load, cycles=1)]
    return rl.Question(rough() if body is None else body, pair, loads=load, ask=wanted, **others)


def followed(question, times):
    """What a path of so many times as many loads gives, pressed by hand."""
    case = Case.of(question)
    path = ShearPath.of(case)
    finer = replace(path, pressing=times * path.pressing, per_cycle=times * path.per_cycle)
    (force,) = case.loads.forces
    loads = finer.on(case.body, case, force)
    curve = rl.press(
        loads.body,
        half_space=loads.half_space,
        friction=loads.friction,
        forces=loads.forces,
        shear_forces=loads.shear_forces,
        fields=loads.fields,
    )
    cycles = ShearCycles(curve, path.friction, finer.pressing - 1, finer.per_cycle, 1)
    return {
        "shear_displacement": cycles.displacement,
        "micro_slip": cycles.micro_slip,
        "stiffness_before_slip": cycles.stiffness_before,
        "stiffness_on_further_shear": cycles.stiffness_on,
        "stiffness_on_return": cycles.stiffness_back,
        "cycle_energy": cycles.energy,
        "loss_factor": cycles.loss_factor,
        "sticking_share": cycles.sticking_share,
        "fretting": cycles.fretting,
    }


CASES = [
    (hurst, poisson, mu, share, periodic, times)
    for times, bodies in (
        (
            2,
            (
                *((0.8, 0.3, 0.3, 0.7), (0.3, 0.3, 0.3, 0.95), (0.8, 0.3, 0.1, 0.7)),
                *((0.3, 0.3, 1.0, 0.3), (0.8, 0.0, 0.525, 0.7)),
            ),
        ),
        (16, ((0.8, 0.3, 0.3, 0.7), (0.3, 0.3, 1.0, 0.3))),
    )
    for hurst, poisson, mu, share in bodies
    for periodic in (False, True)
]


@pytest.mark.parametrize(("hurst", "poisson", "mu", "share", "periodic", "times"), CASES)
def test_what_half_as_many_loads_leave_open_holds_what_far_more_give(
    hurst, poisson, mu, share, periodic, times
):
    question = asked(rough(hurst, seed=2), poisson, mu, share, periodic=periodic)
    answers, finer = rl.assess(question).answers, followed(question, times)
    for key in OF_SHEAR:
        value = answers[key].values
        low, high = of_steps(answers[key]) or (value, value)  # where nothing moves it
        assert low[0] - ROUNDING * value[0] <= finer[key] <= high[0] + ROUNDING * value[0], key


def of_steps(answer):
    """Both ends that the steps leave open; None where they leave nothing open."""
    return next((each.ends for each in answer.margins if each.cause == "steps"), None)


def test_they_stand_in_the_list_in_the_cost_in_why_and_add_in_squares(monkeypatch):
    from roughline.assessment import cost

    monkeypatch.setattr(cost, "_ANNOUNCED_POINTS", 1)
    question = asked(rough(n=32), grid_error=True)
    listed = {each.name: each for each in list_presses(Case.of(question))}
    path, halved = listed["sheared"], listed["sheared, steps"]
    assert halved.purpose == "steps"
    assert halved.share == pytest.approx(path.share / 2, rel=0.1)
    told = []
    result = rl.assess(question, announce=told.append)
    assert " for the shear force in half as many loads" in told[0]
    answer = result.answers["shear_displacement"]
    reasons = {each.cause: each for each in answer.why()}
    assert reasons.keys() == {"grid", "steps"}
    assert "a path of more loads (rl.press) would narrow it" in str(reasons["steps"])
    together = math.hypot(*(math.log(each.high) for each in reasons.values()))
    assert answer.high[0] / answer.values[0] == pytest.approx(math.exp(together), rel=1e-6)
    assert "shear_left_open" not in {each.kind for each in result.facts}


def test_without_the_grid_their_reason_is_told_and_no_interval():
    result = rl.assess(asked())
    answer = result.answers["cycle_energy"]
    reasons = {each.cause: each for each in answer.why()}
    assert reasons["steps"].is_known
    assert not reasons["grid"].is_known
    assert answer.ends is None


def test_bodies_that_pressure_does_not_move_along_each_other_have_none():
    alike = ("E=3 GPa nu=0.38",) * 2
    wanted = [rl.Friction(0.3), rl.Shear("0.2 N")]
    question = rl.Question(rough(), alike, loads="1 N", ask=wanted)
    assert "sheared, steps" not in {each.name for each in list_presses(Case.of(question))}
    assert "steps" not in {each.cause for each in rl.assess(question).answers["micro_slip"].margins}


def test_a_contact_that_grows_in_few_loads_says_how_far_its_depth_is_off():
    """The depth of one load is off by about as much as is told, and less with more of them."""
    surface = rl.SelfAffine(hurst=0.8, rms_height=0.01, q_roll=25.0).surface(N, rng=3)
    for poisson, beta in ((0.3, 2 / 7), (0.0, 0.5)):
        body = rl.Homogeneous(1.0, poisson=poisson, beta=beta)

        def pressed(loads, body=body):
            forces = np.linspace(0.0, 0.02, loads + 1)[1:]
            return rl.press(surface, half_space=body, friction=rl.Friction(0.525), forces=forces)

        found = pressed(16)
        assert growth(found) is None
        for loads in (1, 2):
            curve = pressed(loads)
            told = growth(curve).numbers["error"]
            assert 0 < curve.depth[-1] / found.depth[-1] - 1 < told < 0.01
        assert told < growth(pressed(1)).numbers["error"] / 2.5
    assert growth(rl.press(surface, half_space=rl.Homogeneous(1.0, poisson=0.3), **ONE)) is None


def test_a_load_that_turns_says_how_finely_to_cut_it():
    surface, body = rough(), rl.Homogeneous(1e9, poisson=0.3)

    def pressed(angles):
        shears = [(2.0 * np.cos(each), 2.0 * np.sin(each)) for each in angles]
        asked = {"friction": rl.Friction(0.3), "forces": [20.0] * len(shears)}
        curve = rl.press(surface, half_space=body, shear_forces=shears, **asked)
        return [each for each in curve.facts if each.kind == "turns_within_a_load"]

    (told,) = pressed([0.0, np.pi / 2])
    assert told.numbers == {"load": 1, "angle": pytest.approx(90.0), "parts": 16}
    assert pressed(np.linspace(0.0, np.pi / 2, told.numbers["parts"] + 1)) == []
    assert pressed([0.0, np.pi, 0.0]) == []  # along one line


ONE = {"friction": rl.Friction(0.3), "forces": [0.02]}


def growth(curve):
    return next((each for each in curve.facts if each.kind == "grown_in_few_loads"), None)
