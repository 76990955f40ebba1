"""Parameters of surfaces whose values are known from their definitions."""

import numpy as np
import pytest

import roughline as rl
from known_surfaces import (
    cosine,
    gaussian_field,
    grid,
    quantiles,
    scattered,
    stripes,
    surface,
)


@pytest.mark.parametrize("axis", [0, 1])
def test_a_plane_has_its_slope_whatever_the_cells(axis):
    heights = 0.1 * grid(64, 48, dy=2.0)[axis]
    found = rl.iso(surface(heights, dy=2.0))
    assert found.Sdq == pytest.approx(0.1, rel=1e-12)
    assert found.Sdr == pytest.approx(0.498756, rel=1e-6)


@pytest.mark.parametrize(("waves", "forward"), [(4, 0.138617), (16, 0.541196)])
def test_slopes_are_forward_differences_around_a_periodic_surface(waves, forward):
    found = rl.iso(surface(cosine(waves), is_cut_out=False))
    assert found.Sdq == pytest.approx(forward, rel=1e-5)
    steps = np.diff(np.append(cosine(waves)[:, 0], 1.0))
    assert found.Sdr == pytest.approx(100 * np.mean(np.sqrt(1 + steps**2) - 1), rel=1e-9)


def test_the_developed_area_is_the_mean_of_both_ways_to_split_a_cell():
    """A corner lifted by h: triangles of slopes (h, h), twice of one and 0, and 0, from sqrt."""
    found = rl.iso(surface(np.array([[0.0, 0.0], [0.0, 1.0]])))
    split_across = (1 + np.sqrt(3)) / 2
    split_through = np.sqrt(2)
    expected = 100 * ((split_across + split_through) / 2 - 1)
    assert found.Sdr == pytest.approx(expected, rel=1e-12)


def test_uniform_heights_have_a_core_alone():
    heights, _ = quantiles(100**2)
    found = rl.iso(surface(scattered(heights)))
    layers = [found.Sk, found.Spk, found.Svk, found.Smr1, found.Smr2]
    assert layers == pytest.approx([1, 0, 0, 0, 100], abs=1e-9)
    volumes = [found.Vmp, found.Vmc, found.Vvc, found.Vvv]
    assert volumes == pytest.approx([0.005, 0.315, 0.385, 0.020], abs=1e-8)
    assert found.Sa == pytest.approx(0.25)


def test_gaussian_heights_have_the_layers_of_their_distribution():
    """The fitted line gives 2.57396; the secant itself would be 2.62200."""
    _, heights = quantiles(256**2)
    found = rl.iso(surface(scattered(heights)))
    assert found.Sk == pytest.approx(2.57396, abs=1e-4)
    assert [found.Spk, found.Svk] == pytest.approx([0.94503, 0.94503], rel=1e-4)
    assert [found.Smr1, found.Smr2] == pytest.approx([9.9051, 90.0949], abs=2e-3)  # of a point
    volumes = [found.Vmp, found.Vmc, found.Vvc, found.Vvv]
    assert volumes == pytest.approx([0.04734, 0.90592, 1.21726, 0.11164], abs=2e-5)
    assert found.Sku == pytest.approx(3.0, abs=1e-3)
    assert found.Ssk == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("step", "exact"),
    [
        (0.1, {"Sk": 2.6603, "Spk": 0.9665, "Smr1": 8.850, "Vmp": 0.0455}),
        (0.25, {"Spk": 0.8799}),
    ],
)
def test_points_of_equal_height_are_counted(step, exact):
    _, heights = quantiles(256**2)
    found = rl.iso(surface(scattered(step * np.round(heights / step))))
    for name, value in exact.items():
        assert getattr(found, name) == pytest.approx(value, rel=1e-3), name


@pytest.mark.parametrize("offset", [0.0, 0.1, 1e3 / 3])
def test_plateaus_are_kept_whole(offset):
    """The core is the first flat part; what is above it is a hill, what is below it a dale."""
    half = rl.iso(surface(offset + scattered(np.repeat([0.0, 1.0], 128))))
    assert [half.Sk, half.Spk, half.Svk] == pytest.approx([0, 0, 2], abs=1e-9)
    assert [half.Smr1, half.Smr2] == pytest.approx([50, 50])
    quarter = rl.iso(surface(offset + scattered(np.repeat([0.0, 1.0], [192, 64]))))
    assert [quarter.Sk, quarter.Spk, quarter.Svk] == pytest.approx([0, 2, 0], abs=1e-9)
    assert [quarter.Smr1, quarter.Smr2] == pytest.approx([25, 25])


def test_a_cosine_decays_where_it_is_known_to():
    exact = 32 * np.arccos(0.2) / (2 * np.pi)  # 6.9745
    endless = rl.iso(surface(cosine(4), is_cut_out=False))
    assert endless.Sal == pytest.approx(exact, rel=1e-5)
    assert endless.Std == 0
    assert endless.undefined["Str"].endswith("Str is below 0.11")
    pieces = [
        rl.iso(surface(np.cos(2 * np.pi / 32 * (grid(128)[0] + shift))), trend="tilt").Sal
        for shift in range(0, 32, 4)
    ]
    assert np.mean(pieces) == pytest.approx(exact, rel=0.01)
    assert pieces == pytest.approx([exact] * len(pieces), rel=0.04)  # the phase at the borders


