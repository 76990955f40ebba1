"""Whatever a page sends with a question, it is answered, or refused in one line without a trace."""

import json
import random

import numpy as np
import pytest

from roughline.lab.tasks import TASKS
from roughline.server.tasks import Outcome, Place, outcome_of

MUTATIONS = 100  # of each task
LONGEST = 500  # sentence [characters]
SLOW = ("measured.report", "explore.download", "published.claims")  # seconds each, or half of one
EXPLORE = {"n": "64", "D_f": "2.2", "seed": "1", "F": "0.1", "boundary": "periodic", "L": "1 mm"}
MEASURED = {"file": "key", "unit": "m", "size": "1 mm", "first": "steel", "second": "copper"}
MEASURED |= {"loads": "2 MPa", "grid_error": "no", "boundary": "periodic"}
PUBLISHED = {"D_f": "2,2.2", "mean": "arithmetic", "low_1D": "1e-4", "map_F": "0.1"}
STATES = {"explore": EXPLORE, "measured": MEASURED, "published": PUBLISHED}
OTHERS = ("which", "name", "model", "row", "map", "presses", "sides", "refines")
UNUSED = ("hardness_bar", "H", "theories", "rms", "h", "slope", "E", "roll_off", "cutoff", "view")
UNUSED += ("crop", "low_pass", "resample", "hardness", "joint_area", "friction", "frequency", "v")
UNUSED += ("bodies", "trend", "outliers", "fill", "most_missing", "channel", "example", "elastic")
STRANGE = ("__proto__", "session", "crowded", "", "\ud800", "x" * 2000)
NUMBERS = (
    "0",
    "-1",
    "1e-6",
    "nan",
    "inf",
    "1e999",
    "1e-400",
    "9" * 2000,
    "1,5",
    "1_0",
    "²",
    "0x10",
)
QUANTITIES = ("1 km", "1e400 m", "1e-300 m", "nan Pa", "9e" + 30 * "9" + " N", "1 m**9999", "5 %")
WORDS = ("", " ", "\0", "\ud800", "a\nb", "\u202e", "../../etc/passwd", "steel", "E=", "E=nan GPa")
WORDS += ("1 m,1 m,1 m,1 m", ";;", ",", "persson", "periodic", "modulus", "slope", "key,key", "H=x")
TEXTS = (*NUMBERS, *QUANTITIES, *WORDS)
VALUES = (None, True, 0, -1, 1.5, 10**400, -(10**400), 5e-324, float("nan"), float("inf"), 2**53)
VALUES += ([], {}, [[]], [1, 2], [10**400, 1], [1e-320, 1e-320], ["1"], {"__proto__": {"a": []}})


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    """A session with one file of 32 x 32 points."""
    folder = tmp_path_factory.mktemp("session")
    path = folder / "3f9a0c5d7e2b4a61.npy"
    np.save(path, np.random.default_rng(1).normal(size=(32, 32)) * 1e-6)
    return {
        "folder": str(folder),
        "files": {"key": str(path)},
        "names": {str(path): "mine.npy"},
        "max_points": 128,
        "max_memory": 4e9,
    }


def mutated(chance, state):
    """Arguments of a question, as a page sends them, of which one to three are not as they were."""
    arguments = {"state": dict(state)}
    for _ in range(chance.randint(1, 3)):
        value = chance.choice(TEXTS if chance.random() < 0.6 else VALUES)
        place = arguments["state"] if chance.random() < 0.75 else arguments
        if place is arguments:
            place[chance.choice(("state", *OTHERS, *STRANGE))] = value
        elif isinstance(place, dict):
            place[chance.choice((*state, *state, *UNUSED, *STRANGE))] = value
    return json.loads(json.dumps(arguments))


@pytest.mark.parametrize("task", [task for task in TASKS if task not in SLOW])
def test_every_question_is_answered_or_refused_in_one_line(task, session, capfd):
    chance = random.Random(task)
    for _ in range(MUTATIONS):
        asked = mutated(chance, STATES[task.partition(".")[0]])
        told = {**asked, "session": session, "crowded": chance.random() < 0.5}
        outcome = outcome_of(TASKS[task], told, lambda done, total: None)
        assert (outcome.answer is None) == bool(outcome.error), asked
        assert capfd.readouterr() == ("", ""), asked
        assert len(outcome.error) <= LONGEST, asked
        assert len(outcome.error.splitlines()) <= 1, asked
        assert session["folder"] not in outcome.error, asked
        json.dumps([outcome.error, outcome.at], allow_nan=False)


@pytest.mark.parametrize("view", STATES)
def test_what_is_no_text_is_refused_at_its_control(view, session):
    (task,) = {"explore.code", "measured.bodies", "published.point"} & {
        each for each in TASKS if each.startswith(view)
    }
    for key in STATES[view]:
        told = {"state": STATES[view] | {key: 3}, "session": session, "crowded": False}
        outcome = outcome_of(TASKS[task], told, lambda done, total: None)
        assert outcome == Outcome(
            error="this question is not one of the lab: reload the page", at=key
        )


def mistaken(arguments, progress):
    """A task with a mistake in its program."""
    return arguments["nothing"]


def test_a_mistake_in_the_program_leaves_a_trace(session, capfd):
    outcome = outcome_of(Place(__name__, "mistaken"), {"session": session}, lambda *steps: None)
    assert "the terminal in which the lab was started shows more" in outcome.error
    assert "KeyError: 'nothing'" in capfd.readouterr().err
