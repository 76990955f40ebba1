"""Pieces of a topography: which points lie in a crop."""

from __future__ import annotations

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.units import in_words

Crop = tuple[float, ...]
"""From and to along each side: (x0, x1, y0, y1) of a map, (x0, x1) of a line. [length]"""


def points_in(
    crop: Crop, sides: tuple[float, ...], shape: tuple[int, ...], unit: str | None
) -> tuple[slice, ...]:
    """Return the points along each side that a crop keeps."""
    _refuse_misplaced(crop, sides, unit)
    points = []
    for low, high, side, n in zip(crop[::2], crop[1::2], sides, shape, strict=True):
        first, end = round(low / (side / n)), min(round(high / (side / n)), n)
        if n > 1 or end == first:  # a body that is one point wide keeps that
            _refuse_few((low, high), end - first, unit)
        points.append(slice(first, end))
    return tuple(points)


def points_between(crop: Crop, positions: Real) -> tuple[slice]:
    """Return the points of an uneven line that a crop keeps.

    Lengths are in metres.
    """
    _refuse_misplaced(crop, (float(positions[-1]),), "m")
    first, end = (int(each) for each in np.searchsorted(positions, crop))
    _refuse_few(crop, end - first, "m")
    return (slice(first, end),)


def ranges_in_words(points: tuple[slice, ...]) -> str:
    """Points that are kept along each side, in words that settings hold."""
    ranges = [f"{each.start}:{each.stop}" for each in points]
    return ranges[0] if len(points) == 1 else f"x {ranges[0]}, y {ranges[1]}"


def _refuse_misplaced(crop: Crop, sides: tuple[float, ...], unit: str | None) -> None:
    """Refuse a crop that has not two lengths for each side, or is not within it."""
    if len(crop) != 2 * len(sides):
        raise InputError(
            f"has {len(crop)} lengths; give {2 * len(sides)}, from and to along each side", "crop"
        )
    for low, high, side in zip(crop[::2], crop[1::2], sides, strict=True):
        if not 0 <= low < high <= side * (1 + 1e-9):
            raise InputError(
                f"is {_from_to(low, high, unit)}; lengths that rise, within "
                f"{_from_to(0, side, unit)}, are needed",
                "crop",
            )


def _refuse_few(crop: Crop, points: int, unit: str | None) -> None:
    """Refuse a crop that keeps fewer than two points along a side."""
    if points < 2:
        raise InputError(
            f"is {_from_to(crop[0], crop[1], unit)}, which keeps {points} points; take more", "crop"
        )


def _from_to(low: float, high: float, unit: str | None) -> str:
    return f"{in_words(low, unit)} to {in_words(high, unit)}"