@pytest.mark.parametrize("dy", [1.0, 2.0])
def test_a_gaussian_field_decays_as_its_autocorrelation(dy):
    exact = 8 * np.sqrt(np.log(5))  # 10.149 where dy = 1
    fields = [gaussian_field(256, 8.0, seed) for seed in range(4)]
    found = [rl.iso(surface(each[:, :: int(dy)], dy=dy, is_cut_out=False)) for each in fields]
    # the fastest of all directions: chance makes it shorter, by 7 % at 32 lengths a side
    assert np.mean([each.Sal for each in found]) == pytest.approx(exact, rel=0.1)
    assert min(each.Str for each in found) > 0.8


def test_a_lag_within_half_of_the_map_is_needed():
    """Of a wave half as long as the map and more, no autocorrelation is known to decay."""
    found = rl.iso(surface(stripes(0.0, n=64, wavelength=700.0)[:8]))
    assert (
        found.undefined["Sal"] == "the autocorrelation does not fall to 0.2 within half of the map"
    )
    assert found.undefined["Str"] == found.undefined["Std"] == found.undefined["Sal"]


@pytest.mark.parametrize("ratio", [1.0, 1e6])
@pytest.mark.parametrize("height", [1.0, 1e-300])
def test_cells_of_any_shape_and_heights_of_any_unit_decay_alike(ratio, height):
    heights = height * np.cos(2 * np.pi * np.arange(32) / 16)[:, None] * np.ones(24)
    surface = rl.Surface(heights, (32.0, 24.0 * ratio), is_cut_out=False)
    assert rl.iso(surface).Sal == pytest.approx(16 * np.arccos(0.2) / (2 * np.pi), rel=1e-3)


def test_a_short_map_is_told():
    field = gaussian_field(256, 8.0, 5)
    assert rl.iso(surface(field)).remarks == ()
    (told,) = rl.iso(surface(field[:48, :200])).remarks
    assert "autocorrelation lengths wide" in told


@pytest.mark.parametrize("dy", [1.0, 2.0])
@pytest.mark.parametrize(("lay", "direction"), [(0, 90), (90, 0), (30, 60), (150, 120), (17, 73)])
def test_the_direction_is_that_of_the_waves_with_the_first_row_at_the_top(lay, direction, dy):
    found = rl.iso(surface(stripes(lay, dy=dy), dy=dy))
    assert found.Std == pytest.approx(direction, abs=0.02)


def test_every_hill_within_the_map_is_a_peak():
    x, y = grid(128)
    q = 2 * np.pi / 16
    heights = np.cos(q * (x - 8)) + np.cos(q * (y - 8))
    for is_cut_out in (True, False):
        found = rl.iso(surface(heights, is_cut_out=is_cut_out))
        assert found.Spd * 128**2 == pytest.approx(64)
        assert found.Spc == pytest.approx(q**2, rel=1e-5)  # 0.15421
    on_borders = rl.iso(surface(np.cos(q * x) + np.cos(q * y)))
    assert on_borders.Spd * 128**2 == pytest.approx(
        49
    )  # those on the first row and column are none
    around = rl.iso(surface(np.cos(q * x) + np.cos(q * y), is_cut_out=False))
    assert around.Spd * 128**2 == pytest.approx(64)


def test_hills_lower_than_a_twentieth_do_not_count():
    """One hill of height 1, and one that stands `low` above the saddle to it."""
    for low, peaks in ((0.04, 1), (0.06, 2)):
        heights = np.zeros((9, 12))
        heights[4, 3:9] = [1.0, 0.8, 0.5, 0.5 + low, 0.4, 0.2]
        assert rl.iso(surface(heights)).Spd * 108 == pytest.approx(peaks)


@pytest.mark.parametrize("is_cut_out", [True, False])
@pytest.mark.parametrize("lay", [0, 90, 45])
def test_ridges_are_no_peaks(lay, is_cut_out):
    wavelength = 16 / np.sqrt(2) if lay == 45 else 16.0  # so that all of them are periodic
    found = rl.iso(surface(stripes(lay, wavelength=wavelength), is_cut_out=is_cut_out))
    assert found.Spd == 0
    assert found.undefined["Spc"].startswith("there is no peak")


def test_peaks_are_those_of_a_search_by_thresholds():
    """A hill counts if its peak is alone among points that lie less than 5 % of Sz below it."""
    from scipy import ndimage

    heights = gaussian_field(64, 3.0, 7)[:40, :50]
    least = 0.05 * np.ptp(heights)
    count = 0
    for i in range(40):
        for j in range(50):
            labels, _ = ndimage.label(heights > heights[i, j] - least, np.ones((3, 3)))
            top = labels == labels[i, j]
            is_inside = not (top[[0, -1]].any() or top[:, [0, -1]].any())
            count += is_inside and heights[top].max() == heights[i, j]
    assert rl.iso(surface(heights)).Spd * 2000 == pytest.approx(count)


def test_surfalize_agrees_where_it_is_exact():
    peer = pytest.importorskip("surfalize")
    heights = gaussian_field(128, 4.0, 3)
    found, other = rl.iso(surface(heights)), peer.Surface(heights, 1.0, 1.0)
    for name in ("Sq", "Sa", "Sp", "Sv", "Sz", "Ssk", "Sku"):
        assert getattr(found, name) == pytest.approx(getattr(other, name)(), rel=1e-6), name
    for name in ("Sdq", "Sdr", "Sk", "Spk", "Svk", "Vmp", "Vmc", "Vvc", "Vvv"):
        assert getattr(found, name) == pytest.approx(getattr(other, name)(), rel=0.01), name
