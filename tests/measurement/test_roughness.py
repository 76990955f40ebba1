"""Roughness parameters against their definitions."""

import math

import numpy as np
import pytest
from scipy import stats

import roughline as rl
from roughline.measurement.roughness import roughness

ROUGH = rl.SelfAffine(hurst=0.7, rms_height=1e-6, length=1e-3, q_roll=3e4).surface(128, 3)


def test_amplitudes_are_the_textbook_ones():
    found = roughness(ROUGH)
    h = ROUGH.heights.ravel()
    assert found.rms_height == pytest.approx(h.std(), rel=1e-12)
    assert found.skewness == pytest.approx(stats.skew(h), rel=1e-9)
    assert found.kurtosis == pytest.approx(stats.kurtosis(h, fisher=False), rel=1e-9)
    assert found.rms_slope == ROUGH.rms_slope
    assert found.isotropy > 0.9
    assert found.remarks == []


def test_summits_are_counted():
    x = np.arange(64) / 64
    waves = np.cos(8 * np.pi * x)[:, np.newaxis] * np.cos(6 * np.pi * x)
    found = roughness(rl.Surface(waves, (1.0, 1.0)))
    # 4 x 3 cells have two summits each; those on the border are not seen
    assert found.summits in range(12, 25)
    line = rl.Line(np.sin(2 * np.pi * 5.2 * np.arange(300) / 300), 1.0, kind="profile")
    assert roughness(line).summits == 5
    assert roughness(line).isotropy is None


def test_directions_are_told_apart():
    stretched = rl.Surface(ROUGH.heights, (1e-3, 4e-3), "m")
    found = roughness(stretched)
    assert found.isotropy == pytest.approx(0.25, rel=0.1)
    assert any("slopes differ by direction" in text for text in found.remarks)
    turned = np.array([[1.0, 0.5], [0.5, 1.0]])  # a plane wave across the diagonal
    x, y = np.indices((64, 64)) / 64
    diagonal = rl.Surface(np.cos(2 * np.pi * 4 * (turned[0, 0] * x + turned[1, 1] * y)), (1, 1))
    assert roughness(diagonal).isotropy < 0.05


@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e9])
def test_shape_does_not_depend_on_scale(scale):
    one = roughness(rl.Surface(ROUGH.heights * 1e6, (1.0, 1.0)))
    other = roughness(rl.Surface(ROUGH.heights * 1e6 * scale, (scale, scale)))
    assert other.skewness == pytest.approx(one.skewness, rel=1e-9)
    assert other.kurtosis == pytest.approx(one.kurtosis, rel=1e-9)
    assert other.summits == one.summits
    assert other.fit.hurst == one.fit.hurst


def test_what_has_no_spectrum_still_has_its_amplitudes():
    flat = roughness(rl.Surface(np.zeros((16, 16)), (1.0, 1.0)))
    assert math.isnan(flat.skewness)
    assert flat.spectrum is None
    assert "they have no spectrum" in flat.remarks[0]
    thin = roughness(rl.Surface(np.random.default_rng(0).normal(size=(1, 90)), (1.0, 90.0)))
    assert math.isnan(thin.isotropy)
    assert "8 x 8 or more" in thin.remarks[0]
    with pytest.raises(rl.InputError, match="this is a reduced line"):
        roughness(rl.SelfAffine(hurst=0.5, rms_height=1.0).line(64, 1))


def test_a_bow_takes_the_intervals_of_the_law_down_until_it_is_removed():
    spectrum = rl.SelfAffine(hurst=0.7, rms_height=1.0, q_roll=50.0)
    x = np.linspace(-1, 1, 64)
    heights = spectrum.surface(128, 5, "gaussian").heights[:64, :64]
    bowed = rl.Surface(heights + 3 * (x[:, np.newaxis] ** 2 + x**2), (0.5, 0.5), is_cut_out=True)
    fit = rl.roughness(bowed).fit
    assert not fit.is_judged
    assert "a bow of rms height" in fit.objections[0]
    level = rl.prepared(bowed, rl.Preparation(trend="curvature"))
    low, high = rl.roughness(level).fit.hurst_interval
    assert low <= 0.7 <= high
