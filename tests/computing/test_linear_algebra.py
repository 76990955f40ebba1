"""The threads of the linear algebra, where several threads are at work side by side."""

from threading import Barrier, Thread
from types import SimpleNamespace

import scipy.linalg  # noqa: F401  loads the library
from threadpoolctl import threadpool_info

from reference import patience
from roughline.computing import linear_algebra
from roughline.computing.linear_algebra import on_one_thread


def threads():
    return {each["num_threads"] for each in threadpool_info() if each["user_api"] == "blas"}


def test_the_first_that_ends_leaves_the_last_on_one_thread():
    """One that begins within another and ends after it had two threads for a while before."""
    both_at_work, one_has_ended = Barrier(2), Barrier(2)
    seen = []

    def first():
        with on_one_thread():
            both_at_work.wait(patience())
        one_has_ended.wait(patience())

    def last():
        with on_one_thread():
            both_at_work.wait(patience())
            one_has_ended.wait(patience())
            seen.append(threads())

    before = threads()
    at_work = [Thread(target=each) for each in (first, last)]
    for each in at_work:
        each.start()
    for each in at_work:
        each.join(patience())
    assert seen == [{1}]
    assert threads() == before


def test_an_error_gives_the_threads_back():
    before = threads()
    try:
        with on_one_thread():
            raise ValueError
    except ValueError:
        pass
    assert threads() == before


def test_where_there_is_one_thread_already_nothing_is_changed(monkeypatch):
    def refused(change):
        raise AssertionError("threads are changed")

    monkeypatch.setattr(linear_algebra, "_libraries", lambda: [SimpleNamespace(num_threads=1)])
    monkeypatch.setattr(linear_algebra, "_in_passing", refused)
    with on_one_thread(), on_one_thread():
        pass
