"""The study of averages: known exponents come back, whatever is held fixed."""

import math
import re

import numpy as np
import pytest
import xarray

from benchmarks.made_curves import DEPTH_EXPONENT, DEPTH_WINDOW, ensemble, exponent_at_level
from roughline.paper.averaging import exponent_of_means
from roughline.statistics.verdict import Verdict
from studies.averaging.measure import (
    DATA,
    DIMENSIONS,
    PUBLISHED,
    choices,
    exponent,
    plan,
    reproductions,
    windows,
)
from studies.averaging.study import FORCE, STUDY, USUAL
from studies.paper.data import dataset
from studies.reduced_data import read_one, write_one
from studies.study import DOCS

AGAIN = "the page is not that of the data any more: run make published"


@pytest.mark.parametrize("fixed", ["force", "depth", "level"])
def test_a_known_exponent_comes_back_within_its_interval(fixed):
    alpha = DEPTH_EXPONENT
    if fixed == "level":
        alpha = exponent_at_level()
        assert alpha > DEPTH_EXPONENT + 0.1  # it is another exponent
    data = ensemble(40, np.random.default_rng(5))
    found = exponent_of_means(data, DEPTH_WINDOW, fixed, "arithmetic")
    assert found.low < alpha < found.high
    assert found.low < found.value < found.high
    assert found.value == pytest.approx(alpha, abs=0.06)


def test_means_that_do_not_cover_the_window_give_no_exponent():
    data = ensemble(20, np.random.default_rng(0))
    assert math.isnan(exponent_of_means(data, (1e-9, 1e-8), "level", "geometric").value)
    assert math.isnan(exponent_of_means(data, (1, 100), "depth", "arithmetic").value)


def test_the_page_is_that_of_the_data():
    assert (DOCS / "averaging.md").read_text("utf-8") == STUDY.page, AGAIN


def test_the_data_are_those_of_the_published_study():
    for bodies, window, choice in (
        ("surfaces", DEPTH_WINDOW, choices()[2]),
        ("lines", (1e-3, 1e-1), choices()[0]),
        ("surfaces", (1e-3, 1e-2), choices()[4]),
    ):
        one = dataset(bodies).sel(fractal_dimension=2.4)
        found = exponent_of_means(one, window, choice.fixed, choice.averaging)
        kept = exponent(bodies, window, choice, 2.4)
        for name in ("value", "low", "high"):
            assert getattr(kept, name) == pytest.approx(getattr(found, name), abs=1e-6)


def test_sentences_without_numbers_are_true_too():
    # "its interval is the narrowest of all at D_f = ..., and at most 6% wider elsewhere"
    said = re.search(r"narrowest of all at D_f = (.*?), and at most (\d+)% wider", STUDY.page)
    for one in DIMENSIONS:
        found = [exponent("surfaces", USUAL["surfaces"], each, one) for each in choices()]
        force = exponent("surfaces", USUAL["surfaces"], FORCE, one)
        least = min(each.high - each.low for each in found if not math.isnan(each.value))
        excess = (force.high - force.low) / least - 1
        assert (excess == 0) == (str(one) in said[1].split(", "))
        assert excess <= (int(said[2]) + 0.5) / 100
    # the linear law is shown by no choice, for no fractal dimension
    for bodies in USUAL:
        for window in windows(bodies):
            for choice in choices():
                judged = reproductions(bodies, window, choice, "1").values()
                assert all(each.verdict is not Verdict.CONFIRMED for each in judged)
    assert set(PUBLISHED) == {"1/(4 − D_f)", "0.2567 D_f", "1"}
    assert len(DIMENSIONS) == 6


def test_another_plan_is_refused_with_the_difference(tmp_path):
    path = tmp_path / "data.nc"
    write_one(path, plan(), xarray.Dataset({"x": ("y", [1.0])}))
    assert read_one(path, plan()).x.values.tolist() == [1.0]
    other = {**plan(), "fixed": ["force"]}
    with pytest.raises(Exception, match=r"fixed = \['force', 'depth', 'level'\], the plan has"):
        read_one(path, other)
    path.write_bytes(DATA.read_bytes()[:2000])
    with pytest.raises(Exception, match="is damaged"):
        read_one(path, plan())
    path.unlink()
    with pytest.raises(Exception, match="does not exist"):
        read_one(path, plan())
