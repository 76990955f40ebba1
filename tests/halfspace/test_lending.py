"""What is kept from one press for the next changes no bit of it, and nobody shares it."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import fields

import numpy as np
import pytest

import roughline as rl
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.search import lending
from roughline.halfspace.search.lending import lent

pytestmark = pytest.mark.usefixtures("nothing_kept")

HALF_SPACE = Homogeneous(1.0)
SQUARE = (1.0, 1.0)


def press(seed, n=300, **settings):
    surface = rl.SelfAffine(hurst=0.8, rms_height=1.0).surface(n, seed)
    return rl.press(surface, E_star=1.0, forces=[1e-4, 0.02, 0.3], fields=True, **settings)


def assert_same_bits(one, other):
    for name in ("depth", "force", "stiffness", "area_fraction", "residual", "convolutions"):
        assert (getattr(one, name) == getattr(other, name)).all(), name
    for found, expected in zip(one.fields, other.fields, strict=True):
        for each in fields(found):
            values = getattr(found, each.name)
            assert np.array_equal(values, getattr(expected, each.name)), each.name


@pytest.mark.parametrize(
    "settings",
    [{}, {"periodic": True}, {"precision": "float32", "rtol": 1e-5}, {"hardness": 0.5}],
)
def test_what_is_kept_changes_no_bit(settings):
    anew = []
    for seed in (1, 2):
        lending._kept.clear()
        anew.append(press(seed, **settings))
    assert len(lending._kept) == 4  # the grid, and the coarser ones that lead it
    kept = set(lending._kept.values())
    for seed, expected in zip((1, 2), anew, strict=True):
        assert_same_bits(press(seed, **settings), expected)
    assert set(lending._kept.values()) == kept


def test_threads_that_press_side_by_side_change_no_bit():
    expected = [press(seed, 257) for seed in range(4)]
    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(lambda seed: press(seed, 257), range(4)))
    for curve, other in zip(found, expected, strict=True):
        assert_same_bits(curve, other)


def test_a_grid_is_lent_to_one_at_a_time_and_kept_for_the_next():
    with lent(HALF_SPACE, (8, 8), SQUARE) as one, lent(HALF_SPACE, (8, 8), SQUARE) as other:
        assert one is not other
    with lent(HALF_SPACE, (8, 8), SQUARE) as again:
        assert again is one
    for half_space, shape, spacing in (
        (Homogeneous(2.0), (8, 8), SQUARE),
        (Homogeneous(1.0, periodic=True), (8, 8), SQUARE),
        (HALF_SPACE, (8, 9), SQUARE),
        (HALF_SPACE, (8, 8), (1.0, 1.1)),
    ):
        with lent(half_space, shape, spacing) as different:
            assert different is not one


def test_what_an_exception_left_half_done_is_not_kept():
    with pytest.raises(KeyboardInterrupt), lent(HALF_SPACE, (8, 8), SQUARE):
        raise KeyboardInterrupt
    assert not lending._kept


def test_few_points_are_kept_of_the_grids_used_last(monkeypatch):
    monkeypatch.setattr(lending, "_MOST_POINTS", 200)
    for n in (6, 8, 10, 15):
        with lent(HALF_SPACE, (n, n), SQUARE):
            pass
    assert [inverse.operator.shape for inverse in lending._kept.values()] == [
        (6, 6),
        (8, 8),
        (10, 10),
    ]
    with lent(HALF_SPACE, (6, 6), SQUARE):
        pass
    with lent(HALF_SPACE, (5, 5), SQUARE):
        pass
    assert [inverse.operator.shape for inverse in lending._kept.values()] == [
        (10, 10),
        (6, 6),
        (5, 5),
    ]
