"""A surface cut into equal pieces, each without its tilt, and the contact law there."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import pairwise

import numpy as np

from roughline.contact.grid_error import field_on
from roughline.halfspace.laws.law import ContactLaw
from roughline.topography.body import Surface


def cut(surface: Surface, count: int) -> list[Surface]:
    """Cut a surface into so many pieces along each side, row by row, each without its tilt."""
    return [surface.cropped(*each).detrended() for each in _windows(surface, count)]


def laws_on_pieces(surface: Surface, law: ContactLaw, count: int) -> Iterator[ContactLaw]:
    """The contact law of a surface on each of these pieces."""
    for x, y in _windows(surface, count):
        yield law.on(partial(field_on, surface, partial(Surface.cropped, x=x, y=y)))


def _windows(surface: Surface, count: int) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """First points of the pieces along both sides, and one more than the last."""
    ends = [np.linspace(0, n, count + 1).astype(int).tolist() for n in surface.shape]
    along_x, along_y = (list(pairwise(each)) for each in ends)
    return [(x, y) for x in along_x for y in along_y]
