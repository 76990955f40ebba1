"""Two rough bodies, and line scans that are pressed."""

import math
from dataclasses import replace

import numpy as np
import pytest

import roughline as rl
from roughline.topography.missing import Filled
from roughline.topography.provenance import Provenance


def rough(seed, n=64, length=1e-3, unit="m"):
    surface = rl.SelfAffine(hurst=0.8, length=length, rms_height=1e-6, q_high=6e4).surface(n, seed)
    return rl.Surface(surface.heights, surface.sizes, unit)


def test_heights_add_and_the_second_is_turned_over():
    first, second = rough(1), rough(2)
    both = rl.facing(first, second)
    assert (both.heights == first.heights + second.heights[::-1]).all()
    assert both.sizes == first.sizes
    flat = rl.Surface(np.zeros((64, 64)), (1e-3, 1e-3), "m")
    assert (rl.facing(first, flat).heights == first.heights).all()


def test_other_grids_are_laid_on_the_first():
    first, fine = rough(1, 64), rough(2, 192)
    both = rl.facing(first, fine)
    assert both.shape == (64, 64)
    in_the_middle = fine.heights[::-1][1::3, 1::3]  # where the coarse cells have their centres
    assert both.heights - first.heights == pytest.approx(in_the_middle, abs=1e-9)
    small = rough(3, 32, 5e-4)
    common = rl.facing(first, small)
    assert common.sizes == pytest.approx((5e-4, 5e-4))
    assert common.shape == (32, 32)
    assert common.settings["first_cropped_to"] == "0.0005 x 0.0005"
    assert "second_cropped_to" not in common.settings
    assert "second_resampled_to" not in common.settings  # the same spacing
    assert both.settings["second_resampled_to"] == "64 x 64"
    assert not {"first_cropped_to", "second_cropped_to"} & set(both.settings)


def test_what_does_not_fit_is_refused():
    with pytest.raises(rl.InputError, match="in m and mm: give both in one unit"):
        rl.facing(rough(1), rough(2, unit="mm"))
    with pytest.raises(rl.InputError, match="points in common; at least 2 x 2"):
        rl.facing(rough(1), rl.Surface(np.eye(8), (1e-5, 1e-5), "m"))


def test_two_equal_random_surfaces_are_as_one_of_root_two():
    """Independent spectra add: the mean stiffness is that of sqrt(2) h."""
    forces = np.array([0.01, 0.1]) * 1e-6
    spectrum = rl.SelfAffine(
        hurst=0.8, rms_height=1e-6, q_roll=4 * 2 * math.pi, q_high=24 * 2 * math.pi
    )
    pairs, ones = [], []
    for seed in range(12):
        pair = rl.facing(spectrum.surface(64, seed), spectrum.surface(64, 100 + seed))
        pairs.append(rl.press(pair, E_star=1.0, forces=forces).stiffness)
        one = spectrum.surface(64, 200 + seed).scaled(math.sqrt(2))
        ones.append(rl.press(one, E_star=1.0, forces=forces).stiffness)
    assert np.mean(pairs, axis=0) == pytest.approx(np.mean(ones, axis=0), rel=0.1)


@pytest.mark.parametrize(("points", "is_resampled"), [(64, False), (32, False), (None, True)])
def test_only_a_second_body_on_another_grid_is_said_to_be_resampled_to_the_first(
    points, is_resampled
):
    """That both were resampled before, as they were prepared, is another matter."""
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1e-6, length=1e-3, q_roll=4e4)
    first, second = (replace(spectrum.surface(n, i), unit="m") for n, i in ((64, 1), (48, 2)))
    preparation = rl.Preparation(points=points)
    question = rl.Question(
        first, ("steel", "copper"), loads="1 N", against=second, preparation=preparation
    )
    notes = rl.assess(question).notes
    said = [text for text in notes if "resampled by cubic splines to pixels of 15.6" in text]
    assert bool(said) is is_resampled


def test_the_share_of_missing_points_is_that_of_the_body_that_lacks_most():
    bodies = [
        replace(
            rl.SelfAffine(hurst=0.8, rms_height=1e-6, length=1e-3).surface(16, i),
            provenance=Provenance(filled=Filled(int(256 * share), share, "harmonic")),
        )
        for i, share in enumerate((0.25, 0.5, 0.125))
    ]
    both = rl.facing(bodies[0], bodies[1])
    for all_three in (rl.facing(both, bodies[2]), rl.facing(bodies[2], both)):
        assert all_three.provenance.missing_share == both.provenance.missing_share == 0.5


@pytest.fixture(params=[50, 200])
def lines(request, monkeypatch):
    """Let a scan be pressed as some lines, and be compared with as many cuts."""
    for name in ("_SCAN_LINES", "_CUTS"):
        monkeypatch.setattr(f"roughline.margins.scans.{name}", request.param)
    return request.param


def test_a_line_scan_is_pressed_with_an_interval(lines):
    heights = rl.SelfAffine(hurst=0.8, rms_height=1e-6, length=1e-3, q_roll=4e4).surface(256, 3)
    scan = rl.Line(heights.heights[10], 1e-3, "m", kind="profile")
    forces = np.geomspace(1e-2, 1, 4)
    found = rl.press_scan(scan, E_star=1e9, forces=forces, gaussian=True)
    again = rl.press_scan(scan, E_star=1e9, forces=forces, gaussian=True)
    assert (found.curve.stiffness == again.curve.stiffness).all()
    assert (found.low < found.curve.stiffness).all()
    assert (found.curve.stiffness < found.high).all()
    assert (found.curve.force == forces).all()
    assert found.curve.area_fraction is None
    assert "one line only" in found.curve.warnings[0]
    assert found.curve.settings["lines"] == lines
    found.curve.to_dataset()
    with pytest.raises(rl.InputError, match="this is a reduced line"):
        rl.press_scan(rl.Line(scan.heights, 1e-3), E_star=1e9, forces=forces)


def test_independent_spectra_add():
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1e-6, length=1e-3, q_roll=4e4)
    first, second = (rl.isotropic_spectrum(spectrum.surface(128, i)) for i in (1, 2))
    both = first + second
    assert both.C_2d == pytest.approx(first.C_2d + second.C_2d)
    assert both.rms_height == pytest.approx(math.sqrt(2) * 1e-6)
    smooth = rl.isotropic_spectrum(spectrum.surface(128, 2).scaled(1e-9))
    assert (first + smooth).C_2d == pytest.approx(first.C_2d)


@pytest.mark.usefixtures("lines")
def test_two_line_scans_are_pressed_as_one_of_root_two():
    spectrum = rl.SelfAffine(hurst=0.8, rms_height=1e-6, length=1e-3, q_roll=4e4)
    heights = spectrum.surface(256, 3).heights
    one, other = (rl.Line(heights[i], 1e-3, "m", kind="profile") for i in (10, 120))
    forces = [0.1, 1.0]
    both = rl.press_scan(one, E_star=1e9, forces=forces, against=other)
    alone, second = (rl.press_scan(scan, E_star=1e9, forces=forces) for scan in (one, other))
    # medians over what the scans leave open, of which the long waves are a third
    assert both.curve.rms_height == pytest.approx(
        math.hypot(alone.curve.rms_height, second.curve.rms_height), rel=0.15
    )
    assert (both.curve.stiffness < alone.curve.stiffness).all()
