"""What a thread keeps from one press for the next changes no bit of it."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import fields

import numpy as np
import pytest

import roughline as rl
from roughline.halfspace.elasticity.homogeneous import Homogeneous
from roughline.halfspace.inverse import cache
from roughline.halfspace.inverse.cache import inverse_on, working_memory

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
    [
        {},
        {"periodic": True},
        {"solver": rl.Solver(precision="float32"), "rtol": 1e-5},
        {"hardness": 0.5},
    ],
)
def test_what_is_kept_changes_no_bit(settings):
    anew = []
    for seed in (1, 2):
        cache._cache.clear()
        anew.append(press(seed, **settings))
    # the grid, the coarser ones that lead it, and windows of them for light loads
    assert len(cache._cache.inverses) >= 4
    before = set(cache._cache.inverses.values())
    for seed, expected in zip((1, 2), anew, strict=True):
        assert_same_bits(press(seed, **settings), expected)
    assert before <= set(cache._cache.inverses.values())


def test_threads_that_press_side_by_side_change_no_bit():
    expected = [press(seed, 257) for seed in range(4)]
    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(lambda seed: press(seed, 257), range(4)))
    for curve, other in zip(found, expected, strict=True):
        assert_same_bits(curve, other)


def test_a_grid_is_kept_for_the_next_who_asks():
    one = inverse_on(HALF_SPACE, (8, 8), SQUARE)
    assert inverse_on(Homogeneous(1.0), (8, 8), SQUARE) is one
    for half_space, shape, spacing in (
        (Homogeneous(2.0), (8, 8), SQUARE),
        (Homogeneous(1.0, periodic=True), (8, 8), SQUARE),
        (HALF_SPACE, (8, 9), SQUARE),
        (HALF_SPACE, (8, 8), (1.0, 2.0)),
    ):
        assert inverse_on(half_space, shape, spacing) is not one


def test_other_threads_have_their_own():
    one = inverse_on(HALF_SPACE, (8, 8), SQUARE)
    with ThreadPoolExecutor(1) as pool:
        other = pool.submit(inverse_on, HALF_SPACE, (8, 8), SQUARE).result()
    assert other is not one
    assert other.operator.workspace is not one.operator.workspace


def test_a_half_space_without_a_hash_is_not_kept():
    class Unhashed(Homogeneous):
        __hash__ = None

    inverse_on(Unhashed(1.0), (8, 8), SQUARE)
    assert not cache._cache.inverses


def test_working_memory_is_kept_unless_it_is_much_or_may_be_half_at_work(monkeypatch):
    workspace = cache._cache.workspace
    workspace.give_up()
    with working_memory():
        grid = workspace.array("grid", (3, 4), float)
    with working_memory():
        assert np.shares_memory(workspace.array("grid", (2, 2), np.float32), grid)
    with pytest.raises(KeyboardInterrupt), working_memory():
        raise KeyboardInterrupt
    assert not workspace.nbytes
    monkeypatch.setattr(cache, "MUCH_MEMORY", 95)
    with working_memory():
        workspace.array("grid", (3, 4), float)
        workspace.array("grid", (2, 2), float)
        assert workspace.nbytes == 96
    assert not workspace.nbytes


def test_grids_are_kept_as_far_as_they_have_room_the_last_ones_first(monkeypatch):
    sizes = {n: inverse_on(HALF_SPACE, (n, n), SQUARE).nbytes for n in range(5, 12)}
    cache._cache.clear()
    monkeypatch.setattr(cache, "_MOST_CACHED_BYTES", sizes[8] + sizes[9] + sizes[10])
    for n in (7, 8, 9, 10):
        inverse_on(HALF_SPACE, (n, n), SQUARE)
    found = [inverse.operator.shape for inverse in cache._cache.inverses.values()]
    assert found == [(8, 8), (9, 9), (10, 10)]
    for n in (8, 7):  # one that was kept, and one that takes the place of the last used
        inverse_on(HALF_SPACE, (n, n), SQUARE)
    found = [inverse.operator.shape for inverse in cache._cache.inverses.values()]
    assert found == [(10, 10), (8, 8), (7, 7)]
    monkeypatch.setattr(cache, "_MOST_CACHED_BYTES", sizes[11] - 1)
    inverse_on(HALF_SPACE, (11, 11), SQUARE)
    assert found == [inverse.operator.shape for inverse in cache._cache.inverses.values()]
