"""Whatever a page sends with a question, it is answered, or refused in one line without a trace."""

import json
import random

import numpy as np
import pytest

from mutated_questions import SLOW, STATES, mutated
from random_cases import cases
from roughline.lab.server.tasks import Place, TaskOutcome, run_task
from roughline.lab.site import TASKS

MUTATIONS = cases(100, share=2)  # of each task
LONGEST = 500  # sentence [characters]


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
        "max_memory": 4e9,
    }


@pytest.mark.parametrize("task", [task for task in TASKS if task not in SLOW])
def test_every_question_is_answered_or_refused_in_one_line(task, session, capfd):
    chance = random.Random(task)
    for _ in range(MUTATIONS):
        asked = mutated(chance, STATES[task.partition(".")[0]])
        told = {**asked, "session": session}
        outcome = run_task(TASKS[task], told, lambda done, total: None)
        assert (outcome.answer is None) == bool(outcome.error), asked
        assert capfd.readouterr() == ("", ""), asked
        assert len(outcome.error) <= LONGEST, asked
        assert len(outcome.error.splitlines()) <= 1, asked
        assert session["folder"] not in outcome.error, asked
        json.dumps([outcome.error, outcome.at], allow_nan=False)


@pytest.mark.parametrize("task", ["explore.code", "measured.bodies", "published.point"])
def test_what_is_no_text_is_refused_at_its_control(task, session):
    state = STATES[task.partition(".")[0]]
    for key in state:
        told = {"state": state | {key: 3}, "session": session}
        outcome = run_task(TASKS[task], told, lambda done, total: None)
        assert outcome == TaskOutcome(
            error="this question is not one of the lab: reload the page", at=key
        )


def test_sides_beyond_all_floats_are_refused(session, capfd):
    told = {"state": STATES["measured"], "sides": [10**400, 1], "session": session}
    outcome = run_task(TASKS["measured.bodies"], told, lambda done, total: None)
    assert "give two positive, finite numbers" in outcome.error
    assert capfd.readouterr() == ("", "")


def mistaken(arguments, progress):
    """A task with a mistake in its program."""
    return arguments["nothing"]


def test_a_mistake_in_the_program_leaves_a_trace(session, capfd):
    outcome = run_task(
        Place(lambda name: mistaken, "mistaken"), {"session": session}, lambda *steps: None
    )
    assert "the terminal in which the lab was started shows more" in outcome.error
    assert "KeyError: 'nothing'" in capfd.readouterr().err
