"""Which tests run: the choice by durations, its words, and what the file of today says."""

import json
import re
import subprocess
import sys

import pytest

import tiers
from reference import DURATIONS
from tiers import WALKED, durations, part, part_in, shared_by_files, short

known = pytest.mark.skipif(not DURATIONS.is_file(), reason=f"no {DURATIONS.name}")
MOST, LONGEST = 300, 10  # of `make test` and of one test, on the machine of the durations [s]
PROCESSES = 2
TAKEN = {"a::f[1]": 0.1, "a::f[2]": 9.0, "a::g[1]": 3.0, "a::g[2]": 2.0, "b::h": 0.2, "b::i": 7.0}


def test_what_is_short_runs_and_of_what_is_long_the_shortest():
    assert short(TAKEN, TAKEN) == {"a::f[1]", "a::g[2]", "b::h", "b::i"}


def test_a_test_that_is_not_in_the_file_counts_as_short():
    assert short([*TAKEN, "b::new"], TAKEN) == short(TAKEN, TAKEN) | {"b::new"}
    assert short(["a::g[1]", "a::g[3]"], TAKEN) == {"a::g[3]"}


def test_a_walk_stands_for_what_takes_long_in_its_file():
    taken = {"a::test_walk[1]": 5.0, "a::test_walk[2]": 4.0, "a::f": 3.0, "a::g": 0.4, "b::h": 3.0}
    assert short(taken, taken) == {"a::test_walk[2]", "a::g", "b::h"}


@known
def test_names_of_tests_hold_no_folder_of_a_machine():
    """Else they are other tests elsewhere, and count as short there."""
    folders = str(DURATIONS.parents[1]), "/docs/", "/src/", "/tests/"
    names = [node.partition("::")[2] for node in durations()]
    assert not [name for name in names if any(each in name for each in folders)]


@known
@pytest.mark.parametrize("of", [1, 2, 3, 12])
def test_parts_are_all_of_it_once_and_take_as_long_as_each_other(of):
    taken = durations()
    parts = [part(taken, taken, number, of) for number in range(1, of + 1)]
    assert sum(map(len, parts)) == len(taken)
    assert set().union(*parts) == set(taken)
    sums = [sum(taken[node] for node in each) for each in parts]
    assert max(sums) - min(sums) <= max(taken.values()) + 0.01 * len(taken)
    assert parts[0] == part(sorted(taken), taken, 1, of)


@pytest.mark.parametrize("text", ["0/3", "4/3", "3", "a/b", "1/0", "-1/3"])
def test_a_part_that_is_none_is_refused_in_a_line(text):
    with pytest.raises(pytest.UsageError, match=rf"--part {re.escape(text)}: give one of some"):
        part_in(text)


@known
def test_make_test_has_something_of_every_function_but_those_that_a_walk_stands_for():
    taken = durations()
    functions = {node.partition("[")[0] for node in taken}
    left = functions - {node.partition("[")[0] for node in short(taken, taken)}
    walked = {each.partition("::")[0] for each in functions if "::test_walk" in each}
    assert {each.partition("::")[0] for each in left} <= walked
    assert all(taken[node] > WALKED for node in taken if node.partition("[")[0] in left)


@known
def test_make_test_is_short_by_the_file():
    """And none of its tests is long."""
    taken = durations()
    chosen = short(taken, taken)
    whole = sum(taken[node] for node in chosen) + sum(shared_by_files().values())
    assert whole / PROCESSES <= MOST
    assert [node for node in chosen if taken[node] > LONGEST] == []


@pytest.fixture
def suite(tmp_path):
    """A suite of its own: runs it, and gives the last lines that it prints."""
    (tmp_path / "tests").mkdir()
    (tmp_path / "pytest.ini").write_text("[pytest]\n")
    (tmp_path / "tests" / "conftest.py").write_text(
        "import reference, tiers\n"
        "from pathlib import Path\n"
        "reference.DURATIONS = tiers.DURATIONS = Path(__file__).with_name('durations.json')\n"
        "from tiers import pytest_addoption, pytest_configure\n"
    )
    (tmp_path / "tests" / "test_it.py").write_text(
        "import pytest\n"
        "@pytest.fixture(scope='module')\n"
        "def shared():\n    import time; time.sleep(0.3)\n"
        "def test_quick(): pass\n"
        "@pytest.mark.parametrize('n', [1, 2])\n"
        "def test_heavy(n): pass\n"
        "def test_first(shared): pass\n"
        "def test_second(shared): pass\n"
        "@pytest.fixture(scope='module', params=[1, 2])\n"
        "def varied(request):\n    import time; time.sleep(0.3)\n"
        "@pytest.fixture(scope='module')\n"
        "def resting(varied): pass\n"
        "def test_varied(resting): pass\n"
        "def test_page(): pytest.skip('no Chromium: install it')\n"
    )
    file = tmp_path / "tests" / "durations.json"

    def run(*options, known=None):
        if known is not None:
            file.write_text(json.dumps({"reference": 1e9, "tests": {"test_it.py": known}}))
        command = [
            sys.executable,
            "-m",
            "pytest",
            "-p",
            "no:cacheprovider",
            "-v",
            *options,
            "tests",
        ]
        done = subprocess.run(
            command,
            cwd=tmp_path,
            env={"PYTHONPATH": str(DURATIONS.parent), "PATH": ""},
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    run.file = file
    return run


KNOWN = {"test_quick": 0.0, "test_heavy[1]": 5.0, "test_heavy[2]": 4.0, "test_first": 0.1}


def test_what_is_left_out_is_told_in_a_line_each(suite):
    told = suite("--tier", "short", known=KNOWN)
    assert "test_heavy[2]" in told
    assert "test_heavy[1]" not in told
    assert "4 tests ran that are not in durations.json: `make durations` adds them" in told
    assert "left out: 1 of 8 tests, which are long; `make full` runs all" in told
    assert "left out: 1 tests: no Chromium: install it" in told


def test_without_the_file_all_run_and_it_is_told(suite):
    told = suite("--tier", "short")
    assert "7 passed, 1 skipped" in told
    assert "durations.json is missing, so that all tests ran: `make durations` writes it" in told


def test_what_is_shared_counts_once_for_a_file_and_what_is_varied_for_each(suite):
    suite("--record")
    written = json.loads(suite.file.read_text())
    known = written["tests"]["test_it.py"]
    assert "test_page" not in known
    assert 0.3 <= written["shared"]["test_it.py"] < 0.6
    assert max(known["test_first"], known["test_second"], known["test_quick"]) < 0.3
    assert min(known["test_varied[1]"], known["test_varied[2]"]) >= 0.3


def test_a_run_of_some_tests_keeps_what_is_known_of_others_and_forgets_those_that_are_gone(
    suite, monkeypatch, tmp_path
):
    file = tmp_path / "durations.json"
    known = {"a.py": {"gone": 1.0, "kept": 2.0}, "b.py": {"other": 3.0}}
    file.write_text(json.dumps({"reference": 0.5, "tests": known}))
    monkeypatch.setattr(tiers, "DURATIONS", file)
    monkeypatch.setattr(tiers, "slowness", lambda: 2.0)
    monkeypatch.setattr(tiers, "seconds_here", lambda: 1.0)
    tiers.write({"a.py::new": 4.0}, {"a.py": 3.0}, ["a.py::kept", "a.py::new"])
    assert json.loads(file.read_text()) == {
        "reference": 0.5,
        "shared": {"a.py": 1.5},
        "tests": {"a.py": {"kept": 2.0, "new": 2.0}, "b.py": {"other": 3.0}},
    }
