"""Shear in Explore: the loop, its numbers, map and code are those of the library."""

import numpy as np
import pytest

import roughline as rl
from lab.explore_asked import E_STAR, HEIGHT, SCALE, SHEARED, SMALL, answer, said
from roughline.lab.explore import pictures
from roughline.lab.explore.reading import read_state, usable_state

FORCE = 0.2 * SCALE
FIRST = 4  # number of the load that first has the largest shear force


@pytest.fixture(scope="module")
def pressed():
    shear = rl.cycle(0.15 * FORCE, per_cycle=16, cycles=1)
    return rl.press(
        read_state(SMALL).surface(64),
        half_space=rl.Homogeneous(E_STAR, poisson=0.3),
        friction=rl.Friction(0.3),
        forces=[FORCE] * len(shear),
        shear_forces=shear,
        fields=[FIRST, len(shear) - 1],
    )


@pytest.fixture(scope="module")
def found():
    return answer(pictures.further, SHEARED, of="mu")


def test_the_loop_is_that_of_the_library(pressed, found):
    series = found[0]["panels"]["loop"]["series"]
    slides, shares = pressed.slide[:, 0] / HEIGHT, pressed.shear_force[:, 0] / FORCE
    for name, loads in (("rising", slice(FIRST + 1)), ("loop", slice(FIRST, None))):
        np.testing.assert_allclose(series[name]["x"], slides[loads], rtol=1e-9)
        np.testing.assert_allclose(series[name]["y"], shares[loads], rtol=1e-9, atol=1e-15)
    assert series["here"]["y"] == pytest.approx([0.15])
    assert found[0]["panels"]["loop"]["caption"].endswith("on 64² points")


def test_the_strip_has_slide_stiffness_loss_and_what_never_slips(pressed, found):
    strip = said(found[0])
    slip = np.diff([each.slip_total for each in pressed.fields if each], axis=0)[0]
    assert strip["slide"]["value"] == f"{pressed.slide[FIRST, 0] / HEIGHT:#.3g} h"
    stiffness = 1 / np.linalg.inv(pressed.shear_stiffness_back[0])[0, 0]
    assert strip["tangential"]["value"] == f"{stiffness / 1e6:#.3g} MN/m"
    energy = pressed.dissipated[FIRST + 1 :].sum()
    assert strip["lost"]["value"] == f"{energy * 1e9:#.3g} nJ"
    loss = energy / (np.pi * 0.15 * FORCE * pressed.slide[FIRST, 0])
    assert strip["lost"]["below"] == f"loss factor {loss:#.3g}"
    contact = pressed.fields[-1].contact
    never = contact & (slip <= 1e-3 * slip.max())
    assert strip["stuck"]["value"] == f"{100 * never.sum() / contact.sum():#.3g}%"
    assert strip["stuck"]["below"] == f"slides under {0.3 * FORCE:#.3g} N"
    assert 0 < never.sum() < contact.sum()
    np.testing.assert_array_equal(found[1]["stick"].T, 2 * contact - never)
    assert found[0]["maps"]["stick"]["meanings"]["ink"] == "never slips"


def test_the_contact_is_that_without_shear():
    plain, sheared = (answer(pictures.full, each) for each in (SMALL, SHEARED))
    for part in ("strip", "panels", "facts"):
        assert sheared[0][part] == plain[0][part]
    np.testing.assert_array_equal(sheared[1]["pressure"], plain[1]["pressure"])


def test_a_load_that_bears_the_shear_no_more_is_refused_at_the_load():
    before = SHEARED | {"Q": "5 N"}
    asked = {"state": before | {"F": "0.1"}, "before": before, "session": {}}
    state, refused = usable_state(asked)
    assert list(refused) == ["F"]
    assert state.F == 0.2
    assert pytest.approx(5 / FORCE) == state.added[0].Q


@pytest.mark.parametrize("boundary", ["free", "periodic"])
def test_a_layer_is_sheared(boundary):
    coated = SHEARED | {"t": "0.05", "E_l": "0.2", "boundary": boundary}
    found = [answer(pictures.further, each, of="mu")[0] for each in (coated, coated | {"t": ""})]
    stiffness = [float(said(each)["tangential"]["value"].split()[0]) for each in found]
    assert stiffness[0] < 0.8 * stiffness[1]
    captions = [each["panels"]["loop"]["caption"] for each in found]
    assert captions[0].startswith("the first cycle, of bodies pressed in one load")
    assert captions[1].startswith("a cycle in 16 steps")


def test_the_layer_is_the_second_body_of_the_command():
    state = read_state(SHEARED | {"t": "0.05", "E_l": "0.2"})
    layer = next(each for each in state.added if each.key == "t")
    asked = rl.Question(state.surface(32), materials=layer.code(state).materials, loads=["1 N"])
    waves = np.geomspace(1e2, 1e6, 9)
    told, own = (
        each.coupling_spectrum(waves) for each in (asked.sheared_half_space, state.half_space)
    )
    np.testing.assert_allclose(told, own, rtol=1e-9)


def test_code_gives_the_same_numbers(pressed, ran):
    scale = pressed.slide[FIRST, 0]
    for state in (SHEARED, SHEARED | {"Q": "3.3 N"}):
        lines = ran(state, "python")
        slide, lost = float(lines[3].split()[-1]), float(lines[4].split()[-2])
        assert slide == pytest.approx(scale / HEIGHT, rel=1e-9)
        assert lost == pytest.approx(pressed.dissipated[FIRST + 1 :].sum(), rel=1e-9)
    sheared = ran(SHEARED, "command")["sheared"]
    np.testing.assert_allclose(sheared["slide"], pressed.slide, rtol=0, atol=1e-6 * scale)
    assert sheared["energy_of_cycles"] == pytest.approx([lost], rel=1e-5)
