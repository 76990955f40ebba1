"""Whatever is typed at a control is used, or refused there, and all others are used meanwhile."""

import numpy as np
import pytest

from lab.unpacked import unpacked
from roughline.lab.controls import usable
from roughline.lab.explore import controls as explore
from roughline.lab.explore.physics import PHYSICS
from roughline.lab.explore.reading import read_state as explore_state
from roughline.lab.explore.state import ExploreState
from roughline.lab.measured import controls as measured
from roughline.lab.published import controls as published
from roughline.lab.published.state import PublishedState
from roughline.lab.published.state import read_state as published_state
from roughline.lab.server.tasks import run_task
from roughline.lab.site import TASKS

TEXTS = (
    *("", " ", "abc", "1,5", "1e400", "nan", "inf", "-1", "0", "1e-6", "٣", "x" * 300, "😀"),
    *("1 km", "3 GPa", "<b>x</b>", "-2 um", "9" * 2000),
)
NEVER_USED = ("abc", "nan", "inf", "٣", "<b>x</b>")
LONGEST = 400  # sentence [characters]


def check(key, text, refused):
    """Check that what is refused is refused at its control, in one line, and nothing else is."""
    assert set(refused) <= {key}, (key, text, refused)
    for sentence in refused.values():
        assert sentence.endswith(" is used meanwhile")
        assert len(sentence.splitlines()) == 1
        assert len(sentence) < LONGEST


def test_texts_of_explore():
    added = {
        control.key: {kind.key: f"{kind.controls[0].default}"}
        for kind in PHYSICS
        for control in kind.controls
    }
    for key in {*ExploreState().texts(), *added, "fluid"}:
        for text in TEXTS:
            state = {"n": "64", "F": "0.3", "D_f": "2.4", **added.get(key, {}), key: text}
            found, refused = usable({"state": state}, explore_state, ExploreState.texts)
            check(key, text, refused)
            assert refused or text not in NEVER_USED
            kept = found.texts()
            assert all(kept[k] == state[k] for k in ("n", "F", "D_f") if k != key)
    assert explore.NUMBERS["D_f"].key in state


def test_a_text_of_blanks_is_called_none():
    sent = {"state": {"w": "abc"}, "before": {"w": " "}}
    _, refused = usable(sent, explore_state, ExploreState.texts)
    assert refused["w"].endswith("; none is used meanwhile")


def test_texts_of_the_paper():
    for key in (*published.NUMBERS, *published.CHOICES, "D_f"):
        for text in TEXTS:
            found, refused = usable({"state": {key: text}}, published_state, PublishedState.address)
            check(key, text, refused)
            assert refused or text not in NEVER_USED
            assert published_state(found.address()) == found


@pytest.fixture(scope="module")
def ask(tmp_path_factory):
    """Ask as My surface does, of a file of 32 x 16 points without unit and sizes."""
    folder = tmp_path_factory.mktemp("session")
    path = folder / "3f9a0c5d7e2b4a61.npy"
    np.save(path, np.random.default_rng(1).normal(size=(32, 16)) * 1e-6)
    session = {"folder": str(folder), "files": {"key": str(path)}, "names": {str(path): "a.npy"}}

    def asked(task, state, **others):
        told = {"state": state, "session": session, **others}
        outcome = run_task(TASKS[f"measured.{task}"], told, lambda done, total: None)
        assert not outcome.error, (state, outcome.error)
        return unpacked(outcome.answer)[0]

    return asked


BEFORE = {"file": "key", "unit": "um", "size": "1 mm, 0.5 mm", "first": "gold"}
BEFORE |= {"second": "copper", "loads": "3 MPa"}
KEYS = [key for key in measured.KEYS if key != "channel"]


@pytest.mark.parametrize("task", ["bodies", "look", "prepare"])
def test_texts_of_my_surface(ask, task):
    keys = KEYS if task == "bodies" else KEYS[: KEYS.index("bodies")]
    for key in keys:
        for text in TEXTS:
            state = {**BEFORE, **({"bodies": "modulus"} if key == "E" else {"friction": "0.3"})}
            header = ask(task, {**state, key: text}, before=state, sides=[1e-3, 5e-4])
            check(key, text, header["refused"])
            if task == "bodies":
                is_whole = key == "loads" and not text.strip()
                assert len(header["lists"]["loads"]) == (0 if is_whole else 1)
                assert header["refused"] or text not in NEVER_USED
            elif header["refused"]:
                assert header["body"]["sides"] == [1e-3, 5e-4]


def test_several_that_are_refused_in_my_surface_say_so_each(ask):
    wrong = {
        **{"most_missing": "120 %", "crop": "1 km", "low_pass": "-1 um", "resample": "100000"},
        **{"first": "steal", "loads": "5", "joint_area": "1 nm^2", "hardness": "soft"},
        **{"friction": "30", "frequency": "5 m", "trend": "cubic", "theories": "hertz"},
    }
    header = ask("bodies", {**BEFORE, **wrong}, before=BEFORE, sides=[1e-3, 5e-4])
    assert set(header["refused"]) == set(wrong)
    assert header["refused"]["first"].endswith("; gold is used meanwhile")
    assert header["refused"]["resample"].endswith("; none is used meanwhile")
    assert header["refused"]["most_missing"].endswith("; 10 % is used meanwhile")
    prepared = ask("prepare", {**BEFORE, "low_pass": "1 km", "crop": "0 um, 500 um, 0 um, 500 um"})
    assert list(prepared["refused"]) == ["low_pass"]
    assert prepared["body"]["points"] == [16, 16]
