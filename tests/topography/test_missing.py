"""Missing points: filled, counted, and described in words."""

import numpy as np
import pytest

import roughline as rl
from roughline.topography.missing import Filler, Missing, missing_pattern


def masked_wave(n=48, share=0.05):
    x = np.linspace(-1, 1, n)
    heights = x[:, np.newaxis] ** 2 - x**2  # harmonic, so one of the methods is exact
    mask = np.random.default_rng(1).random((n, n)) < share
    mask[0] = mask[-1] = mask[:, 0] = mask[:, -1] = False
    return heights, np.ma.MaskedArray(heights, mask)


def test_harmonic_filling_is_exact_for_a_harmonic_surface_and_nearest_is_near():
    heights, masked = masked_wave()
    assert Filler().filled(masked, "a map") == pytest.approx(heights, abs=1e-12)
    near = Filler(Missing("nearest")).filled(masked, "a map")
    assert np.abs(near - heights).max() < 0.2
    assert (near[~masked.mask] == heights[~masked.mask]).all()
    line = np.ma.MaskedArray(np.arange(9.0), np.arange(9) % 4 == 2)
    assert Filler(Missing(most=0.5)).filled(line, "a line") == pytest.approx(np.arange(9.0))


def test_a_missing_point_may_hold_any_number_even_one_that_a_processor_signals():
    heights, masked = masked_wave()
    bits = np.where(masked.mask, 0x7FF0000000000001, heights.view("i8"))  # a signalling NaN
    masked = np.ma.MaskedArray(bits.view("f8"), masked.mask)
    assert Filler().filled(masked, "a map") == pytest.approx(heights, abs=1e-12)


def with_corner_missing(heights, share=0.28):
    mask = np.zeros(heights.shape, bool)
    mask[tuple(slice(0, round(share * n)) for n in heights.shape)] = True
    return np.ma.MaskedArray(heights, mask)


@pytest.mark.parametrize("method", ["harmonic", "nearest"])
@pytest.mark.parametrize("axes", [1, 2])
def test_what_is_filled_leans_with_the_rest(axes, method):
    rough = np.random.default_rng(3).normal(size=(40, 30)[:axes])
    x = np.indices(rough.shape)
    plane = 7.0 + 0.9 * x[0] - 0.4 * x[-1]
    level, leaning = (
        Filler(Missing(method, 0.5)).filled(with_corner_missing(each), "a map")
        for each in (rough, rough + plane)
    )
    np.testing.assert_allclose(leaning - plane, level, atol=1e-10)
    bowl = plane + 0.05 * (x[0] - 3) ** 2 + 0.02 * x[0] * x[-1]
    level, bent = (
        Filler(Missing(method, 0.5), "curvature").filled(with_corner_missing(each), "a map")
        for each in (rough, rough + bowl)
    )
    np.testing.assert_allclose(bent - bowl, level, atol=1e-10)


def test_one_known_row_tells_no_slope_across_it():
    heights = np.ma.MaskedArray(np.tile(np.arange(5.0), (6, 1)), True)
    heights.mask[2] = False
    filled = Filler(Missing(most=0.9)).filled(heights, "a map")
    np.testing.assert_allclose(filled, heights.data, atol=1e-12)


def test_too_many_missing_points_are_refused_with_numbers():
    _, masked = masked_wave(share=0.3)
    with pytest.raises(
        rl.InputError, match=r"a map has \d+ missing points of 2304 \(\d\d%\); up to"
    ):
        Filler().filled(masked, "a map")
    everything = np.ma.MaskedArray(np.ones((3, 3)), True)
    with pytest.raises(rl.InputError, match="9 missing points of 9"):
        Filler(Missing(most=0.99)).filled(everything, "a map")
    with pytest.raises(rl.InputError, match='missing is "spline"'):
        Missing("spline")
    with pytest.raises(rl.InputError, match="most_missing is 1"):
        Missing(most=1.0)


def missing_at(*pieces, shape=(40, 60)):
    unknown = np.zeros(shape, dtype=bool)
    for piece in pieces:
        unknown[piece] = True
    return missing_pattern(unknown)


@pytest.mark.parametrize(
    ("pieces", "said"),
    [
        ([], "none"),
        ([np.s_[10:20, 5:9]], "one region, inside"),
        ([np.s_[:, :7]], "one region, at the border"),
        ([np.s_[:30, :40], np.s_[35, 50]], "mostly one region, at the border"),
        ([np.s_[10:20, 5:9], np.s_[10:20, 20:24]], "2 regions, inside"),
        ([np.s_[0:10, 5:9], np.s_[10:20, 20:24]], "2 regions, at the border and inside"),
        ([np.s_[2:-2:4, 2:-2:4]], "scattered in 126 places, inside"),
    ],
)
def test_where_points_are_missing_is_said_in_words(pieces, said):
    assert str(missing_at(*pieces)) == said


def test_a_coarse_map_shows_the_share_that_is_missing_in_each_piece():
    found = missing_at(np.s_[:, :15], np.s_[0, 59])
    assert (found.count, found.regions, found.largest, found.at_border) == (601, 2, 600, 601)
    columns, rows = found.cells.shape
    assert (columns, rows) == (21, 16)  # about twice as many as square characters would need
    assert (found.cells[:, : rows // 4] == 1).all()
    assert (found.cells[:, rows // 4 : -1] == 0).all()
    assert found.cells[0, -1] > 0
    line = missing_at(np.s_[30:], shape=(60,))
    assert line.cells.shape == (48,)
    assert line.cells[:24].sum() == 0
    assert (line.cells[24:] == 1).all()
