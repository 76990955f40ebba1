"""Preparation of measured bodies: each step does what it says, and says that it did."""

import math

import numpy as np
import pytest

import roughline as rl
from roughline.topography.preparation import Preparation, outliers, prepared
from roughline.topography.trend import without_trend

ROUGH = rl.SelfAffine(hurst=0.7, length=1e-3, rms_height=1e-6, q_high=4e5).surface(96, 4)
X, Y = np.meshgrid(np.linspace(-1, 1, 96), np.linspace(-1, 1, 96), indexing="ij")


def as_measured(heights, sizes=(1e-3, 1e-3)):
    return rl.Surface(heights, sizes, "m", is_cut_out=True)


@pytest.mark.parametrize(
    ("trend", "added", "gone"),
    [
        ("mean", 5.0 + 0 * X, True),
        ("mean", X, False),
        ("tilt", 5 + X - 2 * Y, True),
        ("tilt", X**2, False),
        ("curvature", 1 + X - Y + 3 * X**2 - X * Y + Y**2, True),
        ("curvature", X**2 * Y, False),
    ],
)
def test_a_trend_is_removed_whole_and_nothing_beyond_it(trend, added, gone):
    plain = without_trend(ROUGH.heights, trend)
    found = without_trend(ROUGH.heights + 1e-6 * added, trend)
    assert (np.abs(found - plain).max() < 1e-18) == gone
    assert without_trend(found, trend) == pytest.approx(found, abs=1e-19)


def test_curvature_is_the_least_squares_fit():
    """Against the normal equations, on a grid that is not square."""
    x, y = np.meshgrid(np.arange(7.0), np.arange(5.0), indexing="ij")
    h = np.random.default_rng(2).normal(size=x.shape)
    terms = np.stack([f.ravel() for f in (x**0, x, y, x * x, x * y, y * y)], axis=1)
    fit = terms @ np.linalg.lstsq(terms, h.ravel(), rcond=None)[0]
    assert without_trend(h, "curvature").ravel() == pytest.approx(h.ravel() - fit, abs=1e-12)


def test_of_a_piece_the_trend_is_removed_that_was_removed_of_the_whole():
    tilted = as_measured(ROUGH.heights + 1e-5 * X)
    piece = Preparation(crop=(0, 5e-4, 0, 1e-3))
    for trend in ("tilt", "curvature"):
        found = prepared(tilted.detrended(trend), piece)
        again = without_trend(tilted.heights[:48], trend)
        assert found.heights == pytest.approx(again, abs=1e-18)
        assert found.settings["detrended"] == trend
    for kept in (tilted, rl.Surface(tilted.heights, tilted.sizes)):
        assert (prepared(kept).heights == tilted.heights).all()
        assert (prepared(kept, piece).heights == tilted.heights[:48]).all()
        assert (prepared(kept, Preparation(remove_outliers=True)).heights == tilted.heights).all()
    level = tilted.detrended()
    left = prepared(level, Preparation(crop=piece.crop, trend="none"))
    assert (left.heights == level.heights[:48]).all()


def test_spikes_are_counted_and_removed_only_when_asked():
    heights = ROUGH.heights.copy()
    heights[[10, 40, 40, 80], [20, 50, 51, 3]] += 2e-5
    spiky = as_measured(heights)
    assert np.count_nonzero(outliers(spiky)) == 4
    assert not outliers(ROUGH).any()
    kept = prepared(spiky)
    assert kept.settings["outliers_kept"] == 4
    removed = prepared(spiky, Preparation(remove_outliers=True, trend="none"))
    assert removed.settings["outliers_removed"] == 4
    assert np.abs(removed.heights - ROUGH.heights).max() < 5e-7
    line = rl.Line(np.sin(np.arange(200) / 9), 1.0, kind="profile")
    assert not outliers(line).any()
    particle = ROUGH.heights.copy()
    particle[30:34, 30:34] += 2e-5  # sixteen points: a feature
    assert not outliers(as_measured(particle)).any()
    assert not outliers(as_measured(np.zeros((8, 8)))).any()


