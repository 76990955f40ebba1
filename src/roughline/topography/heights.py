"""Heights, sizes and units, checked, and the rms of heights."""

from __future__ import annotations

from typing import Any

import numpy as np

from roughline.computing.arrays import Real
from roughline.errors import InputError
from roughline.errors.checks import refuse, shown
from roughline.units import is_unit_of_length

_LARGEST_LENGTH = 1e150  # beyond it, squares of lengths leave the range of double precision
_BLOCK = 2**16  # heights summed at a time


def checked_heights(heights: Any, dimensions: int, body: str = "") -> Real:
    """Return heights as a read-only array of finite numbers, without a copy where possible."""
    if isinstance(heights, np.ma.MaskedArray):
        missing = int(np.count_nonzero(np.ma.getmaskarray(heights)))
        if missing:
            raise InputError(
                f"{missing} of {heights.size} heights are masked; all must be known: fill them "
                "or crop to where they are"
            )
        heights = heights.data
    try:
        array = np.asarray(heights)
        if np.iscomplexobj(array):
            raise TypeError("complex")
        array = np.asarray(array, dtype=np.float64)
        if not array.flags.f_contiguous:  # instruments' maps often run along y first; left so
            array = np.ascontiguousarray(array)
        array = array.view()
    except (TypeError, ValueError, OverflowError) as error:
        what = "complex numbers" if str(error) == "complex" else shown(heights)
        raise InputError(f"are not an array of real numbers, but {what}", "heights") from error
    if array.ndim != dimensions:
        name = body or {1: "a Line", 2: "a Surface"}[dimensions]
        raise InputError(
            f"the heights have {array.ndim} dimensions; {name} takes {dimensions}: reshape them"
        )
    largest = max(array.max(), -array.min()) if array.size else 0.0  # NaN if any height is
    if not np.isfinite(largest):
        bad = array.size - int(np.count_nonzero(np.isfinite(array)))
        raise InputError(
            f"{bad} of {array.size} heights are NaN or infinite; all must be finite: fill or crop "
            "them first"
        )
    if largest > _LARGEST_LENGTH:
        raise InputError(f"heights reach {largest:.3g}; at most {_LARGEST_LENGTH:g}: rescale")
    array.flags.writeable = False
    return array


def checked_radii(radii: Any) -> Real:
    """Return radii of a profile as a read-only array that rises from zero."""
    needed = "numbers that rise from zero, at least two, are needed"
    try:
        given = np.ma.asarray(radii)
    except (TypeError, ValueError, OverflowError):
        refuse("radii", radii, needed)
    if given.dtype.kind not in "iuf" or given.ndim != 1 or given.size < 2:
        refuse("radii", radii, needed)
    array = np.ma.filled(given.astype(np.float64), np.nan)
    if array[0] != 0 or not (np.diff(array) > 0).all():
        refuse("radii", radii, needed)
    if not _is_length(array[-1]):
        refuse(
            "radii",
            radii,
            f"the largest is {array[-1]:g}, and at most {_LARGEST_LENGTH:g} is allowed",
        )
    array.flags.writeable = False
    return array


def checked_unit(unit: str | None) -> str | None:
    """Return the unit of a body's lengths."""
    if unit is not None and not is_unit_of_length(unit):
        refuse("unit", unit, 'a unit of length is needed, such as "um", "mm" or "m"')
    return unit


def checked_sides(sizes: Any) -> tuple[float, float]:
    """Return the sides of a surface."""
    try:
        sides = tuple(float(size) for size in sizes)
    except (TypeError, ValueError, OverflowError):
        sides = ()
    if len(sides) != 2 or not all(map(_is_length, sides)):
        refuse("sizes", sizes, "give two positive, finite numbers (Lx, Ly)")
    return sides


def checked_length(length: Any) -> float:
    """Return the length of a line."""
    try:
        value = float(length)
    except (TypeError, ValueError, OverflowError):
        value = np.nan
    if not _is_length(value):
        refuse("length", length, "a positive, finite number is needed")
    return value


def rms_deviation(heights: Real) -> float:
    """Root-mean-square deviation from the mean height. [length]"""
    lowest, highest = float(heights.min()), float(heights.max())
    if lowest == highest:
        return 0.0  # rounding of the mean is no roughness
    mean = float(heights.mean())
    return rms(heights, mean, max(highest - mean, mean - lowest))


def rms(values: Real, mean: float = 0.0, largest: float | None = None) -> float:
    """Root of the mean square deviation, neither overflowing nor underflowing on the way.

    Blocks are summed one at a time, so that large arrays need no memory of their own size.

    Deviations are from `mean`; the largest of them is computed where it is not given.
    """
    if largest is None:
        largest = float(max(values.max(initial=0.0), -values.min(initial=0.0)))
    if largest == 0.0:
        return 0.0
    flat, total = values.ravel(order="K"), 0.0
    for start in range(0, flat.size, _BLOCK):
        deviations = (flat[start : start + _BLOCK] - mean) / largest
        total += float(np.einsum("i,i->", deviations, deviations))
    return float(np.sqrt(total / flat.size)) * largest


def _is_length(value: float) -> bool:
    return 1 / _LARGEST_LENGTH < value < _LARGEST_LENGTH
