"""Every constant of the margins says what it bounds, and stands in the table that doubles them."""

import csv
import importlib
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DATA = ROOT / "docs" / "data"


@pytest.fixture
def numbers(monkeypatch):
    """What finds the constants."""
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    return importlib.import_module("numbers_of_margins")


@pytest.fixture
def reasons(monkeypatch):
    """What chose them."""
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    return importlib.import_module("reasons_of_constants")


def rows_of_the_table():
    """The constants by file and name, with the other cells of their rows."""
    with (DATA / "constants.csv").open(encoding="utf-8") as file:
        _, *rows = csv.reader(file)
    return {row[0].replace(" ", ":", 1): row[1:] for row in rows}


def test_every_constant_stands_in_the_table_with_its_value(numbers):
    table, found = rows_of_the_table(), numbers.constants()
    assert [each.key for each in found] == [*table]
    assert len(found) > 100
    for each in found:
        assert table[each.key][:2] == [each.value, each.bounds]


def test_the_numbers_beside_the_table_are_of_the_same_constants(numbers):
    with (DATA / "constants" / "numbers.csv").open(encoding="utf-8") as file:
        rows = {f"{row['file']}:{row['constant']}": row["value"] for row in csv.DictReader(file)}
    assert rows == {each.key: each.value for each in numbers.constants()}


def test_every_constant_says_what_it_bounds(numbers):
    assert [each.key for each in numbers.constants() if not each.bounds] == []


def test_what_changes_nothing_says_what_it_guards():
    silent = {key: row for key, row in rows_of_the_table().items() if "nothing" in row[-1]}
    assert [key for key, row in silent.items() if "Guards: " not in row[-1]] == []


def test_reasons_are_of_constants_that_are_there(numbers, reasons):
    keys = {each.key for each in numbers.constants()}
    assert not {*reasons.CHOSEN, *reasons.GUARDS} - keys
    makefile = (ROOT / "Makefile").read_text("utf-8")
    for reason in reasons.CHOSEN.values():
        for target in re.findall(r"`make ([\w-]+)`", reason):
            assert f"\n{target}: " in makefile


@pytest.mark.parametrize(
    ("value", "twice"),
    [
        (0.3, 0.6),
        (0.7, 0.35),  # a share of 1.4 is none
        (0.975, 0.95),  # twice as many of the cases that are left out
        (1.01, 1.02),
        (1.0, 2.0),
        (64, 128),
        (-200.0, -400.0),
        ((0.02, 2), (0.04, 4)),
        (("sides", 1.5), ("sides", 3.0)),
    ],
)
def test_a_share_stays_a_share_when_it_is_doubled(numbers, value, twice):
    assert numbers.doubled(value)[0] == pytest.approx(twice)