def test_wide_spikes_of_line_scans_are_found():
    """A stylus is wider than the distance of points, so dust is some dozen points wide."""
    x = np.arange(4000)
    rng = np.random.default_rng(3)
    clean = np.cumsum(rng.normal(size=x.size)) * 1e-9 + 1e-7 * np.sin(x / 700)
    dust = sum(2e-7 * np.exp(-(((x - at) / 4) ** 2)) for at in (500, 1730, 3100))
    scan = rl.Line(clean + dust, 1e-3, "m", kind="profile")
    assert not outliers(rl.Line(clean, 1e-3, kind="profile")).any()
    found = outliers(scan)
    assert all(found[at - 3 : at + 4].all() for at in (500, 1730, 3100))
    assert found.sum() < 120
    cleaned = prepared(scan, Preparation(remove_outliers=True))
    assert (
        np.abs(cleaned.heights - prepared(rl.Line(clean, 1e-3, "m", scan.settings)).heights).max()
        < 5e-8
    )


def test_cropping_keeps_the_points_and_the_spacing():
    found = prepared(
        as_measured(ROUGH.heights), Preparation(crop=(0, 5e-4, 2.5e-4, 1e-3), trend="none")
    )
    assert found.shape == (48, 72)
    assert found.spacing == pytest.approx(ROUGH.spacing)
    assert (found.heights == ROUGH.heights[:48, 24:]).all()
    assert "cropped" in found.settings
    line = rl.Line(np.arange(100.0), 1.0, kind="profile")
    piece = prepared(line, Preparation(crop=(0.25, 0.5), trend="none"))
    assert (piece.heights == np.arange(25.0, 50.0)).all()
    assert piece.length == pytest.approx(0.25)
    assert piece.kind == "profile"


def test_the_low_pass_halves_a_wave_of_its_cutoff():
    n, wave = 512, 1e-4
    x = np.arange(n) * 1e-3 / n
    line = rl.Line(np.cos(2 * np.pi * x / wave), 1e-3, kind="profile")
    found = prepared(line, Preparation(low_pass=wave, trend="none"))
    assert found.heights[100:400].max() == pytest.approx(0.5, rel=2e-3)  # ISO 16610-21
    assert found.settings["low_pass"] == wave
    long = prepared(line, Preparation(low_pass=wave / 3, trend="none"))
    assert long.heights[100:400].max() == pytest.approx(0.5 ** (1 / 9), rel=2e-3)


def test_resampling_takes_means_or_splines():
    coarse = prepared(ROUGH, Preparation(points=48, trend="none"))
    assert coarse.heights == pytest.approx(ROUGH.coarsened().heights, abs=1e-20)
    assert coarse.sizes == ROUGH.sizes
    odd = prepared(ROUGH, Preparation(points=(50, 31), trend="none"))
    assert odd.heights.mean() == pytest.approx(ROUGH.heights.mean(), abs=1e-18)
    smooth = rl.Surface(np.cos(2 * X) * np.sin(Y), (1, 1))
    fine = prepared(smooth, Preparation(points=192, trend="none"))
    assert fine.coarsened().heights[2:-2, 2:-2] == pytest.approx(
        smooth.heights[2:-2, 2:-2], abs=1e-3
    )
    assert fine.settings["resampled_to"] == "192 x 192"


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"trend": "cubic"}, 'trend is "cubic"; allowed are "none", "mean", "tilt"'),
        ({"low_pass": 0.0}, "low_pass is 0"),
        ({"low_pass": math.nan}, "low_pass is nan"),
        ({"points": 1}, "points is 1; whole numbers of at least 2"),
        ({"crop": (0, 1)}, "crop has 2 lengths; give 4"),
        ({"crop": (0, 2e-3, 0, 1e-3)}, "crop from 0 to 0.002 is not within 0 to 0.001"),
        ({"crop": (5e-4, 1e-4, 0, 1e-3)}, "or not rising"),
        ({"crop": (0, 1e-6, 0, 1e-3)}, "keeps 0 points; take more"),
    ],
)
def test_what_cannot_be_done_is_said(settings, message):
    with pytest.raises(rl.InputError, match=message):
        prepared(as_measured(ROUGH.heights), Preparation(**settings))
    with pytest.raises(rl.InputError, match="give 1 of them"):
        prepared(rl.Line(np.arange(9.0), 1.0), Preparation(points=(4, 4)))


@pytest.mark.parametrize("hurst", [0.2, 0.5, 0.8, 1.0])
def test_random_roughness_has_no_spikes(hurst):
    spectrum = rl.SelfAffine(hurst=hurst, rms_height=1.0)
    for seed in range(5):
        surface = spectrum.surface(256, seed, "gaussian")
        assert not outliers(surface).any()
        assert not outliers(rl.Line(surface.heights[7], 1.0, kind="profile")).any()
