"""A surface cut into equal pieces."""

import numpy as np
import pytest

import roughline as rl
from roughline.contact.pieces import cut, laws_on_pieces


@pytest.mark.parametrize("shape", [(8, 8), (9, 14)])
@pytest.mark.parametrize("count", [1, 2, 4])
def test_pieces_cover_the_surface_row_by_row_without_their_tilt(shape, count):
    heights = np.random.default_rng(3).normal(size=shape)
    surface = rl.Surface(heights, (1.0, 2.0))
    pieces = cut(surface, count)
    assert len(pieces) == count**2
    rows = [np.concatenate([each.heights for each in pieces[i::count]]) for i in range(count)]
    assert np.concatenate(rows, axis=1).shape == shape
    assert sum(each.area for each in pieces) == pytest.approx(surface.area)
    first = surface.cropped((0, shape[0] // count), (0, shape[1] // count)).detrended()
    assert np.array_equal(pieces[0].heights, first.heights)


def test_a_law_that_is_even_is_the_same_on_each():
    surface, law = rl.Surface(np.zeros((8, 8)), (1.0, 1.0)), rl.Yielding(2.0)
    assert list(laws_on_pieces(surface, law, 2)) == [law] * 4
