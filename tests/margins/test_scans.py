"""Intervals of a pressed line scan, and when there is none, on surfaces as workshops make them."""

from __future__ import annotations

import re
from functools import cache

import numpy as np
import pytest

import roughline as rl
from benchmarks.made_surfaces import SIDE, Make, parent_of, piece_of
from roughline.margins.scans import independent_heights

LOADS = np.array([0.01, 0.1, 1.0])  # F / (E* h L)


@cache
def piece(kind: str, seed: int, points: int, waves: float) -> rl.Surface:
    make, rng = Make(points, 4, waves=waves), np.random.default_rng(seed)
    return piece_of(parent_of(kind, make, rng), make, rng).detrended()


def scan_of(surface: rl.Surface, row: int = 7) -> rl.Line:
    return rl.Line(surface.heights[row], SIDE, "m", kind="profile")


def forces_on(surface: rl.Surface) -> np.ndarray:
    return LOADS * surface.rms_height * SIDE


def pressed(surface: rl.Surface, **told: bool) -> rl.PressedScan:
    return rl.press_scan(scan_of(surface), E_star=1.0, forces=forces_on(surface), **told)


@pytest.mark.parametrize("kind", ["sharp roll-off", "ground, 9"])
def test_gaussian_surfaces_are_held_whatever_their_directions(kind):
    held = []
    for seed in (11, 12):
        surface = piece(kind, seed, 128, 6.0)
        full = rl.press(surface, E_star=1.0, forces=forces_on(surface), rtol=1e-3).stiffness
        found = pressed(surface, gaussian=True)
        held += list((found.low <= full) & (full <= found.high))
        assert (found.high / found.low < 9).all()
    assert np.mean(held) >= 0.8


@pytest.mark.parametrize("kind", ["worn", "lognormal summits", "lognormal pits", "plateau-honed"])
def test_other_heights_have_no_interval_even_if_told_to_be_gaussian(kind):
    found = pressed(piece(kind, 13, 256, 24.0), gaussian=True)
    assert np.isnan([found.low, found.high]).all()
    assert any("not Gaussian" in each for each in found.curve.warnings)
    assert "without an interval, and may be off by a factor of several" in found.curve.warnings[0]


def test_a_long_gaussian_scan_has_an_interval_and_a_short_one_only_if_told():
    assert np.isfinite(pressed(piece("sharp roll-off", 16, 256, 60.0)).low).all()
    short = piece("sharp roll-off", 14, 128, 4.0)
    silent = pressed(short)
    assert np.isnan(silent.low).all()
    assert "independent heights, too few to show" in silent.curve.warnings[0]
    told = pressed(short, gaussian=True)
    assert (told.low < told.curve.stiffness).all()
    assert (told.curve.stiffness == silent.curve.stiffness).all()


def test_answers_without_an_interval_are_said_at_the_top():
    surface = piece("lognormal summits", 15, 256, 24.0)
    result = rl.assess(rl.Question(scan_of(surface), materials="rigid, glass", loads="1 N"))
    assert result.stiffness_interval is None
    k = result.answers["contact_stiffness"]
    assert (k.low, k.high) == (None, None)
    assert "without an interval" in result.warnings[0]
    assert sum("not Gaussian" in each for each in result.warnings) == 1


def test_a_scan_steeper_than_metals_bear_has_no_interval():
    steep = piece("sharp roll-off", 14, 256, 24.0).scaled(30)
    result = rl.assess(rl.Question(scan_of(steep), materials="steel,copper", loads="1 N"))
    assert result.answers["contact_stiffness"].low is None
    assert any("do not hold, and come without intervals" in each for each in result.warnings)


@pytest.mark.parametrize("what", ["step", "saturated", "half a plateau"])
def test_steps_plateaus_and_saturated_heights_have_no_interval(what):
    heights = piece("sharp roll-off", 14, 256, 24.0).heights[7].copy()
    if what == "step":
        heights[128:] += 10e-6
    elif what == "saturated":
        heights = np.clip(heights, None, np.quantile(heights, 0.8))
    else:
        heights = np.maximum(heights, np.median(heights))
    scan = rl.Line(heights, SIDE, "m", kind="profile")
    found = rl.press_scan(scan, E_star=1.0, forces=LOADS * 1e-9, gaussian=True)
    assert np.isnan(found.low).all()
    assert found.curve.warnings[0].count("\n") == 0


def test_independent_heights_are_counted_over_the_whole_of_a_long_scan():
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1e-6, length=4 * SIDE, q_roll=1e5)
    surface = spectrum.surface(1024, 3)
    fine = rl.Line(surface.heights[5], 4 * SIDE, "m", kind="profile")
    coarse = rl.Line(surface.heights[5, ::2], 4 * SIDE, "m", kind="profile")
    counts = [independent_heights(each.detrended()) for each in (fine, coarse)]
    assert counts[0] == pytest.approx(counts[1], rel=0.1)
    assert counts[0] > 64  # waves of the roll-off along the scan


def test_few_points_are_refused_in_a_line():
    scan = rl.Line(np.random.default_rng(1).normal(size=20), SIDE, "m", kind="profile")
    with pytest.raises(rl.InputError, match="20 points; a spectrum needs 64"):
        rl.press_scan(scan, E_star=1.0, forces=[1e-9])


def test_one_peak_that_gaussian_scans_do_not_have_is_told_by_what_it_does_to_springs():
    """Under light loads the peak alone touches, and is softer than summits of the scan."""
    surface = piece("sharp roll-off", 16, 256, 60.0)
    heights = surface.heights[7]
    peak = 6 * heights.std() * np.exp(-(((np.arange(256) - 128) / 2) ** 2) / 2)
    with_peak = heights + peak
    loads = np.array([1e-3, 1e-2, 0.1])  # F / (E* h L)
    scan = rl.Line(with_peak, SIDE, "m", kind="profile")
    forces = loads * surface.rms_height * SIDE
    said = rl.press_scan(scan, E_star=1.0, forces=forces).curve.warnings[0]
    found = re.match(
        r"heights are not Gaussian: pressed as independent springs, those of the scan are ([\d.]+) "
        r"times as stiff under load (\d) as Gaussian ones of its spectrum, and chance",
        said,
    )
    under = [loads[int(found[2]) - 1]]
    peaked, plain = (
        rl.press(rl.Line(each / each.std(), 1.0), E_star=1.0, forces=under).stiffness[0]
        for each in (with_peak, heights)
    )
    assert float(found[1]) == pytest.approx(peaked / plain, rel=0.1)
    assert float(found[1]) < 1
