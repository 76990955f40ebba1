"""Heights that are the instrument's and not the surface's: cut off, written as a number, or off."""

from __future__ import annotations

import numpy as np
import pytest

import roughline as rl
from benchmarks.made_surfaces import KINDS, SIDE, Make, measured, parent_of, piece_of
from roughline.measurement.departures import departures

HEIGHTS = (rl.SelfAffine(hurst=0.8, length=4.0, rms_height=1.0, q_roll=25.0)).surface(256, 7)
HEIGHTS = HEIGHTS.heights[:64, :64]


def said_of(heights, **change):
    body = rl.Surface(1e-6 * heights, (SIDE, SIDE), "m", is_cut_out=True, **change)
    return [each.text for each in departures(body) if each.assumption == "measured"]


def clipped(share):
    return np.minimum(HEIGHTS, np.quantile(HEIGHTS, 1 - share))


def with_step_of_rows(*rows, by):
    heights = HEIGHTS.copy()
    heights[list(rows)] += by * HEIGHTS.std()
    return heights


@pytest.mark.parametrize("share", [0.01, 0.1, 0.5])
def test_summits_that_are_cut_off_are_told_however_the_map_is_tilted(share):
    heights = clipped(share)
    x = np.arange(64)
    for tilt in (0.0, 0.013 * x[:, np.newaxis] - 0.029 * x):
        (said,) = said_of(heights + tilt)
        assert said.startswith(f"{100 * share:.2g}% of the heights are equal")


def test_valleys_that_are_cut_off_change_no_answer_and_rounded_heights_stand_on_many_levels():
    assert said_of(np.maximum(HEIGHTS, np.quantile(HEIGHTS, 0.1))) == []
    assert said_of(np.round(10 * HEIGHTS)) == []
    written_as_zero = HEIGHTS.copy()
    written_as_zero[5:25, 5:20] = 0.0
    assert said_of(written_as_zero) != []


@pytest.mark.parametrize("by", [1.0, -3.0])
def test_a_row_that_is_off_is_told_with_its_place(by):
    heights = with_step_of_rows(20, by=by)
    side = "above" if by > 0 else "below"
    for each, axis in ((heights, "x"), (heights.T, "y")):
        (said,) = said_of(each)
        assert said.startswith(f"at {axis} = 312 µm a whole row stands")
        assert f"{side} those beside it" in said


@pytest.mark.parametrize("by", [40.0, -400.0])
def test_a_spike_is_no_row_and_hides_none(by):
    spike = np.zeros_like(HEIGHTS)
    spike[30, 40] = by * HEIGHTS.std()
    assert said_of(HEIGHTS + spike) == []
    (said,) = said_of(with_step_of_rows(20, by=1.0) + spike)
    assert said.startswith("at x = 312 µm a whole row stands")


def test_a_step_is_told_and_a_groove_or_a_ramp_is_none():
    (said,) = said_of(with_step_of_rows(*range(40, 64), by=1.0))
    assert said.startswith("at x = 625 µm all heights beyond stand")
    x = np.arange(64.0)[:, np.newaxis]
    groove = 5 * np.exp(-(((x - 30) / 2.5) ** 2) / 2)
    cusps = np.abs(x % 8 - 4)
    for shape in (groove, -groove, cusps, -cusps, 3 * np.clip(x - 30, 0, 4)):
        assert said_of(HEIGHTS + shape * HEIGHTS.std()) == []


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("instrument", ["pixel means", "quantised", "noise"])
def test_surfaces_as_they_are_made_and_measured_show_no_fault(kind, instrument):
    make, rng = Make(points=128, maps=4, cells=8), np.random.default_rng(5)
    piece = piece_of(parent_of(kind, make, rng), make, rng)
    said = said_of(1e6 * measured(piece, instrument, 2, rng))
    assert bool(said) == ((kind, instrument) == ("worn", "quantised"))  # on one step, all of it


def test_a_faulty_map_is_answered_without_an_interval_and_with_the_fault_first():
    body = rl.Surface(1e-6 * clipped(0.05), (SIDE, SIDE), "m", is_cut_out=True)
    question = rl.Question(body, materials=("steel", "steel"), loads=["10 MPa"], grid_error=True)
    result = rl.assess(question)
    first = result.warnings[0]
    assert first.startswith("5% of the heights are equal")
    assert first.endswith("all values come without an interval")
    heights_matter = set(result.answers) - {"holm_resistance", "plastic_conductance_per_area"}
    assert {key for key in heights_matter if result.answers[key].low is not None} == set()
    of_curve = rl.assess(rl.Question(body, E_star="100 GPa", loads=["10 MPa"], grid_error=True))
    assert of_curve.intervals is None
    assert of_curve.warnings[0] == first
