"""In how many ways a body is pressed: the list is an upper bound, told before and kept to."""

from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.assessment.presses import list_presses
from roughline.contact.pressing import Pressing
from roughline.margins.variant import AS_ASKED, Stopped, Variant, press_all
from roughline.question.case import Case

PAIR = "steel,copper"
SURFACE = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=2.5e4).surface(64, 7)
SURFACE = rl.Surface(SURFACE.heights, SURFACE.sizes, "m", is_cut_out=False)
MAP = rl.Surface(SURFACE.heights, SURFACE.sizes, "m", is_cut_out=True)

OF_GRID = 4  # steps that tell what the grid leaves open of a body
PUNCH = 1  # of a body that is not cut out of a larger one, whose interface is its own
ASKED = {
    "a modulus": (SURFACE, {"E_star": 1e11}, 1 + OF_GRID),
    "elastic bodies": (SURFACE, {"materials": PAIR, "elastic": True}, 1 + OF_GRID + PUNCH),
    "a known hardness": (SURFACE, {"materials": PAIR, "hardness": "1 GPa"}, 2 + OF_GRID + PUNCH),
    "a hardness of the table": (SURFACE, {"materials": PAIR}, 4 + OF_GRID + PUNCH),
    "a periodic map": (
        MAP,
        {"materials": PAIR, "elastic": True, "periodic": True},
        1 + OF_GRID + 2,
    ),
    "a map": (MAP, {"materials": PAIR, "elastic": True}, 2 * (1 + OF_GRID) + 2),
    "a map that yields": (MAP, {"materials": PAIR}, 2 * (4 + OF_GRID) + 2),
}


@pytest.fixture
def pressed(monkeypatch):
    """Points along the sides of what was pressed, in its order."""
    done, original = [], Pressing.curve

    def curve(pressing, *given):
        done.append(pressing.surface.shape)
        return original(pressing, *given)

    monkeypatch.setattr(Pressing, "curve", curve)
    return done


def listed_presses(question):
    """What is listed, but for curves that follow from others."""
    return [each for each in list_presses(Case.of(question)) if each.share]


@pytest.mark.parametrize("asked", ASKED)
def test_no_body_is_pressed_more_often_than_the_list_says(pressed, asked):
    body, settings, most = ASKED[asked]
    question = rl.Question(body, loads=["5 MPa", "20 MPa"], **settings)
    listed = listed_presses(question)
    assert len(listed) == most
    steps = []
    rl.assess(question, progress=lambda *step: steps.append(step))
    studied = sum(each.purpose == "grid" for each in listed) // OF_GRID
    assert 0 < pressed.count(body.shape) <= most - studied * OF_GRID - 2 * (body is MAP)
    assert pressed.count((16, 16)) == studied + 16 * (body is MAP)  # coarsest selves, and tiles
    assert steps == sorted(steps)
    assert len({total for _, total in steps}) == 1
    assert steps[-1][0] == steps[-1][1]


def test_equal_presses_of_several_causes_are_solved_once(pressed):
    """One that is as exact, and measures as much, answers for the other."""
    case = Case.of(rl.Question(SURFACE, PAIR, loads=["5 MPa"], elastic=True))
    exact = replace(case.loads.pressing(), measures=[rl.MEAN_GAP])
    rough = replace(exact, rtol=1e-3, measures=())
    others = [
        replace(rough, rtol=1e-7),
        replace(rough, half_space=rough.half_space.interface),
        replace(rough, loads=replace(rough.loads, values=2 * rough.loads.values)),
        replace(rough, surface=rl.Surface(2 * SURFACE.heights, SURFACE.sizes, "m")),
    ]
    asked = {"first": [exact], "second": [rough], "others": others}
    variants = [
        Variant(name, "grid", lambda _, found=found: found, SURFACE.shape, False)
        for name, found in asked.items()
    ]
    curves = press_all(variants, 1, None)
    assert curves.of_pieces["second"][0] is curves.of_pieces["first"][0]
    assert len(pressed) == 1 + len(others)


def test_what_is_needless_is_not_pressed(pressed):
    """Under light loads nothing yields, so that elastic, harder and softer bodies are no others."""
    question = rl.Question(SURFACE, "alumina,glass", loads="0.5 N")
    assert len(listed_presses(question)) == 4 + OF_GRID + PUNCH
    rl.assess(question)
    assert pressed.count(SURFACE.shape) == 1 + PUNCH
    assert len(pressed) == 4 + PUNCH  # with three coarser selves


@pytest.mark.parametrize("stop_at", [0, 8, 12])
def test_an_interrupt_carries_what_is_done(monkeypatch, stop_at):
    assert_done_is_carried(monkeypatch, stop_at)


@pytest.mark.parametrize("stop_at", [1, 3])
def test_an_interrupt_of_the_second_variant_carries_the_first(monkeypatch, stop_at):
    assert_done_is_carried(monkeypatch, stop_at)


def assert_done_is_carried(monkeypatch, stop_at):
    case = Case.of(rl.Question(MAP, PAIR, loads=["5 MPa", "20 MPa"], elastic=True))
    variants, count, original = list_presses(case), [], Pressing.curve

    def curve(pressing, progress=None, *kept):
        count.append(pressing)

        def stop(done, total):
            if len(count) > stop_at:
                raise KeyboardInterrupt

        return original(pressing, stop, *kept)

    monkeypatch.setattr(Pressing, "curve", curve)
    with pytest.raises(Stopped) as stop:
        press_all(variants, case.loads.count, lambda done, total: None)
    curves = stop.value.curves
    names = list(dict.fromkeys(each.name for each in variants))
    of_coarser = [f"{names[0]}, coarser grids", f"{names[1]}, coarser grids"]
    in_turn = [*names[:2], *(each for name in of_coarser for each in [name] * 3)]
    in_turn += ["2 x 2 tiles"] * 4 + ["4 x 4 tiles"] * 16
    assert curves.stopped == in_turn[stop_at]
    done = names[: names.index(curves.stopped) + (stop_at < 2)]  # a body, as far as it came
    assert [*curves.by_name, *curves.of_pieces] == done
    assert curves.complete(curves.stopped) is None
    assert curves.as_asked is curves.by_name[AS_ASKED]
    assert curves.as_asked.converged.all() == (stop_at > 0)
    count.clear()
    result = rl.assess(case.question, progress=lambda done, total: None)
    assert result.interrupted
    interface = result.answers.get("interface_stiffness")
    assert interface is None or interface.ends is None
    known = np.isfinite(result.answers["contact_stiffness"].values)
    assert known.tolist() == [True, stop_at > 0]  # a load that was solved before is kept
