"""What a single surface shows of the difference between the two models."""

import numpy as np
import pytest

from roughline.comparison.models import difference_of_one, scatter_of_surfaces


def test_the_interval_beside_one_surface_holds_its_scatter(published_results):
    """Each of 60 surfaces alone, against what all of them say of the two models."""
    surfaces, lines = published_results.full, published_results.matched
    half = 2  # loads, eight a decade: F̄ / 1.8
    shares = []
    for dimension in surfaces.fractal_dimension.values:
        full, reduced = (
            data.sel(fractal_dimension=dimension).stiffness.values for data in (surfaces, lines)
        )
        truth = (full.mean(axis=0) / reduced.mean(axis=0) - 1)[half:]
        at_half, reduced = reduced[:, :-half], reduced[:, half:]
        scatter = scatter_of_surfaces(reduced, at_half)
        ends = [difference_of_one(surface[half:], reduced, scatter)[1:] for surface in full]
        low, high = np.array(ends).transpose(1, 0, 2)
        shares.append(((low <= truth) & (truth <= high)).mean(axis=0))
    # 60 surfaces: 95 % less three standard errors is 87 %
    assert np.min(shares) > 0.86
    assert np.mean(shares) > 0.95


def test_of_surfaces_that_do_not_scatter_the_error_of_the_lines_is_left():
    lines = np.exp(np.random.default_rng(1).normal(0, 0.2, (200, 3)))
    difference, low, high = difference_of_one(np.full(3, 1.5), lines, np.zeros(3))
    error = lines.std(axis=0, ddof=1) / np.sqrt(200) / lines.mean(axis=0)
    assert difference == pytest.approx(1.5 / lines.mean(axis=0) - 1)
    for end, sign in ((low, -1), (high, 1)):
        assert np.log1p(end) == pytest.approx(np.log1p(difference) + sign * 1.97 * error)
