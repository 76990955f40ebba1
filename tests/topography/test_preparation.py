"""Preparation of measured bodies: each step does what it says, and says that it did."""

import math
import tracemalloc

import numpy as np
import pytest

import roughline as rl
from roughline.topography import preparation
from roughline.topography.effects import effects
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
        ({"low_pass": -1.0}, "low_pass is -1"),
        ({"low_pass": math.inf}, "low_pass is inf"),
        ({"low_pass": "2 um"}, 'low_pass is "2 um"; a number without a unit'),
        ({"low_pass": True}, "low_pass is True"),
        ({"low_pass": 5e-3}, "low_pass is 5 mm, longer than the topography, 1 mm"),
        ({"low_pass": 1e3}, "low_pass is 1 km, longer than the topography"),
        ({"points": 1}, "points is 1; whole numbers of at least 2"),
        ({"points": 0}, "points is 0; whole numbers"),
        ({"points": -3}, "points is -3; whole numbers"),
        ({"points": 2.5}, "points is 2.5; whole numbers"),
        ({"points": math.nan}, "points is nan; whole numbers"),
        ({"points": "64"}, 'points is "64"; whole numbers'),
        ({"points": True}, "points is True; whole numbers"),
        ({"points": (1, 64)}, r"points is \(1, 64\); whole numbers"),
        ({"points": (64, 64, 64)}, r"points is \(64, 64, 64\); give 2 of them"),
        ({"points": 10**6}, "resampling to 1000000 x 1000000 points needs about .* GB of memory"),
        ({"points": 10**30}, "of memory, and .* GB is free: resample to fewer points"),
        ({"remove_outliers": "yes"}, 'remove_outliers is "yes"; True or False is needed'),
        ({"trend": []}, "trend is .*; allowed are"),
        ({"crop": "0 um, 5 um"}, 'crop is "0 um, 5 um"; give from and to'),
        ({"crop": 3}, "crop is 3; give from and to"),
        ({"crop": (math.nan, 1, 0, 1)}, "crop is .nan, 1, 0, 1.; give from and to"),
        ({"crop": (0, 1)}, "crop has 2 lengths; give 4"),
        ({"crop": (0, 2e-3, 0, 1e-3)}, "crop is 0 m to 2 mm; lengths that rise, within 0 m"),
        ({"crop": (5e-4, 1e-4, 0, 1e-3)}, "crop is 500 µm to 100 µm; lengths that rise"),
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


@pytest.mark.parametrize("points", [8, 40])
def test_a_line_is_resampled_to_so_many_points(points):
    x = (np.arange(20) + 0.5) / 20
    line = rl.Line(np.sin(2 * np.pi * x), 1.0, kind="profile")
    found = Preparation(points=points).applied(line)
    assert (found.heights.size, found.length) == (points, 1.0)
    there = np.sin(2 * np.pi * (np.arange(points) + 0.5) / points)
    assert np.abs(found.heights - there).max() < 0.1


@pytest.mark.parametrize("dimensions", [1, 2])
@pytest.mark.parametrize("factor", [0.37, 0.99, 1.5, 4])
def test_the_memory_of_a_preparation_is_known_before_the_work(monkeypatch, dimensions, factor):
    n = {1: 2**16, 2: 200}[dimensions]
    heights = np.random.default_rng(3).normal(size=(n,) * dimensions)
    body = as_measured(heights) if dimensions == 2 else rl.Line(heights, 1e-3, "m", kind="profile")
    lines = {"lines": "tilt", "remove_scars": True} if dimensions == 2 else {}
    steps = Preparation(
        **lines, remove_outliers=True, trend="curvature", low_pass=1e-4, points=int(factor * n)
    )
    steps.applied(body)  # what is loaded on the way counts only once
    known = []
    monkeypatch.setattr(preparation, "refuse_beyond_memory", lambda need, *_: known.append(need))
    tracemalloc.start()
    try:
        steps.applied(body)
        largest = tracemalloc.get_traced_memory()[1] + heights.nbytes
    finally:
        tracemalloc.stop()
    assert largest < 1.05 * known[0] + 2**20
    assert known[0] < 3 * largest


def notes(body, **steps):
    return [str(each.fact) for each in effects(Preparation(**steps).applied(body))]


def test_a_step_says_what_it_took_of_the_roughness():
    surface = as_measured(ROUGH.heights)
    said, _ = notes(surface, low_pass=2e-4)
    low = prepared(surface, Preparation(low_pass=2e-4))
    before = surface.cropped((10, 86), (10, 86))
    taken = [1 - getattr(low, name) / getattr(before, name) for name in ("rms_height", "rms_slope")]
    assert said == (
        f"the low pass of 200 µm lowers the rms height by {taken[0]:.0%} and the rms slope by "
        f"{taken[1]:.0%}"
    )
    assert notes(surface, remove_outliers=True) == ["no spikes are found, so none is removed"]
    (said,) = notes(surface, points=48)
    assert said.startswith("resampling to 48 x 48 points lowers the rms height by ")
    x = np.linspace(0, 1e-4, 96)
    (said,) = notes(as_measured(ROUGH.heights + x), trend="tilt")
    assert said.startswith("the removal of the tilt lowers the rms height by ")


@pytest.mark.parametrize(
    ("steps", "message"),
    [
        ({"low_pass": 1e-9}, "the low pass of 1 nm changes neither rms height nor rms slope"),
        ({"points": 96}, "resampling to 96 x 96 points changes neither rms height nor rms slope"),
        ({"crop": (0, 1e-3, 0, 1e-3)}, "the crop keeps all points: it changes nothing"),
        (
            {"low_pass": 9e-4},
            "most of the roughness is gone, and answers are those of what is left",
        ),
        ({"points": 2}, "most of the roughness is gone"),
    ],
)
def test_a_step_that_does_nothing_or_takes_most_is_warned_of(steps, message):
    surface = as_measured(ROUGH.heights).detrended()
    with pytest.warns(rl.PreparationWarning, match=message):
        prepared(surface, Preparation(**steps))


def test_a_press_warns_of_roughness_that_a_preparation_took():
    smooth = Preparation(low_pass=9e-4).applied(as_measured(ROUGH.heights))
    curve = rl.press(smooth, E_star=1e9, depths=[1e-8])
    assert any("most of the roughness is gone" in each for each in curve.warnings)


def test_a_crop_that_keeps_all_leaves_a_periodic_surface_periodic():
    whole = rl.Surface(ROUGH.heights, ROUGH.sizes, "m", is_cut_out=False)
    steps = Preparation(crop=(0, 1e-3, 0, 1e-3))
    assert not steps.applied(whole).is_cut_out
    assert whole.cropped((0, 95), (0, 96)).is_cut_out


def test_a_surface_that_is_one_point_wide_can_be_prepared():
    thin = rl.Surface(ROUGH.heights[:, :1], (1e-3, 1e-5), "m")
    found = prepared(thin, Preparation(crop=(0, 5e-4, 0, 1e-5), trend="tilt", points=24))
    assert found.shape == (24, 1)
