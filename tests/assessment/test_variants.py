"""In how many ways a body is pressed: the list is an upper bound, told before and kept to."""

from itertools import groupby

import numpy as np
import pytest

import roughline as rl
from roughline.assessment.presses import list_presses
from roughline.margins import variant as variants_of_case
from roughline.margins.variant import AS_ASKED, Stopped, press_all
from roughline.question.case import Case

PAIR = "steel,copper"
SURFACE = rl.SelfAffine(hurst=0.8, length=1e-3, rms_height=1e-6, q_roll=2.5e4).surface(64, 7)
SURFACE = rl.Surface(SURFACE.heights, SURFACE.sizes, "m", is_cut_out=False)
MAP = rl.Surface(SURFACE.heights, SURFACE.sizes, "m", is_cut_out=True)

ASKED = {
    "a modulus": (SURFACE, {"E_star": 1e11}, 1),
    "elastic bodies": (SURFACE, {"materials": PAIR, "elastic": True}, 1),
    "a known hardness": (SURFACE, {"materials": PAIR, "hardness": "1 GPa"}, 2),
    "a hardness of the table": (SURFACE, {"materials": PAIR}, 4),
    "a periodic map": (MAP, {"materials": PAIR, "elastic": True, "periodic": True}, 1 + 2),
    "a map": (MAP, {"materials": PAIR, "elastic": True}, 2 + 2),
    "a map that yields": (MAP, {"materials": PAIR}, 2 * 4 + 2),
}


@pytest.fixture
def pressed(monkeypatch):
    """What was pressed, in its order."""
    done, original = [], variants_of_case.press
    monkeypatch.setattr(
        variants_of_case, "press", lambda body, **k: done.append(body.shape) or original(body, **k)
    )
    return done


@pytest.mark.parametrize("asked", ASKED)
def test_no_body_is_pressed_more_often_than_the_list_says(pressed, asked):
    body, settings, most = ASKED[asked]
    question = rl.Question(body, loads=["5 MPa", "20 MPa"], **settings)
    assert len(list_presses(Case.of(question))) == most
    steps = []
    rl.assess(question, progress=lambda *step: steps.append(step))
    lists = [shape for shape, _ in groupby(pressed)]  # pieces of one shape are one variant
    pieces = [shape for shape in lists if shape != body.shape]
    assert len(pieces) == (2 if body is MAP else 0)
    assert len(pieces) < len(pieces) + pressed.count(body.shape) <= most
    assert steps == sorted(steps)
    assert len({total for _, total in steps}) == 1
    assert steps[-1][0] == steps[-1][1]


def test_what_is_needless_is_not_pressed(pressed):
    """Under light loads nothing yields, so that elastic, harder and softer bodies are no others."""
    question = rl.Question(SURFACE, "alumina,glass", loads="0.5 N")
    assert len(list_presses(Case.of(question))) == 4
    rl.assess(question)
    assert len(pressed) == 1


@pytest.mark.parametrize("stop_at", [0, 5, 6])
def test_an_interrupt_carries_what_is_done(monkeypatch, stop_at):
    assert_done_is_carried(monkeypatch, stop_at)


def test_an_interrupt_of_the_second_variant_carries_the_first(monkeypatch):
    assert_done_is_carried(monkeypatch, 1)


def assert_done_is_carried(monkeypatch, stop_at):
    case = Case.of(rl.Question(MAP, PAIR, loads=["5 MPa", "20 MPa"], elastic=True))
    variants, count, original = list_presses(case), [], variants_of_case.press

    def press(body, *, progress, **named):
        count.append(body)

        def stop(done, total):
            if len(count) > stop_at:
                raise KeyboardInterrupt

        return original(body, progress=stop, **named)

    monkeypatch.setattr(variants_of_case, "press", press)
    with pytest.raises(Stopped) as stop:
        press_all(variants, case.loads.count, lambda done, total: None)
    curves = stop.value.curves
    stopped = min(stop_at, 2) if stop_at < 6 else 3  # after two wholes, four halves
    assert [*curves.by_name, *curves.of_pieces] == [
        each.name for each in variants[: min(stop_at + 1, stopped + (stopped < 2))]
    ]
    assert curves.stopped == variants[stopped].name
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
