"""Maps from above, as instruments' software shows them: x to the right, y from the top downwards.

They are thinned to the number of points that a picture can show.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.image import AxesImage
from numpy.typing import NDArray

from roughline.plot.style import in_unit

_MOST_PIXELS = 600  # along a side; a picture shows no more
_LEAST_SHOWN = 24  # points along a side of a piece of a map


def draw_map(
    axes: Axes, values: NDArray[Any], sizes: tuple[float, float], unit: str | None, **look: Any
) -> AxesImage:
    """Draw values over sides that have a given unit."""
    size = label_sides(axes, sizes, unit)
    return show_map(axes, values, (sizes[0] * size, sizes[1] * size), **look)


def show_map(
    axes: Axes, values: NDArray[Any], sides: tuple[float, float], **look: Any
) -> AxesImage:
    """Draw values over sides in the units of the axes."""
    extent = (0.0, sides[0], sides[1], 0.0)  # left, right, bottom, top
    return axes.imshow(values.T, origin="upper", extent=extent, **look)


def drawn_sides(image: AxesImage) -> tuple[float, float]:
    """Sides of a map that was drawn, in the units of its axes."""
    _, right, bottom, _ = image.get_extent()
    return right, bottom


def label_sides(axes: Axes, sizes: tuple[float, float], unit: str | None) -> float:
    """Label both axes of a map; returns the factor from lengths to those on the axes."""
    (x, size), (y, _) = (in_unit(name, sizes, unit) for name in "xy")
    axes.set(xlabel=x, ylabel=y)
    return size


def thinned(heights: NDArray[Any]) -> NDArray[Any]:
    """Every few points of a map."""
    steps = _steps(heights.shape)
    return heights[:: steps[0], :: steps[1]]


def any_marked(marks: NDArray[Any]) -> NDArray[Any]:
    """The largest mark within each pixel of a map, so that single ones show."""
    for axis, step in enumerate(_steps(marks.shape)):
        marks = np.maximum.reduceat(marks, np.arange(0, marks.shape[axis], step), axis=axis)
    return marks


def look_at(axes: Axes, image: AxesImage, marked: NDArray[np.bool_]) -> None:
    """Show the square piece that holds all marked points of a drawn map, if it is a small one."""
    sides, shape = drawn_sides(image), marked.shape
    places = [np.flatnonzero(marked.any(axis=1 - axis)) for axis in (0, 1)]
    if not places[0].size:
        return
    steps = [side / n for side, n in zip(sides, shape, strict=True)]
    middles = [
        (each[0] + each[-1] + 1) / 2 * step for each, step in zip(places, steps, strict=True)
    ]
    held = [(np.ptp(each) + 1) * step for each, step in zip(places, steps, strict=True)]
    side = max(1.5 * max(held), _LEAST_SHOWN * max(steps))
    if side > min(sides) / 2:
        return
    x, y = (
        min(max(middle, side / 2), whole - side / 2)
        for middle, whole in zip(middles, sides, strict=True)
    )
    axes.set(xlim=(x - side / 2, x + side / 2), ylim=(y + side / 2, y - side / 2))


def _steps(shape: tuple[int, ...]) -> list[int]:
    return [max(1, n // _MOST_PIXELS) for n in shape]
