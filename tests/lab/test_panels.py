"""Panels of curves as they are declared, and the ranges that what fills them has."""

import math

import numpy as np
import pytest

from roughline.lab.explore import physics
from roughline.lab.maps import height_map
from roughline.lab.measured.panels import PANELS as MEASURED
from roughline.lab.panels import PanelContent, linear_span, theory_lines
from roughline.lab.published.panels import PANELS as PUBLISHED

EVERY = {
    "explore": physics.panels().values(),
    "measured": MEASURED,
    "published": PUBLISHED,
}


@pytest.mark.parametrize("view", EVERY)
def test_series_and_panels_of_a_view_have_names_of_their_own(view):
    keys = [panel.key for panel in EVERY[view]]
    assert len(set(keys)) == len(keys)
    for panel in EVERY[view]:
        names = [series.name for series in panel.series]
        assert len(set(names)) == len(names), panel.key


def test_theories_differ_by_their_dashes():
    lines = theory_lines({"one": "One", "two": "Two", "three": "Three"})
    assert len({each.glyphs["line"]["line_dash"] for each in lines}) == 3
    assert [each.legend for each in lines] == ["One", "Two", "Three"]


def test_axes_fit_all_that_is_drawn_and_known():
    series = {
        "line": {"x": np.array([1.0, 10.0, math.nan]), "y": np.array([0.0, 2.0, 3.0])},
        "interval": {"x": [1.0], "y": [1.0], "low": [0.5], "high": [8.0]},
    }
    filled = PanelContent.fitted(series)
    assert filled.x == pytest.approx((1 / 1.2, 12.0))
    assert filled.y == pytest.approx((0.5 / 1.2, 9.6))
    low, high = PanelContent.fitted(series, is_logarithmic=False).y
    assert low < 0
    assert high > 8
    assert PanelContent.fitted({"line": {"x": [], "y": []}}).x is None


def test_a_flat_line_has_room_about_it():
    assert linear_span([2.0, 2.0]) == (1.0, 3.0)
    assert linear_span([math.nan]) is None


def test_the_ends_of_a_map_are_those_of_its_numbers_as_they_are_sent():
    heights = np.array([[0.1, 0.2], [np.nan, 0.7]])
    shown = height_map(heights, "µm")
    assert shown.low == float(np.float32(0.1))
    assert shown.high == float(np.float32(0.7))
    assert height_map(np.full((2, 2), np.nan), "µm").high == 1
