"""Maps thinned to the number of points that a picture can show."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

_MOST_PIXELS = 600  # along a side; a picture shows no more


def thinned(heights: NDArray[Any]) -> NDArray[Any]:
    """Every few points of a map."""
    steps = _steps(heights.shape)
    return heights[:: steps[0], :: steps[1]]


def any_marked(marks: NDArray[Any]) -> NDArray[Any]:
    """The largest mark within each pixel of a map, so that single ones show."""
    for axis, step in enumerate(_steps(marks.shape)):
        marks = np.maximum.reduceat(marks, np.arange(0, marks.shape[axis], step), axis=axis)
    return marks


def _steps(shape: tuple[int, ...]) -> list[int]:
    return [max(1, n // _MOST_PIXELS) for n in shape]
