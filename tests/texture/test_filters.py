"""The Gaussian filter of ISO 16610 and its borders."""

import numpy as np
import pytest

from known_surfaces import gaussian_field
from roughline.texture.filters import smoothed


@pytest.mark.parametrize("cutoff", [8.0, 16.0, 64.0])
def test_the_transmission_is_that_of_the_standard(cutoff):
    """exp(-π (α λc / λ)²), half at the cutoff."""
    wave = np.cos(2 * np.pi * np.arange(256) / 16)
    passed = smoothed(wave, (1.0,), cutoff, is_periodic=True)
    expected = np.exp(-np.log(2) * (cutoff / 16) ** 2)
    assert passed == pytest.approx(expected * wave, abs=1e-9)


def test_the_filter_is_the_weighted_mean_of_the_points_there_are():
    rng = np.random.default_rng(2)
    heights, spacings, cutoff = rng.normal(size=(13, 17)), (1.0, 2.0), 6.0
    alpha = np.sqrt(np.log(2) / np.pi)
    expected = heights
    for axis, (n, step) in enumerate(zip(heights.shape, spacings, strict=True)):
        x = step * np.arange(n)
        weights = np.exp(-np.pi * ((x[:, None] - x) / (alpha * cutoff)) ** 2)
        weights /= weights.sum(axis=1, keepdims=True)
        expected = np.moveaxis(np.tensordot(weights, expected, axes=(1, axis)), 0, axis)
    assert smoothed(heights, spacings, cutoff, is_periodic=False) == pytest.approx(expected)


def test_what_is_level_stays_level_up_to_the_border():
    level = np.full((20, 30), 7.0)
    assert smoothed(level, (1.0, 1.0), 9.0, is_periodic=False) == pytest.approx(level, rel=1e-14)


def test_a_crest_on_the_border_keeps_about_half():
    wave = np.cos(2 * np.pi * np.arange(2000) / 500)
    passed = smoothed(wave, (1.0,), 500.0, is_periodic=False)
    assert passed[[0, 1000]] == pytest.approx([0.5, 0.5], abs=3e-3)


def test_borders_are_near_those_of_the_larger_parent():
    """Pieces of a periodic field, filtered apart and with all of it: no border point stands out."""
    whole = gaussian_field(192, 5.0, 1)
    reference = smoothed(whole, (1.0, 1.0), 16.0, is_periodic=True)[:64, :64]
    piece = smoothed(whole[:64, :64], (1.0, 1.0), 16.0, is_periodic=False)
    wrong = np.abs(piece - reference)
    assert wrong[16:-16, 16:-16].max() < 1e-3 * np.ptp(whole)
    assert wrong.mean() < 0.05 * whole.std()


def test_a_map_one_point_wide_is_filtered_along_itself():
    heights = np.random.default_rng(0).normal(size=40)
    along = smoothed(heights, (1.0,), 7.0, is_periodic=False)
    assert smoothed(heights[None], (3.0, 1.0), 7.0, is_periodic=False)[0] == pytest.approx(along)
