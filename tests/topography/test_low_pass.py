"""The low pass halves a wave of its cutoff everywhere, and tells what it leaves out."""

import numpy as np
import pytest

import roughline as rl
from roughline.topography.effects import effects

N, SIDE, WAVE = 256, 1e-3, 1e-4
WAVES = rl.SelfAffine(hurst=0.7, length=SIDE, rms_height=1e-6, q_roll=4 * 2 * np.pi / SIDE)


def low_passed(body, cutoff=WAVE, **steps):
    return rl.Preparation(low_pass=cutoff, **steps).applied(body)


def wave(length=WAVE, phase=0.0):
    x = (np.arange(N) + 0.5) * SIDE / N
    return np.cos(2 * np.pi * x / length + phase)


@pytest.mark.parametrize("phase", [0.0, 0.9, 1.6])
def test_a_wave_of_the_cutoff_is_halved_up_to_the_ends_of_what_stays(phase):
    line = rl.Line(wave(phase=phase), SIDE, kind="profile", is_cut_out=True)
    found = low_passed(line)  # ISO 16610-21
    left = round(WAVE / 2 / line.spacing)
    assert found.heights.size == N - 2 * left
    assert found.length == pytest.approx((N - 2 * left) * line.spacing)
    half = 0.5 * wave(phase=phase)[left:-left]
    assert found.heights == pytest.approx(half, abs=5e-3)
    assert found.heights[left:-left] == pytest.approx(half[left:-left], abs=1e-3)
    third = low_passed(line, WAVE / 3)
    assert third.heights[left:-left].max() == pytest.approx(0.5 ** (1 / 9), rel=2e-3)


def test_a_periodic_body_keeps_all_points_and_its_wave_is_halved_at_the_border_too():
    heights = wave()[:, None] * np.ones(N)
    found = low_passed(rl.Surface(heights, (SIDE, SIDE), "m", is_cut_out=False))
    assert found.shape == (N, N)
    assert not found.is_cut_out
    assert found.heights == pytest.approx(0.5 * heights, abs=2e-3)
    assert [str(each.fact) for each in effects(found)] == [
        "the low pass of 100 µm lowers the rms height by 50% and the rms slope by 50%"
    ]


@pytest.mark.parametrize("seed", range(3))
def test_a_piece_is_filtered_as_the_surface_that_it_was_cut_out_of(seed):
    whole = WAVES.surface(N, seed)
    large = low_passed(whole)  # periodic
    at = (slice(30, 158), slice(70, 198))
    found = low_passed(whole.cropped(*((each.start, each.stop) for each in at)))
    left = round(WAVE / 2 / whole.spacing[0])
    expected = large.heights[at][left:-left, left:-left]
    assert found.heights == pytest.approx(expected, abs=0.02 * large.rms_height)


def test_what_is_left_out_at_borders_is_said_and_recorded():
    piece = WAVES.surface(N, 1).cropped((0, 128), (0, 64))
    found = low_passed(rl.Surface(piece.heights, piece.sizes, "m", is_cut_out=True))
    assert found.shape == (102, 38)
    assert found.spacing == pytest.approx(piece.spacing)
    _, said = (str(each.fact) for each in effects(found))
    assert said == (
        "half a cutoff of the low pass is left out at each border, beyond which no heights are "
        "known: 398.4 µm x 148.4 µm stay, and loads act on them"
    )
    assert found.settings["low_pass_kept"] == "x 13:115, y 13:51"
    assert "low_pass_kept" not in found.cropped((0, 9), (0, 9)).settings
    thin = low_passed(rl.Surface(piece.heights[:, :1], (5e-4, 4e-6), "m", is_cut_out=True))
    assert thin.shape == (102, 1)


def test_a_low_pass_that_leaves_nothing_is_refused():
    piece = rl.Surface(WAVES.surface(N, 1).heights, (SIDE, SIDE / 4), "m", is_cut_out=True)
    with pytest.raises(rl.InputError, match="half of it is left out at each border, and of a side"):
        low_passed(piece, SIDE / 4)
    whole = rl.Surface(piece.heights, piece.sizes, "m", is_cut_out=False)
    assert "most of the roughness" in str(effects(low_passed(whole, SIDE))[0].fact)
