"""Parameters of profiles whose values are known from their definitions."""

import numpy as np
import pytest

import roughline as rl
from known_surfaces import quantiles


def profile(heights, spacing=0.01, is_cut_out=True):
    length = spacing * heights.size
    return rl.Line(heights, length, "um", kind="profile", is_cut_out=is_cut_out)


def sine(waves=40, points=100):
    """Waves 1 µm long, the crests on points."""
    return np.sin(2 * np.pi * (np.arange(waves * points) + 0.5) / points)


def test_rz_is_the_mean_of_five_sections():
    """One pit 5 µm deep among waves of 2 µm: (4 x 2 + 6) / 5."""
    heights = sine(points=1000)
    heights[7750] = -5.0
    found = rl.iso(profile(heights, 0.001))
    assert found.Rz == pytest.approx(2.8, rel=1e-4)
    assert found.Rt == pytest.approx(6.0, rel=1e-4)
    assert found.Rp + found.Rv == pytest.approx(found.Rz)
    assert "over 5 sections of 8 um" in found.remarks[0]


def test_a_sine_has_its_heights_and_its_spacing():
    found = rl.iso(profile(sine(), is_cut_out=False))
    assert found.Ra == pytest.approx(2 / np.pi, rel=1e-3)
    assert found.Rq == pytest.approx(np.sqrt(0.5), rel=1e-9)
    assert found.Rku == pytest.approx(1.5)
    assert found.Rsk == pytest.approx(0.0, abs=1e-9)
    assert found.RSm == pytest.approx(1.0, rel=1e-6)
    forward = 2 * np.sin(np.pi / 100) / 0.01
    assert found.Rdq == pytest.approx(forward * np.sqrt(0.5), rel=1e-9)


def test_ripples_on_a_wave_are_no_profile_elements():
    rippled = sine() + 0.02 * np.random.default_rng(0).normal(size=4000)
    assert rl.iso(profile(rippled)).RSm == pytest.approx(1.0, rel=0.01)


def test_without_two_crossings_there_is_no_spacing():
    found = rl.iso(profile(np.linspace(0.0, 1.0, 50)))
    assert found.undefined["RSm"].startswith("there are fewer than two hills")


@pytest.mark.parametrize("points", [2, 5, 6, 39, 40, 43])
def test_sections_of_few_points_have_no_peak_and_pit_of_their_own(points):
    for seed in range(20):
        found = rl.iso(profile(np.random.default_rng(seed).standard_normal(points)))
        for name in ("Rp", "Rv", "Rz", "RSm"):
            assert (found.undefined.get(name) == "a section has less than 8 points") == (
                points < 40
            )
        if points >= 40:
            assert 0 < found.Rz <= found.Rt


def test_a_straight_profile_has_its_slope():
    found = rl.iso(profile(np.arange(50.0), spacing=10.0))
    assert found.Rdq == pytest.approx(0.1)
    assert found.Rdr == pytest.approx(0.498756, rel=1e-6)


def test_gaussian_profiles_have_the_layers_of_gaussian_surfaces():
    heights = np.random.default_rng(0).permutation(quantiles(10_000)[1])
    found = rl.iso(profile(heights))
    assert found.Rk == pytest.approx(2.57396, rel=1e-3)
    assert [found.Rpk, found.Rvk] == pytest.approx([0.94503, 0.94503], rel=2e-3)
    assert [found.Rmrk1, found.Rmrk2] == pytest.approx([9.9051, 90.0949], abs=0.02)


@pytest.mark.parametrize(("cutoff", "sections"), [(2.0, 5), (8.0, 5), (10.0, 4), (30.0, 1)])
def test_sections_are_as_long_as_the_cutoff(cutoff, sections):
    found = rl.iso(profile(sine()), l_filter=cutoff)
    plural = "s" if sections > 1 else ""
    assert f"over {sections} section{plural} of {cutoff:g} um" in found.remarks[0]
    assert found.body.length == pytest.approx(sections * cutoff)


def test_a_long_wave_is_filtered_off():
    wavy = sine() + 5 * np.sin(2 * np.pi * np.arange(4000) / 4000)
    found = rl.iso(profile(wavy), l_filter=4.0)
    assert found.Rq == pytest.approx(np.sqrt(0.5), rel=0.06)  # of which 1 - 2^-16 passes
    assert rl.iso(profile(wavy)).Rq > 3


def test_reduced_lines_are_refused():
    with pytest.raises(rl.InputError, match="made for springs, and no profile"):
        rl.iso(rl.Line(sine(), 40.0))
