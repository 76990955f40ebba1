"""What a page has had computed is kept, as far as the system lets it."""

import time
from pathlib import Path

import pytest

from roughline.lab.measured.cache import cached


@pytest.fixture
def session(tmp_path):
    return {"folder": tmp_path}


def never():
    raise AssertionError("it was kept")


def test_a_question_that_was_asked_before_is_not_computed_again(session):
    assert cached(session, "body", ("file", 1), lambda: "made") == "made"
    assert cached(session, "body", ("file", 1), never) == "made"
    assert cached(session, "body", ("file", 2), lambda: "other") == "other"


def test_the_oldest_goes(session, tmp_path):
    for number in range(5):
        cached(session, "body", number, lambda: "made")
        time.sleep(0.02)
    assert len(list(tmp_path.iterdir())) == 3
    assert cached(session, "body", 0, lambda: "anew") == "anew"


@pytest.mark.parametrize("refused", ["replace", "unlink"])
def test_files_that_another_process_reads_hinder_nothing_on_windows(
    session, tmp_path, monkeypatch, refused
):
    """There a file that is open can be neither replaced nor deleted."""
    for number in range(3):
        cached(session, "body", number, lambda: "made")
    done = getattr(Path, refused)

    def refuses(path, *arguments, **options):
        if path.suffix == ".pickle" or refused == "replace":
            raise PermissionError(13, "used by another process", str(path))
        return done(path, *arguments, **options)

    monkeypatch.setattr(Path, refused, refuses)
    assert cached(session, "body", 7, lambda: "made") == "made"
    monkeypatch.undo()
    assert all(path.suffix == ".pickle" for path in tmp_path.iterdir())
    assert cached(session, "body", 8, lambda: "made") == "made"
    assert len(list(tmp_path.iterdir())) == 3
