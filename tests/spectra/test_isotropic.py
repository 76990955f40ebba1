"""The spectrum of a given surface, and the line that belongs to it."""

import numpy as np
import pytest

import roughline as rl
from roughline.spectra.isotropic import isotropic_spectrum


@pytest.mark.parametrize("hurst", [0.0, 0.5, 1.0])
def test_the_spectrum_of_a_generated_surface_is_the_given_one(hurst):
    spectrum = rl.SelfAffine(hurst=hurst, length=2.0, C_0=1e-9, q_high=64 * np.pi)
    found = isotropic_spectrum(spectrum.surface(256, rng=3))
    wanted = spectrum.C_2d(found.q[:62])
    assert found.q[:3] == pytest.approx([np.pi, 2 * np.pi, 3 * np.pi])
    assert found.C_2d[0] == pytest.approx(wanted[0], rel=1e-12)
    assert found.C_2d[1] == pytest.approx(wanted[1], rel=0.3)  # a ring of q = 2 and √5
    assert found.C_2d[4:62] == pytest.approx(wanted[4:], rel=0.12)
    assert found.C_2d[70:] == pytest.approx(0.0, abs=1e-6 * wanted[-1])
    assert found.C_reduced == pytest.approx(np.pi * found.q * found.C_2d)


def test_the_line_has_the_surfaces_rms_and_waves():
    spectrum = rl.SelfAffine(hurst=0.5, length=1e-3, rms_height=2e-6, q_high=32 * 2e3 * np.pi)
    surface = spectrum.surface(128, rng=1)
    line = isotropic_spectrum(surface).line(4096, rng=5)
    assert line.rms_height == pytest.approx(2e-6)
    assert line.length == pytest.approx(1e-3)
    power = np.abs(np.fft.rfft(line.heights))[1:] ** 2
    direct = np.abs(np.fft.rfft(spectrum.line(4096, rng=5).heights))[1:] ** 2
    assert power[:30] == pytest.approx(direct[:30], rel=0.3)
    assert power[40:].max() < 1e-20 * power[0]


def test_a_cut_out_surface_is_windowed():
    """A quarter of a surface has nearly the same spectrum, though its sides do not meet."""
    spectrum = rl.SelfAffine(hurst=0.8, length=1.0, rms_height=1.0)
    estimates = [
        isotropic_spectrum(spectrum.surface(512, rng=i).cropped((0, 256), (0, 256)))
        for i in range(12)
    ]
    found = np.mean([estimate.C_2d for estimate in estimates], axis=0)
    whole = isotropic_spectrum(spectrum.surface(512, rng=0))
    wanted = np.exp(np.interp(np.log(estimates[0].q), np.log(whole.q), np.log(whole.C_2d)))
    assert found[4:60] == pytest.approx(wanted[4:60], rel=0.5)
    assert found[20:60].mean() == pytest.approx(wanted[20:60].mean(), rel=0.1)


@pytest.mark.parametrize("ratio", [100.0, 1e30])
@pytest.mark.parametrize("is_cut_out", [True, False])
def test_pixels_far_from_square_show_no_waves_along_both_sides(ratio, is_cut_out):
    """A line scan beside the next, far from it: moments of all directions are not known."""
    heights = np.random.default_rng(0).standard_normal((24, 20))
    surface = rl.Surface(heights, (24e-6, 20e-6 * ratio), "m", is_cut_out=is_cut_out)
    with pytest.raises(rl.InputError, match="times as long as wide.*resample the finer side"):
        isotropic_spectrum(surface)
    assert rl.roughness(surface).spectrum is None


def test_bad_input():
    with pytest.raises(rl.InputError, match="a spectrum needs 8 x 8 or more"):
        isotropic_spectrum(rl.Surface(np.random.default_rng(0).random((4, 9)), (1.0, 1.0)))
    with pytest.raises(rl.InputError, match="they have no spectrum"):
        isotropic_spectrum(rl.Surface(np.ones((9, 9)), (1.0, 1.0)))
    surface = rl.SelfAffine(hurst=0.5, rms_height=1.0).surface(64, rng=0)
    with pytest.raises(rl.InputError, match="waves need"):
        isotropic_spectrum(surface).line(32)
